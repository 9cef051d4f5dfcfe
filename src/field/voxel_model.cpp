#include "lekalo/field/voxel_model.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::field {
namespace {

struct Unit {
  geom::Point middle;
  double length;
};

Unit unit_of(const GridFrame& frame) {
  const geom::Point low = frame.origin, high = frame.node(frame.columns - 1, frame.rows - 1);
  return {0.5 * (low + high), std::max(norm(high - low) / 2, frame.pitch)};
}

}  // namespace

VoxelImages voxel_images(const FieldGrid& grid, std::uint16_t palette) {
  VoxelImages result{grid.frame, palette, {}};
  for (auto& image : result.images) image.resize(grid.frame.size());
  const Unit unit = unit_of(grid.frame);
  for (std::size_t j = 0; j < grid.frame.rows; ++j) {
    for (std::size_t i = 0; i < grid.frame.columns; ++i) {
      const std::size_t n = j * grid.frame.columns + i;
      const geom::Point at = (1 / unit.length) * (grid.frame.node(i, j) - unit.middle);
      const double a = static_cast<double>(grid.dx[n]), b = static_cast<double>(grid.dy[n]);
      const double u = static_cast<double>(grid.value[n]) / unit.length;
      const std::array<double, 4> plane{a, b, -1, u - a * at.x - b * at.y};
      double square = 0;
      for (const double component : plane) square += component * component;
      for (std::size_t k = 0; k < 4; ++k)
        result.images[k][n] =
            static_cast<std::uint16_t>(std::floor(palette * (1 + plane[k] / std::sqrt(square)) / 2 + 0.5));
    }
  }
  return result;
}

Jet read_node(const VoxelImages& images, std::size_t i, std::size_t j) {
  const std::size_t n = j * images.frame.columns + i;
  std::array<double, 4> plane{};
  for (std::size_t k = 0; k < 4; ++k)
    plane[k] = 2.0 * static_cast<double>(images.images[k][n]) / static_cast<double>(images.palette) - 1;
  const Unit unit = unit_of(images.frame);
  const geom::Point at = (1 / unit.length) * (images.frame.node(i, j) - unit.middle);
  const geom::Point gradient{-plane[0] / plane[2], -plane[1] / plane[2]};
  return {unit.length * (dot(gradient, at) - plane[3] / plane[2]), gradient};
}

ReadingError reading_error(const VoxelImages& images, std::size_t i, std::size_t j, const Jet& node) {
  const Unit unit = unit_of(images.frame);
  const geom::Point at = (1 / unit.length) * (images.frame.node(i, j) - unit.middle);
  const double u = node.value / unit.length, d = u - dot(node.gradient, at);
  const double k = std::sqrt(dot(node.gradient, node.gradient) + 1 + d * d);
  const double qk = k / images.palette;
  constexpr double kRounding = 1e-12;
  if (!(qk < 1)) return {HUGE_VAL, HUGE_VAL};
  return {unit.length * (qk * (std::abs(at.x) + std::abs(at.y) + std::abs(u) + 1) / (1 - qk) + kRounding),
          qk * (1 + norm(node.gradient)) / (1 - qk) + kRounding};
}

}  // namespace lekalo::field

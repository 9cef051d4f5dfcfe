#include "lekalo/field/voxel_model.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/stop.hpp"

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
    ask(1 + grid.frame.columns);
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

}  // namespace lekalo::field

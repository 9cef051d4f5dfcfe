#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lekalo/base/double_of_text.hpp"
#include "lekalo/draw/grey_png.hpp"
#include "lekalo/field/voxel_model.hpp"

namespace lekalo::cases {

/// Reads functional-voxel images and their pictures back, as whoever has nothing else would.

namespace voxel_detail {

/// Half the diagonal of the grid, and a node counted in it from the grid's middle.
struct Unit {
  geom::Point middle;
  double length;
};
inline Unit unit_of(const field::GridFrame& frame) {
  const geom::Point low = frame.origin, high = frame.node(frame.columns - 1, frame.rows - 1);
  return {0.5 * (low + high), std::max(norm(high - low) / 2, frame.pitch)};
}

inline std::string text_of(const draw::GreyImage& image, const char* key) {
  for (const auto& [name, value] : image.texts)
    if (name == key) return value;
  return {};
}

}  // namespace voxel_detail

/// Value and gradient at a node, from the images alone.
inline field::Jet read_node(const field::VoxelImages& images, std::size_t i, std::size_t j) {
  const std::size_t n = j * images.frame.columns + i;
  std::array<double, 4> plane{};
  for (std::size_t k = 0; k < 4; ++k)
    plane[k] = 2.0 * static_cast<double>(images.images[k][n]) / static_cast<double>(images.palette) - 1;
  const voxel_detail::Unit unit = voxel_detail::unit_of(images.frame);
  const geom::Point at = (1 / unit.length) * (images.frame.node(i, j) - unit.middle);
  const geom::Point gradient{-plane[0] / plane[2], -plane[1] / plane[2]};
  return {unit.length * (dot(gradient, at) - plane[3] / plane[2]), gradient};
}

/// How far read_node may be from the grid's own value (mm) and each component of its gradient, at a node with
/// this value and gradient: with q = 1 / palette the rounding of each n_i and k = 1 / |n_C|, q k (|X| + |Y| +
/// |U| + 1) / (1 - q k) half diagonals, and q k (1 + |gradient|) / (1 - q k).
struct ReadingError {
  double value = 0, gradient = 0;
};
inline ReadingError reading_error(const field::VoxelImages& images, std::size_t i, std::size_t j,
                                  const field::Jet& node) {
  const voxel_detail::Unit unit = voxel_detail::unit_of(images.frame);
  const geom::Point at = (1 / unit.length) * (images.frame.node(i, j) - unit.middle);
  const double u = node.value / unit.length, d = u - dot(node.gradient, at);
  const double k = std::sqrt(dot(node.gradient, node.gradient) + 1 + d * d);
  const double qk = k / images.palette;
  constexpr double kRounding = 1e-12;
  if (!(qk < 1)) return {HUGE_VAL, HUGE_VAL};
  return {unit.length * (qk * (std::abs(at.x) + std::abs(at.y) + std::abs(u) + 1) / (1 - qk) + kRounding),
          qk * (1 + norm(node.gradient)) / (1 - qk) + kRounding};
}

/// Gives the images that draw::voxel_pngs was given back from the bytes of its pictures A, B, C, D, or
/// bad_input that begins with the letter of the picture that is not the one expected.
inline Result<field::VoxelImages> parse_voxel_pngs(const std::array<std::string, 4>& pictures) {
  field::VoxelImages model;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string letter(1, static_cast<char>('A' + k));
    LEKALO_TRY(const draw::GreyImage image, draw::parse_grey_png(pictures[k], letter));
    const auto number = [&](const char* key) { return double_of_text(voxel_detail::text_of(image, key)); };
    const auto x = number("origin x mm"), y = number("origin y mm"), pitch = number("pitch mm"),
               palette = number("palette");
    if (voxel_detail::text_of(image, "lekalo M-image") != letter || !x || !y || !pitch || !palette)
      return failure(ErrorCode::bad_input, letter + ": no M-image of this letter with its numbers");
    model.frame = {{*x, *y}, *pitch, image.columns, image.rows};
    model.palette = static_cast<std::uint16_t>(*palette);
    // Node (i, j) is pixel i of row j from below.
    for (std::size_t row = image.rows; row-- > 0;)
      for (std::size_t i = 0; i < image.columns; ++i)
        model.images[k].push_back(image.pixels[row * image.columns + i]);
  }
  return model;
}

}  // namespace lekalo::cases

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lekalo/field/grid.hpp"

namespace lekalo::field {

/// Functional-voxel model (Tolok & Tolok, Scientific Visualization 14(3), 2022): at each node the local
/// linear function A x + B y + C u + D = 0, kept as four grey pictures, one for each component of the unit
/// vector n along (A, B, C, D): M_i = palette (1 + n_i) / 2. The pictures and four numbers are all there is.
///
/// So that n is not nearly all D, x and y count from the middle of the grid in units of its half diagonal,
/// and u in the same unit.
struct VoxelImages {
  GridFrame frame;
  std::uint16_t palette = 65535;
  std::array<std::vector<std::uint16_t>, 4> images;  ///< of A, B, C, D
};

/// \pre palette > 1
[[nodiscard]] VoxelImages voxel_images(const FieldGrid& grid, std::uint16_t palette = 65535);

/// Value and gradient at a node, from the pictures alone.
[[nodiscard]] Jet read_node(const VoxelImages& images, std::size_t i, std::size_t j);

/// How far read_node may be from the grid's own value (mm) and each component of its gradient, at a node with
/// this value and gradient: with q = 1 / palette the rounding of each n_i and k = 1 / |n_C|, q k (|X| + |Y| +
/// |U| + 1) / (1 - q k) half diagonals, and q k (1 + |gradient|) / (1 - q k).
struct ReadingError {
  double value = 0, gradient = 0;
};
[[nodiscard]] ReadingError reading_error(const VoxelImages& images, std::size_t i, std::size_t j,
                                         const Jet& node);

}  // namespace lekalo::field

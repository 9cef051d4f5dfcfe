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

}  // namespace lekalo::field

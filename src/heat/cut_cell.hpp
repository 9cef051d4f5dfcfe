#pragma once

#include <array>

namespace lekalo::heat {

/// Values at the corners of a voxel; corner n lies at x, y, z = bits 0, 1, 2 of n.
using Corners = std::array<double, 8>;

/// Share of a square, of whose corners (around it) the values are given, on which they are positive; linear
/// in each of the four triangles about the middle.
[[nodiscard]] double open_share(double a, double b, double c, double d);

struct CutCell {
  double share = 0;  ///< of the volume, in [0, 1]
  double wall = 0;   ///< area of the zero inside
};
/// \param pitch  of the voxel along x, y, z
[[nodiscard]] CutCell cut_cell(const Corners& value, const std::array<double, 3>& pitch);

}  // namespace lekalo::heat

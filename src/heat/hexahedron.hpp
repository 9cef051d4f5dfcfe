#pragma once

#include <array>
#include <cstddef>

namespace lekalo::heat {

inline constexpr std::size_t kCorners = 8, kComponents = 3, kUnknowns = kCorners * kComponents;

/// A voxel as an elastic body. Corner n lies at x, y, z = bits 0, 1, 2 of n; unknown 3 n + c is its
/// displacement along axis c.
struct Hexahedron {
  std::array<std::array<double, kUnknowns>, kUnknowns> stiffness{};  ///< N/mm
  /// Forces by an expansion of 1, and by one that grows from -1 to 1 along each axis; N.
  std::array<std::array<double, 4>, kUnknowns> load{};
  std::array<std::array<double, kUnknowns>, 6> strain{};  ///< at the middle: xx, yy, zz, yz, zx, xy
  double youngs = 0, poisson = 0;

  /// Stress by von Mises of a strain from which the expansion is taken.
  [[nodiscard]] double mises(const std::array<double, 6>& strain) const;
};
[[nodiscard]] Hexahedron hexahedron_of(const std::array<double, 3>& pitch, double youngs, double poisson);

}  // namespace lekalo::heat

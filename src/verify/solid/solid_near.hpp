#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "placed_solid.hpp"
#include "verify/number/both.hpp"

namespace lekalo::verify {

/// The points at + x a + y b + z c with x, y, z from 0 to 1, none of which is nearer to the blank's surface
/// than `apart`.
struct FarBody {
  /// A side of it: its points have normal . q from `level` on.
  struct Side {
    Exact3 normal;
    Fraction level;
  };
  std::array<Side, 6> sides;  ///< x >= 0, x <= 1, y >= 0, y <= 1, z >= 0, z <= 1
  Fraction apart;
};

/// Makes the body of a row of a certificate: at, a, b, c and `apart`. Says why it is none.
[[nodiscard]] std::optional<std::string> fault_of_body(const PlacedSolid& blank,
                                                       const std::array<Decimal, 13>& row, FarBody& body);

/// How far the farthest point of some triangles is from a surface. Widths do not count.
struct FarthestOf {
  double low = 0, high = 0;
  bool open = false;  ///< true where it was given up before it was known well enough
};

/// Cuts the triangles until no point is shown to be farther than `said`, or the farthest is known within
/// `within`.
[[nodiscard]] FarthestOf farthest_of(const PlacedSolid& part, const std::vector<std::uint32_t>& triangles,
                                     const PlacedSolid& blank, double said, double within);

/// Holds how far the farthest point is said to be from the surface against the triangles: it may be no
/// farther, and no nearer by more than `slack`, as far as it is known `within`. Says what is false.
/// \param is_open  set where it was given up before it was known
[[nodiscard]] std::optional<std::string> fault_of_farthest(const PlacedSolid& part,
                                                           const std::vector<std::uint32_t>& triangles,
                                                           const PlacedSolid& blank, Span said, double slack,
                                                           double within, bool& is_open);

/// Encloses how far points of a part are from a surface, off what they should be: the root of the mean square
/// over 600 points of some triangles (docs/formats.md, "Criteria"). Widths do not count.
/// \param triangles  at least one; and of each the target of its points, or none, in their order
[[nodiscard]] Span deviation_of(const PlacedSolid& part, const std::vector<std::uint32_t>& triangles,
                                const std::vector<std::optional<double>>& targets, const PlacedSolid& blank);

}  // namespace lekalo::verify

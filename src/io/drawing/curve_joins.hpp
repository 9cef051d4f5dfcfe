#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/geom/point.hpp"

namespace lekalo::io {

/// An open curve for joining: its two ends, and how far it reaches.
struct OpenCurve {
  geom::Point from, to;
  double reach = 0;  ///< mm: about the diagonal of its box
  bool used = true;  ///< false: left out
};

/// End 2 i is the first point of curve i, end 2 i + 1 its last.
using EndNumber = std::uint32_t;
inline constexpr EndNumber kNoEnd = 0xffffffff;

struct CurveJoins {
  /// The end that each end is joined with, or kNoEnd.
  std::vector<EndNumber> partner;
  /// Ends near which another end has no partner either, so that it cannot be told which of them is meant;
  /// ascending.
  std::vector<EndNumber> undecided;
  /// An end with more than kMostEndsNearby others about it. If there is one, nothing was joined.
  std::optional<EndNumber> crowded;
};

/// More loose ends than this within about twice the reach of a join are no drawing of contours.
inline constexpr std::size_t kMostEndsNearby = 64;

/// Joins ends in pairs. Two ends are joined when they are at most `tolerance` apart, both still free, and no
/// other free end is within the tolerance of one of them and at most twice as far from it; nearest pairs
/// first, so that what coincides is joined before what is only near. The two ends of one curve count as a
/// pair only when the curve reaches at least four times as far as they are apart.
///
/// The result does not depend on anything but the numbers. Cost: O(n log n).
[[nodiscard]] CurveJoins join_ends(const std::vector<OpenCurve>& curves, double tolerance);

/// Returns the places where three ends or more meet, one of them without a partner: all ends of each place,
/// ascending, also those that have a partner. Ends belong to one place when they are within the tolerance of
/// each other and one of the two has no partner, or are partners. Where more than kMostEndsNearby different
/// points lie close together, or points in a row lead farther than four times the tolerance, only equal ones
/// are of one place. Cost: O(n log n).
[[nodiscard]] std::vector<std::vector<EndNumber>> branchings(const std::vector<OpenCurve>& curves,
                                                             const CurveJoins& joins, double tolerance);

}  // namespace lekalo::io

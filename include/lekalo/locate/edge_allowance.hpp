#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::locate {

/// The allowance along the outline of a placed part, edge by edge, for regions of lines and arcs with holes
/// and several pieces; a polygon is a region of lines. At a point of the outline it is the distance to the
/// blank's boundary, negative outside the blank's material. (allowance.hpp measures point contours of any
/// shape, also ones that cross themselves, and decides sides exactly; here every edge has its extremes,
/// proved.)

/// A point of the part's outline and the material over it.
struct OutlinePoint {
  double along = 0;               ///< mm of arc length from the edge's `from`
  geom::Point in_part, in_blank;  ///< the point in either frame, mm
  double allowance = 0;           ///< mm; 0 where it cannot be told from 0
  /// The nearest edge of the blank.
  std::uint32_t blank_edge = 0;
};

struct EdgeAllowance {
  double length = 0;  ///< mm
  /// The samples in order from `from` to `to`, both ends included, at most `step` apart; `least` and `most`
  /// are among them.
  std::vector<OutlinePoint> samples;
  OutlinePoint least, most;
  /// No point of the edge has less allowance than `least_low`, and none has more than `most_high`. These are
  /// off the two points above by at most the tolerance asked for and the rounding (more after kMostSplits).
  /// For an arc whose ends differ in their radii they are those of the curve that region.hpp means.
  double least_low = 0, most_high = 0;
};

/// A request for more samples than this is refused: 600 MB.
inline constexpr std::size_t kMaxOutlinePoints = 10'000'000;
/// The extremes of an edge are searched in at most this many steps each.
inline constexpr std::size_t kMostSplits = 100'000;

/// Measures the allowance of every edge. The least allowance of an edge that nothing crosses comes from the
/// closed formulas of geom/edge_distance.hpp, and the other extremes are found by branch and bound over
/// stretches of the edge. A stretch from a to b has at most (f(a) + f(b) + length) / 2, because the distance
/// to a set changes by no more than the way. It also has at most the largest distance of its points from any
/// one edge of the blank: for a line its ends', since the distance from a convex set is convex.
///
/// \pre regions made by make_region, at least one in each, not crossing themselves or each other
/// Errors: usage when step or tolerance is not > 0 (step may be infinite), or more than kMaxOutlinePoints.
/// Cost: O((s + k) log m), s samples, m edges of the blank, k stretches: a few dozen for an edge along an
/// edge, some thousand for an arc along another at 1e-4 mm.
[[nodiscard]] Result<std::vector<EdgeAllowance>> edge_allowances(const std::vector<geom::Region>& part,
                                                                 const std::vector<geom::Region>& blank,
                                                                 const geom::BlankFromPart& pose, double step,
                                                                 double tolerance);

/// A place of the part where the blank has no material.
struct MissingPlace {
  geom::Point in_part, in_blank;
  /// The distance to the nearest material of the blank, mm, > 0.
  double depth = 0;
};

/// Finds where the part reaches furthest beyond the blank's material, also inside the part, over a hole of
/// the blank for instance: the deepest place, then the deepest more than `apart` mm from those before, at
/// most `most`. Each is at most 1/64 of its depth and `tolerance` less deep than the deepest possible there,
/// where kMostSplits steps were enough to find it.
///
/// \pre as above; tolerance > 0. Cost: O(log n) a square of a quadtree, some thousand squares a place.
[[nodiscard]] std::vector<MissingPlace> missing_material(const std::vector<geom::Region>& part,
                                                         const std::vector<geom::Region>& blank,
                                                         const geom::BlankFromPart& pose, std::size_t most,
                                                         double apart, double tolerance);

}  // namespace lekalo::locate

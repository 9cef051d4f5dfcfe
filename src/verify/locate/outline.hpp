#pragma once

#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "verify/number/exact.hpp"

namespace lekalo::verify {

/// A closed outline in integer units, its convex hull, and by how much it misses being convex. All exact.
///
/// A file that was meant convex may miss it by the last digits of its numbers. Between hull vertices j and j
/// + 1 the outline then runs at most dents[j] / |hull edge| inside hull edge j. The hull with every edge
/// moved in by its dent lies inside the outline: around a point deeper than every dent each stretch of the
/// outline can be pulled straight onto its hull edge without meeting the point, so the outline winds around
/// it once.
struct Outline {
  Ring points;                    ///< file order
  bool counter_clockwise = true;  ///< which way the file runs
  std::vector<std::size_t> hull;  ///< into points; counter-clockwise, strictly convex, at least 3
  std::vector<Integer> dents;  ///< per hull edge: largest edge x (q - start) of the points q under it, >= 0

  [[nodiscard]] const Point& corner(std::size_t j) const { return points[hull[j % hull.size()]]; }
  [[nodiscard]] Point side(std::size_t j) const { return corner(j + 1) - corner(j); }
  /// All points lie on the hull's boundary.
  [[nodiscard]] bool convex() const;
};

/// bad_input when the points have no area or do not run once around their hull.
[[nodiscard]] Result<Outline> make_outline(Ring points, std::string_view name);

/// Index of the hull corner farthest against the left normal of `direction`: -direction x (q - o) is largest.
/// Climbs from corner `start`; cost O(corners) at worst, O(1) from nearby.
[[nodiscard]] std::size_t lowest_corner(const Outline& outline, const Point& direction, std::size_t start);

/// The hull of `inner` lies in the material of `outer` (where its outline winds around): no edge of `outer`
/// enters the hull's interior, and the interior is material. Otherwise `culprit` is an edge of `outer` (file
/// order).
[[nodiscard]] bool lies_inside(const Outline& inner, const Outline& outer, std::size_t& culprit);

}  // namespace lekalo::verify

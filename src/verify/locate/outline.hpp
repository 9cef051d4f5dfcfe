#pragma once

#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "verify/number/exact.hpp"

namespace lekalo::verify {

/// A closed outline in integer units, its convex hull, and by how much it misses being convex. All of it is
/// exact.
///
/// Step 4 of docs/design/verify.md: a file that was meant convex may miss it by the last digits of its
/// numbers. Between hull vertices j and j + 1 the outline then runs at most dents[j] / |hull edge| inside
/// hull edge j. The hull with every edge moved in by its dent lies inside the outline. For around a point
/// deeper than every dent each stretch of the outline can be pulled straight onto its hull edge without
/// meeting the point, so the outline winds around it once.
struct Outline {
  /// The points in the order of the file.
  Ring points;
  /// True when the file runs counter-clockwise.
  bool counter_clockwise = true;
  /// Indices into `points`: counter-clockwise, strictly convex, at least 3.
  std::vector<std::size_t> hull;
  /// By hull edge: the largest edge x (q - start) of the points q under it, >= 0.
  std::vector<Integer> dents;

  [[nodiscard]] const Point& corner(std::size_t j) const { return points[hull[j % hull.size()]]; }
  [[nodiscard]] Point side(std::size_t j) const { return corner(j + 1) - corner(j); }
  /// Says whether all points lie on the hull's boundary.
  [[nodiscard]] bool convex() const;
};

/// Fails with bad_input when the points have no area or do not run once around their hull.
[[nodiscard]] Result<Outline> make_outline(Ring points, std::string_view name);

/// Returns the index of the hull corner that lies farthest against the left normal of `direction`: there
/// -direction x (q - o) is largest. The search climbs from corner `start`. Cost: O(corners) at worst, O(1)
/// from nearby.
[[nodiscard]] std::size_t lowest_corner(const Outline& outline, const Point& direction, std::size_t start);

/// Says whether the hull of `inner` lies in the material of `outer`, which is where its outline winds around.
/// It does when no edge of `outer` enters the hull's interior and the interior is material. Otherwise
/// `culprit` is an edge of `outer` (file order).
[[nodiscard]] bool lies_inside(const Outline& inner, const Outline& outer, std::size_t& culprit);

}  // namespace lekalo::verify

#pragma once

#include <optional>

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::phi {

/// By how much two outlines on the grid are in each other's way, and how to end that:
/// docs/design/layout-check.md. Shifts are found in floating point and then proved on the grid
/// (phi/outline_relation.hpp), so the one that is returned works. There is no promise that none is shorter.
/// \pre as in outline_relation.hpp

struct Separation {
  geom::GridPoint shift;   ///< steps
  double distance_mm = 0;  ///< length of the shift
  geom::Point direction;   ///< unit vector of the shift
  /// A place in the overlap before the shift, or where the outline sticks out most, mm.
  geom::Point at;
};

/// Returns a short shift of `a` after which interiors_meet(a, b, b_shift) is false. Its length is never below
/// the penetration depth (that of the shortest such shift). For convex outlines it is nearly always the depth
/// itself but for some steps. Cost: some thirty directions, each O((a + b) log) for outlines whose cross
/// sections have few pieces.
/// \pre interiors_meet(a, b, b_shift)
[[nodiscard]] Separation separate(const geom::GridRegion& a, const geom::GridRegion& b,
                                  geom::GridPoint b_shift = {});

/// Returns a short shift of `a` after which lies_within(container, a) holds, in a straight line from where it
/// is. Returns none when none was found; `a` may then still fit, but not near by.
/// \pre !lies_within(container, a)
[[nodiscard]] std::optional<Separation> bring_inside(const geom::GridRegion& container,
                                                     const geom::GridRegion& a);

/// The distance by which vertices of `a` lie outside the container, mm. It is 0 when none does, and `a` may
/// then still reach into a hole.
struct StickingOut {
  double distance_mm = 0;
  /// The vertex furthest out, mm; a vertex of the container's hole in `a` when no vertex of `a` is outside.
  geom::Point at;
};
[[nodiscard]] StickingOut sticking_out(const geom::GridRegion& container, const geom::GridRegion& a);

}  // namespace lekalo::phi

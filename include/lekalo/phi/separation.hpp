#pragma once

#include <optional>

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::phi {

/// This header says by how much two outlines on the grid are in each other's way, and how to end that:
/// docs/design/layout-check.md. Shifts are found in floating point and then proved on the grid
/// (phi/outline_relation.hpp), so that the one returned works; whether none is shorter is not promised. \pre
/// as in outline_relation.hpp.

struct Separation {
  geom::GridPoint shift;   ///< steps
  double distance_mm = 0;  ///< its length
  geom::Point direction;   ///< its direction, unit
  geom::Point at;          ///< mm, before the shift: a place in the overlap, or where most sticks out
};

/// A short shift of `a` after which interiors_meet(a, b, b_shift) is false: the length is never below the
/// penetration depth (that of the shortest such shift), and for convex outlines nearly always the depth
/// itself but for some steps. Cost: some thirty directions, each O((a + b) log) for outlines whose cross
/// sections have few pieces. \pre interiors_meet(a, b, b_shift)
[[nodiscard]] Separation separate(const geom::GridRegion& a, const geom::GridRegion& b,
                                  geom::GridPoint b_shift = {});

/// A short shift of `a` after which lies_within(container, a) holds, in a straight line from where it is;
/// none when none was found, then it may still fit, but not near by. \pre !lies_within(container, a)
[[nodiscard]] std::optional<Separation> bring_inside(const geom::GridRegion& container,
                                                     const geom::GridRegion& a);

/// How far vertices of `a` lie outside the container, mm; 0 when none does (a may then still reach into a
/// hole).
struct StickingOut {
  double distance_mm = 0;
  geom::Point at;  ///< mm, the vertex furthest out; one of the container's hole in `a` when none is
};
[[nodiscard]] StickingOut sticking_out(const geom::GridRegion& container, const geom::GridRegion& a);

}  // namespace lekalo::phi

#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::phi {

/// The checks for overlap that people use, to be measured against; outlines on the grid, outer loops alone,
/// moved by whole steps. Known faults and how often they show: docs/design/layout-check.md. Signs are exact,
/// so what is wrong is the method's.

/// The source's ray method decides whether a loop holds a point: a horizontal ray to the left; a vertex on it
/// counts once when its neighbours lie on opposite sides and twice when on the same; an edge on it counts
/// once when its neighbours lie on opposite sides and twice when on the same (the source prints it the other
/// way round, `printed_rule`, which is the wrong parity). A point on the outline counts as outside.
[[nodiscard]] bool ray_holds(const std::vector<geom::GridPoint>& loop, geom::GridPoint p,
                             bool printed_rule = false) noexcept;

/// An outline as the source's method keeps it.
struct FragmentImage {
  std::vector<geom::GridPoint> original;
  /// The outer loop with edges longer than the shortest box side split evenly (rounded to the grid).
  std::vector<geom::GridPoint> split;
  geom::GridBox box;
  geom::GridPoint pole;  ///< middle of the box, rounded
  double radius = 0;     ///< half the box's diagonal and a step, steps
};

/// The smallest side of all parts' boxes, in steps: the source's Min_Wst.
[[nodiscard]] std::int64_t smallest_box_side(const std::vector<const geom::GridRegion*>& parts) noexcept;
/// Edges longer than `smallest_side` get floor(length / smallest_side) further vertices. \pre smallest_side
/// >= 1
[[nodiscard]] FragmentImage fragment_image(const geom::GridRegion& part, std::int64_t smallest_side);

/// `fragment`: circles, boxes, then every vertex of each split outline against the other by rays.
[[nodiscard]] bool fragment_overlap(const FragmentImage& a, const FragmentImage& b, geom::GridPoint b_shift);
/// `ray`: every vertex of each outline against the other.
[[nodiscard]] bool ray_overlap(const std::vector<geom::GridPoint>& a, const std::vector<geom::GridPoint>& b,
                               geom::GridPoint b_shift) noexcept;
/// `segments`: every edge against every edge, for a crossing of both's insides; then one vertex of each by
/// rays.
[[nodiscard]] bool segments_overlap(const std::vector<geom::GridPoint>& a,
                                    const std::vector<geom::GridPoint>& b, geom::GridPoint b_shift) noexcept;

}  // namespace lekalo::phi

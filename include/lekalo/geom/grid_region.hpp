#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/grid.hpp"
#include "lekalo/geom/predicates.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::geom {

/// Corners of an axis-parallel box in grid steps, ends included.
struct GridBox {
  GridPoint low, high;
  friend constexpr bool operator==(const GridBox&, const GridBox&) = default;
};
/// The box with corners at a and b.
[[nodiscard]] inline GridBox box_of(GridPoint a, GridPoint b) noexcept {
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}
[[nodiscard]] constexpr GridBox moved(GridBox box, GridPoint by) noexcept {
  return {box.low + by, box.high + by};
}
/// True if the boxes, borders included, have a point in common or come as near as `margin` in x and in y.
[[nodiscard]] inline bool boxes_meet(const GridBox& a, const GridBox& b, std::int64_t margin = 0) noexcept {
  return a.low.x - margin <= b.high.x && b.low.x - margin <= a.high.x && a.low.y - margin <= b.high.y &&
         b.low.y - margin <= a.high.y;
}

/// One bounded piece of the plane with straight edges between grid points: outer loop counter-clockwise,
/// holes clockwise, material on the left of every edge. Loop l is points [loop_starts[l], loop_starts[l +
/// 1]), its last point joined to its first; loop 0 is the outer one.
struct GridRegion {
  std::vector<GridPoint> points;
  std::vector<std::uint32_t> loop_starts = {0};

  [[nodiscard]] std::size_t loops() const noexcept { return loop_starts.size() - 1; }
  [[nodiscard]] bool empty() const noexcept { return points.empty(); }
  friend bool operator==(const GridRegion&, const GridRegion&) = default;
};

/// No vertex may lie within this many steps of an edge that does not end there (2.9 nanometres). Turning
/// moves a vertex by at most 0.71 steps when it is rounded, two of them towards each other by 1.42: an
/// outline that keeps this distance stays simple in every rotation.
inline constexpr std::int64_t kGridResolution = 3;

/// Points of a loop that follow one another within kGridResolution become one, loops are turned into their
/// normal direction (each keeps its first point); then checked.
///
/// Fails with ErrorCode::bad_input, naming loop ("outline", "hole 0") and point (0-based, with its
/// millimetres): a coordinate beyond +-kGridLimit / 4, fewer than three points, no area, a loop that meets
/// itself or another (nearer than kGridResolution), a hole outside the outline or inside another hole. Cost:
/// O((n + k) log n), k pairs of edges whose boxes meet.
[[nodiscard]] Result<GridRegion> make_grid_region(std::vector<std::vector<GridPoint>> loops);

enum class ChordSide {
  grow,   ///< the polygon holds the region: parts, defects
  shrink  ///< the region holds the polygon: stock
};

inline constexpr std::size_t kMostPointsOfCurves = 4'000'000;

/// A region of lines and arcs as a polygon on the grid: arcs become chords that stay on one side of them by
/// at least 2 steps away from their ends, so that no rounding of a rotation brings the arc out, and by at
/// most `tolerance` mm; vertices of the drawing are rounded to the nearest step. Arcs that are not consistent
/// (arc_radius) count as the band between their radii. Fails as make_grid_region does, for a tolerance
/// below 2^-16 mm, and for more than `most_points` points_of_curves, before it makes any. Cost: O(chords log
/// chords).
[[nodiscard]] Result<GridRegion> grid_region_of_curves(const Region& region, ChordSide side, double tolerance,
                                                       std::size_t most_points = kMostPointsOfCurves);
/// The number of points that grid_region_of_curves makes of a region before it joins those that are too near
/// to each other. Cost: O(edges).
[[nodiscard]] std::size_t points_of_curves(const Region& region, ChordSide side, double tolerance);

/// The box as a region. \pre it has an area
[[nodiscard]] GridRegion rectangle(const GridBox& box);
/// The same outline in millimetres, as a region of lines. Exact.
[[nodiscard]] Region region_of_lines(const GridRegion& region);

/// Both (0, 0) for no points.
[[nodiscard]] GridBox bounds(const GridRegion& region) noexcept;
/// Twice the area of the material in square steps, exact.
[[nodiscard]] Int128 twice_area(const GridRegion& region) noexcept;
/// mm^2, to the nearest double.
[[nodiscard]] double area_mm2(const GridRegion& region) noexcept;
/// Every point turned (grid.hpp); mirrored loops are reversed, so that material stays on the left.
[[nodiscard]] GridRegion turned(const GridRegion& region, GridRotation rotation, bool mirrored);
[[nodiscard]] GridRegion moved(GridRegion region, GridPoint by) noexcept;
/// The answer says where p lies: inside the material, on an edge, or outside. Exact. Cost: O(n).
[[nodiscard]] PointLocation locate_point(const GridRegion& region, GridPoint p) noexcept;

}  // namespace lekalo::geom

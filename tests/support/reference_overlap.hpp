#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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
[[nodiscard]] inline bool ray_holds(const std::vector<geom::GridPoint>& loop, geom::GridPoint p,
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
[[nodiscard]] inline std::int64_t smallest_box_side(
    const std::vector<const geom::GridRegion*>& parts) noexcept;
/// Edges longer than `smallest_side` get floor(length / smallest_side) further vertices. \pre smallest_side
/// >= 1
[[nodiscard]] inline FragmentImage fragment_image(const geom::GridRegion& part, std::int64_t smallest_side);

/// `fragment`: circles, boxes, then every vertex of each split outline against the other by rays.
[[nodiscard]] inline bool fragment_overlap(const FragmentImage& a, const FragmentImage& b,
                                           geom::GridPoint b_shift);
/// `ray`: every vertex of each outline against the other.
[[nodiscard]] inline bool ray_overlap(const std::vector<geom::GridPoint>& a,
                                      const std::vector<geom::GridPoint>& b,
                                      geom::GridPoint b_shift) noexcept;
/// `segments`: every edge against every edge, for a crossing of both's insides; then one vertex of each by
/// rays.
[[nodiscard]] inline bool segments_overlap(const std::vector<geom::GridPoint>& a,
                                           const std::vector<geom::GridPoint>& b,
                                           geom::GridPoint b_shift) noexcept;

namespace overlap_detail {

using Loop = std::vector<geom::GridPoint>;

inline bool on_edge(geom::GridPoint p, geom::GridPoint a, geom::GridPoint b) noexcept {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y) && geom::turn(a, b, p) == 0;
}

inline bool any_vertex_within(const Loop& of, geom::GridPoint shift, const Loop& in) noexcept {
  return std::any_of(of.begin(), of.end(), [&](geom::GridPoint p) { return ray_holds(in, p + shift); });
}

}  // namespace overlap_detail

inline bool ray_holds(const overlap_detail::Loop& loop, geom::GridPoint p, bool printed_rule) noexcept {
  const std::size_t n = loop.size();
  int count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const geom::GridPoint a = loop[i], b = loop[i + 1 == n ? 0 : i + 1];
    if (overlap_detail::on_edge(p, a, b)) return false;
    if (a.y == p.y && b.y != p.y && a.x < p.x) {
      // The last vertex on the ray, of one or of an edge: what comes before the first one?
      std::size_t first = i;
      while (loop[(first + n - 1) % n].y == p.y) first = (first + n - 1) % n;
      const bool edge = first != i;
      const geom::GridPoint before = loop[(first + n - 1) % n];
      const bool same_side = (before.y > p.y) == (b.y > p.y);
      count += same_side == (edge && printed_rule) ? 1 : 2;
    } else if ((a.y < p.y && p.y < b.y) || (b.y < p.y && p.y < a.y)) {
      if ((geom::turn(a, b, p) > 0) != (b.y > a.y)) ++count;  // p lies right of the edge
    }
  }
  return count % 2 != 0;
}

inline std::int64_t smallest_box_side(const std::vector<const geom::GridRegion*>& parts) noexcept {
  std::int64_t smallest = std::numeric_limits<std::int64_t>::max();
  for (const geom::GridRegion* part : parts) {
    const geom::GridBox box = bounds(*part);
    smallest = std::min({smallest, box.high.x - box.low.x, box.high.y - box.low.y});
  }
  return smallest;
}

inline FragmentImage fragment_image(const geom::GridRegion& part, std::int64_t smallest_side) {
  FragmentImage image;
  image.original.assign(part.points.begin(), part.points.begin() + part.loop_starts[1]);
  image.box = bounds(part);
  image.pole = {(image.box.low.x + image.box.high.x) / 2, (image.box.low.y + image.box.high.y) / 2};
  const geom::GridPoint diagonal = image.box.high - image.box.low;
  image.radius = std::hypot(static_cast<double>(diagonal.x), static_cast<double>(diagonal.y)) / 2 + 1;
  for (std::size_t i = 0; i < image.original.size(); ++i) {
    const geom::GridPoint a = image.original[i],
                          b = image.original[i + 1 == image.original.size() ? 0 : i + 1];
    const geom::GridPoint d = b - a;
    image.split.push_back(a);
    const double length = std::sqrt(static_cast<double>(dot(d, d)));
    if (!(length > static_cast<double>(smallest_side))) continue;
    const auto more = static_cast<std::int64_t>(length / static_cast<double>(smallest_side));
    for (std::int64_t k = 1; k <= more; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(more + 1);
      image.split.push_back({a.x + std::llround(share * static_cast<double>(d.x)),
                             a.y + std::llround(share * static_cast<double>(d.y))});
    }
  }
  return image;
}

inline bool fragment_overlap(const FragmentImage& a, const FragmentImage& b, geom::GridPoint shift) {
  const geom::GridPoint apart = b.pole + shift - a.pole;
  const double reach = a.radius + b.radius;
  if (static_cast<double>(dot(apart, apart)) >= reach * reach) return false;
  if (std::max(a.box.low.x, b.box.low.x + shift.x) >= std::min(a.box.high.x, b.box.high.x + shift.x) ||
      std::max(a.box.low.y, b.box.low.y + shift.y) >= std::min(a.box.high.y, b.box.high.y + shift.y))
    return false;
  return overlap_detail::any_vertex_within(b.split, shift, a.split) ||
         overlap_detail::any_vertex_within(a.split, -shift, b.split);
}

inline bool ray_overlap(const overlap_detail::Loop& a, const overlap_detail::Loop& b,
                        geom::GridPoint shift) noexcept {
  return overlap_detail::any_vertex_within(b, shift, a) || overlap_detail::any_vertex_within(a, -shift, b);
}

inline bool segments_overlap(const overlap_detail::Loop& a, const overlap_detail::Loop& b,
                             geom::GridPoint shift) noexcept {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const geom::GridPoint p = a[i], q = a[i + 1 == a.size() ? 0 : i + 1];
    for (std::size_t j = 0; j < b.size(); ++j) {
      const geom::GridPoint r = b[j] + shift, s = b[j + 1 == b.size() ? 0 : j + 1] + shift;
      if (geom::turn(p, q, r) * geom::turn(p, q, s) < 0 && geom::turn(r, s, p) * geom::turn(r, s, q) < 0)
        return true;
    }
  }
  return ray_holds(a, b[0] + shift) || ray_holds(b, a[0] - shift);
}

}  // namespace lekalo::phi

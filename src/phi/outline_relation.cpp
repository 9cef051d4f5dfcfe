#include "lekalo/phi/outline_relation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/wide_product.hpp"

namespace lekalo::phi {
namespace {

using geom::GridBox;
using geom::GridPoint;
using geom::GridRegion;
using geom::Int128;
using geom::Point;

/// An edge with the point before it. Whoever looks at a touching point needs no more.
struct Edge {
  GridPoint before, from, to;
};

/// Returns the edges of a region, moved, whose boxes come within `margin` of `window`.
std::vector<Edge> edges_near(const GridRegion& region, GridPoint shift, const GridBox& window,
                             std::int64_t margin = 0) {
  ask(1 + region.points.size() / 16);
  std::vector<Edge> edges;
  for (std::size_t l = 0; l < region.loops(); ++l) {
    const std::uint32_t begin = region.loop_starts[l], end = region.loop_starts[l + 1];
    GridPoint before = region.points[end - 2] + shift, from = region.points[end - 1] + shift;
    for (std::uint32_t i = begin; i < end; ++i) {
      const GridPoint to = region.points[i] + shift;
      if (boxes_meet(box_of(from, to), window, margin)) edges.push_back({before, from, to});
      before = from;
      from = to;
    }
  }
  return edges;
}

/// The directions that lead into the material at a point of the boundary: counter-clockwise from `first` to
/// `last`, both along the boundary.
struct Sector {
  GridPoint first, last;
};

bool same_direction(GridPoint a, GridPoint b) noexcept { return cross(a, b) == 0 && dot(a, b) > 0; }

/// Says whether d lies in the half-open sector, which includes `first`.
bool holds(const Sector& s, GridPoint d) noexcept {
  if (same_direction(s.first, d)) return true;
  const int opening = geom::sign(cross(s.first, s.last));
  const int after_first = geom::sign(cross(s.first, d)), before_last = geom::sign(cross(d, s.last));
  if (opening > 0) return after_first > 0 && before_last > 0;
  if (opening < 0) return after_first > 0 || before_last > 0;
  // The sector is half a turn. A spike (no turn, or a full one) is no simple outline.
  return after_first > 0;
}

/// Says whether two open sectors have a direction in common, which they have just when the half-open ones do.
bool meet(const Sector& a, const Sector& b) noexcept { return holds(a, b.first) || holds(b, a.first); }

Sector at_vertex(const Edge& edge) noexcept { return {edge.to - edge.from, edge.before - edge.from}; }
Sector along(const Edge& edge) noexcept { return {edge.to - edge.from, edge.from - edge.to}; }
Sector other_side(const Sector& s) noexcept { return {s.last, s.first}; }

/// Says whether p, which must lie on the line of the edge, lies between its ends, ends included.
bool between_ends(GridPoint p, const Edge& edge) noexcept {
  const GridBox box = box_of(edge.from, edge.to);
  return box.low.x <= p.x && p.x <= box.high.x && box.low.y <= p.y && p.y <= box.high.y;
}

/// Cases (1) and (2) of step 1 of docs/design/layout-check.md: says whether the material beside two edges
/// meets at a point that both have. They may cross there. Or a vertex of one lies on the other and the
/// directions into both materials have one in common. Every vertex begins one edge, so it is enough to look
/// at beginnings.
bool material_meets(const Edge& a, const Edge& b, bool outside_of_a) noexcept {
  const int b_from = geom::turn(a.from, a.to, b.from), b_to = geom::turn(a.from, a.to, b.to);
  if (b_from * b_to > 0) return false;
  const int a_from = geom::turn(b.from, b.to, a.from), a_to = geom::turn(b.from, b.to, a.to);
  if (a_from * a_to > 0) return false;
  if (b_from * b_to < 0 && a_from * a_to < 0) return true;
  const auto in_a = [&](const Sector& s) { return outside_of_a ? other_side(s) : s; };
  if (a.from == b.from) return meet(in_a(at_vertex(a)), at_vertex(b));
  if (b_from == 0 && b.from != a.to && between_ends(b.from, a) && meet(in_a(along(a)), at_vertex(b)))
    return true;
  return a_from == 0 && a.from != b.to && between_ends(a.from, b) && meet(in_a(at_vertex(a)), along(b));
}

/// Says whether two closed outlines have such a point.
/// \param outside_of_a  a's material is what lies outside it
bool boundaries_mix(const GridRegion& a, const GridRegion& b, GridPoint shift, bool outside_of_a) {
  const GridBox box_a = bounds(a), box_b = geom::moved(bounds(b), shift);
  if (!boxes_meet(box_a, box_b)) return false;
  const std::vector<Edge> near = edges_near(b, shift, box_a);
  if (near.empty()) return false;
  for (const Edge& edge : edges_near(a, {}, box_b)) {
    ask(1 + near.size() / 16);
    const GridBox box = box_of(edge.from, edge.to);
    for (const Edge& other : near)
      if (boxes_meet(box, box_of(other.from, other.to)) && material_meets(edge, other, outside_of_a))
        return true;
  }
  return false;
}

bool holds_point(const GridRegion& region, GridPoint p) noexcept {
  return locate_point(region, p) == geom::PointLocation::inside;
}

/// Step 3: says exactly whether p lies less than gap from the segment.
bool nearer_than(GridPoint p, GridPoint from, GridPoint to, std::int64_t gap) noexcept {
  const GridPoint edge = to - from, out = p - from;
  const Int128 squared_gap = Int128{gap} * gap, at = dot(out, edge), length = dot(edge, edge);
  if (at <= 0) return dot(out, out) < squared_gap;
  if (at >= length) return dot(p - to, p - to) < squared_gap;
  const Int128 height = cross(edge, out), magnitude = height < 0 ? -height : height;
  // Each side below has three roundings of a relative 2^-53.
  const double left = static_cast<double>(magnitude) * static_cast<double>(magnitude);
  const double right = static_cast<double>(squared_gap) * static_cast<double>(length);
  if (left < right * (1 - 0x1p-49)) return true;
  if (left > right * (1 + 0x1p-49)) return false;
  return geom::wide_product(magnitude, magnitude) < geom::wide_product(squared_gap, length);
}

bool have_common_point(const Edge& a, const Edge& b) noexcept {
  const int b_from = geom::turn(a.from, a.to, b.from), b_to = geom::turn(a.from, a.to, b.to);
  if (b_from * b_to > 0) return false;
  const int a_from = geom::turn(b.from, b.to, a.from), a_to = geom::turn(b.from, b.to, a.to);
  if (a_from * a_to > 0) return false;
  return b_from != 0 || b_to != 0 || a_from != 0 || a_to != 0 ||
         boxes_meet(box_of(a.from, a.to), box_of(b.from, b.to));
}

/// A squared distance in steps, and the place on the edge. It has digits enough for a report, not for a
/// decision.
struct Foot {
  double squared = 0;
  Point at;  ///< steps
};
Foot foot(GridPoint p, const Edge& edge) noexcept {
  const GridPoint along_edge = edge.to - edge.from, out = p - edge.from;
  const Int128 at = dot(out, along_edge), length = dot(along_edge, along_edge);
  const auto to_end = [&](GridPoint end) {
    return Foot{static_cast<double>(dot(p - end, p - end)),
                {static_cast<double>(end.x), static_cast<double>(end.y)}};
  };
  if (at <= 0) return to_end(edge.from);
  if (at >= length) return to_end(edge.to);
  const double height = static_cast<double>(cross(along_edge, out)),
               share = static_cast<double>(at) / static_cast<double>(length);
  return {height * (height / static_cast<double>(length)),
          {static_cast<double>(edge.from.x) + share * static_cast<double>(along_edge.x),
           static_cast<double>(edge.from.y) + share * static_cast<double>(along_edge.y)}};
}

}  // namespace

bool interiors_meet(const GridRegion& a, const GridRegion& b, GridPoint shift) {
  const GridBox box_a = bounds(a), box_b = geom::moved(bounds(b), shift);
  if (box_a.low.x >= box_b.high.x || box_b.low.x >= box_a.high.x || box_a.low.y >= box_b.high.y ||
      box_b.low.y >= box_a.high.y)
    return false;
  // Step 1 of docs/design/layout-check.md, the three cases.
  return boundaries_mix(a, b, shift, false) || holds_point(a, b.points[0] + shift) ||
         holds_point(b, a.points[0] - shift);
}

bool lies_within(const GridRegion& container, const GridRegion& b, GridPoint shift) {
  const GridBox outer = bounds(container), box = geom::moved(bounds(b), shift);
  if (box.low.x < outer.low.x || box.high.x > outer.high.x || box.low.y < outer.low.y ||
      box.high.y > outer.high.y)
    return false;
  // Step 2 of docs/design/layout-check.md, with the complement of the container.
  if (boundaries_mix(container, b, shift, true)) return false;
  if (locate_point(container, b.points[0] + shift) == geom::PointLocation::outside) return false;
  for (std::size_t hole = 1; hole < container.loops(); ++hole)
    if (holds_point(b, container.points[container.loop_starts[hole]] - shift)) return false;
  return true;
}

bool edges_nearer_than(const GridRegion& a, const GridRegion& b, std::int64_t gap, GridPoint shift) {
  if (gap <= 0) return false;
  const GridBox box_a = bounds(a), box_b = geom::moved(bounds(b), shift);
  if (!boxes_meet(box_a, box_b, gap)) return false;
  const std::vector<Edge> near = edges_near(b, shift, box_a, gap);
  if (near.empty()) return false;
  for (const Edge& edge : edges_near(a, {}, box_b, gap)) {
    ask(1 + near.size() / 16);
    const GridBox box = box_of(edge.from, edge.to);
    for (const Edge& other : near) {
      if (!boxes_meet(box, box_of(other.from, other.to), gap)) continue;
      // Segments that do not cross are nearest at an end of one. Every end begins an edge, but that edge may
      // be out of reach of the window, so both ends are asked.
      if (nearer_than(edge.from, other.from, other.to, gap) ||
          nearer_than(edge.to, other.from, other.to, gap) ||
          nearer_than(other.from, edge.from, edge.to, gap) ||
          nearer_than(other.to, edge.from, edge.to, gap) || have_common_point(edge, other))
        return true;
    }
  }
  return false;
}

EdgeDistance edge_distance(const GridRegion& a, const GridRegion& b, GridPoint shift) {
  EdgeDistance best;
  double squared = std::numeric_limits<double>::infinity();
  const GridBox box_b = geom::moved(bounds(b), shift);
  const std::vector<Edge> others = edges_near(b, shift, box_b);
  const auto beyond = [&](const GridBox& p, const GridBox& q) {
    const double dx =
        static_cast<double>(std::max({std::int64_t{0}, q.low.x - p.high.x, p.low.x - q.high.x}));
    const double dy =
        static_cast<double>(std::max({std::int64_t{0}, q.low.y - p.high.y, p.low.y - q.high.y}));
    return dx * dx + dy * dy > squared;
  };
  const auto consider = [&](const Foot& at, GridPoint p, bool p_on_a) {
    if (!(at.squared < squared)) return;
    squared = at.squared;
    const Point end = geom::mm_from_grid(p), on_edge = geom::mm_from_steps(at.at);
    best = p_on_a ? EdgeDistance{0, end, on_edge} : EdgeDistance{0, on_edge, end};
  };
  for (const Edge& edge : edges_near(a, {}, bounds(a))) {
    ask(1 + others.size() / 16);
    const GridBox box = box_of(edge.from, edge.to);
    if (beyond(box, box_b)) continue;
    for (const Edge& other : others) {
      if (beyond(box, box_of(other.from, other.to))) continue;
      consider(foot(edge.from, other), edge.from, true);
      consider(foot(other.from, edge), other.from, false);
      if (!(squared > 0) || !have_common_point(edge, other)) continue;
      // When edges on one line meet, a vertex of one is on the other, and the loop finds it when its turn
      // comes.
      const Int128 parallel = cross(edge.to - edge.from, other.to - other.from);
      if (parallel == 0) continue;
      const Int128 to_crossing = cross(other.from - edge.from, other.to - other.from);
      const double share = static_cast<double>(to_crossing) / static_cast<double>(parallel);
      const Point from = geom::mm_from_grid(edge.from), to = geom::mm_from_grid(edge.to);
      const Point at = from + share * (to - from);
      best = {0, at, at};
      squared = 0;
    }
  }
  best.distance_mm = std::sqrt(squared) * geom::kGridStep;
  return best;
}

}  // namespace lekalo::phi

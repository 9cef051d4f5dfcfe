// Step 2 of docs/design/shape-tree.md: a box around all points that a shape can have, and around what
// half-planes enclose together.

#include <algorithm>
#include <cmath>

#include "io/text/decimal.hpp"
#include "node.hpp"

namespace lekalo::io::detail {

using geom::Box;
using geom::Point;
using geom::Region;
using geom::Ring;

namespace {

Extent extent_of_union(const std::vector<ShapeNode>& children) {
  Extent all;
  all.empty = true;
  for (const ShapeNode& child : children) {
    if (child.extent.empty) continue;
    if (!child.extent.bounded) return child.extent;
    all.box = all.empty ? child.extent.box : joined(all.box, child.extent.box);
    all.empty = false;
  }
  return all;
}

void keep_common(Extent& all, const Extent& other) {
  if (other.empty || all.empty || !other.bounded) {
    all.empty = all.empty || other.empty;
    all.bounded = all.bounded || other.empty;
    return;
  }
  if (!all.bounded) {
    all = other;
    return;
  }
  Box& box = all.box;
  box.low = {std::max(box.low.x, other.box.low.x), std::max(box.low.y, other.box.low.y)};
  box.high = {std::min(box.high.x, other.box.high.x), std::min(box.high.y, other.box.high.y)};
  all.empty = !(box.low.x <= box.high.x && box.low.y <= box.high.y);
}

/// Half-planes that the shape lies in.
void collect_half_planes(const ShapeNode& node, std::vector<HalfPlane>& planes) {
  switch (node.kind) {
    case ShapeKind::half_plane:
      planes.push_back(node.half_plane);
      return;
    case ShapeKind::intersect:
      for (const ShapeNode& child : node.children) collect_half_planes(child, planes);
      return;
    case ShapeKind::subtract:
      collect_half_planes(node.children[0], planes);
      return;
    case ShapeKind::map: {
      const std::size_t first = planes.size();
      collect_half_planes(node.children[0], planes);
      for (std::size_t i = first; i < planes.size(); ++i) {
        HalfPlane& plane = planes[i];
        plane = {node.map(plane.from), node.map(plane.to)};
        if (node.map.mirrors) std::swap(plane.from, plane.to);  // the left goes to the right
      }
      return;
    }
    case ShapeKind::primitive:
    case ShapeKind::unite:
      return;  // what they lie in, their boxes say
  }
}

/// The part of a convex ring that is at most `slack` to the right of the plane's edge.
Ring clipped(const Ring& ring, const HalfPlane& plane, double slack) {
  const Point along = plane.to - plane.from;
  const Point left = (1 / norm(along)) * perpendicular(along);
  Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    const double da = dot(left, a - plane.from) + slack, db = dot(left, b - plane.from) + slack;
    if (da >= 0) kept.push_back(a);
    if ((da >= 0) != (db >= 0)) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  return kept;
}

/// A box around what the half-planes have in common. The square they cut is the largest that has coordinates
/// of its own; rounding moves its cuts by 1e-6 mm, the slack is a thousand times that.
Extent extent_of_half_planes(const std::vector<HalfPlane>& planes) {
  constexpr double kFar = kLargestMillimetres, kSlack = 1e-3;
  Ring ring{{-kFar, -kFar}, {kFar, -kFar}, {kFar, kFar}, {-kFar, kFar}};
  for (const HalfPlane& plane : planes) {
    if (plane.from == plane.to) return {false, false, {}};  // a map made it too small to have a direction
    ring = clipped(ring, plane, kSlack);
  }
  if (ring.empty()) return {true, true, {}};
  const Box box = geom::bounds(ring);
  // Cuts of lines that are nearly parallel are further off, but by less than a thousandth of where they are.
  const double size = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  if (!(largest_of(box) < 0.99 * kFar)) return {false, false, {}};
  return {true, false, grown(box, 1e-3 * size)};
}

Extent extent_of_intersection(const ShapeNode& node) {
  Extent all;
  all.bounded = false;
  for (const ShapeNode& child : node.children) keep_common(all, child.extent);
  if (all.bounded) return all;
  std::vector<HalfPlane> planes;
  collect_half_planes(node, planes);
  return extent_of_half_planes(planes);
}

}  // namespace

Extent extent_of(const ShapeNode& node) {
  switch (node.kind) {
    case ShapeKind::primitive: {
      const Box box = geom::bounds(node.regions[0].outer);
      return {true, false, grown(box, node.error)};
    }
    case ShapeKind::half_plane:
      return {false, false, {}};
    case ShapeKind::unite:
      return extent_of_union(node.children);
    case ShapeKind::intersect:
      return extent_of_intersection(node);
    case ShapeKind::subtract:
      return node.children[0].extent;
    case ShapeKind::map: {
      Extent extent = node.children[0].extent;
      if (extent.bounded && !extent.empty) extent.box = image(node.map, extent.box);
      return extent;
    }
  }
  return {};
}

}  // namespace lekalo::io::detail

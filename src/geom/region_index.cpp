#include "lekalo/geom/region_index.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/geom/predicates.hpp"

namespace lekalo::geom {
namespace {

/// Returns how often a ray from p to the right crosses an edge.
int crosses_line(const Edge& line, Point p) {
  if ((line.from.y <= p.y) == (line.to.y <= p.y)) return 0;
  const int side = orientation(line.from, line.to, p);
  // The ray crosses where p is on the left of the upward line.
  return side == (line.from.y < line.to.y ? 1 : -1) ? 1 : 0;
}

/// Returns the x at which a stretch of an arc, on the right or the left half of its circle, is at height y.
///
/// An end may miss the circle by half the difference of the radii. Where the circle is nearly level, the
/// circle at the end's height is much further off along the ray. So the x goes no further than this quarter
/// of the stretch reaches, and the jump from the end to the circle stays as near to the arc as its end is.
double crossing_of_half(const Curve& arc, Point begin, Point end, bool right, double y) {
  const Point centre = arc.edge.centre;
  const double h = y - centre.y, side = right ? 1 : -1;
  const double half = std::sqrt(std::max(0.0, (arc.radius - h) * (arc.radius + h)));
  const Point low = begin.y <= end.y ? begin : end, high = begin.y <= end.y ? end : begin;
  const Point outer = h >= 0 ? high : low, inner = h >= 0 ? low : high;
  const bool beyond_axis = h >= 0 ? inner.y < centre.y : inner.y >= centre.y;
  const auto [least, most] = std::minmax({outer.x, beyond_axis ? centre.x + side * arc.radius : inner.x});
  return std::clamp(centre.x + side * half, least, most);
}

int crosses_arc(const Curve& arc, Point p) {
  // A counter-clockwise arc runs upwards on the circle's right half and downwards on its left, so it is split
  // where it is highest and lowest. A turning point exactly at an end does not split. Each stretch is
  // half-open, so that stretches that share an end count it once.
  const Edge& edge = arc.edge;
  const Point centre = edge.centre;
  const bool forwards = edge.kind == EdgeKind::arc_ccw;
  bool right = arc.first.x > 0 || (arc.first.x == 0 && arc.first.y < 0);
  const bool ends_right = arc.last.x > 0 || (arc.last.x == 0 && arc.last.y > 0);
  const int splits = right != ends_right ? 1 : (arc.beyond_half || arc.full ? 2 : 0);
  const Point last = forwards ? edge.to : edge.from;
  Point begin = forwards ? edge.from : edge.to;
  int found = 0;
  for (int i = 0; i <= splits; ++i) {
    const Point turning{centre.x, right ? centre.y + arc.radius : centre.y - arc.radius};
    const Point end = i == splits ? last : turning;
    if ((begin.y <= p.y) != (end.y <= p.y) && crossing_of_half(arc, begin, end, right, p.y) > p.x) ++found;
    begin = end;
    right = !right;
  }
  return found;
}

}  // namespace

RegionIndex::RegionIndex(const std::vector<Region>& regions) {
  const auto add = [&](const Contour& contour) {
    for (const Edge& edge : contour) curves_.push_back(make_curve(edge));
    contour_starts_.push_back(static_cast<std::uint32_t>(curves_.size()));
  };
  for (const Region& region : regions) {
    add(region.outer);
    for (const Contour& hole : region.holes) add(hole);
  }
  nodes_.reserve(2 * curves_.size());
  if (!curves_.empty()) build(0, static_cast<std::uint32_t>(curves_.size()));
}

std::uint32_t RegionIndex::build(std::uint32_t begin, std::uint32_t end) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({{}, begin, end, 0});
  if (end - begin <= kLeaf) {
    Box box = curve_box(curves_[begin]);
    for (std::uint32_t edge = begin + 1; edge < end; ++edge) box = joined(box, curve_box(curves_[edge]));
    nodes_[at].box = box;
    return at;
  }
  const std::uint32_t middle = begin + (end - begin) / 2;
  const std::uint32_t left = build(begin, middle), right = build(middle, end);
  nodes_[at].right = right;
  nodes_[at].box = joined(nodes_[left].box, nodes_[right].box);
  return at;
}

RegionIndex::Nearest RegionIndex::nearest(Point p) const { return nearer(p, {}); }

RegionIndex::Nearest RegionIndex::nearest(Point p, std::uint32_t likely) const {
  const Point first = nearest_on(curves_[likely], p);
  return nearer(p, {norm(p - first), first, likely});
}

RegionIndex::Nearest RegionIndex::nearer(Point p, Nearest best) const {
  double limit = best.distance;
  visit_within(p, 0, limit, [&](std::uint32_t edge) {
    const Point point = nearest_on(curves_[edge], p);
    const double distance = norm(p - point);
    if (distance < best.distance) best = {distance, point, edge}, limit = distance;
  });
  return best;
}

int RegionIndex::crossings_right_of(std::uint32_t at, Point p) const {
  const Node& node = nodes_[at];
  if (p.y < node.box.low.y || p.y > node.box.high.y || p.x > node.box.high.x) return 0;
  if (node.right != 0) return crossings_right_of(at + 1, p) + crossings_right_of(node.right, p);
  int found = 0;
  for (std::uint32_t edge = node.begin; edge < node.end; ++edge) {
    const Curve& curve = curves_[edge];
    found += curve.edge.kind == EdgeKind::line ? crosses_line(curve.edge, p) : crosses_arc(curve, p);
  }
  return found;
}

bool RegionIndex::contains(Point p) const { return !nodes_.empty() && crossings_right_of(0, p) % 2 != 0; }

}  // namespace lekalo::geom

#include "lekalo/geom/region_index.hpp"

#include "lekalo/geom/predicates.hpp"
#include "monotone.hpp"

namespace lekalo::geom {
namespace {

/// Returns how often a ray from p to the right crosses an edge.
int crosses_line(const Edge& line, Point p) {
  if ((line.from.y <= p.y) == (line.to.y <= p.y)) return 0;
  const int side = orientation(line.from, line.to, p);
  // The ray crosses where p is on the left of the upward line.
  return side == (line.from.y < line.to.y ? 1 : -1) ? 1 : 0;
}

int crosses_arc(const Curve& arc, Point p) {
  int found = 0;
  detail::visit_monotone(arc, [&](const detail::Monotone& stretch) {
    // Each stretch is half-open, so that stretches that share an end count it once.
    if ((stretch.begin.y <= p.y) != (stretch.end.y <= p.y) && detail::arc_x_at(stretch, p.y) > p.x) ++found;
  });
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

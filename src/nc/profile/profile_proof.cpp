#include "profile_proof.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/stop.hpp"

namespace lekalo::nc {
namespace {

using geom::Box;
using geom::Curve;
using geom::EdgeKind;
using geom::Point;

double radii_difference(const geom::Edge& edge) {
  if (edge.kind == EdgeKind::line) return 0;
  return std::abs(geom::norm(edge.to - edge.centre) - geom::norm(edge.from - edge.centre));
}

double largest_number(const Curve& curve) {
  const geom::Edge& e = curve.edge;
  double largest = curve.radius;
  for (const Point p : {e.from, e.to, e.centre}) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  return largest;
}

Box box_of(const Curve& curve) {
  return grown(geom::curve_box(curve), radii_difference(curve.edge) + 0x1p-40 * largest_number(curve));
}

std::vector<geom::RegionIndex> indices_of(const std::vector<ProfilePart>& parts) {
  std::vector<geom::RegionIndex> indices;
  indices.reserve(parts.size());
  for (const ProfilePart& part : parts) indices.emplace_back(std::vector<geom::Region>{part.region});
  return indices;
}

}  // namespace

double distance_at_least(const Curve& a, const Curve& b) {
  const double apart = geom::closest_points(a, b).distance;
  // Twice the stated error, so that the rounding of these very sums is covered; a control may go along
  // either radius of an arc, or from one to the other.
  const double largest = std::max(largest_number(a), largest_number(b));
  const double reserve =
      2 * geom::kEdgeDistanceError * largest + 1.5 * (radii_difference(a.edge) + radii_difference(b.edge));
  return std::max(0.0, apart - reserve);
}

double distance_at_least(const Curve& curve, Point p) {
  const double largest = std::max({largest_number(curve), std::abs(p.x), std::abs(p.y)});
  const double reserve = 2 * geom::kEdgeDistanceError * largest + 1.5 * radii_difference(curve.edge);
  return std::max(0.0, geom::norm(geom::nearest_on(curve, p) - p) - reserve);
}

KerfProof::KerfProof(const std::vector<ProfilePart>& parts, const ProfileOptions& options)
    : resolution_(resolution_of(options)),
      half_kerf_(0.5 * options.kerf_mm),
      tolerance_(options.tolerance_mm),
      indices_(indices_of(parts)) {
  std::vector<Box> boxes;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const auto& curves = indices_[part].curves();
    Box all = box_of(curves.front());
    for (const Curve& curve : curves) {
      ask();
      const Box box = box_of(curve);
      all.low = {std::min(all.low.x, box.low.x), std::min(all.low.y, box.low.y)};
      all.high = {std::max(all.high.x, box.high.x), std::max(all.high.y, box.high.y)};
      boxes.push_back(box);
      edges_.push_back(curve);
      part_of_edge_.push_back(part);
    }
    part_boxes_.push_back(all);
  }
  edge_tree_ = std::make_unique<geom::BoxTree>(boxes);
  part_tree_ = std::make_unique<geom::BoxTree>(part_boxes_);
}

bool KerfProof::in_material(Point p, std::size_t& part) const {
  bool found = false;
  part_tree_->visit_meeting({p, p}, [&](std::uint32_t i) {
    if (found || !indices_[i].contains(p)) return;
    found = true;
    part = i;
  });
  return found;
}

KerfProof::Finding KerfProof::look(const std::vector<WrittenEdge>& path) const {
  Finding finding;
  for (const WrittenEdge& edge : path) {
    const Curve curve = geom::make_curve(edge_mm(edge, resolution_));
    edge_tree_->visit_meeting(geom::grown(box_of(curve), half_kerf_ * (1 + 0x1p-40)), [&](std::uint32_t i) {
      const double deep = half_kerf_ - distance_at_least(curve, edges_[i]);
      if (!(deep <= finding.deepest_mm)) finding.deepest_mm = deep, finding.part = part_of_edge_[i];
    });
  }
  finding.deepest_mm = std::nextafter(finding.deepest_mm, 1e300);
  // One point answers for the whole path that keeps its distance; a path that does not is refused anyway.
  std::size_t part = 0;
  if (in_material(resolution_.mm(path.front().from), part)) {
    finding.inside = true;
    finding.part = part;
    finding.deepest_mm = std::max(finding.deepest_mm, 2 * half_kerf_);
  }
  return finding;
}

bool KerfProof::stays_out(const std::vector<WrittenEdge>& path) const {
  const Finding finding = look(path);
  return !finding.inside && finding.deepest_mm <= tolerance_;
}

bool KerfProof::disc_stays_out(WrittenPoint p, double radius) const {
  const Point at = resolution_.mm(p);
  std::size_t part = 0;
  if (in_material(at, part)) return false;
  bool out = true;
  edge_tree_->visit_meeting_while(geom::grown({at, at}, radius * (1 + 0x1p-40)), [&](std::uint32_t i) {
    return out = distance_at_least(edges_[i], at) >= radius - tolerance_;
  });
  return out;
}

}  // namespace lekalo::nc

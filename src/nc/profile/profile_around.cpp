#include "profile_around.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lekalo/geom/edge_distance.hpp"
#include "profile_proof.hpp"

namespace lekalo::nc {

KerfsAround::KerfsAround(const std::vector<Cut>& cuts, const ProfileOptions& options)
    : resolution_(resolution_of(options)), kerf_(options.kerf_mm), pierce_(options.pierce_diameter_mm) {
  std::vector<geom::Box> boxes;
  for (std::size_t cut = 0; cut < cuts.size(); ++cut) {
    first_edge_.push_back(edges_.size());
    constexpr double kFar = std::numeric_limits<double>::infinity();
    geom::Box all{{kFar, kFar}, {-kFar, -kFar}};
    for (const WrittenEdge& edge : cuts[cut].path) {
      edges_.push_back(geom::make_curve(edge_mm(edge, resolution_)));
      boxes.push_back(geom::curve_box(edges_.back()));
      cut_of_.push_back(cut);
      const geom::Box& box = boxes.back();
      all.low = {std::min(all.low.x, box.low.x), std::min(all.low.y, box.low.y)};
      all.high = {std::max(all.high.x, box.high.x), std::max(all.high.y, box.high.y)};
    }
    boxes_.push_back(all);
  }
  first_edge_.push_back(edges_.size());
  tree_ = std::make_unique<geom::BoxTree>(boxes);
}

std::vector<std::size_t> KerfsAround::met(std::size_t own, const std::vector<WrittenEdge>& lead,
                                          WrittenPoint pierce) const {
  std::vector<std::size_t> met;
  for (const WrittenEdge& edge : lead) {
    const geom::Curve curve = geom::make_curve(edge_mm(edge, resolution_));
    tree_->visit_meeting(geom::grown(geom::curve_box(curve), kerf_), [&](std::uint32_t i) {
      if (cut_of_[i] != own && !(distance_at_least(curve, edges_[i]) >= kerf_)) met.push_back(cut_of_[i]);
    });
  }
  if (pierce_ > 0) {
    const geom::Point at = resolution_.mm(pierce);
    const double reach = 0.5 * (pierce_ + kerf_);
    tree_->visit_meeting(geom::grown({at, at}, reach), [&](std::uint32_t i) {
      if (cut_of_[i] != own && !(distance_at_least(edges_[i], at) >= reach)) met.push_back(cut_of_[i]);
    });
  }
  std::sort(met.begin(), met.end());
  met.erase(std::unique(met.begin(), met.end()), met.end());
  return met;
}

bool KerfsAround::keeps_apart(std::size_t own, const geom::Edge& line, double by) const {
  const geom::Curve curve = geom::make_curve(line);
  return tree_->visit_meeting_while(geom::grown(geom::curve_box(curve), by), [&](std::uint32_t i) {
    return cut_of_[i] == own || distance_at_least(curve, edges_[i]) >= by;
  });
}

bool KerfsAround::goes_along(std::size_t own, const WrittenEdge& line) const {
  const geom::Curve curve = geom::make_curve(edge_mm(line, resolution_));
  return !tree_->visit_meeting_while(geom::grown(geom::curve_box(curve), kerf_), [&](std::uint32_t i) {
    const geom::Edge& edge = edges_[i].edge;
    if (cut_of_[i] == own || edge.kind != geom::EdgeKind::line) return true;
    if (!(std::abs(geom::cross(curve.unit, edges_[i].unit)) < 0.2)) return true;
    const double first = geom::dot(edge.from - curve.edge.from, curve.unit),
                 last = geom::dot(edge.to - curve.edge.from, curve.unit);
    const double both = std::min(std::max(first, last), curve.length) - std::max(std::min(first, last), 0.0);
    return !(both > 0.5 * kerf_ && geom::closest_points(curve, edges_[i]).distance < kerf_);
  });
}

std::vector<std::size_t> KerfsAround::holding(std::size_t own, WrittenPoint p, double within) const {
  const geom::Point at = resolution_.mm(p);
  std::vector<std::size_t> cuts;
  tree_->visit_meeting(geom::grown({at, at}, within), [&](std::uint32_t i) {
    if (cut_of_[i] != own && geom::norm(geom::nearest_on(edges_[i], at) - at) <= within)
      cuts.push_back(cut_of_[i]);
  });
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

double KerfsAround::distance(std::size_t cut, geom::Point p) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = first_edge_[cut]; i < first_edge_[cut + 1]; ++i)
    least = std::min(least, geom::norm(geom::nearest_on(edges_[i], p) - p));
  return least;
}

bool KerfsAround::is_apart(std::size_t cut, geom::Point p, double by) const {
  const geom::Box& box = boxes_[cut];
  const geom::Point off{std::max({0.0, box.low.x - p.x, p.x - box.high.x}),
                        std::max({0.0, box.low.y - p.y, p.y - box.high.y})};
  return geom::norm(off) >= by || distance(cut, p) >= by;
}

}  // namespace lekalo::nc

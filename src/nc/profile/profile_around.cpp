#include "profile_around.hpp"

#include <algorithm>
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

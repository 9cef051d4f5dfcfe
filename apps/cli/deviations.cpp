#include "deviations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "lekalo/geom/distance.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/geom/predicates.hpp"

namespace lekalo::cli {

double Deviations::least() const { return *std::min_element(signed_mm.begin(), signed_mm.end()); }
double Deviations::greatest() const { return *std::max_element(signed_mm.begin(), signed_mm.end()); }

Deviations measure_deviations(const geom::Ring& probed, const geom::Ring& part,
                              const locate::Placement& placement) {
  const auto pose = geom::BlankFromPart::from_angle(placement.theta, {placement.x, placement.y});
  geom::Ring placed;
  std::vector<double> flat;
  for (const geom::Point& p : part) {
    placed.push_back(pose(p));
    flat.insert(flat.end(), {placed.back().x, placed.back().y});
  }
  Deviations deviations;
  for (const geom::Point& p : probed) {
    const double distance = geom::distance_to_boundary(p, placed);
    const bool inside = geom::locate_point(flat.data(), placed.size(), p) == geom::PointLocation::inside;
    deviations.signed_mm.push_back(inside ? -distance : distance);
  }
  return deviations;
}

std::string deviations_csv(const geom::Ring& probed, const Deviations& deviations) {
  std::string text = "index,x,y,deviation\n";
  for (std::size_t k = 0; k < probed.size(); ++k) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", k, probed[k].x, probed[k].y,
                   deviations.signed_mm[k]);
  }
  return text;
}

}  // namespace lekalo::cli

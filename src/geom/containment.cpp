#include "containment.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace lekalo::geom::detail {
namespace {

/// Returns the boxes of the contours, grown by more than the rounding of bounds().
std::vector<Box> boxes_of(const std::vector<const Contour*>& contours) {
  std::vector<Box> boxes;
  boxes.reserve(contours.size());
  for (const Contour* contour : contours) {
    const Box box = bounds(*contour);
    const double margin = kEdgeDistanceError * (norm(box.low) + norm(box.high));
    boxes.push_back(grown(box, margin));
  }
  return boxes;
}

}  // namespace

Containment::Containment(std::vector<const Contour*> contours)
    : contours_(std::move(contours)), tree_(boxes_of(contours_)), indices_(contours_.size()) {}

std::vector<std::size_t> Containment::around(std::size_t contour) {
  const Point p = contours_[contour]->front().from;
  std::vector<std::size_t> found;
  tree_.visit_meeting({p, p}, [&](std::uint32_t c) {
    if (c == contour) return;
    if (!indices_[c]) indices_[c].emplace(std::vector<Region>{{*contours_[c], {}}});
    if (indices_[c]->contains(p)) found.push_back(c);
  });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace lekalo::geom::detail

#include "containment.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace lekalo::geom::detail {
namespace {

std::vector<Piece> pieces_of(const std::vector<const Contour*>& contours) {
  std::vector<Piece> pieces;
  for (std::size_t c = 0; c < contours.size(); ++c)
    for (const Edge& edge : *contours[c]) append_pieces(edge, static_cast<std::uint32_t>(c), 0, pieces);
  return pieces;
}

std::vector<Box> boxes_of(const std::vector<Piece>& pieces) {
  std::vector<Box> boxes;
  boxes.reserve(pieces.size());
  for (const Piece& piece : pieces) boxes.push_back(box_of(piece));
  return boxes;
}

}  // namespace

Containment::Containment(const std::vector<const Contour*>& contours)
    : pieces_(pieces_of(contours)), tree_(boxes_of(pieces_)) {}

std::vector<std::size_t> Containment::holding(Point p) const {
  std::vector<std::size_t> crossed, found;
  tree_.visit_meeting({p, {std::numeric_limits<double>::infinity(), p.y}}, [&](std::uint32_t i) {
    if (crosses_ray(pieces_[i], p)) crossed.push_back(pieces_[i].origin);
  });
  std::sort(crossed.begin(), crossed.end());
  for (std::size_t i = 0, end = 0; i < crossed.size(); i = end) {
    while (end < crossed.size() && crossed[end] == crossed[i]) ++end;
    if ((end - i) % 2 != 0) found.push_back(crossed[i]);
  }
  return found;
}

}  // namespace lekalo::geom::detail

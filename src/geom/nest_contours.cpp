#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "box_tree.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/region_check.hpp"
#include "piece.hpp"

namespace lekalo::geom {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Which contours hold a point, by the parity of their edges on a ray to the right.
class Containment {
 public:
  explicit Containment(const std::vector<Contour>& contours)
      : pieces_(pieces_of(contours)), tree_(boxes_of(pieces_)) {}

  /// In ascending order; rounding decides on a contour.
  [[nodiscard]] std::vector<std::size_t> holding(Point p) const {
    std::vector<std::size_t> crossed, found;
    tree_.visit_meeting({p, {std::numeric_limits<double>::infinity(), p.y}}, [&](std::uint32_t i) {
      if (detail::crosses_ray(pieces_[i], p)) crossed.push_back(pieces_[i].origin);
    });
    std::sort(crossed.begin(), crossed.end());
    for (std::size_t i = 0, end = 0; i < crossed.size(); i = end) {
      while (end < crossed.size() && crossed[end] == crossed[i]) ++end;
      if ((end - i) % 2 != 0) found.push_back(crossed[i]);
    }
    return found;
  }

 private:
  static std::vector<detail::Piece> pieces_of(const std::vector<Contour>& contours) {
    std::vector<detail::Piece> pieces;
    for (std::size_t c = 0; c < contours.size(); ++c)
      for (const Edge& edge : contours[c])
        detail::append_pieces(edge, static_cast<std::uint32_t>(c), 0, pieces);
    return pieces;
  }
  static std::vector<Box> boxes_of(const std::vector<detail::Piece>& pieces) {
    std::vector<Box> boxes;
    for (const detail::Piece& piece : pieces) boxes.push_back(detail::box_of(piece));
    return boxes;
  }

  std::vector<detail::Piece> pieces_;
  detail::BoxTree tree_;
};

}  // namespace

Result<std::vector<Region>> nest_contours(std::vector<Contour> contours) {
  std::vector<double> areas;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    auto checked = make_region(std::move(contours[i]));
    if (!checked) {
      constexpr std::string_view kOuter = "outer contour";
      return failure(checked.error().code,
                     fmt::format("contour {}{}", i, checked.error().message.substr(kOuter.size())));
    }
    contours[i] = std::move(checked->outer);
    areas.push_back(signed_area(contours[i]));
  }
  const Containment containment(contours);
  std::vector<std::size_t> owner(contours.size(), kNone), region_of(contours.size(), kNone);
  std::vector<Region> regions;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const auto around = containment.holding(contours[i].front().from);
    std::size_t depth = 0;
    for (const std::size_t c : around) {
      if (c == i) continue;
      ++depth;
      if (owner[i] == kNone || areas[c] < areas[owner[i]]) owner[i] = c;
    }
    if (depth % 2 != 0) continue;
    owner[i] = i;
    region_of[i] = regions.size();
    regions.push_back({contours[i], {}});
  }
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (owner[i] == i) continue;
    const std::size_t outline = region_of[owner[i]];
    // Contours that cross can be anything to each other; fault_of names them below.
    if (outline == kNone)
      regions.push_back({contours[i], {}});
    else
      regions[outline].holes.push_back(reversed(contours[i]));
  }
  if (const auto fault = fault_of(regions)) return failure(ErrorCode::bad_input, *fault);
  return regions;
}

}  // namespace lekalo::geom

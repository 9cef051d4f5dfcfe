#include <limits>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "containment.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/region_check.hpp"

namespace lekalo::geom {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

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
  std::vector<const Contour*> all;
  for (const Contour& contour : contours) all.push_back(&contour);
  detail::Containment containment(std::move(all));
  std::vector<std::size_t> owner(contours.size(), kNone), region_of(contours.size(), kNone);
  std::vector<Region> regions;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const auto around = containment.around(i);
    for (const std::size_t c : around)
      if (owner[i] == kNone || areas[c] < areas[owner[i]]) owner[i] = c;
    if (around.size() % 2 != 0) continue;
    owner[i] = i;
    region_of[i] = regions.size();
    regions.push_back({contours[i], {}});
  }
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (owner[i] == i) continue;
    const std::size_t outline = region_of[owner[i]];
    // Contours that cross may seem to hold each other in any way; fault_of names them below.
    if (outline == kNone)
      regions.push_back({contours[i], {}});
    else
      regions[outline].holes.push_back(reversed(contours[i]));
  }
  if (const auto fault = fault_of(regions)) return failure(ErrorCode::bad_input, *fault);
  return regions;
}

}  // namespace lekalo::geom

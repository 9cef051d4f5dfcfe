#include <string>
#include <utility>

#include <fmt/core.h>

#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/containment.hpp"
#include "lekalo/geom/region_check.hpp"

namespace lekalo::geom {

Result<std::vector<Region>> nest_contours(std::vector<Contour> contours) {
  for (std::size_t i = 0; i < contours.size(); ++i) {
    auto checked = make_region(std::move(contours[i]));
    if (!checked) {
      constexpr std::string_view kOuter = "outer contour";
      return failure(checked.error().code,
                     fmt::format("contour {}{}", i, checked.error().message.substr(kOuter.size())));
    }
    contours[i] = std::move(checked->outer);
  }
  std::vector<const Contour*> all;
  for (const Contour& contour : contours) all.push_back(&contour);
  const std::vector<Enclosed> enclosed = enclosed_contours(all);
  std::vector<std::size_t> region_of(contours.size(), 0);
  std::vector<Region> regions;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (enclosed[i].depth % 2 != 0) continue;
    region_of[i] = regions.size();
    regions.push_back({contours[i], {}});
  }
  for (std::size_t i = 0; i < contours.size(); ++i)
    if (enclosed[i].depth % 2 != 0) regions[region_of[enclosed[i].by]].holes.push_back(reversed(contours[i]));
  if (const auto fault = fault_of(regions)) return failure(ErrorCode::bad_input, *fault);
  return regions;
}

}  // namespace lekalo::geom

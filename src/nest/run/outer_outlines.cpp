#include "outer_outlines.hpp"

#include <algorithm>
#include <cmath>

#include "nest/table/simplify.hpp"
#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {

layout::Document with_outer_outlines(const layout::Document& document, bool from_given) {
  layout::Document searched = document;
  for (std::uint32_t p = 0; p < document.parts.size(); ++p) {
    geom::GridRegion& outline = searched.parts[p].outline.polygon;
    if (outline.points.size() <= tuning::kMostCorners) continue;
    if (std::any_of(
            document.placements.begin(), document.placements.end(),
            [&](const layout::Placement& one) { return one.part == p && (one.locked || from_given); }))
      continue;
    outline = outer_outline(outline, std::sqrt(geom::area_mm2(outline)));
  }
  return searched;
}

}  // namespace lekalo::nest

#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::mill {

/// Regions cut into convex or nearly convex pieces along straight lines: at each corner that turns away from
/// the material by more than 0.1 rad, and at each arc that bends into it by more than 3 % of the region's
/// size, the shortest cut of those along its edges, across it, and to other such places; one
/// that does away with two counts half. The pieces cover
/// the regions and overlap nowhere; at most 200 are made. Cost: O(n^2) a cut. \pre regions made by
/// make_region, without faults
[[nodiscard]] Result<std::vector<geom::Region>> convex_fragments(const std::vector<geom::Region>& regions);

}  // namespace lekalo::mill

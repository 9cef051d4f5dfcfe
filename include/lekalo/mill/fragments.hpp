#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::mill {

/// Regions cut into convex or nearly convex pieces along straight lines. A piece may bend away from the
/// material by 3 % of its size: an arc, or a curve of short edges that turn by less than 0.35 rad each, that
/// bends more is cut at its middle; other corners that turn away by more than 0.1 rad are cut. Taken is the
/// shortest cut of those along the edges there, across, and to other such places; one that does away with two
/// counts half. The pieces cover the regions and overlap nowhere; at most 200 are made. Cost: O(n^2) a cut.
/// \pre regions made by make_region, without faults
[[nodiscard]] Result<std::vector<geom::Region>> convex_fragments(const std::vector<geom::Region>& regions);

}  // namespace lekalo::mill

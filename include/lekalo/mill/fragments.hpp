#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::mill {

/// Cuts regions along straight lines into pieces that are convex or nearly so. A piece may bend away from the
/// material by 3 % of its size. An arc that bends more is cut at its middle, and so is a curve of short edges
/// that turn by less than 0.35 rad each; other corners that turn away by more than 0.1 rad are cut. The cuts
/// tried at such a place go along its edges, straight across, and to other such places; the shortest is
/// taken, and one that does away with two places counts half. The pieces cover the regions and overlap
/// nowhere; at most 200 are made. Cost: O(n^2) a cut. \pre regions made by make_region, without faults
[[nodiscard]] Result<std::vector<geom::Region>> convex_fragments(const std::vector<geom::Region>& regions);

}  // namespace lekalo::mill

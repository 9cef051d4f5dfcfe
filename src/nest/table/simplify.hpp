#pragma once

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::nest {

/// A region with fewer corners that holds the given one, but for some steps of rounding. Dents no deeper
/// than `tolerance` mm are filled. An edge between two corners that stick out gives way to the point where
/// its neighbours meet, if that is no further out. It ends at `enough` corners. The given region comes back
/// where the result would not be simple. Cost: O(n log n), and that of geom::make_grid_region.
[[nodiscard]] geom::GridRegion simplified(const geom::GridRegion& region, double tolerance,
                                          std::size_t enough);

/// The outline as it is searched: simplified within the share kSimplify of a size, mm, and where
/// kMostCorners are left even so, within larger ones up to kSimplifyMost. nest.md, step 1.
[[nodiscard]] geom::GridRegion outer_outline(const geom::GridRegion& region, double size);

}  // namespace lekalo::nest

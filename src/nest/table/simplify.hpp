#pragma once

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::nest {

/// A region with fewer corners that holds the given one, but for some steps of rounding. Dents no deeper
/// than `tolerance` mm are filled. An edge between two corners that stick out gives way to the point where
/// its neighbours meet, if that is no further out. It ends at `enough` corners. The given region comes back
/// where the result would not be simple. Cost: O(n^2).
[[nodiscard]] geom::GridRegion simplified(const geom::GridRegion& region, double tolerance,
                                          std::size_t enough);

}  // namespace lekalo::nest

#pragma once

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::nest {

/// A region with fewer corners that holds the given one but for some steps of rounding: dents no deeper than
/// `tolerance` mm are filled, edges between two corners that stick out are replaced by the point where their
/// neighbours meet, where that is no further out. Down to `enough` corners; the given region where the result
/// would not be simple. Cost: O(n^2).
[[nodiscard]] geom::GridRegion simplified(const geom::GridRegion& region, double tolerance,
                                          std::size_t enough);

}  // namespace lekalo::nest

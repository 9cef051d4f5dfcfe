#pragma once

#include <vector>

#include "lekalo/geom/grid_region.hpp"
#include "lekalo/geom/point.hpp"

namespace lekalo::nest {

/// The corners of a convex polygon, counter-clockwise, mm.
using ConvexPiece = std::vector<geom::Point>;

/// Convex pieces without common interior whose union is the region. Ears are cut off, then joined again
/// across the cuts as long as they stay convex. Cost: O(n^2), with holes O(n^2 holes).
[[nodiscard]] std::vector<ConvexPiece> convex_pieces(const geom::GridRegion& region);

}  // namespace lekalo::nest

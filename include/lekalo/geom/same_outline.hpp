#pragma once

#include <vector>

#include "lekalo/geom/region.hpp"

namespace lekalo::geom {

/// Says whether two sets of pieces have the same edges, whatever their order, directions and first points.
/// Then they are the same set of points, if neither has a fault (fault_of). O(n log n).
[[nodiscard]] bool same_outline(const std::vector<Region>& a, const std::vector<Region>& b);

}  // namespace lekalo::geom

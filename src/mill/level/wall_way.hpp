#pragma once

#include <optional>
#include <vector>

#include "lekalo/geom/region_index.hpp"

namespace lekalo::mill {

/// A way along a wall is taken instead of one across if it is at most this many steps long.
constexpr double kWallWay = 6;

/// A way along a wall from one place on it to another: forwards if that is at most `most` mm, else back if
/// that is; none where neither is, or where the places are not both on one wall. Time: O(edges on the way).
[[nodiscard]] std::optional<std::vector<geom::Edge>> way_along_wall(const geom::RegionIndex& walls,
                                                                    geom::Point from, geom::Point to,
                                                                    double most);

}  // namespace lekalo::mill

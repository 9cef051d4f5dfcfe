#pragma once

#include <optional>
#include <vector>

#include "lekalo/geom/region_index.hpp"

namespace lekalo::mill {

/// Of the step: how long a way along a wall instead of one across may be.
constexpr double kWallWay = 6;

/// Along a wall, either way round, from one place on it to another; none where they are not both on it, or
/// further from each other than `most` mm. Time: O(edges on the way).
[[nodiscard]] std::optional<std::vector<geom::Edge>> way_along_wall(const geom::RegionIndex& walls,
                                                                    geom::Point from, geom::Point to,
                                                                    double most);

}  // namespace lekalo::mill

#pragma once

#include <cstddef>
#include <vector>

#include "corners.hpp"
#include "tool_motion.hpp"

namespace lekalo::mill {

/// Step 7 of docs/design/pocket.md: cuts one pass along each wall, which takes the strip that the fields
/// keep, and the corners that it comes by. The pass begins ahead of where a front's pass ended near the wall,
/// so that it comes to the wall at a small angle. \param ends  where passes ended Errors: as Corners::cut.
Result<void> cut_walls(ToolMotion& tool, Corners& corners, const Piece& piece,
                       const std::vector<geom::Point>& ends);

/// Cuts some stretches of walls, the nearest first. \param rounded  those walls, whose corners are cut later
void cut_stretches(ToolMotion& tool, const std::vector<Front>& walls, std::vector<std::size_t> which,
                   const geom::RegionIndex& rounded);

/// Cuts stretches of the walls that no pass came along, as the path shows. Time: O(walls * passes).
/// \param cleared  where other tools have been
void cut_missed_walls(ToolMotion& tool, const Piece& piece, const std::vector<geom::Region>& cleared);

}  // namespace lekalo::mill

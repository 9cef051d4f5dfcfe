#pragma once

#include <cstddef>
#include <vector>

#include "corners.hpp"
#include "tool_motion.hpp"

namespace lekalo::mill {

/// One pass along each wall, which takes the strip the fields keep; where it comes by a corner, that as well.
/// It begins ahead of where a pass came near the wall, to which it comes at a small angle.
/// \param ends  where passes ended
/// Errors: as Corners::cut.
Result<void> cut_walls(ToolMotion& tool, Corners& corners, const Piece& piece,
                       const std::vector<geom::Point>& ends);

/// Some stretches of walls, the nearest first.
void cut_stretches(ToolMotion& tool, const std::vector<Front>& walls, std::vector<std::size_t> which);

/// Stretches of the walls no pass came along, as the path shows. Time: O(walls * passes).
/// \param cleared  where other tools have been
void cut_missed_walls(ToolMotion& tool, const Piece& piece, const std::vector<geom::Region>& cleared);

}  // namespace lekalo::mill

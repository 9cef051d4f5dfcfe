#pragma once

#include <vector>

#include "tool_motion.hpp"

namespace lekalo::mill {

/// Where the tool comes down: the widest disc of places, cut by a helix and a spiral.
struct Entry {
  geom::Point centre;
  double disc = 0;   ///< mm, its radius
  double helix = 0;  ///< mm, radius of the helix
};

/// Looked for at 65 x 65 places and about the best of them, to 1e-7 mm.
[[nodiscard]] Entry widest_disc(const std::vector<geom::Region>& places, double tool_radius);

/// What is cut after it, a disc; of hardly any room what of 0.01 mm the tool's middle may come to. Errors: as
/// geom::combine.
[[nodiscard]] Result<std::vector<geom::Region>> start_region(const Entry& entry, const Piece& piece);

/// A helix, its level turn, and quarter circles out to the disc, in the steps that hold the angle.
/// \param ahead  of length 1: from the centre to where the spiral ends
void enter(ToolMotion& tool, const Entry& entry, geom::Point ahead, const PocketOptions& options);

/// Where other tools have been, for coming down without cutting: near p, with some room about it.
[[nodiscard]] geom::Point roomy_place(geom::Point p, const geom::RegionIndex& cleared, double tool_radius);

}  // namespace lekalo::mill

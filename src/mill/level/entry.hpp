#pragma once

#include <vector>

#include "tool_motion.hpp"

namespace lekalo::mill {

/// Step 2 of docs/design/pocket.md: the disc at which the tool comes down, the widest among the places. A
/// helix and a spiral cut it.
struct Entry {
  geom::Point centre;
  double disc = 0;   ///< mm, its radius
  double helix = 0;  ///< mm, radius of the helix
};

/// Looks at 65 x 65 places, and about the best of them to 1e-7 mm.
[[nodiscard]] Entry widest_disc(const std::vector<geom::Region>& places, double tool_radius);

/// The places that are cut after an entry: its disc, or where there is hardly any room those of a disc of
/// 0.01 mm that the tool's middle may come to. Errors: as geom::combine.
[[nodiscard]] Result<std::vector<geom::Region>> start_region(const Entry& entry, const Piece& piece);

/// Cuts a helix, a level turn, and quarter circles out to the disc in the steps that hold the angle.
/// \param ahead  of length 1: from the centre to where the spiral ends
void enter(ToolMotion& tool, const Entry& entry, geom::Point ahead, const PocketOptions& options);

/// A place near p, with some room about it, where other tools have been: the tool comes down there without
/// cutting.
[[nodiscard]] geom::Point roomy_place(geom::Point p, const geom::RegionIndex& cleared, double tool_radius);

}  // namespace lekalo::mill

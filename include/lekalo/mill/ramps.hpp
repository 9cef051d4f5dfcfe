#pragma once

#include <vector>

#include "lekalo/mill/feeds.hpp"
#include "lekalo/mill/pocket.hpp"

namespace lekalo::mill {

/// A stretch of a path that is cut on the way down: an entry.
struct Ramp {
  geom::Point from, to;
  /// The floor of the stretch, mm.
  double z = 0;
  double length = 0;  ///< mm in plan
  /// The part of the rim that would meet material at one depth, degrees.
  double engagement_deg = 0;
};

struct RampedPath {
  PocketPath path;
  std::vector<Ramp> ramps;  ///< in the path's order
};

/// Gives the path ramps where it would meet more of the rim than 1.25 straight passes do over 0.15 mm: slots,
/// acute corners, ends of grooves, whatever has no side to be relieved from. There the tool rises nearly to
/// the top of its level, goes down along the stretch and a radius around it, comes back through what it has
/// cut, and repeats this to the floor. It meets a thin layer at a time: the ramp angle times the stretch, two
/// diameters of it at most, but at least a fiftieth of the diameter and at most a tenth. No ramp leaves the
/// path in plan, and all of them go in its direction.
///
/// Cost: linear in the path; a ramp's way is its depth over the ramp angle.
/// \param loads  of each move, along it
[[nodiscard]] RampedPath with_ramps(PocketPath path, const std::vector<std::vector<MoveLoad>>& loads,
                                    const PocketOptions& options);

}  // namespace lekalo::mill

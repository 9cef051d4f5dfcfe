#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "nc_moves.hpp"

namespace lekalo::verify {

/// The plane of an arc: XY as G17 has it, ZX as G18, YZ as G19.
enum class ArcPlane { xy, zx, yz };

using Spot = std::array<double, 3>;  ///< x, y, z in mm

/// An arc in one of the three planes, as its words say it, in mm.
struct NcArc {
  ArcPlane plane = ArcPlane::xy;
  bool ccw = true;
  Spot from{}, to{};
  /// The two coordinates of the middle, in the order of the plane's axes: x y, z x, y z.
  std::array<double, 2> centre{};
  int turns = 1;
};

/// The indices in a Spot of the plane's two axes and of the one across.
[[nodiscard]] std::array<std::size_t, 3> axes_of(ArcPlane plane);

/// The middle of the arc by radius; else complaint says why there is none.
[[nodiscard]] std::optional<std::array<double, 2>> centre_of_radius(const NcArc& arc, double radius,
                                                                    std::string& complaint);

/// Returns the fault of an arc whose ends and middle are known; empty: none. Between ends that differ and
/// can hardly be told apart from the middle, one control runs a full turn and another none.
/// \param spirals  the radii at the ends may differ as in programs for controls that run a spiral then
[[nodiscard]] std::string complaint_about(const NcArc& arc, bool spirals = false);

/// The place after this share of the way, from 0 to 1: angle, radius and height change evenly.
[[nodiscard]] Spot spot_at(const NcArc& arc, double share);

/// Adds the arc to the moves: in the XY plane as one, in another as chords that stay within 1e-4 mm of it.
/// Everything but the places is taken from `like`.
void add_arc_moves(const NcArc& arc, const Move& like, std::vector<Move>& moves);

}  // namespace lekalo::verify

#pragma once

#include <cstdint>

#include "lekalo/base/angle.hpp"

namespace lekalo::locate {

/// Where the part lies: part coordinates p go to R(theta) p + (x, y) in blank coordinates.
struct Placement {
  double x = 0, y = 0;  ///< mm
  double theta = 0;     ///< radians, counter-clockwise
  double clearance =
      0;  ///< minimum allowance there, mm, never above the exact one; negative: the part sticks out
};

/// Vertex of the part against the line of blank edge `blank_edge` (from that vertex to the next), indices
/// into the polygons of the problem.
struct Contact {
  std::uint32_t part_vertex = 0, blank_edge = 0;
  double multiplier = 0;
};

/// Angles from `from` to `to` >= `from`, radians. The default is every angle.
struct AngleWindow {
  double from = 0, to = kTurnAbove;
  [[nodiscard]] constexpr bool full_circle() const noexcept { return to - from >= kTurn; }
};

enum class Status {
  optimal,    ///< the gap asked for (or the limit of double arithmetic, if larger) is closed
  stopped,    ///< stopped by budget or request; pose and bound are valid
  infeasible  ///< proved: no placement in the window reaches the minimum allowance
};

}  // namespace lekalo::locate

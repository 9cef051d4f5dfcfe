#pragma once

#include <cstdint>

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
  double from = 0, to = 6.283185307179587;  ///< the double just above 2 pi
  [[nodiscard]] constexpr bool full_circle() const noexcept { return to - from >= 6.283185307179586; }
};

enum class Status {
  optimal,    ///< the gap asked for (or the limit of double arithmetic, if larger) is closed
  stopped,    ///< stopped by budget or request; pose and bound are valid
  infeasible  ///< proved: no placement in the window reaches the minimum allowance
};

}  // namespace lekalo::locate

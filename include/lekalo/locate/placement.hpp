#pragma once

#include <cstdint>
#include <optional>

#include "lekalo/geom/point.hpp"

#include "lekalo/base/angle.hpp"

namespace lekalo::locate {

/// The place of the part: part coordinates p go to R(theta) p + (x, y) in blank coordinates.
struct Placement {
  double x = 0, y = 0;  ///< mm
  double theta = 0;     ///< radians, counter-clockwise
  /// The minimum allowance there, mm, never above the exact one; negative where the part sticks out.
  double clearance = 0;
};

/// A vertex of the part against the line of blank edge `blank_edge` (from that vertex to the next). Both are
/// indices into the polygons of the problem.
struct Contact {
  std::uint32_t part_vertex = 0, blank_edge = 0;
  double multiplier = 0;
};

/// A place that holds a placement: where the part is nearest to the blank's boundary. Edges have the numbers
/// of the regions given (geom::Region).
struct Touch {
  /// For convex outlines this is the vertex that touches, at which that edge begins.
  std::uint32_t part_edge = 0;
  std::uint32_t blank_edge = 0;
  geom::Point part, blank;  ///< the two points, each in its own frame, mm
  double distance = 0;      ///< mm, at the placement
  /// The contact's share in what holds the placement; all shares sum to 1.
  double multiplier = 0;
  /// The cap that the part's point is deep for, with `part_edge` counted in its list. Without a value the
  /// point is near the boundary.
  std::optional<std::uint32_t> cap;
};

/// The angles from `from` to `to` >= `from`, radians. The default is every angle.
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

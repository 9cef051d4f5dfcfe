#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/field/grid.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::field {

/// The time at which a front gets to each node: |grad T| = 1 / speed.
struct ArrivalTimes {
  GridFrame frame;
  /// The time of each node, s: infinite where nothing arrives, negative in the start.
  std::vector<double> time;
  /// The latest finite time, s; not below 0.
  double last = 0;
  /// True when the front gets to every node with a speed.
  bool reaches_all = true;
};

/// Marches a front from a start at time 0 (fast marching, J. A. Sethian, 1996), with differences of second
/// order where two nodes behind are known.
/// \param speed  mm/s at each node, as many as the frame has; not above 0 where nothing goes
/// \param start  of lines and arcs; nodes in it or nearer than 2.2 pitches get the exact distance (negative
///   inside) over their own speed
/// Error, h the pitch: with one speed, where the way to a node from the start is straight and passes no wall
/// closely, 0.5 h^2 / r over the speed (r the front's least radius, at least 2 h): second order. Elsewhere
/// first order, over the least speed: h where the speed jumps, 1.5 h behind a corner, and 5.5 h half round a
/// round wall, which on the grid is a staircase. Held by tests/property/field_arrival_test.cpp. Every node
/// outside the start has a neighbour with an earlier time. No threads: the same input gives the same bytes.
/// Cost: O(n log n), n the nodes with a speed. \pre frame.pitch > 0, a start that is not empty
[[nodiscard]] ArrivalTimes arrival_times(const GridFrame& frame, const std::vector<double>& speed,
                                         const geom::RegionIndex& start);

/// Carries the times on straight to nodes without speed up to `rings` away from those that have a time, so
/// that level lines cross the walls: the mean of 2 T1 - T2 along each axis, or T1 alone where T2 is not
/// known. The lowest and the highest two rows of the grid get no time. \param speed  as for arrival_times
void extend_beyond_walls(ArrivalTimes& arrival, const std::vector<double>& speed, std::size_t rings);

}  // namespace lekalo::field

#pragma once

#include <array>
#include <vector>

#include "lekalo/nc/machine_time.hpp"

namespace lekalo::nc {

using SpaceVector = std::array<double, 3>;

/// A motion of a program as the plan of speeds needs it.
struct PlannedMotion {
  double length_mm = 0;      ///< above 0
  SpaceVector first, last;   ///< the directions of travel at its ends, of length 1
  double radius_mm = 0;      ///< of an arc in the plane; 0 for a line
  double feed_mm_per_s = 0;  ///< infinite for a rapid
};

/// Returns the seconds of each motion of a way that begins and ends at rest, with the wait where it stops.
/// The speed never rises above what feed, axes and curvature allow, nor faster than the acceleration, and at
/// a junction it is at most what the control's rule allows. Cost: O(motions).
[[nodiscard]] std::vector<double> planned_seconds(const std::vector<PlannedMotion>& way,
                                                  const MachineModel& machine);

}  // namespace lekalo::nc

#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/jobs/heat.hpp"

namespace lekalo::jobs {

/// The places of a pocket's walls that a program cuts.
struct CutWalls {
  std::vector<WallPoint> points;  ///< with place and direction; ordered by the outline, then by height
  std::vector<std::vector<WallVisit>> visits;  ///< of each of them, in the order of time
  std::size_t uncut = 0;
};

/// Steps 1 and 2 of docs/design/heat-walls.md. \param spacing  of places, mm
[[nodiscard]] Result<CutWalls> cut_walls(const HeatSourceJob& job, const HeatSource& source, double spacing);

/// Step 7: the scaling about the middle of the walls, and the shift, by least squares.
[[nodiscard]] UniformScaling best_scaling(const std::vector<WallPoint>& walls,
                                          const std::vector<double>& errors_um);

/// Returns what a scaling of the program leaves of a part of the errors, um.
[[nodiscard]] std::vector<double> scaled(const std::vector<WallPoint>& walls,
                                         const std::vector<double>& errors_um, double part,
                                         const UniformScaling& by);

[[nodiscard]] WallErrors summary_of(const std::vector<double>& errors_um);

}  // namespace lekalo::jobs

#pragma once

#include <vector>

#include "heat_passes.hpp"
#include "lekalo/nc/moved_path.hpp"

namespace lekalo::jobs {

/// Step 4 of docs/design/heat-correction.md: the way of the tool moved as its finishing passes are, and back
/// to where it was beside them.
/// \param spacing  of places, mm
[[nodiscard]] std::vector<nc::MovedMotion> moved_motions(const HeatFound& found,
                                                         const std::vector<WallPasses>& stations,
                                                         double tool_radius, double spacing);

}  // namespace lekalo::jobs

#pragma once

#include <optional>
#include <string>

#include "lekalo/jobs/heat.hpp"

namespace lekalo::jobs {

/// The errors of walls are those of heat: they count from where the program's path would leave a wall in a
/// cold workpiece. A program may leave it elsewhere than it is drawn, as one that was corrected for heat
/// does. Then this is a sentence with the errors that count from the drawing, at the middles; step 14 of
/// docs/design/heat-walls.md.
[[nodiscard]] std::optional<std::string> path_off_walls(const HeatJob& job, const HeatFound& found);

}  // namespace lekalo::jobs

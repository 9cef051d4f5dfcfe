#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/jobs/locate.hpp"
#include "lekalo/locate/placement.hpp"

namespace lekalo::jobs {

/// The blank on layer BLANK and the part as it lies on layer PART, in the blank's coordinates. Placed
/// coordinates are rounded to doubles. \pre format is not `none`
[[nodiscard]] Result<std::string> placed_drawing(DrawingFormat format, const std::vector<geom::Region>& part,
                                                 const std::vector<geom::Region>& blank,
                                                 const locate::Placement& placement, bool mirrored);

}  // namespace lekalo::jobs

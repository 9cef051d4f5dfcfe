#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/locate/placement.hpp"

namespace lekalo::cli {

/// The bytes of --drawing: the blank on layer BLANK and the part as it lies on layer PART, in the blank's
/// coordinates; DXF or SVG by the ending of `path`. Placed coordinates are rounded to doubles.
[[nodiscard]] Result<std::string> placed_drawing(const std::string& path,
                                                 const std::vector<geom::Region>& part,
                                                 const std::vector<geom::Region>& blank,
                                                 const locate::Placement& placement, bool mirrored);

}  // namespace lekalo::cli

#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::mill {

/// Shrinks regions by `shrink` and keeps of that what discs of radius `fillet` reach: corners become round,
/// and what is narrower than a disc is gone. Errors: as geom::offset.
[[nodiscard]] Result<std::vector<geom::Region>> opened_by(const std::vector<geom::Region>& regions,
                                                          double shrink, double fillet);

}  // namespace lekalo::mill

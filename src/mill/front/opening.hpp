#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::mill {

/// Regions shrunk by `shrink`, and of that what discs of radius `fillet` reach: corners are rounded, what is
/// narrower is gone. Errors: as geom::offset.
[[nodiscard]] Result<std::vector<geom::Region>> opened_by(const std::vector<geom::Region>& regions,
                                                          double shrink, double fillet);

}  // namespace lekalo::mill

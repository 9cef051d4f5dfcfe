#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/mill/path.hpp"

/// Mirrors with x for -x: what is climb on one side of a mirror is conventional on the other.
namespace lekalo::mill {

/// Errors: as geom::make_region.
[[nodiscard]] Result<std::vector<geom::Region>> mirrored(const std::vector<geom::Region>& regions);
[[nodiscard]] PocketPath mirrored(PocketPath path);

}  // namespace lekalo::mill

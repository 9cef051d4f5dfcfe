#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/mill/pocket.hpp"

namespace lekalo::mill {

/// mm: material that stands thinner than this where an earlier tool came along is rounding.
inline constexpr double kThin = 4e-3;

/// The places where a tool of this radius meets nothing at this depth, because earlier tools have been there.
/// Material that stands thinner than kThin counts as nothing.
[[nodiscard]] Result<std::vector<geom::Region>> cleared_places(const std::vector<EarlierCut>& cuts,
                                                               double depth, double tool_radius);

/// The places where a tool may be, divided into those that are cut and those that are left.
struct Divided {
  std::vector<geom::Region> cleared, left;
};
/// \param allowed  one piece of places, \param cleared  as from cleared_places
[[nodiscard]] Result<Divided> divided(const geom::Region& allowed, const std::vector<geom::Region>& cleared);

}  // namespace lekalo::mill

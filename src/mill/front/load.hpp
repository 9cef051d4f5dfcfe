#pragma once

#include <vector>

#include "lekalo/geom/region.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::mill {

/// The load on a tool along a pass, when everything within the tool's radius of an earlier pass is cut.
struct Load {
  /// The length of the pass, mm.
  double length = 0;
  /// The length of it on which the rim's arc in material is larger than the angle held, mm.
  double beyond = 0;
  /// The largest such arc that lasts from one place looked at to the next, degrees.
  double largest = 0;
};

/// Measures the load every `spacing` mm. The load only chooses steps, because the checker judges the program.
/// \param back  `before`, the earlier pass, lies on the right of the pass, not on the left
[[nodiscard]] Load load_of(const std::vector<geom::Edge>& pass, bool back, const geom::RegionIndex& before,
                           double tool_radius, double held_degrees, double spacing);

}  // namespace lekalo::mill

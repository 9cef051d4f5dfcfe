#pragma once

#include <vector>

#include "lekalo/geom/region.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::mill {

/// The load on a tool along a pass when all within its radius of `before` is cut.
struct Load {
  double length = 0;   ///< mm of the pass
  double beyond = 0;   ///< mm of it on which the rim's arc in material is larger than the angle held
  double largest = 0;  ///< degrees, lasting from one place looked at to the next
};

/// Measures the load every `spacing` mm. It only chooses steps; the checker judges the program.
/// \param back  `before` lies on the right of the pass, not on the left
[[nodiscard]] Load load_of(const std::vector<geom::Edge>& pass, bool back, const geom::RegionIndex& before,
                           double tool_radius, double held_degrees, double spacing);

}  // namespace lekalo::mill

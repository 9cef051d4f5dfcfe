#pragma once

#include <vector>

#include "fronts.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::mill {

/// Step 5 of docs/design/pocket.md: leads from what is cut into corridors hardly wider than the tool, by the
/// loops of a trochoid. They are half circles from wall to wall about the places with most room, each as far
/// from the one before as the angle allows. Where not even a loop has room a slot leads on. Parents are
/// numbered from 0 among these fronts.
/// \param limit  where the tool's middle may be
/// \param narrow  the corridors, and some of what they lead to
/// \param done  fronts before: what their slots have cut is not in `cut`
[[nodiscard]] std::vector<Front> corridor_loops(const geom::RegionIndex& limit,
                                                const geom::RegionIndex& narrow,
                                                const std::vector<geom::Region>& cut,
                                                const std::vector<Front>& done, const GrowthLaw& law);

}  // namespace lekalo::mill

#pragma once

#include <vector>

#include "lekalo/geom/region.hpp"

namespace lekalo::mill {

/// Appends lines and arcs from the first place to the last that pass within `tolerance` of all of them; each
/// begins and ends at one of them. Greedy: as far as one piece goes.
void fit_arcs(const std::vector<geom::Point>& places, double tolerance, std::vector<geom::Edge>& edges);

}  // namespace lekalo::mill

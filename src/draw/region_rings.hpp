#pragma once

#include <vector>

#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::draw {

/// The contours as points: chords no further than `sag` off their arcs and no longer than `step`, mm, at most
/// 10,000 an edge. Each outer contour before its holes.
[[nodiscard]] std::vector<geom::Ring> region_rings(const std::vector<geom::Region>& regions, double sag,
                                                   double step);

}  // namespace lekalo::draw

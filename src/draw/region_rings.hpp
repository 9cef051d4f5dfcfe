#pragma once

#include <vector>

#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::draw {

/// Returns the contours as points, each outer contour before its holes. The chords are no further than `sag`
/// off their arcs and no longer than `step`, mm, and an edge has at most 10,000 of them.
[[nodiscard]] std::vector<geom::Ring> region_rings(const std::vector<geom::Region>& regions, double sag,
                                                   double step);

/// Returns edges that need not close as points, their end among them, in the same way.
[[nodiscard]] geom::Ring chain_points(const geom::Contour& chain, double sag, double step);

}  // namespace lekalo::draw

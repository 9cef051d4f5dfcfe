#pragma once

#include <optional>
#include <vector>

#include "lekalo/geom/grid_region.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::layout {

/// Says exactly whether some disc lies in all of `inside` and in none of `without` (closed outlines). A
/// corner of such a set is a vertex of one of the outlines or a point where edges of two cross. Around each
/// of these the directions between the edges are tried. Crossings are fractions, compared in 256 bits. Cost:
/// (vertices and crossings within all boxes of `inside`) times all edges.
/// \return one such corner, in steps
/// \pre coordinates within kGridLimit, edges no longer than kGridLimit
[[nodiscard]] std::optional<geom::Point> common_corner(const std::vector<const geom::GridRegion*>& inside,
                                                       const std::vector<const geom::GridRegion*>& without);

/// Returns a place where a part with this outline needs better material than a zone of `quality` with this
/// outline has: a corner of the place, in steps. Returns none where there is no such place. Rule 6 of
/// docs/design/layout.md.
[[nodiscard]] std::optional<geom::Point> lacks_quality(const Part& part, const Placement& placement,
                                                       const geom::GridRegion& outline,
                                                       const QualityZone& zone);

}  // namespace lekalo::layout

#pragma once

#include "arrangement.hpp"
#include "planar_map.hpp"

namespace lekalo::geom::detail {

/// A loop as edges again: stretches of one edge joined, whole edges with their own doubles.
struct LoopContour {
  Contour contour;
  double corner_error = 0;  ///< boolean.hpp, for edges moved by `edge_error`
};
[[nodiscard]] LoopContour contour_of(const PlanarMap::Loop& loop, const Outlines& outlines,
                                     const Arrangement& arrangement, double edge_error);

}  // namespace lekalo::geom::detail

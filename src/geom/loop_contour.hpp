#pragma once

#include "arrangement.hpp"
#include "planar_map.hpp"

namespace lekalo::geom::detail {

/// A loop as edges again: stretches of one edge are joined, and whole edges have their own doubles.
struct LoopContour {
  Contour contour;
  /// The corner_error of boolean.hpp when edges move by `edge_error`.
  double corner_error = 0;
  /// By edge: the outline edge that it comes from, the first of several on one line.
  std::vector<std::uint32_t> origins;
};
[[nodiscard]] LoopContour contour_of(const PlanarMap::Loop& loop, const Outlines& outlines,
                                     const Arrangement& arrangement, double edge_error);

}  // namespace lekalo::geom::detail

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::locate {

/// A convex outline as the fast path takes it, and the way back to the indices of the file it was read from.
struct ConvexOutline {
  geom::ConvexPolygon polygon;  ///< mm
  double coordinate_error = 0;  ///< every coordinate is within this of the true one, mm
  /// The numbers that results give the polygon's vertices and edges (edge k runs from vertex k to the next).
  /// When the lists are empty they are the indices.
  std::vector<std::uint32_t> vertex_numbers, edge_numbers;
};

/// The thing that is placed, or the thing that it is placed in.
struct Outline {
  /// Regions of lines and arcs, mm, made by make_region. May be empty where `convex` is there.
  std::vector<geom::Region> regions;
  /// The true outline lies within this of that of `regions`, mm.
  double tolerance = 0;
  /// The layer or the primitive that each edge comes from, "" for none. Empty: no edge has one.
  std::vector<std::string> labels;
  /// The same outline where it is a convex polygon; two of them may be placed by the fast path.
  std::optional<ConvexOutline> convex;
};

}  // namespace lekalo::locate

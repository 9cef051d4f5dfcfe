#pragma once

#include <vector>

#include "lekalo/geom/region.hpp"

/// Lines and arcs as stretches of a path.
namespace lekalo::mill {

[[nodiscard]] double length_of(const geom::Edge& edge);
[[nodiscard]] double length_of(const std::vector<geom::Edge>& edges);
/// The place at a share of an edge's length, in [0, 1].
[[nodiscard]] geom::Point place_at(const geom::Edge& edge, double share);
/// The stretch between two shares. \pre 0 <= from < to <= 1
[[nodiscard]] geom::Edge part_of(const geom::Edge& edge, double from, double to);
/// The direction of travel at a place of the edge.
[[nodiscard]] geom::Point heading_at(const geom::Edge& edge, geom::Point at);
/// Places on the edges no further than `spacing` apart, both ends among them.
[[nodiscard]] std::vector<geom::Point> places_on(const std::vector<geom::Edge>& edges, double spacing);

}  // namespace lekalo::mill

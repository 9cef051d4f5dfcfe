#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/polygon.hpp"

namespace lekalo::locate {

/// A closed outline through measured points (indices), joined in this order.
using Loop = std::vector<std::uint32_t>;

/// Median distance of a point from the nearest other, by at most 2,000 of them. \pre sorted by x, then y, no
/// two equal, at least two
[[nodiscard]] double median_nearest(const geom::Ring& points, const std::vector<std::uint32_t>& sorted);

/// Points that have no other within `reach`. Ascending.
[[nodiscard]] std::vector<std::uint32_t> lonely_points(const geom::Ring& points, double reach);

/// Loops through some of the points, at least `spread` apart from each other, such that every other point
/// lies within `spread` of one of them. Two are neighbours if they are at most `link` apart and no third is
/// nearer to both than they are to each other (relative neighbourhood graph, Toussaint 1980); loose ends are
/// joined to the nearest loose end.
///
/// Fails with ErrorCode::bad_input, naming the place, where a point has more than two neighbours, where loose
/// ends could be joined in several ways, and for points that belong to no closed outline.
/// \param sorted  indices of points by x, then y, no two of them at one place
/// Cost: O(n + m log m), m points of the loops.
[[nodiscard]] Result<std::vector<Loop>> order_points(const geom::Ring& points,
                                                     const std::vector<std::uint32_t>& sorted, double spread,
                                                     double link);

/// Two edges of closed outlines meet here that should not: neighbours elsewhere than in the point they share,
/// others anywhere.
struct Crossing {
  std::uint32_t loop_a = 0, edge_a = 0, loop_b = 0, edge_b = 0;
};
/// The first found, going along the loops: early for points in no order. Exact predicates.
/// Cost: O(n) for edges of about the same length.
[[nodiscard]] std::optional<Crossing> first_crossing(const geom::Ring& points,
                                                     const std::vector<Loop>& loops);

/// Makes each loop run around material: counter-clockwise if an even number of the others is around it,
/// clockwise if an odd one. Turns those around that do not. \pre no two edges meet
void turn_material_left(const geom::Ring& points, std::vector<Loop>& loops);

}  // namespace lekalo::locate

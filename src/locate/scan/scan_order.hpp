#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/polygon.hpp"

namespace lekalo::locate {

/// A closed outline through measured points (indices), joined in this order.
using Loop = std::vector<std::uint32_t>;

/// Returns the median distance of a point from the nearest other one, of at most 2,000 points.
/// \pre sorted by x, then y, no two equal, at least two
[[nodiscard]] double median_nearest(const geom::Ring& points, const std::vector<std::uint32_t>& sorted);

/// Returns the points that have no other within `reach`, ascending.
[[nodiscard]] std::vector<std::uint32_t> lonely_points(const geom::Ring& points, double reach);

/// Returns a point as messages name it, mm.
[[nodiscard]] std::string place_of(geom::Point p);

/// Step 1 of docs/design/scan.md for points without order: returns loops through some of the points, at least
/// `spread` apart from each other, such that every other point lies within `spread` of one of them. Two are
/// neighbours if they are at most `link` apart and no third is nearer to both than they are to each other
/// (relative neighbourhood graph, Toussaint 1980). Loose ends are joined to the nearest loose end.
///
/// Fails with ErrorCode::bad_input, naming the place, where a point has more than two neighbours, where loose
/// ends could be joined in several ways, and for points that belong to no closed outline.
/// \param sorted  indices of points by x, then y, no two of them at one place
/// Cost: O(n + m log m), m points of the loops.
[[nodiscard]] Result<std::vector<Loop>> order_points(const geom::Ring& points,
                                                     const std::vector<std::uint32_t>& sorted, double spread,
                                                     double link);

/// Two edges of closed outlines that meet and should not: neighbours elsewhere than in the point they share,
/// others anywhere.
struct Crossing {
  std::uint32_t loop_a = 0, edge_a = 0, loop_b = 0, edge_b = 0;
};
/// Returns the first crossing found, going along the loops, which for points in no order comes early. Exact
/// predicates. Cost: O(n) for edges of about the same length.
[[nodiscard]] std::optional<Crossing> first_crossing(const geom::Ring& points,
                                                     const std::vector<Loop>& loops);

/// Step 2: makes each loop run around material, counter-clockwise if an even number of the others is around
/// it, clockwise if an odd one. Loops that run the other way are turned.
/// \pre no two edges meet
void turn_material_left(const geom::Ring& points, std::vector<Loop>& loops);

}  // namespace lekalo::locate

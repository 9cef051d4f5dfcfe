#pragma once

#include <compare>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/limits.hpp"

namespace lekalo::verify {

/// Outlines between points of the grid of docs/design/layout.md, and what is asked about several of them at
/// once. Everything is decided in whole numbers.

__extension__ using Wide = __int128;

struct GridPoint {
  std::int64_t x{}, y{};
  friend auto operator<=>(const GridPoint&, const GridPoint&) = default;
};

struct GridEdge {
  GridPoint from, to;  ///< material on the left
};

struct GridBox {
  std::int64_t low_x{}, low_y{}, high_x{}, high_y{};
};

using GridLoop = std::vector<GridPoint>;

struct GridOutline {
  std::vector<GridEdge> edges;
  GridBox box;
};

/// The largest coordinates of an outline as it is written and as it is placed, in steps of 2^-20 mm.
inline constexpr std::int64_t kMostWritten = static_cast<std::int64_t>(limits::kLargestOutline) << 20,
                              kMostPlaced = std::int64_t{1} << 40;

/// Turns the first loop counter-clockwise and the others clockwise; the first is the outer one.
/// \pre fault_of(loops) finds no fault
[[nodiscard]] GridOutline make_outline(std::vector<GridLoop> loops);

/// The fault that keeps loops from being an outline: fewer than three points, no area, a vertex less than 3
/// steps from an edge that does not end there, edges that cross, a hole that is not inside, or more pairs of
/// edges whose boxes meet than limits::most_meeting_boxes. Cost: O(n log n + those pairs).
[[nodiscard]] std::optional<std::string> fault_of(const std::vector<GridLoop>& loops);

/// The answer says whether some disc lies in the material of all of `in` and in none of `out` (of these too,
/// holes are not material). \pre 1 outline or more in `in`, coordinates within kMostPlaced. Cost: for each
/// point of an edge near the box common to `in`, and each crossing, the edges that a ray from it may meet.
[[nodiscard]] bool have_common_disc(const std::vector<const GridOutline*>& in,
                                    const std::vector<const GridOutline*>& out);

/// The answer says whether a point of a's edges and one of b's are less than `gap` steps apart. \pre 0 <= gap
/// <= kMostPlaced
[[nodiscard]] bool edges_nearer_than(const GridOutline& a, const GridOutline& b, std::int64_t gap);

}  // namespace lekalo::verify

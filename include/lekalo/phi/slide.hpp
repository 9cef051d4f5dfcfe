#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::phi {

/// Moving an outline along a direction until something is in the way: docs/design/slide.md.

/// A way from `start` along `direction`. Positions are those grid points that are nearest to the straight
/// way.
struct SlidePath {
  geom::GridPoint start;
  geom::Point direction;  ///< unit vector
  double length = 0;      ///< steps, <= 2^42

  [[nodiscard]] geom::GridPoint at(double s) const noexcept;
};

/// Appends the places on the way, in steps, where the distance of the two outlines' edges can pass the gap:
/// the way's crossings of every vertex with what lies within `gap` of every edge, both ways round. Between
/// two of these places it does not change whether they are apart; at some of them nothing changes. Unordered.
/// \param moving  around its own origin, moved by the path's points; `fixed` is moved by fixed_at
/// Cost: O(edges of both that the way sweeps near, multiplied).
void append_slide_events(const geom::GridRegion& moving, const SlidePath& path, const geom::GridRegion& fixed,
                         geom::GridPoint fixed_at, std::int64_t gap, std::vector<double>& events);

/// Finds the last position on the way that can be reached through valid ones only.
///
/// `valid` decides exactly whether a position is allowed; `events` are all places where that can change
/// (append_slide_events). Positions may lie one step beside the straight way where that keeps them valid, so
/// that a part that slides along a slanting edge does not catch on the grid. What blocks the way for less
/// than 4 steps (4 nanometres) of it may be passed.
///
/// The position returned is valid. Where the way is blocked, one of the 8 grid points around it is not.
///
/// Cost: a sort of the events, up to 9 questions for each until the first that blocks, and about 50 to place
/// it.
/// \pre valid(path.start)
struct SlideEnd {
  geom::GridPoint at;
  double way = 0;  ///< steps
  /// True when the way is blocked before its end.
  bool blocked = false;
};
[[nodiscard]] SlideEnd slide(const SlidePath& path, std::vector<double> events,
                             const std::function<bool(geom::GridPoint)>& valid);

}  // namespace lekalo::phi

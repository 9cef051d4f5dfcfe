#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/region.hpp"
#include "scan_order.hpp"

namespace lekalo::locate {

/// An outline with what must stay out of the guaranteed blank: everything within reach[i] of edge i, and
/// everything within the guard of a point that was measured beside it.
struct GuardedLoop {
  /// The vertices, with material on the left.
  Loop vertices;
  std::vector<double> reach;  ///< by edge, mm
  /// The points measured beside edge i are beside[beside_starts[i] .. beside_starts[i + 1]).
  std::vector<std::uint32_t> beside_starts, beside;

  [[nodiscard]] std::uint32_t vertex(std::size_t i) const { return vertices[i % vertices.size()]; }
};

/// A rectangle that stands for a run of edges (first, first + 1, ..., last - 1 of a loop) along `along`. All
/// that must stay out lies between `low` and `high` across and between `back` and `front` along.
struct Slab {
  geom::Point along;
  double low = 0, high = 0, back = 0, front = 0;
};

/// Step 3 of docs/design/scan.md: covers what a loop keeps out by slabs. A greedy walk takes as few as it
/// finds whose inner side is nowhere more than `tolerance` further in than what it covers there. Cost: O(n
/// log n).
[[nodiscard]] std::vector<Slab> cover_by_slabs(const geom::Ring& points, const GuardedLoop& loop,
                                               double guard, double tolerance);

/// Step 4: gives the regions of lines inside the outlines and outside all slabs. Slabs are made wider by
/// `margin`. Fails as the Booleans do. Cost: O((n + k) log n), k pairs of slabs that meet.
[[nodiscard]] Result<std::vector<geom::Region>> inside_of_slabs(const geom::Ring& points,
                                                                const std::vector<GuardedLoop>& loops,
                                                                const std::vector<Slab>& slabs,
                                                                double margin);

/// Step 5: cuts corners of the regions off, of the material only, where that takes vertices away and no cut
/// is deeper than `tolerance`. Cost: O(n log n) where corners are not crowded.
[[nodiscard]] std::vector<geom::Region> cut_corners(const std::vector<geom::Region>& regions,
                                                    double tolerance);

/// Step 6, the proof on which the claim rests: says whether every edge of the loops is at least its reach
/// away from the regions, every point beside them at least the guard away, and every piece inside the
/// outlines. Each distance is lessened by what rounding may have done.
[[nodiscard]] bool keeps_out(const geom::Ring& points, const std::vector<GuardedLoop>& loops, double guard,
                             const std::vector<geom::Region>& regions);

}  // namespace lekalo::locate

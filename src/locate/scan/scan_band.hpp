#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/region.hpp"
#include "scan_order.hpp"

namespace lekalo::locate {

/// An outline with what must stay out of the guaranteed blank: everything within reach[i] of edge i, and
/// within the guard of every point measured beside it.
struct GuardedLoop {
  Loop vertices;              ///< material on the left
  std::vector<double> reach;  ///< per edge, mm
  /// Points measured beside edge i: beside[beside_starts[i] .. beside_starts[i + 1]).
  std::vector<std::uint32_t> beside_starts, beside;

  [[nodiscard]] std::uint32_t vertex(std::size_t i) const { return vertices[i % vertices.size()]; }
};

/// A slab replaces a run of edges (first, first + 1, ..., last - 1 of a loop) by one rectangle along `along`:
/// all that must stay out lies between `low` and `high` across and `back` and `front` along.
struct Slab {
  geom::Point along;
  double low = 0, high = 0, back = 0, front = 0;
};

/// Covers what a loop keeps out by slabs, as few as a greedy walk finds whose inner side is nowhere more than
/// `tolerance` further in than what it covers at that place. Cost: O(n log n).
[[nodiscard]] std::vector<Slab> cover_by_slabs(const geom::Ring& points, const GuardedLoop& loop,
                                               double guard, double tolerance);

/// Gives what lies inside the outlines and outside all slabs; regions of lines. Slabs are made wider by
/// `margin`. Fails as the Booleans do. Cost: O((n + k) log n), k pairs of slabs that meet.
[[nodiscard]] Result<std::vector<geom::Region>> inside_of_slabs(const geom::Ring& points,
                                                                const std::vector<GuardedLoop>& loops,
                                                                const std::vector<Slab>& slabs,
                                                                double margin);

/// Cuts corners of the regions off, material only, where that takes vertices away and no cut is deeper than
/// `tolerance`. Cost: O(n log n) where corners are not crowded.
[[nodiscard]] std::vector<geom::Region> cut_corners(const std::vector<geom::Region>& regions,
                                                    double tolerance);

/// The proof that nothing else relies on: whether every edge of the loops is at least its reach, every point
/// beside them at least the guard away from the regions, and every piece lies inside the outlines; each
/// distance lessened by what rounding may have done.
[[nodiscard]] bool keeps_out(const geom::Ring& points, const std::vector<GuardedLoop>& loops, double guard,
                             const std::vector<geom::Region>& regions);

}  // namespace lekalo::locate

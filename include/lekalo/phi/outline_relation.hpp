#pragma once

#include <cstdint>

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::phi {

/// The relation of two outlines on the grid is decided exactly: there are no tolerances, and touching is not
/// overlapping. docs/design/layout-check.md says how, and why it is complete. `b` always counts as moved by
/// `shift`.
/// \pre regions made by make_grid_region or turned() from one; |shift| <= 2 kGridLimit
/// Cost: O(a + b + pairs of edges whose boxes meet). No exceptions, threads or library mathematics.

/// Says whether some disc lies in the material of both.
[[nodiscard]] bool interiors_meet(const geom::GridRegion& a, const geom::GridRegion& b,
                                  geom::GridPoint shift = {});

/// Says whether all material of `b` lies in that of `container`; edges may touch.
[[nodiscard]] bool lies_within(const geom::GridRegion& container, const geom::GridRegion& b,
                               geom::GridPoint shift = {});

/// Says whether some point of a's edges and some point of b's edges are less than `gap` steps apart; equal is
/// not less.
/// \pre 0 <= gap <= kGridLimit
[[nodiscard]] bool edges_nearer_than(const geom::GridRegion& a, const geom::GridRegion& b, std::int64_t gap,
                                     geom::GridPoint shift = {});

/// The least distance between the edges of both, mm, and where it is reached. It is within 1e-15 of itself
/// relatively and 1e-12 mm, and exactly 0 where the edges meet.
struct EdgeDistance {
  double distance_mm = 0;
  geom::Point on_a, on_b;  ///< mm
};
[[nodiscard]] EdgeDistance edge_distance(const geom::GridRegion& a, const geom::GridRegion& b,
                                         geom::GridPoint shift = {});

}  // namespace lekalo::phi

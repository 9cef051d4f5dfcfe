#pragma once

#include "lekalo/geom/point.hpp"
#include "lekalo/geom/polygon.hpp"

namespace lekalo::geom {

/// Distances in millimetres, to nearest rounding of a short formula: within 8 u d of the exact value for
/// points whose largest coordinate difference is d (u = 2^-53). Not for decisions: those are predicates.h.

[[nodiscard]] Point nearest_on_segment(Point p, Point a, Point b) noexcept;
[[nodiscard]] double distance_to_segment(Point p, Point a, Point b) noexcept;
/// 0 where the segments cross or touch.
[[nodiscard]] double distance_between_segments(Point a, Point b, Point c, Point d) noexcept;
/// From p to the nearest boundary point of the ring (never negative, inside or out).
[[nodiscard]] double distance_to_boundary(Point p, const Ring& ring) noexcept;

}  // namespace lekalo::geom

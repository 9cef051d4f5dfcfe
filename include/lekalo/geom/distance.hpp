#pragma once

#include "lekalo/geom/point.hpp"

namespace lekalo::geom {

/// Distances in millimetres by short formulas. Not for decisions: those are predicates.hpp.
///
/// Every distance here is within kDistanceError * d of the exact one, d the largest coordinate difference
/// between the points given (0 or at least 2^-480; coordinates at most 2^480 in magnitude): for 1 m, 1.4e-12
/// mm. To first order, u = 2^-53: the cross product of two differences is within 4 u |v| |w|, its division by
/// the rounded length adds 3 u of the distance, and |w| <= sqrt(2) d: 7 sqrt(2) u d; the rest is reserve.
inline constexpr double kDistanceError = 0xCp-53;

/// The point of segment ab nearest to p, exactly a or b beyond the ends; within kDistanceError * d of the
/// true one and half a unit in the last place of its coordinates.
[[nodiscard]] Point nearest_on_segment(Point p, Point a, Point b) noexcept;
[[nodiscard]] double distance_to_segment(Point p, Point a, Point b) noexcept;

}  // namespace lekalo::geom

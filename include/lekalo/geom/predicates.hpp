#pragma once

#include <cstddef>

#include "lekalo/geom/point.hpp"

namespace lekalo::geom {

/// Laws of this header (tests/property/predicates_test.cpp), for finite points with |coordinate| in
/// {0} or [2^-400, 2^400]:
///   (1) orientation(a, b, c) is the sign of the exact real determinant
///   (2) orientation(a, b, c) == orientation(b, c, a) == -orientation(b, a, c)
///   (3) segment_relation and locate_point are decided from exact signs only, no tolerance anywhere.
/// They hold no memory, call no mathematics library and throw nothing, so the same code runs in a browser.

/// Turn a -> b -> c: +1 left (counter-clockwise), -1 right, 0 on one line. Adaptive: a floating-point filter
/// answers nearly always (kOrientationFilter x the two products), else an exact expansion.
/// Source: Shewchuk 1997, section 4.4; the code is our own.
[[nodiscard]] int orientation(Point a, Point b, Point c) noexcept;

/// Sign of the exact cross product (b - a) x (d - c): +1 when cd turns left of ab, 0 when parallel.
[[nodiscard]] int turn(Point a, Point b, Point c, Point d) noexcept;

enum class PointLocation { outside, boundary, inside };

/// Where p lies in the closed polygon with n vertices (x0, y0, x1, y1, ...) in either direction, simple or not
/// (even-odd rule). Cost: O(n). Source: crossing number with the half-open rule, exact signs.
[[nodiscard]] PointLocation locate_point(const double* xy, std::size_t n, Point p) noexcept;

enum class SegmentRelation {
  disjoint,  ///< no common point
  touch,     ///< one common point, an end of at least one of them
  cross,     ///< one common point inside both
  overlap    ///< collinear, more than one common point
};

[[nodiscard]] SegmentRelation segment_relation(Point a, Point b, Point c, Point d) noexcept;

}  // namespace lekalo::geom

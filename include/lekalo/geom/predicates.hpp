#pragma once

#include <cstddef>

#include "lekalo/geom/point.hpp"

namespace lekalo::geom {

/// Laws of this header (tests/property/geom_predicates_test.cpp), for coordinates that satisfy
/// is_exact_coordinate:
///   (1) orientation(a, b, c) is the sign of the exact real determinant
///   (2) orientation(a, b, c) == orientation(b, c, a) == -orientation(b, a, c)
///   (3) turn(a, b, c, d) == -turn(c, d, a, b) == -turn(b, a, c, d); turn(a, b, a, c) == orientation(a, b, c)
///   (4) segment_relation does not depend on the order or the direction of the two segments
///   (5) locate_point does not depend on the first vertex or the direction
///   (6) segment_relation and locate_point are decided from exact signs only, no tolerance anywhere.
/// Outside that range nothing is promised but that they return: infinities and NaN are the caller's error
/// (readers refuse them), and where a product underflows or overflows a sign may be wrong.
///
/// They hold no memory, call no library and throw nothing, so the same code runs in a browser.

/// Magnitudes for which the arithmetic behind the predicates is exact: two coordinates' last bits multiply to
/// at least 2^-1064, above the smallest double, and all sums of products stay below 2^964.
inline constexpr double kSmallestExactCoordinate = 0x1p-480;
inline constexpr double kLargestExactCoordinate = 0x1p480;

/// Returns true for 0 and for magnitudes in the range above; false for infinities and NaN.
[[nodiscard]] constexpr bool is_exact_coordinate(double v) noexcept {
  const double magnitude = v < 0 ? -v : v;
  return v == 0 || (magnitude >= kSmallestExactCoordinate && magnitude <= kLargestExactCoordinate);
}
[[nodiscard]] constexpr bool is_exact(Point p) noexcept {
  return is_exact_coordinate(p.x) && is_exact_coordinate(p.y);
}

/// The filter of orientation and turn: the cross product l - r of rounded differences differs from the exact
/// one by less than this times |l| + |r|. With u = 2^-53: each factor and each product is within u of its
/// own size, so three factors (1 + u) give 3 u + 3 u^2 + u^3; the rest pays for rounding the sum, the
/// bound and the difference.
inline constexpr double kOrientationFilter = 0x3p-53 + 0x10p-106;

namespace detail {
inline constexpr int kUndecided = 2;

/// Is the first tier of `turn`: returns its sign, or kUndecided.
[[nodiscard]] constexpr int turn_filter(Point a, Point b, Point c, Point d) noexcept {
  const double left = (b.x - a.x) * (d.y - c.y);
  const double right = (b.y - a.y) * (d.x - c.x);
  const double difference = left - right;
  const double bound = kOrientationFilter * ((left < 0 ? -left : left) + (right < 0 ? -right : right));
  // The comparison is >=, so that two zero products, which are exact, are decided here.
  if (difference >= bound) return difference > 0 ? 1 : 0;
  return -difference >= bound ? -1 : kUndecided;
}

/// Always returns the exact sign, by the tiers that follow (src/geom/turn_tiers.hpp).
[[nodiscard]] int turn_exact(Point a, Point b, Point c, Point d) noexcept;
}  // namespace detail

/// Returns the sign of the exact cross product (b - a) x (d - c): +1 when cd turns left of ab, 0 when
/// parallel. It is adaptive: a floating-point filter answers nearly always, else expansions of exact
/// products.
/// Source: Shewchuk 1997, section 4.4, for the idea and the bound of the filter; the code is our own.
[[nodiscard]] constexpr int turn(Point a, Point b, Point c, Point d) noexcept {
  const int sign = detail::turn_filter(a, b, c, d);
  return sign != detail::kUndecided ? sign : detail::turn_exact(a, b, c, d);
}

/// Returns the turn a -> b -> c: +1 left (counter-clockwise), -1 right, 0 on one line.
[[nodiscard]] constexpr int orientation(Point a, Point b, Point c) noexcept { return turn(a, b, a, c); }

enum class PointLocation { outside, boundary, inside };

/// Says where p lies in the closed polygon with n vertices (x0, y0, x1, y1, ...) in either direction, simple
/// or not (even-odd rule). Without vertices p is outside, with one or two on the boundary or outside. Cost:
/// O(n). Source: crossing number with the half-open rule, exact signs.
[[nodiscard]] PointLocation locate_point(const double* xy, std::size_t n, Point p) noexcept;

enum class SegmentRelation {
  disjoint,  ///< no common point
  touch,     ///< one common point, an end of at least one of them
  cross,     ///< one common point inside both
  overlap    ///< collinear, more than one common point
};

/// A segment may be a single point (a == b).
[[nodiscard]] SegmentRelation segment_relation(Point a, Point b, Point c, Point d) noexcept;

}  // namespace lekalo::geom

#pragma once

#include "placed_solid.hpp"

namespace lekalo::verify {

/// Encloses the distance of two triangles, which may be lines or points. Where it is surely above `limit`
/// only the low end is worth something.
///
/// Plain doubles propose the two nearest points. They prove nothing: what holds is that two sets are no
/// nearer than the gap between them along any direction, and no farther than any two of their points.
[[nodiscard]] Span distance(const Triangle3& a, const Triangle3& b, double limit = kInfinity);

/// How two triangles lie exactly.
struct ExactDistance {
  Fraction squared;  ///< 0 where they have a point in common
  /// True when an edge of one runs through the inside of the other from one side to the other.
  bool pierces = false;
};
[[nodiscard]] ExactDistance exact_distance(const ExactTriangle& a, const ExactTriangle& b);
/// Says whether an edge runs through the inside of a triangle from one side to the other.
[[nodiscard]] bool pierces(const Exact3& from, const Exact3& to, const ExactTriangle& t);
/// Returns the squared distance of a point from a triangle.
[[nodiscard]] Fraction exact_squared_distance(const Exact3& p, const ExactTriangle& t);

}  // namespace lekalo::verify

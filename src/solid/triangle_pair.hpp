#pragma once

#include "triangle.hpp"

namespace lekalo::solid {

/// A point of each of two triangles that are nearest to each other, in so far as rounding lets them be found,
/// and a bound below which the triangles are not near.
struct PairFound {
  Vector a, b;
  double squared = 0;
  double low = 0;  ///< negative where nothing was found that separates them
};
/// It looks no further where the bound is `most` or more, or no more than `enough` below the distance.
[[nodiscard]] PairFound nearest_points(const Corners& a, const Corners& b, double most,
                                       double enough) noexcept;

/// Says if two triangles are easily seen to be `most` apart or more: along a normal of one, or along the way
/// between their middles. Nearly all pairs that two trees bring together are.
[[nodiscard]] bool clearly_apart(const Corners& a, const Corners& b, double most) noexcept;

}  // namespace lekalo::solid

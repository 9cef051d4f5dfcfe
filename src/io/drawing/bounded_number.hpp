#pragma once

#include <cmath>

#include "drawn_shapes.hpp"
#include "io/text/decimal.hpp"
#include "lekalo/geom/double_double.hpp"

namespace lekalo::io::detail {

/// Arithmetic of numbers that know how far they may be off. Of each sum, product and quotient the rounding is
/// added, 0 where there is none.

using Bounded = Millimetres;

[[nodiscard]] inline Bounded plus(const Bounded& a, const Bounded& b) noexcept {
  const geom::DoubleDouble sum = geom::two_sum(a.value, b.value);
  return {sum.hi, a.error + b.error + std::abs(sum.lo)};
}
[[nodiscard]] inline Bounded negative(const Bounded& a) noexcept { return {-a.value, a.error}; }
[[nodiscard]] inline Bounded minus(const Bounded& a, const Bounded& b) noexcept {
  return plus(a, negative(b));
}

[[nodiscard]] inline Bounded times(const Bounded& a, const Bounded& b) noexcept {
  const geom::DoubleDouble product = geom::two_product(a.value, b.value);
  return {product.hi, std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error +
                          std::abs(product.lo)};
}
/// \pre b is further from 0 than twice its error
[[nodiscard]] inline Bounded over(const Bounded& a, const Bounded& b) noexcept {
  const double quotient = a.value / b.value;
  const geom::DoubleDouble back = geom::two_product(quotient, b.value);
  const double remainder = std::abs((back.hi - a.value) + back.lo);  // exact
  return {quotient, 2 * (a.error + std::abs(quotient) * b.error + remainder) / std::abs(b.value)};
}

/// Both coordinates with the larger error.
[[nodiscard]] inline BoundedPoint point_of(const Bounded& x, const Bounded& y) noexcept {
  return {{x.value, y.value}, std::max(x.error, y.error)};
}
[[nodiscard]] inline Bounded x_of(const BoundedPoint& p) noexcept { return {p.at.x, p.error}; }
[[nodiscard]] inline Bounded y_of(const BoundedPoint& p) noexcept { return {p.at.y, p.error}; }
[[nodiscard]] inline BoundedPoint plus(const BoundedPoint& a, const BoundedPoint& b) noexcept {
  return point_of(plus(x_of(a), x_of(b)), plus(y_of(a), y_of(b)));
}

}  // namespace lekalo::io::detail

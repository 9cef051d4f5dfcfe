#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "vec3.hpp"
#include "verify/number/exact.hpp"

namespace lekalo::verify {

/// Returns an enclosure of a decimal.
[[nodiscard]] inline Span enclosed(const Decimal& value) {
  const double near = approximate(value);
  return sgn(value.digits) == 0 ? just(0) : outwards(near, near);
}

/// A number as it is, and an enclosure of it, which decides nearly always.
struct Both {
  Fraction exact;
  Span near{};
};
using Both3 = std::array<Both, 3>;

[[nodiscard]] inline Both both(const Decimal& value) {
  Both made{to_fraction(value)};
  made.near = enclosed(made.exact);
  return made;
}

/// Returns the number in the arithmetic of spans or of fractions.
template <class Number>
[[nodiscard]] const Number& as(const Both& value) {
  if constexpr (std::is_same_v<Number, Span>)
    return value.near;
  else
    return value.exact;
}
template <class Number>
[[nodiscard]] Of3<Number> as(const Both3& p) {
  return {as<Number>(p[0]), as<Number>(p[1]), as<Number>(p[2])};
}

/// Returns the nearest double, for messages.
[[nodiscard]] inline double nearest(const Fraction& value) {
  const double cut = cut_to_double(value), away = sgn(value) < 0 ? step_down(cut) : step_up(cut);
  return abs(value - Fraction(cut)) <= abs(Fraction(away) - value) ? cut : away;
}

/// Says whether a < b, exactly.
[[nodiscard]] inline bool less(const Both& a, const Both& b) {
  if (a.near.high < b.near.low) return true;
  if (a.near.low >= b.near.high) return false;
  return a.exact < b.exact;
}

}  // namespace lekalo::verify

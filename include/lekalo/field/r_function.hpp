#pragma once

#include <cmath>

#include "lekalo/geom/point.hpp"

namespace lekalo::field {

/// A value and its gradient at one place, mm and without unit where the function is a length.
struct Jet {
  double value = 0;
  geom::Point gradient;
  friend constexpr bool operator==(const Jet&, const Jet&) = default;
};

/// Logic on real functions, positive inside (Rvachev). `linear` ("R1") is min and max, `quadratic` ("R0")
/// smooth but where both are 0; neither changes a sign: a conjunction is positive exactly where both are.
/// Rounding: 4 units in the last place of the larger operand; the quadratic conjunction of positive values is
/// computed without cancellation, as 2 a b / (a + b + sqrt(a^2 + b^2)), within 8 units of its own.
enum class Logic { linear, quadratic };

[[nodiscard]] constexpr Jet operator-(const Jet& a) noexcept { return {-a.value, -a.gradient}; }

/// a and b. Commutative to the bit; the linear one is associative, the quadratic one is not.
[[nodiscard]] inline Jet conjunction(const Jet& a, const Jet& b, Logic logic) noexcept {
  if (logic == Logic::linear) return b.value < a.value ? b : a;
  const double root = std::sqrt(a.value * a.value + b.value * b.value);
  if (!(root > 0)) return {0, 0.5 * (a.gradient + b.gradient)};
  const double sum = a.value + b.value;
  const double value = sum > 0 ? 2 * a.value * b.value / (sum + root) : sum - root;
  return {value, (1 - a.value / root) * a.gradient + (1 - b.value / root) * b.gradient};
}

/// a or b.
[[nodiscard]] inline Jet disjunction(const Jet& a, const Jet& b, Logic logic) noexcept {
  return -conjunction(-a, -b, logic);
}

/// a and not b.
[[nodiscard]] inline Jet difference(const Jet& a, const Jet& b, Logic logic) noexcept {
  return conjunction(a, -b, logic);
}

}  // namespace lekalo::field

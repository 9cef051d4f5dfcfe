#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

#include "exact.hpp"
#include "vec3.hpp"

namespace lekalo::verify {

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

/// Returns the nearest double, for messages; of what is beyond them the largest.
[[nodiscard]] inline double nearest(const Fraction& value) {
  constexpr double kMost = std::numeric_limits<double>::max();
  const double cut = std::clamp(cut_to_double(value), -kMost, kMost);
  const auto off = [&](double at) { return Fraction(abs(value - Fraction(at))); };
  const std::array all{cut, std::max(-kMost, step_down(cut)), std::min(kMost, step_up(cut))};
  return *std::ranges::min_element(all, {}, off);
}

}  // namespace lekalo::verify

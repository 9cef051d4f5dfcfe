#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "exact.hpp"

namespace lekalo::verify {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns the next larger double, bit for bit as std::nextafter(value, infinity) does; NaN and infinity
/// stay. The checker steps twice for each operation on spans, and calls of the library were a third of its
/// time.
[[nodiscard]] inline double step_up(double value) {
  // Doubles of one sign are ordered as their bits are. The sum turns -0 into 0, whose next is a positive one.
  // Without a sign the bits of a NaN may overflow.
  const auto bits = std::bit_cast<std::uint64_t>(value + 0.0);
  const auto next = std::bit_cast<double>((bits >> 63) != 0 ? bits - 1 : bits + 1);
  return value < std::numeric_limits<double>::infinity() ? next : value;
}
/// Returns the next smaller double.
[[nodiscard]] inline double step_down(double value) { return -step_up(-value); }

/// A small brother of Interval in doubles, by which most of a long certificate is decided. Each operation
/// rounds to nearest and then steps one double outwards. Overflow gives infinities or NaN, which decide
/// nothing when comparisons are written to fail on NaN.
struct Span {
  double low = 0, high = 0;
};

[[nodiscard]] inline Span outwards(double low, double high) { return {step_down(low), step_up(high)}; }

/// Returns the span that holds exactly this number.
[[nodiscard]] inline Span just(double value) { return {value, value}; }

/// Encloses value / 2^scale.
[[nodiscard]] inline Span to_span(const Integer& value, long scale) {
  const double cut = scaled_down(value, scale);
  return outwards(cut, cut);
}

/// Encloses a decimal, by itself where a double is that.
[[nodiscard]] Span enclosed(const Decimal& value);

[[nodiscard]] inline Span operator+(Span a, Span b) { return outwards(a.low + b.low, a.high + b.high); }
[[nodiscard]] inline Span plus(Span a, double by) { return a + just(by); }
[[nodiscard]] inline Span operator-(Span a, Span b) { return outwards(a.low - b.high, a.high - b.low); }
[[nodiscard]] inline Span operator-(Span a) { return {-a.high, -a.low}; }
[[nodiscard]] inline Span operator*(Span a, Span b) {
  const double ll = a.low * b.low, lh = a.low * b.high, hl = a.high * b.low, hh = a.high * b.high;
  const double all = (ll + lh) + (hl + hh);
  // The product of 0 and infinity may be any number here. The comparison is written so that NaN fails it,
  // because min and max would drop the NaN.
  if (!(all - all == 0)) {
    return {-kInfinity, kInfinity};
  }
  return outwards(std::min(std::min(ll, lh), std::min(hl, hh)), std::max(std::max(ll, lh), std::max(hl, hh)));
}
/// Nothing is known of a quotient whose divisor may be 0 or less.
[[nodiscard]] inline Span operator/(Span a, Span b) {
  if (!(b.low > 0)) return {-kInfinity, kInfinity};
  return outwards(a.low / (std::signbit(a.low) ? b.low : b.high),
                  a.high / (std::signbit(a.high) ? b.high : b.low));
}
[[nodiscard]] inline Span square_root(Span a) {
  return outwards(std::sqrt(std::max(a.low, 0.0)), std::sqrt(a.high));
}
[[nodiscard]] inline Span squared(Span a) {
  const Span product = a * a;
  return {std::max(0.0, product.low), product.high};
}
[[nodiscard]] inline Span absolute(Span a) {
  if (a.low >= 0) return a;
  if (a.high <= 0) return -a;
  return {0, std::max(-a.low, a.high)};
}

}  // namespace lekalo::verify

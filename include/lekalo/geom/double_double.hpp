#pragma once

#include <cmath>

namespace lekalo::geom {

/// Sums and products of doubles with their rounding errors, and numbers made of two doubles: about 32 decimal
/// digits from + - * / and square root alone, so the same bits in every build and in a browser.
/// Source: Dekker 1971, Knuth TAOCP 2 4.2.2; Hida, Li, Bailey 2001 for the accurate sum. The code is our own.
/// Range: finite, magnitudes between 2^-480 and 2^480 where digits count (the error of a product must not
/// underflow, splitting must not overflow).

struct DoubleDouble {
  double hi = 0, lo = 0;  ///< the value hi + lo, |lo| <= ulp(hi) / 2
};

/// a + b exactly.
[[nodiscard]] constexpr DoubleDouble two_sum(double a, double b) noexcept {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// a + b exactly; \pre |a| >= |b| or a == 0.
[[nodiscard]] constexpr DoubleDouble quick_two_sum(double a, double b) noexcept {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a * b exactly (Dekker's splitting: a fused multiply-add would be a library call on some targets).
[[nodiscard]] constexpr DoubleDouble two_product(double a, double b) noexcept {
  constexpr double kSplitter = 134217729.0;  // 2^27 + 1
  const double product = a * b;
  const double a_big = kSplitter * a, b_big = kSplitter * b;
  const double a_hi = a_big - (a_big - a), b_hi = b_big - (b_big - b);
  const double a_lo = a - a_hi, b_lo = b - b_hi;
  return {product, ((a_hi * b_hi - product) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo};
}

[[nodiscard]] constexpr DoubleDouble operator-(DoubleDouble a) noexcept { return {-a.hi, -a.lo}; }

/// Relative error at most 3 * 2^-106.
[[nodiscard]] constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) noexcept {
  DoubleDouble high = two_sum(a.hi, b.hi);
  const DoubleDouble low = two_sum(a.lo, b.lo);
  high = quick_two_sum(high.hi, high.lo + low.hi);
  return quick_two_sum(high.hi, high.lo + low.lo);
}
[[nodiscard]] constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) noexcept { return a + (-b); }

/// Relative error at most 8 * 2^-106.
[[nodiscard]] constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble product = two_product(a.hi, b.hi);
  return quick_two_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

/// Relative error at most 16 * 2^-106; \pre b != 0.
[[nodiscard]] constexpr DoubleDouble operator/(DoubleDouble a, DoubleDouble b) noexcept {
  const double first = a.hi / b.hi;
  const DoubleDouble rest = a - b * DoubleDouble{first};
  const double second = rest.hi / b.hi;
  const DoubleDouble last = rest - b * DoubleDouble{second};
  const DoubleDouble quotient = quick_two_sum(first, second);
  return quotient + DoubleDouble{last.hi / b.hi};
}

/// Relative error at most 16 * 2^-106; \pre a > 0.
[[nodiscard]] inline DoubleDouble sqrt(DoubleDouble a) noexcept {
  const double first = std::sqrt(a.hi);
  const DoubleDouble rest = a - two_product(first, first);
  return quick_two_sum(first, rest.hi / (2.0 * first));
}

/// Sine and cosine of exactly theta, |theta| <= kMaxAngle of trig.hpp; absolute error at most
/// kSinCosPairError.
struct SinCosPair {
  DoubleDouble sine, cosine;
};
inline constexpr double kSinCosPairError = 1e-30;
[[nodiscard]] SinCosPair sincos_double_double(double theta) noexcept;

}  // namespace lekalo::geom

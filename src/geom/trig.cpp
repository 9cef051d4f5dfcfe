#include "lekalo/geom/trig.hpp"

#include <array>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/assert.hpp"
#include "lekalo/geom/double_double.hpp"

namespace lekalo::geom {
namespace {

// Step 4 of docs/design/geometry.md. The four constants sum to pi/2. The first three have 33 bits, so that
// their products with a quarter-turn count below 2^20 are exact; all four together are within 1e-48 of pi/2.
constexpr std::array<double, 4> kHalfPi = {0x1.921fb54400000p+0, 0x1.0b4611a600000p-34, 0x1.3198a2e000000p-69,
                                           0x1.b839a252049c1p-104};
constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;

/// The reduced angle: theta = quarter_turns * pi/2 + rest, |rest| <= pi/4 (and a rounding more).
struct Reduced {
  DoubleDouble rest;
  int quadrant = 0;
};

Reduced reduce(double theta) noexcept {
  LEKALO_ASSERT(theta >= -kMaxAngle && theta <= kMaxAngle);
  const double scaled = theta * kTwoOverPi;
  const auto quarters = static_cast<int>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
  const double k = quarters;
  DoubleDouble rest = two_sum(theta - k * kHalfPi[0], -k * kHalfPi[1]);
  if (quarters != 0) rest = rest + two_sum(-k * kHalfPi[2], -k * kHalfPi[3]);
  return {rest, quarters & 3};
}

/// Puts sine and cosine of the rest into the quadrant.
template <class Pair, class Value>
Pair turn_quarters(Value sine, Value cosine, int quadrant) noexcept {
  switch (quadrant) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

constexpr int kTerms = 28;

/// Returns 1/n! for n = 0..27 in double-double, computed by the compiler.
constexpr std::array<DoubleDouble, kTerms> inverse_factorials() {
  std::array<DoubleDouble, kTerms> values{};
  DoubleDouble value{1.0};
  for (int n = 0; n < kTerms; ++n) {
    if (n > 0) value = value / DoubleDouble{static_cast<double>(n)};
    values[static_cast<std::size_t>(n)] = value;
  }
  return values;
}
constexpr std::array<DoubleDouble, kTerms> kInverseFactorial = inverse_factorials();

/// Returns the sum over n = first, first - 2, ... of (-1)^(n/2) x^n / n!, without the leading power, by
/// Horner in -x^2.
template <int First, int Last, class Value, class Coefficient>
Value alternating_series(Value minus_square, Coefficient coefficient) noexcept {
  Value sum = coefficient(First);
  for (int n = First - 2; n >= Last; n -= 2) sum = sum * minus_square + coefficient(n);
  return sum;
}

}  // namespace

SinCos sincos(double theta) noexcept {
  const Reduced reduced = reduce(theta);
  const double x = reduced.rest.hi, low = reduced.rest.lo;
  const double minus_square = -x * x;
  const auto coefficient = [](int n) { return kInverseFactorial[static_cast<std::size_t>(n)].hi; };
  // The series is Taylor's about 0. On |x| <= pi/4 the first term left out is below 1e-19. The leading terms
  // are added last, so that only their rounding shows; the low half of the rest enters by the derivative.
  const double sine = x + (x * minus_square * alternating_series<17, 3>(minus_square, coefficient) + low);
  const double cosine = 1.0 + (minus_square * alternating_series<18, 2>(minus_square, coefficient) - x * low);
  return turn_quarters<SinCos>(sine, cosine, reduced.quadrant);
}

SinCosPair sincos_double_double(double theta) noexcept {
  const Reduced reduced = reduce(theta);
  const DoubleDouble x = reduced.rest;
  const DoubleDouble minus_square = -(x * x);
  const auto coefficient = [](int n) { return kInverseFactorial[static_cast<std::size_t>(n)]; };
  const DoubleDouble sine = x * alternating_series<27, 1>(minus_square, coefficient);
  const DoubleDouble cosine = alternating_series<26, 0>(minus_square, coefficient);
  return turn_quarters<SinCosPair>(sine, cosine, reduced.quadrant);
}

double direction_angle(double x, double y) noexcept {
  if (x == 0 && y == 0) return 0;
  const double ax = x < 0 ? -x : x, ay = y < 0 ? -y : y;
  const bool steep = ay > ax;
  const double tangent = steep ? ax / ay : ay / ax;  // in [0, 1]
  // The angle is atan(tangent) = atan(centre) + atan(u) with |u| <= 1/8, where the centre is the nearest
  // quarter.
  constexpr std::array<double, 5> kAtanOfQuarter = {0.0, 0.24497866312686415417, 0.46364760900080611621,
                                                    0.64350110879328438680, 0.78539816339744830962};
  const auto quarter = static_cast<std::size_t>(tangent * 4.0 + 0.5);
  const double centre = 0.25 * static_cast<double>(quarter);
  const double u = (tangent - centre) / (1.0 + tangent * centre);
  const double square = u * u;
  double series = 0;
  for (int n = 19; n >= 3; n -= 2) series = (1.0 / n - series) * square;  // u^2/3 - u^4/5 + ...
  double angle = kAtanOfQuarter[quarter] + (u - u * series);
  if (steep) angle = kPi / 2 - angle;
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

}  // namespace lekalo::geom

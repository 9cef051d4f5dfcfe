// Spans enclose: the step outwards is that of the library for every kind of double, and each operation holds
// what rational arithmetic finds.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>

#include "support/cases.hpp"
#include "support/verify_cases.hpp"
#include "verify/number/span.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::verify_span_test {
namespace {

using namespace verify;
using lekalo::cases::case_count;
using lekalo::verify_cases::Random;

constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kSmallest = std::numeric_limits<double>::denorm_min();
constexpr double kNormal = std::numeric_limits<double>::min();

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }
double of_bits(std::uint64_t value) { return std::bit_cast<double>(value); }

/// Compares the steps with the library's, bit for bit; of NaN only that it stays NaN.
void expect_steps(double value) {
  if (std::isnan(value)) {
    ASSERT_TRUE(std::isnan(step_up(value)) && std::isnan(step_down(value))) << std::hex << bits(value);
    return;
  }
  ASSERT_EQ(bits(step_up(value)), bits(std::nextafter(value, kInfinity))) << std::hexfloat << value;
  ASSERT_EQ(bits(step_down(value)), bits(std::nextafter(value, -kInfinity))) << std::hexfloat << value;
}

TEST(VerifySpan, StepsAreThoseOfTheLibraryAboutEveryExponent) {
  // Where an exponent begins and ends the step changes its size; the first is 0, the last are infinity and
  // NaN.
  for (std::uint64_t exponent = 0; exponent < 2048; ++exponent) {
    for (std::uint64_t off = 0; off < 9; ++off) {
      const std::uint64_t place = (exponent << 52) + off - 4;
      for (const std::uint64_t sign : {std::uint64_t{0}, std::uint64_t{1} << 63}) {
        ASSERT_NO_FATAL_FAILURE(expect_steps(of_bits(place ^ sign)));
      }
    }
  }
  for (const double value :
       {0.0, -0.0, kInfinity, -kInfinity, kLargest, -kLargest, kSmallest, -kSmallest, kNormal, -kNormal,
        std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::signaling_NaN()}) {
    ASSERT_NO_FATAL_FAILURE(expect_steps(value));
  }
}

TEST(VerifySpan, StepsAreThoseOfTheLibraryForDrawnBits) {
  Random random(lekalo::cases::seed());
  const std::size_t count = case_count(4'000'000);
  for (std::size_t i = 0; i < count; ++i) ASSERT_NO_FATAL_FAILURE(expect_steps(of_bits(random.bits())));
}

/// A finite double: of any exponent, of a length in a drawing, or from among the ones that are special.
double draw(Random& random) {
  constexpr std::array<double, 9> kSpecial = {0.0, -0.0, 1.0, kSmallest, kNormal, kLargest, 3.0, 0.1, 0x1p53};
  const double sign = random.below(2) == 0 ? 1 : -1;
  switch (random.below(4)) {
    case 0:
      return sign * kSpecial[random.below(kSpecial.size())];
    case 1: {
      const double digits = static_cast<double>(random.bits() >> 11);
      return sign * std::ldexp(digits, static_cast<int>(random.below(60)) - 80);
    }
    case 2:
      return sign * std::round(random.uniform(0, 1e6)) / 1000;
    default:
      for (;;) {
        const double value = of_bits(random.bits());
        if (std::isfinite(value)) return value;
      }
  }
}

/// Two draws in order, and a number that lies between them.
struct Drawn {
  Span span;
  mpq_class inside;
};
Drawn draw_span(Random& random) {
  const double a = draw(random), b = random.below(3) == 0 ? a : draw(random);
  const mpq_class low(std::min(a, b)), high(std::max(a, b)),
      part(0.25 * static_cast<double>(random.below(5)));
  return {{std::min(a, b), std::max(a, b)}, mpq_class(low + (high - low) * part)};
}

bool holds(Span span, const mpq_class& value) {
  if (std::isnan(span.low) || std::isnan(span.high)) return true;  // which decides nothing
  return (span.low == -kInfinity || (span.low < kInfinity && mpq_class(span.low) <= value)) &&
         (span.high == kInfinity || (span.high > -kInfinity && mpq_class(span.high) >= value));
}
/// Says whether the span holds the root of value, which is not negative.
bool holds_root(Span span, const mpq_class& value) {
  const auto squared = [](double end) { return mpq_class(mpq_class(end) * mpq_class(end)); };
  return (span.low <= 0 || (span.low < kInfinity && squared(span.low) <= value)) &&
         (span.high == kInfinity || (span.high >= 0 && squared(span.high) >= value));
}

TEST(VerifySpan, EveryOperationHoldsWhatRationalArithmeticFinds) {
  Random random(lekalo::cases::seed() + 1);
  const std::size_t count = case_count(100'000);
  for (std::size_t i = 0; i < count; ++i) {
    const Drawn a = draw_span(random), b = draw_span(random);
    const auto about = [&] {
      return testing::Message() << std::hexfloat << a.span.low << ' ' << a.span.high << ' ' << b.span.low
                                << ' ' << b.span.high << " case " << i;
    };
    ASSERT_TRUE(holds(a.span + b.span, a.inside + b.inside)) << about();
    ASSERT_TRUE(holds(a.span - b.span, a.inside - b.inside)) << about();
    ASSERT_TRUE(holds(a.span * b.span, a.inside * b.inside)) << about();
    ASSERT_TRUE(holds(-a.span, -a.inside)) << about();
    ASSERT_TRUE(holds(absolute(a.span), abs(a.inside))) << about();
    ASSERT_TRUE(holds(squared(a.span), a.inside * a.inside)) << about();
    if (b.inside != 0) {
      ASSERT_TRUE(holds(a.span / b.span, a.inside / b.inside)) << about();
    }
    if (a.inside >= 0) {
      ASSERT_TRUE(holds_root(square_root(a.span), a.inside)) << about();
    }
  }
}

TEST(VerifySpan, AWholeNumberOfAnyLengthLiesInItsSpan) {
  Random random(lekalo::cases::seed() + 2);
  const std::size_t count = case_count(100'000);
  for (std::size_t i = 0; i < count; ++i) {
    Integer value = 0;
    for (std::size_t words = random.below(4) + 1; words > 0; --words)
      value = (value << 64) + Integer(std::to_string(random.bits()));
    value >>= random.below(200);
    if (random.below(2) == 0) value = -value;
    const auto scale = static_cast<long>(random.below(1500));
    ASSERT_TRUE(holds(to_span(value, scale), mpq_class(mpq_class(value) / mpq_class(Integer(1) << scale))))
        << value.get_str() << " / 2^" << scale;
  }
}

/// An enclosure that is wider than it need be costs the checker a yes.
TEST(VerifySpan, OfTwoNumbersTheEndsAreTheNeighboursOfTheNearestDouble) {
  Random random(lekalo::cases::seed() + 3);
  const auto expect = [](Span span, double nearest) {
    ASSERT_EQ(span.low, std::nextafter(nearest, -kInfinity));
    ASSERT_EQ(span.high, std::nextafter(nearest, kInfinity));
  };
  const std::size_t count = case_count(100'000);
  for (std::size_t i = 0; i < count; ++i) {
    const double a = draw(random), b = draw(random);
    ASSERT_NO_FATAL_FAILURE(expect(just(a) + just(b), a + b));
    ASSERT_NO_FATAL_FAILURE(expect(just(a) - just(b), a - b));
    if (std::abs(a * b) < kLargest / 4) {
      ASSERT_NO_FATAL_FAILURE(expect(just(a) * just(b), a * b));
    }
    if (b > 0) {
      ASSERT_NO_FATAL_FAILURE(expect(just(a) / just(b), a / b));
    }
    if (a >= 0) {
      ASSERT_NO_FATAL_FAILURE(expect(square_root(just(a)), std::sqrt(a)));
    }
  }
}

// Most decimals take a way in doubles, which is compared with rational arithmetic and with the library.
TEST(VerifySpan, ADecimalLiesInItsSpanAndItsDoubleIsTheNearest) {
  Random random(lekalo::cases::seed() + 4);
  const std::size_t count = case_count(20'000);
  for (std::size_t i = 0; i < count; ++i) {
    const int places = static_cast<int>(random.below(21));
    std::string text = random.below(2) == 0 ? "-" : "";
    for (int k = static_cast<int>(random.below(20)); k >= 0; --k)
      text += static_cast<char>('0' + random.below(10));
    if (random.below(8) == 0) text = std::to_string((std::size_t{1} << 53) - 2 + random.below(5));
    text += "e" + std::to_string(3 - places);
    const auto value = parse_decimal(text);
    ASSERT_TRUE(value) << text;
    EXPECT_EQ(approximate(*value), std::strtod(text.c_str(), nullptr)) << text;
    const Span span = enclosed(*value);
    const mpq_class exact = to_fraction(*value);
    EXPECT_TRUE(mpq_class(span.low) <= exact && exact <= mpq_class(span.high)) << text;
    EXPECT_LE(span.high, step_up(span.low)) << text;
    if (mpq_class(approximate(*value)) == exact) {
      EXPECT_EQ(span.low, span.high) << text;
    }
  }
}

}  // namespace
}  // namespace lekalo::verify_span_test

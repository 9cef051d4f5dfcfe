#include <fmt/core.h>
#include <gmp.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <string>

#include "io/text/decimal.hpp"
#include "lekalo/io/contour/contour_file.hpp"
#include "support/cases.hpp"

// Reading of decimals against exact rationals.

namespace lekalo::io_number_test {
namespace {

class Rational {
 public:
  Rational() { mpq_init(value_); }
  Rational(const Rational&) = delete;
  Rational& operator=(const Rational&) = delete;
  ~Rational() { mpq_clear(value_); }
  mpq_ptr get() { return value_; }

 private:
  mpq_t value_;
};

struct Written {
  std::string digits;  ///< with a sign
  int exponent = 0;
};

/// 25.4^inch * digits * 10^exponent
void set_exact(Rational& exact, const Written& number, bool inch) {
  ASSERT_EQ(mpq_set_str(exact.get(), number.digits.c_str(), 10), 0);
  mpz_t power;
  mpz_init(power);
  mpz_ui_pow_ui(power, 10, static_cast<unsigned long>(std::abs(number.exponent) + (inch ? 1 : 0)));
  if (inch) {
    mpz_mul_ui(mpq_numref(exact.get()), mpq_numref(exact.get()), 254);
    mpz_mul_ui(mpq_denref(exact.get()), mpq_denref(exact.get()), 10);
    mpz_divexact_ui(power, power, 10);
  }
  if (number.exponent < 0) {
    mpz_mul(mpq_denref(exact.get()), mpq_denref(exact.get()), power);
  } else {
    mpz_mul(mpq_numref(exact.get()), mpq_numref(exact.get()), power);
  }
  mpz_clear(power);
  mpq_canonicalize(exact.get());
}

/// |value - exact|
void set_difference(Rational& difference, double value, Rational& exact) {
  mpq_set_d(difference.get(), value);
  mpq_sub(difference.get(), difference.get(), exact.get());
  mpq_abs(difference.get(), difference.get());
}

bool at_most(Rational& difference, double bound) {
  Rational limit;
  mpq_set_d(limit.get(), bound);
  return mpq_cmp(difference.get(), limit.get()) <= 0;
}

/// The same number in another way: the point somewhere, an exponent, zeros around.
std::string writing(const Written& number, Random& random) {
  std::string digits = number.digits, sign;
  if (digits[0] == '-') {
    sign = "-";
    digits.erase(0, 1);
  } else if (random.below(4) == 0) {
    sign = "+";
  }
  digits.insert(0, random.below(3), '0');
  const std::size_t after = random.below(digits.size() + 1);
  digits.insert(digits.size() - after, ".");
  digits.append(random.below(3), '0');
  return fmt::format("{}{}e{}", sign, digits, number.exponent + static_cast<int>(after));
}

TEST(IoNumber, IsTheNearestDoubleWithASoundErrorThatIsZeroOnlyWhenExact) {
  const std::uint64_t seed = cases::seed();
  std::size_t exact_found = 0, total = 0;
  for (std::size_t c = 0; c < cases::case_count(40'000); ++c) {
    Random random(seed, c);
    Written number;
    if (random.below(2) == 0) number.digits = "-";
    number.digits += static_cast<char>('1' + random.below(9));
    const std::size_t count = random.below(random.below(8) == 0 ? 30 : 17);
    for (std::size_t i = 0; i < count; ++i) number.digits += static_cast<char>('0' + random.below(10));
    const int places = static_cast<int>(count) + 1;
    number.exponent = static_cast<int>(random.below(16)) - 8 - places;
    if (c % 4 == 0) {  // halves and quarters, often exact
      number.digits = fmt::format("{}", (random.below(1 << 20) + 1) * 125);
      number.exponent = -static_cast<int>(random.below(5));
    }
    const bool inch = random.below(2) == 0;
    const std::string text = writing(number, random);
    SCOPED_TRACE(fmt::format("seed {} case {}: {} {}", seed, c, text, inch ? "inch" : "mm"));

    const auto file =
        io::parse_contour(text + " 0\n", "a.txt", inch ? LengthUnit::inch : LengthUnit::millimetre);
    Rational exact, here, other;
    set_exact(exact, number, inch);
    if (!file) {
      set_difference(here, 0, exact);
      EXPECT_FALSE(at_most(here, 1e9)) << file.error().message;
      continue;
    }
    const double value = file->points[0].x, error = file->coordinate_error;
    set_difference(here, value, exact);
    EXPECT_TRUE(at_most(here, error));
    const bool is_exact = mpq_sgn(here.get()) == 0;
    EXPECT_TRUE(is_exact || error > 0) << "never called exact";
    if (is_exact && count < 15) {
      EXPECT_EQ(error, 0) << "short exact decimals are recognised";
      ++exact_found;
    }
    EXPECT_LE(error, std::abs(value) * 0x1p-53) << "as small as half a unit in the last place";
    for (const double direction : {-HUGE_VAL, HUGE_VAL}) {
      set_difference(other, std::nextafter(value, direction), exact);
      EXPECT_LE(mpq_cmp(here.get(), other.get()), 0) << "no double is nearer";
    }
    ++total;
  }
  EXPECT_GT(exact_found, total / 20);
}

TEST(IoNumber, ShortDecimalsInAnyUnitAreTheNearestDoublesToo) {
  constexpr io::DecimalFactor kFactors[] = {{1, 0},  {254, -1}, {3048, -1}, {1609344, 0}, {1, 3},
                                            {1, -3}, {254, -4}, {254, -7},  {1, -7},      {1, 6}};
  const std::uint64_t seed = cases::seed();
  for (std::size_t c = 0; c < cases::case_count(20'000); ++c) {
    Random random(seed, c + 1'000'000);
    const io::DecimalFactor factor = kFactors[random.below(std::size(kFactors))];
    std::string digits;
    const std::size_t count = 1 + random.below(19);
    for (std::size_t i = 0; i < count; ++i) digits += static_cast<char>('0' + random.below(10));
    if (c % 3 == 0) digits = fmt::format("{}", random.below(1 << 20) * 125);
    const std::size_t after = random.below(digits.size() + 1);
    const bool negative = random.below(2) == 0;
    std::string text = (negative ? "-" : "") + digits;
    text.insert(text.size() - after, after > 0 || random.below(2) == 0 ? "." : "");
    SCOPED_TRACE(
        fmt::format("seed {} case {}: {} times {}e{}", seed, c, text, factor.multiplier, factor.exponent));
    Rational exact, times, here, other;
    set_exact(exact, {(negative ? "-" : "") + digits, factor.exponent - static_cast<int>(after)}, false);
    mpq_set_ui(times.get(), factor.multiplier, 1);
    mpq_mul(exact.get(), exact.get(), times.get());
    const auto number = io::read_millimetres(text, factor);
    if (!number) {
      set_difference(here, 0, exact);
      EXPECT_FALSE(at_most(here, 1e9));
      continue;
    }
    set_difference(here, number->value, exact);
    EXPECT_TRUE(at_most(here, number->error));
    EXPECT_LE(number->error, std::abs(number->value) * 0x1p-53);
    if (mpq_sgn(here.get()) == 0 && count < 12) {
      EXPECT_EQ(number->error, 0);
    }
    for (const double direction : {-HUGE_VAL, HUGE_VAL}) {
      set_difference(other, std::nextafter(number->value, direction), exact);
      EXPECT_LE(mpq_cmp(here.get(), other.get()), 0) << "no double is nearer";
    }
  }
}

}  // namespace
}  // namespace lekalo::io_number_test

// The limits of the checker's numbers, each from both sides: where a comparison in src/verify/number could be
// its neighbour, one of these cases tells the two apart.

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <mpfr.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>

#include "lekalo/base/random.hpp"
#include "lekalo/verify/memory.hpp"
#include "verify/number/exact.hpp"
#include "verify/number/interval.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify::verify_numbers_test {
namespace {

Decimal decimal(std::string_view text) { return *parse_decimal(text); }
Interval interval(std::string_view text, Precision precision = 200) { return {decimal(text), precision}; }

TEST(VerifyNumbers, DecimalsEndWhereTheirTextEnds) {
  const std::string_view more = "123456e78-";
  for (const auto& [size, digits, exponent] :
       {std::tuple{1, 1, 0L}, {2, 12, 0L}, {3, 123, 0L}, {8, 123456, 7L}}) {
    const auto value = parse_decimal(more.substr(0, static_cast<std::size_t>(size)));
    ASSERT_TRUE(value) << size;
    EXPECT_TRUE(value->digits == digits) << size;
    EXPECT_EQ(value->exponent, exponent) << size;
  }
  for (const std::string_view text : {"-5", "+5", "5.5", "5e5"})
    EXPECT_FALSE(parse_decimal(text.substr(0, text.size() == 2 ? 1 : 0))) << text;
}

TEST(VerifyNumbers, EveryDigitIsADigitAndItsNeighboursAreNot) {
  for (int c = 0; c < 256; ++c) {
    const bool digit = c >= '0' && c <= '9';
    const std::string one(1, static_cast<char>(c));
    EXPECT_EQ(parse_decimal(one).has_value(), digit) << c;
    EXPECT_EQ(parse_decimal("1e" + one).has_value(), digit) << c;
    EXPECT_EQ(parse_decimal("7" + one + "7").has_value(), digit || one == "." || one == "e" || one == "E")
        << c;
  }
  EXPECT_TRUE(decimal("9").digits == 9);
  EXPECT_EQ(decimal("1e9").exponent, 9);
  EXPECT_EQ(decimal("1E+10").exponent, 10);
  EXPECT_EQ(decimal("1e-12").exponent, -12);
}

TEST(VerifyNumbers, NumbersHave400PlacesAnd800DigitsAndNoMore) {
  for (const char* text : {"1e-400", "9.999e399", "1e399", "-1e-400", "0.1e400", "10e-401", "99e-401"})
    EXPECT_TRUE(parse_decimal(text)) << text;
  for (const char* text : {"1e-401", "9.99e-401", "1e400", "-1e400", "10e399", "0.01e402"})
    EXPECT_FALSE(parse_decimal(text)) << text;
  const std::string digits(800, '7');
  EXPECT_TRUE(parse_decimal("0." + digits.substr(0, 300)));
  EXPECT_TRUE(parse_decimal(digits + "e-500"));
  EXPECT_FALSE(parse_decimal(digits + "7e-500"));
  EXPECT_TRUE(parse_decimal("00" + digits + "000e-500")) << "zeros around them are no digits";
  EXPECT_FALSE(parse_decimal("1e1000000000000000000000"));
  EXPECT_FALSE(parse_decimal("1e-1000000000000000000000"));
  EXPECT_EQ(decimal_rule(), "a decimal number of at most 800 digits, 0 or between 1e-400 and 1e400");
}

/// An exponent of more than a million was once read as a million, whatever the decimals before it were.
TEST(VerifyNumbers, ALongExponentIsCountedAgainstAsManyDecimals) {
  const std::string zeros(1'000'001, '0');
  EXPECT_EQ(compare(decimal("0." + zeros + "1e1000003"), decimal("10")), 0);
  EXPECT_EQ(compare(decimal("1" + zeros + "e-1000002"), decimal("0.1")), 0);
  EXPECT_FALSE(parse_decimal("0." + zeros + "1e1000000000000000000000"));
}

TEST(VerifyNumbers, AnExcerptIsShortAndPrints) {
  const std::string forty(40, 'x');
  EXPECT_EQ(excerpt(forty), forty);
  EXPECT_EQ(excerpt(forty + "y"), forty + "...");
  EXPECT_EQ(excerpt(""), "");
  EXPECT_EQ(excerpt(std::string_view("\x1f\x20\x7e\x7f\x80\xff\0a", 8)), "? ~????a");
}

TEST(VerifyNumbers, DecimalsBecomeIntegersFractionsAndDoubles) {
  EXPECT_TRUE(in_units(decimal("12.5"), -3) == 12500);
  EXPECT_TRUE(in_units(decimal("12.5"), -1) == 125);
  EXPECT_TRUE(in_units(Decimal{}, 5) == 0) << "0 has every unit";
  EXPECT_TRUE(to_fraction(decimal("2.5")) == Fraction(5, 2));
  EXPECT_TRUE(to_fraction(decimal("-250")) == Fraction(-250));
  EXPECT_TRUE(to_fraction(decimal("3")) == Fraction(3));
  EXPECT_EQ(approximate(decimal("0.1")), 0.1);
  EXPECT_EQ(approximate(decimal("-1e300")), -1e300);
  EXPECT_TRUE(power_of_ten(0) == 1);
  EXPECT_TRUE(power_of_ten(3) == 1000);
  EXPECT_EQ(digits_of(power_of_ten(100)), 101);
  EXPECT_EQ(digits_of(Integer(7)), 1);
  EXPECT_EQ(bits_of(Integer(8)), 4);
  EXPECT_EQ(bits_of(Integer(0)), 1);
}

TEST(VerifyNumbers, ADoubleIsADecimalExactly) {
  const auto same = [](double value, std::string_view text) {
    return compare(exactly(value), decimal(text)) == 0;
  };
  EXPECT_TRUE(same(0.1, "0.1000000000000000055511151231257827021181583404541015625"));
  EXPECT_TRUE(same(-0.75, "-0.75"));
  EXPECT_TRUE(same(3, "3"));
  EXPECT_TRUE(same(std::ldexp(1, 52), "4503599627370496")) << "the last one before whole steps of two";
  EXPECT_TRUE(same(std::ldexp(1, 53) - 1, "9007199254740991"));
  EXPECT_TRUE(same(std::ldexp(1, 60), "1152921504606846976"));
  EXPECT_TRUE(same(-std::ldexp(1, 70), "-1180591620717411303424"));
  EXPECT_TRUE(exactly(0).digits == 0);
  EXPECT_EQ(exactly(0).exponent, 0);
}

TEST(VerifyNumbers, SmallDecimalsHave18DigitsAnd22Places) {
  const auto told = [](const Decimal& value) {
    const auto few = small(value);
    return few ? fmt::format("{} / {:g}", few->digits, few->power) : "none";
  };
  EXPECT_EQ(told({5, 0}), "5 / 1");
  EXPECT_EQ(told({-5, 2}), "-500 / 1");
  EXPECT_EQ(told({5, -22}), "5 / 1e+22");
  EXPECT_EQ(told({5, -23}), "none");
  const Integer most = power_of_ten(18);
  EXPECT_EQ(told({most - 1, -1}), "999999999999999999 / 10");
  EXPECT_EQ(told({1 - most, -1}), "-999999999999999999 / 10");
  EXPECT_EQ(told({most, -1}), "none");
  EXPECT_EQ(told({-most, -1}), "none");
  EXPECT_EQ(told({most / 10 - 1, 1}), "999999999999999990 / 1");
  EXPECT_EQ(told({most / 10, 1}), "none");
  EXPECT_EQ(told({1 - most / 10, 1}), "-999999999999999990 / 1");
  EXPECT_EQ(told({-most / 10, 1}), "none");
  const long whole = 1L << 53;
  EXPECT_TRUE((SmallDecimal{whole, 1}.is_double() && SmallDecimal{-whole, 1}.is_double()));
  EXPECT_FALSE((SmallDecimal{whole + 1, 1}.is_double() || SmallDecimal{-whole - 1, 1}.is_double()));
}

TEST(VerifyNumbers, TheNearestDoubleIsRoundedOnceAndMayBeInfinite) {
  EXPECT_EQ(approximate(decimal("9654823815.2815238")), 9654823815.2815238)
      << "17 digits would be rounded twice";
  EXPECT_EQ(approximate({1, 400}), kInfinity);
  EXPECT_EQ(approximate({-1, 400}), -kInfinity);
  EXPECT_EQ(approximate({1, -400}), 0);
}

TEST(VerifyNumbers, DifferencesWithZeroKeepTheOtherNumber) {
  const Decimal left = decimal("12.5") - Decimal{}, right = Decimal{} - decimal("12.5");
  EXPECT_TRUE(left.digits == 125);
  EXPECT_EQ(left.exponent, -1);
  EXPECT_TRUE(right.digits == -125);
  EXPECT_EQ(right.exponent, -1);
  EXPECT_EQ(compare(decimal("1e300"), decimal("1e-300")), 1);
  EXPECT_EQ(compare(decimal("1e-300"), decimal("1e300")), -1);
}

TEST(VerifyNumbers, AnAngleCostsFourBitsADigitBeforeItsPoint) {
  EXPECT_EQ(angle_bits(Decimal{}), 0);
  EXPECT_EQ(angle_bits(decimal("0.001")), 0);
  EXPECT_GE(angle_bits(decimal("123")), 12);
  EXPECT_LE(angle_bits(decimal("123")), 16);
  EXPECT_GE(angle_bits(decimal("1e100")), 404);
  EXPECT_LE(angle_bits(decimal("1e100")), 408);
}

TEST(VerifyNumbers, PointsAreEqualWhereBothCoordinatesAre) {
  const Point p{3, 4};
  EXPECT_TRUE(p == (Point{3, 4}));
  EXPECT_FALSE(p == (Point{3, 5}));
  EXPECT_FALSE(p == (Point{2, 4}));
  EXPECT_TRUE(is_even(Integer(-4)) && is_even(Integer(0)) && !is_even(Integer(7)));
}

TEST(VerifyNumbers, ScalingDownNeverRoundsUp) {
  EXPECT_EQ(scaled_down(Integer(12), 2), 3);
  EXPECT_EQ(scaled_down(Integer(-12), 2), -3);
  EXPECT_EQ(scaled_down(Integer(0), 7), 0);
  EXPECT_EQ(scaled_down(Integer(1), -1000), std::ldexp(1, 1000));
  EXPECT_EQ(scaled_down(Integer(1), 1 << 20), 0) << "far below all doubles";
  EXPECT_EQ(scaled_down(Integer(1), -(1 << 20)), kInfinity);
  EXPECT_EQ(scaled_down(Integer(1), 1074), 5e-324);
  const Integer odd = (Integer(1) << 60) + 1;
  EXPECT_LE(scaled_down(odd, 0), std::ldexp(1, 60));
}

TEST(VerifyNumbers, IntervalsKeepTheLargerPrecision) {
  const Interval a(Integer(1), 60), b(Integer(3), 120);
  for (const Interval& made :
       {a + b, b + a, a - b, b - a, a * b, b * a, a / b, minimum(a, b), maximum(b, a), hull(a, b)})
    EXPECT_EQ(made.precision(), 120);
  EXPECT_EQ(square(b).precision(), 120);
  EXPECT_EQ(square_root(a).precision(), 60);
}

TEST(VerifyNumbers, MinimumMaximumAndHullTakeTheRightEnds) {
  const Interval low = hull(interval("1"), interval("4")), high = hull(interval("2"), interval("5"));
  EXPECT_EQ(minimum(low, high).low_double(), 1);
  EXPECT_EQ(minimum(low, high).high_double(), 4);
  EXPECT_EQ(maximum(low, high).low_double(), 2);
  EXPECT_EQ(maximum(low, high).high_double(), 5);
  EXPECT_EQ(hull(low, high).low_double(), 1);
  EXPECT_EQ(hull(low, high).high_double(), 5);
}

TEST(VerifyNumbers, SignsAndOrderHoldOnlyForTheWholeInterval) {
  const Interval from_zero = hull(interval("0"), interval("1")),
                 to_zero = hull(interval("-1"), interval("0"));
  EXPECT_FALSE(certainly_positive(from_zero));
  EXPECT_FALSE(certainly_negative(to_zero));
  EXPECT_FALSE(certainly_zero(from_zero));
  EXPECT_FALSE(certainly_zero(to_zero));
  EXPECT_TRUE(certainly_zero(Interval(64)));
  EXPECT_TRUE(certainly_positive(interval("1e-300")));
  EXPECT_TRUE(certainly_negative(interval("-1e-300")));
  EXPECT_TRUE(certainly_not_above(to_zero, from_zero)) << "they touch";
  EXPECT_FALSE(certainly_above(from_zero, to_zero)) << "they touch";
  EXPECT_TRUE(certainly_above(interval("2"), from_zero));
  EXPECT_FALSE(certainly_not_above(interval("2"), from_zero));
}

TEST(VerifyNumbers, QuotientsOfEverySignHoldTheirExtremes) {
  const Interval divisor = hull(interval("2"), interval("4"));
  const auto quotient = [&](const char* low, const char* high) {
    return hull(interval(low), interval(high)) / divisor;
  };
  EXPECT_EQ(quotient("-8", "-4").low_double(), -4);
  EXPECT_EQ(quotient("-8", "-4").high_double(), -1);
  EXPECT_EQ(quotient("-8", "8").low_double(), -4);
  EXPECT_EQ(quotient("-8", "8").high_double(), 4);
  EXPECT_EQ(quotient("4", "8").low_double(), 1);
  EXPECT_EQ(quotient("4", "8").high_double(), 4);
}

TEST(VerifyNumbers, RootsAndSquaresOfIntervalsAcrossZero) {
  const Interval across = hull(interval("-9"), interval("4"));
  EXPECT_EQ(square_root(across).low_double(), 0);
  EXPECT_EQ(square_root(across).high_double(), 2);
  EXPECT_TRUE(certainly_zero(square_root(interval("-4"))));
  EXPECT_EQ(square(hull(interval("-9"), interval("-2"))).low_double(), 4);
  EXPECT_EQ(square(hull(interval("-9"), interval("-2"))).high_double(), 81);
  EXPECT_EQ(square(hull(interval("2"), interval("9"))).low_double(), 4);
  EXPECT_EQ(square(hull(interval("2"), interval("9"))).high_double(), 81);
}

/// From 0 on, or up to 0, an interval of angles holds more than the angle 0.
TEST(VerifyNumbers, TurnsOfAnglesBesideZeroAreWide) {
  const Turn right = turn_by(hull(Interval(200), interval("0.5"))),
             left = turn_by(hull(interval("-0.5"), Interval(200)));
  EXPECT_GE(right.sine.high_double(), std::sin(0.5));
  EXPECT_LE(right.cosine.low_double(), std::cos(0.5));
  EXPECT_LE(left.sine.low_double(), -std::sin(0.5));
  EXPECT_LE(left.cosine.low_double(), std::cos(0.5));
  EXPECT_GE(left.sine.high_double(), 0);
  EXPECT_GE(left.cosine.high_double(), 1);
  const Turn none = turn_by(Interval(200));
  EXPECT_EQ(none.sine.high_double(), 0);
  EXPECT_EQ(none.cosine.low_double(), 1);
}

TEST(VerifyNumbers, TurnsByQuartersAreExact) {
  struct Quarter {
    int degrees, cosine, sine;
  };
  for (const auto& [degrees, cosine, sine] :
       {Quarter{0, 1, 0}, Quarter{90, 0, 1}, Quarter{180, -1, 0}, Quarter{270, 0, -1}, Quarter{360, 1, 0},
        Quarter{450, 0, 1}, Quarter{-90, 0, -1}, Quarter{-180, -1, 0}, Quarter{-270, 0, 1},
        Quarter{-360, 1, 0}}) {
    const Turn turn = turn_by_degrees(degrees);
    EXPECT_TRUE(certainly_zero(turn.cosine - Interval(Integer(cosine), 64))) << degrees;
    EXPECT_TRUE(certainly_zero(turn.sine - Interval(Integer(sine), 64))) << degrees;
  }
}

/// The digits of a large angle before its point cost none of those behind it.
TEST(VerifyNumbers, OtherTurnsInDegreesAreNarrowWhateverTheAngle) {
  const Interval least(decimal("1e-45"), 200);
  for (const Fraction& turns : {Fraction(0), Fraction(1), Fraction(power_of_ten(40))}) {
    const Turn turn = turn_by_degrees(30 + 360 * turns);
    EXPECT_LE(turn.sine.low_double(), 0.5);
    EXPECT_GE(turn.sine.high_double(), 0.5);
    EXPECT_LE(turn.cosine.low_double(), std::sqrt(0.75));
    EXPECT_GE(turn.cosine.high_double(), std::sqrt(0.75));
    EXPECT_TRUE(certainly_negative(turn.sine - interval("0.5") - least));
    EXPECT_TRUE(certainly_positive(turn.sine - interval("0.5") + least));
  }
  EXPECT_FALSE(certainly_zero(turn_by_degrees(45).sine - turn_by_degrees(0).sine));
  EXPECT_EQ(turn_by_degrees(Fraction(1, 7)).sine.precision(), 160) << "a small angle costs nothing";
}

/// Rounded to 54 bits first, one in four would be rounded twice.
TEST(VerifyNumbers, ARoundedTurnIsTheNearestDouble) {
  Random random(1);
  mpfr_t theta, sine, cosine;
  mpfr_inits2(300, theta, sine, cosine, static_cast<mpfr_ptr>(nullptr));
  for (int i = 0; i < 300; ++i) {
    const double angle = random.uniform(-10, 10);
    mpfr_set_d(theta, angle, MPFR_RNDN);
    mpfr_sin_cos(sine, cosine, theta, MPFR_RNDN);
    const RoundedTurn turn = rounded_turn(angle);
    EXPECT_EQ(turn.cosine, mpfr_get_d(cosine, MPFR_RNDN)) << angle;
    EXPECT_EQ(turn.sine, mpfr_get_d(sine, MPFR_RNDN)) << angle;
  }
  mpfr_clears(theta, sine, cosine, static_cast<mpfr_ptr>(nullptr));
}

TEST(VerifyNumbers, BitsOfAnIntervalAreThoseOfItsLargerEnd) {
  EXPECT_EQ(bits_of(hull(interval("1"), interval("7"))), 3);
  EXPECT_EQ(bits_of(hull(interval("-9"), interval("7"))), 4);
  EXPECT_EQ(bits_of(hull(interval("-1"), interval("0"))), 1);
  EXPECT_EQ(bits_of(interval("0.125")), -2);
  EXPECT_EQ(bits_of(Interval(64)), 0);
}

TEST(VerifyNumbers, TheNearestMultipleIsGivenWhereItIsCertain) {
  EXPECT_EQ(nearest_multiple(interval("1.25"), 2), 5);
  EXPECT_EQ(nearest_multiple(interval("-1.25"), 2), -5);
  EXPECT_EQ(nearest_multiple(interval("0.5"), 0), 0) << "ties go to even";
  EXPECT_EQ(nearest_multiple(interval("1.5"), 0), 2);
  EXPECT_EQ(nearest_multiple(interval("2.5"), 0), 2);
  EXPECT_EQ(nearest_multiple(interval("0.5000000000000000000000000000001"), 0), 1) << "no tie";
  EXPECT_FALSE(nearest_multiple(hull(interval("0.4"), interval("0.6")), 0));
  EXPECT_EQ(nearest_multiple(Interval(Integer("4611686018427387903"), 200), 0), 4611686018427387903);
  EXPECT_EQ(nearest_multiple(Interval(Integer("4611686018427387903") * 8 + 3, 200), -3), 4611686018427387903);
  EXPECT_EQ(nearest_multiple(hull(interval("0.6"), interval("1.4")), 0), 1);
  EXPECT_EQ(nearest_multiple(Interval(Integer("1152921504606846977"), 61), 0), 1152921504606846977);
}

TEST(VerifyNumbers, DoublesOfAnIntervalAreOnTheSafeSide) {
  const Interval tenth = interval("0.1");
  EXPECT_LT(tenth.low_double(), tenth.high_double());
  EXPECT_EQ(std::nextafter(tenth.low_double(), 1), tenth.high_double());
  EXPECT_EQ(interval("12").high_double(2), 3);
  EXPECT_EQ(interval("12").low_double(2), 3);
  EXPECT_EQ(interval("12").nearly_low(2), 3);
  EXPECT_EQ(Interval(64).nearly_low(5), 0);
  EXPECT_EQ(interval("-12").nearly_low(-2), -48);
  EXPECT_EQ(interval("1").nearly_low(1 << 20), 0);
  EXPECT_EQ(interval("1").nearly_low(-(1 << 20)), kInfinity);
  EXPECT_EQ(Interval::exactly(0.1, 53).low_double(), 0.1);
  EXPECT_EQ(Interval::exactly(0.1, 53).high_double(), 0.1);
  EXPECT_EQ(Interval(64).low_text(), "0");
  EXPECT_EQ((Interval(64) - Interval(64)).low_text(), "0") << "without a sign";
}

TEST(VerifyNumbers, AnIntervalThatWasMovedFromCanBeUsedAgain) {
  Interval first = interval("2"), second = std::move(first);
  first = interval("3");
  EXPECT_EQ(first.low_double(), 3);
  EXPECT_EQ(second.low_double(), 2);
  std::swap(first, second);
  EXPECT_EQ(first.high_double(), 2);
}

TEST(VerifyNumbers, NumbersAreMadeOnWhereTheyMayThrow) {
  void* (*make)(std::size_t) = nullptr;
  void* (*resize)(void*, std::size_t, std::size_t) = nullptr;
  void (*release)(void*, std::size_t) = nullptr;
  mp_get_memory_functions(&make, &resize, &release);
  let_numbers_throw_bad_alloc();
  EXPECT_NO_THROW({
    Integer grown = power_of_ten(100);
    grown *= power_of_ten(1000);
    EXPECT_EQ(digits_of(grown), 1101);
  });
  mp_set_memory_functions(make, resize, release);
}

TEST(VerifyNumbers, ASpanIsZeroAndTheNextDoublesAreItsNeighbours) {
  EXPECT_EQ(Span{}.low, 0);
  EXPECT_EQ(Span{}.high, 0);
  for (const double value : {0.0, -0.0, 1.0, -1.0, 5e-324, -5e-324, std::numeric_limits<double>::max(),
                             std::numeric_limits<double>::lowest(), -kInfinity, kInfinity}) {
    EXPECT_EQ(step_up(value), std::nextafter(value, kInfinity)) << value;
    EXPECT_EQ(step_down(value), std::nextafter(value, -kInfinity)) << value;
  }
}

TEST(VerifyNumbers, SpansHoldTheProductsOfEverySign) {
  const Span a{-3, 2}, b{-5, 7};
  const Span product = a * b;
  EXPECT_LE(product.low, -21);
  EXPECT_GE(product.low, -21.1);
  EXPECT_GE(product.high, 15);
  EXPECT_LE(product.high, 15.1);
  const Span squares = squared(Span{-3, 2});
  EXPECT_EQ(squares.low, 0);
  EXPECT_GE(squares.high, 9);
  EXPECT_GT(squared(Span{2, 3}).low, 3.9);
}

TEST(VerifyNumbers, ASpanOfSomethingWithoutBoundDecidesNothing) {
  const Span all{-kInfinity, kInfinity};
  for (const Span& product : {just(0) * all, all * just(0), all * all, just(kInfinity) * just(0)}) {
    EXPECT_EQ(product.low, -kInfinity);
    EXPECT_EQ(product.high, kInfinity);
  }
  for (const Span& divisor : {just(0), Span{0, 1}, Span{-1, 1}, Span{-2, -1}, all}) {
    EXPECT_EQ((just(1) / divisor).low, -kInfinity);
    EXPECT_EQ((just(1) / divisor).high, kInfinity);
  }
}

TEST(VerifyNumbers, QuotientsAndRootsOfSpansHoldTheirExtremes) {
  const auto quotient = [](double low, double high) { return Span{low, high} / Span{2, 4}; };
  const auto about = [](const Span& span, double low, double high) {
    return span.low <= low && span.low >= low - 1e-9 && span.high >= high && span.high <= high + 1e-9;
  };
  EXPECT_TRUE(about(quotient(-8, -4), -4, -1));
  EXPECT_TRUE(about(quotient(-8, 8), -4, 4));
  EXPECT_TRUE(about(quotient(4, 8), 1, 4));
  EXPECT_TRUE(about(quotient(0, 0), 0, 0));
  EXPECT_TRUE(about(quotient(0.25, 0.5), 0.0625, 0.25));
  EXPECT_TRUE(about(just(1) / Span{0.25, 0.5}, 2, 4));
  EXPECT_TRUE(about(absolute(Span{0.5, 0.75}), 0.5, 0.75));
  EXPECT_TRUE(about(absolute(Span{-0.75, 0.5}), 0, 0.75));
  EXPECT_TRUE(about(square_root(Span{4, 9}), 2, 3));
  EXPECT_TRUE(about(square_root(Span{-4, 9}), 0, 3));
  EXPECT_TRUE(about(absolute(Span{-3, 2}), 0, 3));
  EXPECT_TRUE(about(absolute(Span{-3, -2}), 2, 3));
  EXPECT_TRUE(about(absolute(Span{2, 3}), 2, 3));
}

}  // namespace
}  // namespace lekalo::verify::verify_numbers_test

// The grid's rotations and roundings against MPFR and fractions.

#include "lekalo/geom/grid.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lekalo/geom/wide_product.hpp"
#include "support/cases.hpp"
#include "support/grid_cases.hpp"
#include "support/grid_oracle.hpp"

namespace lekalo::geom::geom_grid_test {
namespace {

/// Nearest multiples of 2^-52 to cosine and sine, by 300 bits.
GridRotation by_mpfr(double degrees) {
  mpfr_t angle, sine, cosine;
  mpfr_inits2(300, angle, sine, cosine, static_cast<mpfr_ptr>(nullptr));
  mpfr_const_pi(angle, MPFR_RNDN);
  mpfr_mul_d(angle, angle, degrees, MPFR_RNDN);
  mpfr_div_ui(angle, angle, 180, MPFR_RNDN);
  mpfr_sin_cos(sine, cosine, angle, MPFR_RNDN);
  mpfr_mul_2ui(sine, sine, 52, MPFR_RNDN);
  mpfr_mul_2ui(cosine, cosine, 52, MPFR_RNDN);
  const GridRotation result{mpfr_get_si(cosine, MPFR_RNDN), mpfr_get_si(sine, MPFR_RNDN)};
  mpfr_clears(angle, sine, cosine, static_cast<mpfr_ptr>(nullptr));
  return result;
}

std::vector<double> angles(Random& random, std::size_t count) {
  std::vector<double> result{0, 90, -90, 180, -180, 270, 360, 45, 30, 60, 1e-300, -1e-17, 3.6e6, -3.6e6};
  while (result.size() < count) {
    const double quarter = 90.0 * static_cast<double>(cases::between(random, -8, 8));
    switch (random.below(4)) {
      case 0:
        result.push_back(random.uniform(-360, 360));
        break;
      case 1:
        result.push_back(static_cast<double>(cases::between(random, -3600, 3600)) / 10);
        break;
      case 2:
        result.push_back(quarter + std::exp(random.uniform(-40, 3)));
        break;
      default:
        result.push_back(random.uniform(-3.6e6, 3.6e6));
    }
  }
  return result;
}

TEST(Grid, RotationsAreTheNearestPairs) {
  Random random(cases::seed());
  for (const double degrees : angles(random, cases::case_count(40'000))) {
    const GridRotation r = rotation_from_degrees(degrees);
    ASSERT_EQ(r, by_mpfr(degrees)) << degrees;
    ASSERT_TRUE(is_rotation(r)) << degrees;
  }
}

TEST(Grid, ARotationIsWrittenWithTheFewestDecimals) {
  Random random(cases::seed() + 1);
  for (std::size_t i = 0; i < cases::case_count(20'000); ++i) {
    std::int64_t scale = 1;
    for (std::uint64_t d = random.below(10); d > 0; --d) scale *= 10;
    const double degrees = static_cast<double>(cases::between(random, -180 * scale + 1, 180 * scale)) /
                           static_cast<double>(scale);
    ASSERT_EQ(degrees_of(rotation_from_degrees(degrees)), degrees);
    const double any = random.uniform(-180, 180);
    const double written = degrees_of(rotation_from_degrees(any));
    ASSERT_LT(std::abs(written - any), 1e-12 + (std::round(any * 1e9) / 1e9 == any ? 0 : 1e-12)) << any;
  }
  EXPECT_EQ(degrees_of({-GridRotation::kOne, 0}), 180);
  EXPECT_EQ(degrees_of({-GridRotation::kOne, -1}), 180);
  EXPECT_EQ(std::signbit(degrees_of({GridRotation::kOne, 0})), false);
}

TEST(Grid, TurnedIsTheExactPointRoundedHalfToEven) {
  Random random(cases::seed() + 2);
  const auto rounded = [](std::int64_t a, std::int64_t x, std::int64_t b, std::int64_t y) {
    mpz_class sum = mpz_class(a) * x + mpz_class(b) * y, floor, rest;
    const mpz_class one = mpz_class(1) << 52;
    mpz_fdiv_qr(floor.get_mpz_t(), rest.get_mpz_t(), sum.get_mpz_t(), one.get_mpz_t());
    const mpz_class twice = 2 * rest;
    if (twice > one || (twice == one && mpz_odd_p(floor.get_mpz_t()))) floor += 1;
    return floor.get_si();
  };
  for (std::size_t i = 0; i < cases::case_count(50'000); ++i) {
    GridRotation r = rotation_from_degrees(random.uniform(-180, 180));
    if (random.below(3) == 0) r = {std::int64_t{1} << cases::between(random, 40, 51), 0};  // ties
    const GridPoint p{cases::between(random, -kGridLimit, kGridLimit),
                      cases::between(random, -kGridLimit, kGridLimit)};
    ASSERT_EQ(turned(p, r, false), (GridPoint{rounded(r.c, p.x, -r.s, p.y), rounded(r.s, p.x, r.c, p.y)}));
    ASSERT_EQ(turned(p, r, true), (GridPoint{rounded(r.c, -p.x, -r.s, p.y), rounded(r.s, -p.x, r.c, p.y)}));
  }
  EXPECT_EQ(turned({1, 3}, {std::int64_t{1} << 51, 0}, false), (GridPoint{0, 2}));
}

TEST(Grid, BetweenIsTheCounterClockwiseTurn) {
  std::vector<GridRotation> directions;
  for (std::int64_t x = -3; x <= 3; ++x)
    for (std::int64_t y = -3; y <= 3; ++y)
      if (x != 0 || y != 0) directions.push_back({x, y});
  const auto from_to = [](GridRotation a, GridRotation b) {  // 0 up to a whole turn
    const double turn = std::atan2(static_cast<double>(b.s), static_cast<double>(b.c)) -
                        std::atan2(static_cast<double>(a.s), static_cast<double>(a.c));
    return turn < -1e-9 ? turn + 6.283185307179586 : turn;
  };
  for (const GridRotation d : directions)
    for (const GridRotation a : directions)
      for (const GridRotation b : directions)
        ASSERT_EQ(is_between(d, a, b), from_to(a, d) <= from_to(a, b) + 1e-9)
            << d.c << "," << d.s << " " << a.c << "," << a.s << " " << b.c << "," << b.s;
}

TEST(Grid, LengthsRoundToTheNearestStepAndGapsUp) {
  EXPECT_EQ(grid_from_mm(0.5 * kGridStep), 0);
  EXPECT_EQ(grid_from_mm(1.5 * kGridStep), 2);
  EXPECT_EQ(grid_from_mm(-2.5 * kGridStep), -2);
  EXPECT_EQ(grid_from_mm_up(3), 3 * kGridPerMm);
  EXPECT_EQ(grid_from_mm_up(0.1), 104858);
  EXPECT_EQ(grid_from_mm_up(1e-300), 1);
  EXPECT_FALSE(fits_grid(std::nan("")));
  EXPECT_FALSE(is_rotation({GridRotation::kOne, (1 << 27) + 1}));
  EXPECT_TRUE(is_rotation({GridRotation::kOne, 1 << 27}));
  EXPECT_FALSE(is_rotation({GridRotation::kOne + 8, 0}));
  EXPECT_FALSE(is_rotation({0, 0}));
}

TEST(Grid, ProductsOf256BitsAreExact) {
  Random random(cases::seed() + 3);
  const auto any = [&] {
    const Int128 value = (Int128{static_cast<std::int64_t>(random.bits())} << 63) +
                         static_cast<std::int64_t>(random.bits() >> 2);
    return value >> random.below(125);
  };
  for (std::size_t i = 0; i < cases::case_count(20'000); ++i) {
    const Int128 a = any(), b = any(), c = random.below(3) == 0 ? -a : any(),
                 d = random.below(3) == 0 ? b : any();
    using oracle::detail::wide;
    ASSERT_EQ(sign_of_sum(a, b, c, d), sgn(mpz_class(wide(a) * wide(b) + wide(c) * wide(d))));
    const Unsigned256 product = wide_product(a, b);
    const auto half = [](Unsigned128 v) {
      mpz_class result = static_cast<unsigned long>(v >> 64);
      return mpz_class((result << 64) + static_cast<unsigned long>(v));
    };
    ASSERT_TRUE(mpz_class((half(product.high) << 128) + half(product.low)) ==
                abs(mpz_class(wide(a) * wide(b))));
  }
}

TEST(Grid, TurnIsExactAtTheLimits) {
  Random random(cases::seed() + 4);
  for (std::size_t i = 0; i < cases::case_count(50'000); ++i) {
    const auto any = [&] {
      return GridPoint{cases::between(random, -4 * kGridLimit, 4 * kGridLimit),
                       cases::between(random, -4 * kGridLimit, 4 * kGridLimit)};
    };
    const GridPoint a = any(), b = any();
    GridPoint c = any();
    if (random.below(2) == 0)
      c = cases::point_on(random, {a, b}) + GridPoint{cases::between(random, -1, 1), 0};
    ASSERT_EQ(turn(a, b, c), sgn(mpz_class((mpz_class(b.x) - a.x) * (mpz_class(c.y) - a.y) -
                                           (mpz_class(b.y) - a.y) * (mpz_class(c.x) - a.x))));
  }
}

}  // namespace
}  // namespace lekalo::geom::geom_grid_test

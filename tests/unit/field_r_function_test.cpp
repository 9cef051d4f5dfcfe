#include <gtest/gtest.h>

#include <cmath>

#include "lekalo/field/contour_model.hpp"

namespace lekalo::field::field_r_function_test {
namespace {

Jet plain(double value) { return {value, {}}; }

TEST(RFunction, SignsAreThoseOfLogic) {
  for (const Logic logic : {Logic::linear, Logic::quadratic}) {
    for (const double a : {-3.0, -0.5, 0.5, 3.0}) {
      for (const double b : {-2.0, -0.5, 0.5, 2.0}) {
        EXPECT_EQ(conjunction(plain(a), plain(b), logic).value > 0, a > 0 && b > 0) << a << " " << b;
        EXPECT_EQ(disjunction(plain(a), plain(b), logic).value > 0, a > 0 || b > 0) << a << " " << b;
        EXPECT_EQ(difference(plain(a), plain(b), logic).value > 0, a > 0 && b < 0) << a << " " << b;
        EXPECT_EQ(conjunction(plain(a), plain(b), logic), conjunction(plain(b), plain(a), logic));
      }
    }
  }
}

TEST(RFunction, ValuesAreThoseOfTheFormulas) {
  EXPECT_EQ(conjunction(plain(3), plain(4), Logic::linear).value, 3);
  EXPECT_DOUBLE_EQ(conjunction(plain(3), plain(4), Logic::quadratic).value, 2);
  EXPECT_DOUBLE_EQ(disjunction(plain(3), plain(4), Logic::quadratic).value, 12);
  EXPECT_DOUBLE_EQ(conjunction(plain(-3), plain(4), Logic::quadratic).value, -4);
  EXPECT_EQ(conjunction(plain(0), plain(0), Logic::quadratic).value, 0);
  // Without cancellation: a + b - sqrt(a^2 + b^2) would be 0 here.
  EXPECT_DOUBLE_EQ(conjunction(plain(1e-20), plain(1), Logic::quadratic).value, 1e-20);
}

TEST(RFunction, TheQuadraticConjunctionDependsOnGroupingAsTheSourceFound) {
  const Jet one = plain(1), two = plain(2), three = plain(3);
  const Logic q = Logic::quadratic;
  EXPECT_NEAR(conjunction(conjunction(one, two, q), three, q).value, 0.668, 5e-4);
  EXPECT_NEAR(conjunction(one, conjunction(two, three, q), q).value, 0.678, 5e-4);
  EXPECT_EQ(folded({one, two, three}, q).value, conjunction(one, conjunction(two, three, q), q).value);
}

TEST(RFunction, GradientsAreDerivatives) {
  for (const double a : {-1.5, 0.7}) {
    for (const double b : {-0.4, 2.0}) {
      const Jet x{a, {1, 0}}, y{b, {0, 1}};
      const auto value = [](double u, double v) {
        return conjunction(plain(u), plain(v), Logic::quadratic).value;
      };
      const Jet jet = conjunction(x, y, Logic::quadratic);
      constexpr double h = 1e-6;
      EXPECT_NEAR(jet.gradient.x, (value(a + h, b) - value(a - h, b)) / (2 * h), 1e-8);
      EXPECT_NEAR(jet.gradient.y, (value(a, b + h) - value(a, b - h)) / (2 * h), 1e-8);
    }
  }
}

}  // namespace
}  // namespace lekalo::field::field_r_function_test

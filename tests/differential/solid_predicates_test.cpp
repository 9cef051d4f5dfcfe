// The side of a plane against GMP rationals, on points chosen to be hard.

#include "lekalo/solid/predicates.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "lekalo/base/random.hpp"
#include "support/cases.hpp"

namespace lekalo::solid_predicates_test {
namespace {

using solid::Vector;

int exact_side(Vector a, Vector b, Vector c, Vector p) {
  const auto from_a = [&](Vector v) {
    return std::array<mpq_class, 3>{mpq_class(v.x) - mpq_class(a.x), mpq_class(v.y) - mpq_class(a.y),
                                    mpq_class(v.z) - mpq_class(a.z)};
  };
  const auto u = from_a(b), v = from_a(c), w = from_a(p);
  const mpq_class volume = (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
                           (u[0] * v[1] - u[1] * v[0]) * w[2];
  return sgn(volume);
}

double stepped(double value, int ulps) {
  for (; ulps > 0; --ulps) value = std::nextafter(value, 1e300);
  for (; ulps < 0; ++ulps) value = std::nextafter(value, -1e300);
  return value;
}

TEST(SideOfPlane, IsThatOfRationalsWithinUlpsOfThePlane) {
  Random random(cases::seed(), 31);
  std::array<std::size_t, 3> seen{};
  for (std::size_t i = 0; i < cases::case_count(20000); ++i) {
    const double size = std::ldexp(1.0, static_cast<int>(random.below(41)) - 20);
    const auto point = [&] {
      return Vector{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
    };
    const Vector a = point(), b = point(), c = point();
    const double s = random.uniform(-1, 2), t = random.uniform(-1, 2);
    Vector p = a + s * (b - a) + t * (c - a);
    for (double* const k : {&p.x, &p.y, &p.z}) *k = stepped(*k, static_cast<int>(random.below(5)) - 2);
    const int exact = exact_side(a, b, c, p);
    ++seen[static_cast<std::size_t>(exact + 1)];
    ASSERT_EQ(solid::side_of_plane(a, b, c, p), exact) << i;
    ASSERT_EQ(solid::side_of_plane(b, c, a, p), exact) << i;
    ASSERT_EQ(solid::side_of_plane(b, a, c, p), -exact) << i;
    ASSERT_EQ(solid::side_of_plane(a, b, p, c), -exact) << i;
  }
  EXPECT_GT(seen[0], 100u);
  EXPECT_GT(seen[2], 100u);
}

TEST(SideOfPlane, IsZeroOnPlanesOfAGrid) {
  // Coordinates are multiples of 2^-20, and p is a whole combination of the way to b and c: on the plane,
  // exactly.
  Random random(cases::seed(), 32);
  for (std::size_t i = 0; i < cases::case_count(5000); ++i) {
    const auto number = [&] { return std::ldexp(static_cast<double>(random.below(1u << 30)), -20) - 512; };
    const Vector a{number(), number(), number()}, b{number(), number(), number()},
        c{number(), number(), number()};
    const double s = static_cast<double>(random.below(9)) - 4, t = static_cast<double>(random.below(9)) - 4;
    const Vector p = a + s * (b - a) + t * (c - a);
    ASSERT_EQ(solid::side_of_plane(a, b, c, p), 0) << i;
    ASSERT_EQ(solid::side_of_plane(a, b, c, {p.x, p.y, stepped(p.z, 1)}),
              exact_side(a, b, c, {p.x, p.y, stepped(p.z, 1)}));
  }
}

TEST(SideOfPlane, IsOneWhereTheCornersTurnLeftAsSeenFromThePoint) {
  EXPECT_EQ(solid::side_of_plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 1}), 1);
  EXPECT_EQ(solid::side_of_plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, -1e-300}), -1);
  EXPECT_EQ(solid::side_of_plane({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 1}), 0);
}

}  // namespace
}  // namespace lekalo::solid_predicates_test

// The laws of lekalo/geom/pose.hpp.

#include "lekalo/geom/pose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/cases.hpp"

namespace lekalo::geom_pose_test {
namespace {

using geom::Point;
struct A;
struct B;
struct C;

/// Quarter turns and whole translations: nothing rounds.
template <class To, class From>
geom::Pose<To, From> grid_pose(Random& random) {
  constexpr double cosines[] = {1, 0, -1, 0}, sines[] = {0, 1, 0, -1};
  const auto quarter = random.below(4);
  const auto whole = [&] { return static_cast<double>(random.below(2001)) - 1000; };
  return {cosines[quarter], sines[quarter], {whole(), whole()}, random.below(2) == 1};
}

template <class To, class From>
geom::Pose<To, From> any_pose(Random& random) {
  const Point t{random.uniform(-1000, 1000), random.uniform(-1000, 1000)};
  return geom::Pose<To, From>::from_angle(random.uniform(-10, 10), t, random.below(2) == 1);
}

Point grid_point(Random& random) {
  return {static_cast<double>(random.below(2001)) - 1000, static_cast<double>(random.below(2001)) - 1000};
}

double distance(Point a, Point b) { return norm(a - b); }

TEST(PoseLaws, OnAGridInverseAndCompositionAreExact) {
  Random random(cases::seed(), 1);
  for (int i = 0; i < 20000; ++i) {
    const auto a_from_b = grid_pose<A, B>(random);
    const auto b_from_c = grid_pose<B, C>(random);
    const Point p = grid_point(random), v = grid_point(random), w = grid_point(random);
    ASSERT_EQ(a_from_b.inverse()(a_from_b(p)), p);
    ASSERT_EQ(a_from_b(a_from_b.inverse()(p)), p);
    ASSERT_EQ((a_from_b * b_from_c)(p), a_from_b(b_from_c(p)));
    ASSERT_EQ((a_from_b * b_from_c).inverse()(p), (b_from_c.inverse() * a_from_b.inverse())(p));
    const double turned = cross(a_from_b.rotate(v), a_from_b.rotate(w));
    ASSERT_EQ(turned, a_from_b.mirrored ? -cross(v, w) : cross(v, w));
    ASSERT_EQ(a_from_b.rotate(v), a_from_b(p + v) - a_from_b(p));
  }
}

TEST(PoseLaws, ElsewhereTheyHoldWithinRounding) {
  Random random(cases::seed(), 2);
  for (int i = 0; i < 20000; ++i) {
    const auto a_from_b = any_pose<A, B>(random);
    const auto b_from_c = any_pose<B, C>(random);
    const Point p{random.uniform(-1000, 1000), random.uniform(-1000, 1000)};
    ASSERT_LT(distance(a_from_b.inverse()(a_from_b(p)), p), 1e-11);
    ASSERT_LT(distance((a_from_b * b_from_c)(p), a_from_b(b_from_c(p))), 1e-11);
  }
}

TEST(PoseLaws, AMirroredPartIsMirroredInXFirst) {
  const auto pose = geom::BlankFromPart{0, 1, {10, 20}, true};  // a quarter turn
  EXPECT_EQ(pose({3, 4}), (Point{10 - 4, 20 - 3}));
}

TEST(PoseLaws, NothingIsTheIdentity) {
  const geom::BlankFromPart pose;
  EXPECT_EQ(pose({3, 4}), (Point{3, 4}));
}

}  // namespace
}  // namespace lekalo::geom_pose_test

#include "locate/reference/start.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lekalo/geom/pose.hpp"
#include "lekalo/geom/predicates.hpp"
#include "support/cases.hpp"

namespace lekalo::locate::reference_start_test {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(OutlineMoments, OfARectangleAreItsMiddleAndItsLongSide) {
  const auto rectangle = cases::convex({{10, 20}, {14, 20}, {14, 22}, {10, 22}});
  const OutlineMoments moments = outline_moments(rectangle);
  EXPECT_NEAR(moments.centroid.x, 12, 1e-12);
  EXPECT_NEAR(moments.centroid.y, 21, 1e-12);
  EXPECT_NEAR(moments.axis, 0, 1e-12);
}

TEST(OutlineMoments, AreThoseOfTheOutlineNotOfTheAreaOrTheVertices) {
  // Sides 3, 4, 5 weigh by length: (3*(1.5,0) + 5*(1.5,2) + 4*(0,2)) / 12.
  const OutlineMoments moments = outline_moments(cases::convex({{0, 0}, {3, 0}, {0, 4}}));
  EXPECT_NEAR(moments.centroid.x, 1.0, 1e-12);
  EXPECT_NEAR(moments.centroid.y, 1.5, 1e-12);
}

TEST(OutlineMoments, TurnAndMoveWithThePolygon) {
  Random random(cases::seed());
  for (int i = 0; i < 100; ++i) {
    const auto c = cases::random_case(cases::seed(), static_cast<std::uint64_t>(i), cases::Kind::plain);
    const OutlineMoments before = outline_moments(c.part);
    const double angle = random.uniform(-3, 3);
    const auto pose =
        geom::BlankFromPart::from_angle(angle, {random.uniform(-50, 50), random.uniform(-50, 50)});
    geom::Ring ring;
    for (const geom::Point p : c.part.vertices()) ring.push_back(pose(p));
    const OutlineMoments after = outline_moments(cases::hull(ring));
    const geom::Point off = after.centroid - pose(before.centroid);
    EXPECT_LT(norm(off), 1e-10) << c.name;
    EXPECT_LT(std::abs(std::sin(after.axis - before.axis - angle)), 1e-6) << c.name;
  }
}

TEST(OutlineMoments, KeepTheirDigitsFarFromTheOrigin) {
  const auto far = cases::convex({{1e9, 1e9}, {1e9 + 4, 1e9}, {1e9 + 4, 1e9 + 2}, {1e9, 1e9 + 2}});
  const OutlineMoments moments = outline_moments(far);
  EXPECT_NEAR(moments.centroid.x - 1e9, 2, 1e-6);
  EXPECT_NEAR(moments.axis, 0, 1e-12);
}

TEST(RandomPoint, LiesInThePolygonAndSpreadsByArea) {
  const auto polygon = cases::convex({{0, 0}, {8, 0}, {8, 1}, {4, 4}, {0, 1}});
  Random random(3);
  geom::Point sum;
  constexpr int kDraws = 20'000;
  for (int i = 0; i < kDraws; ++i) {
    const geom::Point p = random_point(polygon, random);
    ASSERT_NE(geom::locate_point(polygon.vertices(), p), geom::PointLocation::outside);
    sum = sum + p;
  }
  // Rectangle 8 x 1 and triangle of area 12 above it: centroid y = (8 * 0.5 + 12 * 2) / 20.
  EXPECT_NEAR(sum.x / kDraws, 4, 0.1);
  EXPECT_NEAR(sum.y / kDraws, 1.4, 0.05);
}

TEST(AngleFolding, AddsWholeTurnsUntilTheAngleLiesInTheWindow) {
  const AngleWindow window{-0.5, 0.5};
  EXPECT_NEAR(fold_into(window, 2 * kPi + 0.25).value(), 0.25, 1e-14);
  EXPECT_NEAR(fold_into(window, -6 * kPi - 0.25).value(), -0.25, 1e-13);
  EXPECT_EQ(fold_into(window, 0.5).value(), 0.5);
  EXPECT_FALSE(fold_into(window, 1.0).has_value());
  EXPECT_EQ(nearest_in(window, 1.0), 0.5);
  EXPECT_EQ(nearest_in(window, 2 * kPi - 1.0), -0.5);
}

TEST(AngleFolding, NeverLeavesTheFullCircle) {
  const AngleWindow circle;
  Random random(5);
  for (int i = 0; i < 100'000; ++i) {
    const double angle = random.uniform(-1000, 1000);
    const double folded = fold_into(circle, angle).value();
    ASSERT_TRUE(folded >= circle.from && folded <= circle.to) << angle;
    ASSERT_LT(std::abs(std::remainder(folded - angle, 2 * kPi)), 1e-12) << angle;
  }
  for (const double angle : {0.0, -1e-300, 2 * kPi, std::nextafter(2 * kPi, 7), -2 * kPi}) {
    const double folded = fold_into(circle, angle).value();
    EXPECT_TRUE(folded >= circle.from && folded <= circle.to) << angle;
  }
}

TEST(AngleWindow, IsRefusedWhenItRunsBackwardsOrIsNotFinite) {
  EXPECT_TRUE(check_window({}));
  EXPECT_TRUE(check_window({1, 1}));
  for (const AngleWindow& window :
       {AngleWindow{1, 0.5}, AngleWindow{std::nan(""), 1}, AngleWindow{0, std::nan("")},
        AngleWindow{0, INFINITY}, AngleWindow{-1e9, 0}}) {
    const auto checked = check_window(window);
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().code, ErrorCode::usage);
  }
}

}  // namespace
}  // namespace lekalo::locate::reference_start_test

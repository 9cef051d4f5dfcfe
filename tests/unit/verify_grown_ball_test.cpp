// How large a ball the checker sees in a grown part, where holes and thin walls are grown over.

#include "verify/locate/grown_ball.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "verify/read/json.hpp"

namespace lekalo::verify::verify_grown_ball_test {
namespace {

/// A plate of 100 by 40 with a bore of radius 6 about (50, 10), side 4, and a slot of 6 by 26 above it, sides
/// 5 to 8.
Shape plate() {
  const std::string text =
      R"({"outer": [{"line": {"from": [0, 0], "to": [100, 0]}}, {"line": {"from": [100, 0], "to": [100, 40]}},
    {"line": {"from": [100, 40], "to": [0, 40]}}, {"line": {"from": [0, 40], "to": [0, 0]}}],
    "holes": [[{"arc": {"from": [56, 10], "to": [56, 10], "centre": [50, 10], "ccw": true}}],
    [{"line": {"from": [40, 27], "to": [60, 27]}}, {"arc": {"from": [60, 27], "to": [60, 33], "centre": [60, 30], "ccw": true}},
     {"line": {"from": [60, 33], "to": [40, 33]}}, {"arc": {"from": [40, 33], "to": [40, 27], "centre": [40, 30], "ccw": true}}]]})";
  std::string complaint;
  Shape read = read_shape(*parse_json(text, "shape"), "shape", complaint);
  EXPECT_EQ(complaint, "");
  EXPECT_EQ(read.sides.size(), 9U);
  return read;
}

double ball(double x, double y, double wanted, double bore, double slot, double below = 0) {
  return grown_ball(plate(), {below, 0, 0, 0, bore, slot, slot, slot, slot}, {just(x), just(y)}, wanted);
}

/// The ball is as large as said, but for rounding, and the checker never sees a larger one.
void expect_ball(double x, double y, double radius, double bore, double slot, double below = 0) {
  SCOPED_TRACE(testing::Message() << x << " " << y);
  EXPECT_NEAR(ball(x, y, radius, bore, slot, below), radius, 1e-10);
  EXPECT_LE(ball(x, y, radius, bore, slot, below), radius);
  EXPECT_LE(ball(x, y, radius + 1, bore, slot, below), radius + 1e-12);
  EXPECT_LE(ball(x, y, radius + 1e-6, bore, slot, below), radius + 1e-12);
}

TEST(GrownBall, ABoreThatIsGrownOverIsMaterialAndSoIsWhatLiesBeyondTheWall) {
  expect_ball(50, 10, 21, 15, 9);
  expect_ball(50, -3, 8, 15, 0);
  expect_ball(50, 2, 13, 15, 9);
}

TEST(GrownBall, ASlotThatIsGrownOverIsCoveredByAllItsSides) {
  expect_ball(50, 30, 17, 15, 14);
  expect_ball(60, 30, 17, 15, 14);
  expect_ball(48, 42, 5, 0, 14);
}

/// Once a ball of radius 0 was seen there, which says that its middle lies in the part.
TEST(GrownBall, APlaceThatIsNotInTheGrownPartHasNone) {
  expect_ball(50, 16.5, 5.5, 5, 9);
  EXPECT_EQ(ball(50, 10, 21, 5, 0), -kInfinity);
  EXPECT_EQ(ball(50, 10, 21, 0, 0), -kInfinity);
  EXPECT_EQ(ball(500, 10, 21, 15, 9), -kInfinity);
  EXPECT_EQ(ball(50, -11.001, 1e-15, 15, 9), -kInfinity);
  EXPECT_EQ(ball(20, 20, 0, 0, 0), -kInfinity);
  EXPECT_EQ(ball(20, 20, -1, 0, 0), -kInfinity);
}

TEST(GrownBall, WhatIsLeftOfABoreAndWhatGrowsAboutTheEndOfAnArcBoundIt) {
  expect_ball(50, 11, 0.5, 5.5, 0);
  const double end = grown_ball(plate(), {0, 0, 0, 0, 0, 0, 2, 0, 0}, {just(59.5), just(28)}, 5);
  EXPECT_NEAR(end, 2 - std::hypot(0.5, 1), 1e-10);
}

/// A ball that touches the outline in more places than one was once made smaller in each by all the work.
TEST(GrownBall, IsWholeWhereItTouchesTheOutlineInManyPlaces) {
  expect_ball(20, 5, 5, 0, 0);
  expect_ball(15, 25, 15, 0, 0);                         // two edges
  expect_ball(50, 21.25, 5.25, 0, 0.5);                  // the bore
  expect_ball(40, 10, 10, 7, 7);                         // the edge below, while the bore is filled
  expect_ball(50, -20, 30, 0, 0, 50);                    // beside the part
  expect_ball(50, 30, 3 + 1000, 0, 1000);                // beyond all of it
  EXPECT_EQ(ball(50, 10, 21 - 1e-9, 15, 9), 21 - 1e-9);  // all round, as the bore is
}

/// Nearly every point of a parallel is nearest there, and rounding told of none whether it is in the
/// material.
TEST(GrownBall, AboutWhatIsNearlyTheCentreOfAnArcItIsWhole) {
  for (const double off : {0.0, 1e-16, 1e-14, -3e-14, 1e-9})
    EXPECT_NEAR(ball(60 + 2 * off, 30 + off, 17, 15, 14), 17, 2.3 * std::abs(off) + 1e-10) << off;
  const std::string text =
      R"({"outer": [{"arc": {"from": [41.8, 21.8], "to": [41.8, 21.8], "centre": [21.8, 21.8], "ccw": true}}],
    "holes": [[{"arc": {"from": [25, 30], "to": [25, 30], "centre": [24, 30], "ccw": true}}]]})";
  std::string complaint;
  const Shape disc = read_shape(*parse_json(text, "shape"), "shape", complaint);
  EXPECT_NEAR(grown_ball(disc, {2, 2}, {just(21.79999999999996), just(21.80000000000002)}, 22), 22, 1e-10);
}

/// A slot of 6 that is grown by 3 is closed by sides that only meet in its middle.
TEST(GrownBall, ASlotThatIsJustClosedIsClosedOnceItsSidesGrowALittleMore) {
  EXPECT_LE(ball(50, 31, 10, 0, 3), 1);
  EXPECT_LE(ball(50, 31, 10, 0, 3 - 1e-9), 1);
  expect_ball(50, 31, 9, 0, 3 + 1e-10);  // from the edge above
}

TEST(GrownBall, ARimThatIsTakenOffCountsWhereNothingGrowsOverIt) {
  expect_ball(50, 10, 21, 15, 9, -2);
  // The bore reaches to x = 14, and at x = 12 the rim of 2 mm is off.
  EXPECT_NEAR(ball(12, 8, 5, 30, 0, -2), 5, 1e-10);
  EXPECT_LE(ball(12, 8, 7, 30, 0, -2), 6);
  // It reaches into the bore and the slot, which are grown over, and touches the rim.
  expect_ball(70, 20, 18, 9, 9, -2);
}

double off(double x, double y, std::vector<double> growth) {
  return off_rims(plate(), growth, {just(x), just(y)});
}

TEST(OffRims, IsTheDistanceFromWhatIsLeftOfThePart) {
  const double inf = kInfinity, diagonal = std::sqrt(2.0);
  EXPECT_EQ(off(20, 20, {-2, 0, 0, 0, 0, 0, 0, 0, 0}), 0);
  EXPECT_EQ(off(20, 20, {0, 0, 0, 0, 0, 0, 0, 0, 0}), 0);
  EXPECT_EQ(off(20, -1, {0, 0, 0, 0, 0, 0, 0, 0, 0}), inf);  // without a rim its sides tell
  // Behind one rim, to both sides of it, behind two, and behind one of a corner and the end of another.
  EXPECT_NEAR(off(20, 0.5, {-2, 0, 0, 0, 0, 0, 0, 0, 0}), 1.5, 1e-9);
  EXPECT_NEAR(off(20, -0.5, {-2, 0, 0, 0, 0, 0, 0, 0, 0}), 2.5, 1e-9);
  EXPECT_NEAR(off(0, 0, {-2, 0, 0, -2, 0, 0, 0, 0, 0}), 2 * diagonal, 1e-9);
  EXPECT_NEAR(off(0.5, 0.5, {-2, 0, 0, -2, 0, 0, 0, 0, 0}), 1.5 * diagonal, 1e-9);
  EXPECT_NEAR(off(0, 0, {-3, 0, 0, -4, 0, 0, 0, 0, 0}), 5, 1e-9);
  // The rim of the bore is a ring; between it and that of the edge below it nothing is left at x = 50.
  EXPECT_NEAR(off(50, 10, {0, 0, 0, 0, -2, 0, 0, 0, 0}), 8, 1e-9);
  EXPECT_NEAR(off(50, 3, {-2, 0, 0, 0, -3, 0, 0, 0, 0}), std::hypot(std::sqrt(17.0), 1), 1e-9);
  EXPECT_GE(off(50, 3, {-2, 0, 0, 0, -3, 0, 0, 0, 0}), std::hypot(std::sqrt(17.0), 1));
  EXPECT_EQ(off(50, 20, {-50, 0, 0, 0, 0, 0, 0, 0, 0}), inf);
}

}  // namespace
}  // namespace lekalo::verify::verify_grown_ball_test

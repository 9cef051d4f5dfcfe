// How large a ball the checker sees in a grown part, where holes and thin walls are grown over.

#include "verify/locate/grown_ball.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "verify/read/json.hpp"
#include "verify/shape/shape_distance.hpp"

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

Shape shape_of(const std::string& text) {
  std::string complaint;
  Shape read = read_shape(*parse_json(text, "shape"), "shape", complaint);
  EXPECT_EQ(complaint, "");
  return read;
}
/// A square, sides 0 to 3 from the lower one on, with a bore, side 4.
Shape bored(double width, double x, double y, double radius) {
  return shape_of(fmt::format(
      R"({{"outer": [{{"line": {{"from": [0, 0], "to": [{0}, 0]}}}}, {{"line": {{"from": [{0}, 0], "to": [{0}, {0}]}}}},
    {{"line": {{"from": [{0}, {0}], "to": [0, {0}]}}}}, {{"line": {{"from": [0, {0}], "to": [0, 0]}}}}],
    "holes": [[{{"arc": {{"from": [{1}, {2}], "to": [{1}, {2}], "centre": [{3}, {2}], "ccw": true}}}}]]}})",
      width, x + radius, y, x));
}

TEST(GrownBall, TheOutlineOfAGrowthCountsInARimAndNotInMaterial) {
  // The right side grows to x = 7 and the bore about (5, 2.5) to a radius of 2.9, in the rim of the lower
  // side.
  const Shape square = bored(10, 5, 2.5, 1);
  const auto ball_at = [&](double x, double y, double wanted) {
    return grown_ball(square, {-2, 3, 0, 0, 1.9}, {just(x), just(y)}, wanted);
  };
  // The outline of the one is covered by the other down to where they meet.
  EXPECT_NEAR(ball_at(7.2, 1, 5), std::hypot(0.2, 1 - (2.5 - std::sqrt(2.9 * 2.9 - 4))), 1e-9);
  // Nothing covers the bore's in the rim, though its inside is material.
  const Shape larger = bored(20, 10, 10, 1);
  EXPECT_NEAR(grown_ball(larger, {-8, 0, 0, 0, 3}, {just(10), just(7)}, 5), 1, 1e-9);
  // The bore's reaches from the material below the edge, which ends the ball.
  expect_ball(35, 10, std::hypot(std::sqrt(341.0) - 15, 10), 15, 0);
}

TEST(GrownBall, OutlinesThatLeaveTheMaterialWhereItIsGrownOverAreNotCoveredByIt) {
  // The bores about (10, 5) and (16, 5) grow to discs of radius 7, which meet below the edge.
  const Shape plate_of_two = shape_of(
      R"({"outer": [{"line": {"from": [-20, 0], "to": [50, 0]}}, {"line": {"from": [50, 0], "to": [50, 60]}},
    {"line": {"from": [50, 60], "to": [-20, 60]}}, {"line": {"from": [-20, 60], "to": [-20, 0]}}],
    "holes": [[{"arc": {"from": [11, 5], "to": [11, 5], "centre": [10, 5], "ccw": true}}],
    [{"arc": {"from": [17, 5], "to": [17, 5], "centre": [16, 5], "ccw": true}}]]})");
  EXPECT_NEAR(grown_ball(plate_of_two, {0, 0, 0, 0, 6, 6}, {just(13), just(4)}, 7), std::sqrt(40.0) - 1,
              1e-9);
}

TEST(GrownBall, AMiddleAtTheVeryBound) {
  const Shape part = plate();
  // In the rim of the lower edge or of the bore, beside it, and at its very end.
  EXPECT_EQ(ball(20, 1, 1, 0, 0, -2), -kInfinity);
  EXPECT_GT(ball(20, 2.25, 1, 0, 0, -2), 0.2);
  bool at_gap = false;
  double low = 2;
  for (int k = 0; k < 20; ++k, low = step_up(low)) {
    const Vec at{just(20), just(low)};
    const double by = step_up(2), boxes = gap(box_of(at), part.tree->box(0));
    at_gap = at_gap || boxes == by;
    EXPECT_EQ(ball(20, low, 1, 0, 0, -2) > -kInfinity, boxes > by || distance(at, part.sides[0]).low > by)
        << k;
  }
  EXPECT_TRUE(at_gap);
  const double apart = distance({just(54.8), just(16.4)}, part.sides[4]).low;
  const auto width_of_rim = [&](double by) { return (just(by) + just(part.sides[4].off)).high; };
  double by = apart;
  while (width_of_rim(by) > apart) by = step_down(by);
  EXPECT_EQ(width_of_rim(by), apart);
  EXPECT_EQ(ball(54.8, 16.4, 1, -by, 0), -kInfinity);
  EXPECT_GE(ball(54.8, 16.4, 1, -step_down(by), 0), 0);
  // Within what grows, up to its very end.
  const double end = (just(distance({just(20), just(-3)}, part.sides[0]).high) + just(0)).high;
  EXPECT_GE(ball(20, -3, 1, 0, 0, end), 0);
  EXPECT_EQ(ball(20, -3, 1, 0, 0, step_down(end)), -kInfinity);
}

/// A side that does not grow has no rim of no width either.
TEST(GrownBall, ASideThatDoesNotGrowIsTheOutlineItself) {
  EXPECT_EQ(ball(20, 35, 10, 0, 0), distance({just(20), just(35)}, plate().sides[2]).low);
}

/// Reading the plate takes 200 steps of these.
bool is_quick(double x, double y, double wanted, double bore, double slot) {
  RunControl run;
  run.work_limit = 1000;
  return stoppable(run, [&] { return ball(x, y, wanted, bore, slot); }).has_value();
}

TEST(GrownBall, PiecesAreHalvedOnlyWhereThatHelps) {
  EXPECT_TRUE(is_quick(20, 5, 7, 0, 0));
  EXPECT_TRUE(is_quick(50, 15.5, 2, 1, 0));
  EXPECT_TRUE(is_quick(50, 10, 21, 15, 9));
  // Sides that grow over a slot by so little that rounding decides.
  double slot = 3;
  for (int k = 0; k < 40; ++k, slot = step_up(slot)) {
    EXPECT_TRUE(is_quick(50, 31, 9, 0, slot)) << k;
    EXPECT_TRUE(is_quick(60.5, 30.5, 9, 0, slot)) << k;
  }
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

TEST(OffRims, OfArcsIsAsFarAsTheirParallelsAndWhereTheyMeet) {
  const auto off_of = [](const std::string& outer, const std::vector<double>& growth, double x, double y) {
    return off_rims(shape_of(R"({"outer": )" + outer + "}"), growth, {just(x), just(y)});
  };
  // A disc of which half a millimetre is left, seen from where no end of its arc is in the way.
  const std::string disc = R"([{"arc": {"from": [6, 0], "to": [6, 0], "centre": [0, 0], "ccw": true}}])";
  EXPECT_NEAR(off_of(disc, {-5.5}, 0, 3), 2.5, 1e-9);
  // A lens, whose arcs' parallels meet in (3.5, 0).
  const std::string lens = R"([{"arc": {"from": [5, 0], "to": [-5, 0], "centre": [0, -12], "ccw": true}},
    {"arc": {"from": [-5, 0], "to": [5, 0], "centre": [0, 12], "ccw": true}}])";
  EXPECT_NEAR(off_of(lens, {-0.5, -0.5}, 5, 0), 1.5, 1e-9);
  // An arc that nearly closes: what is within 3.25 of one of its ends meets what is within it of the other.
  const std::string cut = R"([{"arc": {"from": [4, 3], "to": [4, -3], "centre": [0, 0], "ccw": true}},
    {"line": {"from": [4, -3], "to": [4, 3]}}])";
  EXPECT_NEAR(off_of(cut, {-3.25, 0}, 4, 0), 1.25, 1e-9);
}

TEST(OffRims, OfCoordinatesOfManyDigitsIsFoundAllTheSame) {
  for (const auto& [x, y] : std::vector<std::array<double, 2>>{{0, 1e6}, {0, -1e6}, {1e6, 0}, {-1e6, 0}}) {
    const auto edge = [&, x = x, y = y](int x0, int y0, int x1, int y1) {
      return fmt::format(R"({{"line": {{"from": [{}, {}], "to": [{}, {}]}}}})", x + x0, y + y0, x + x1,
                         y + y1);
    };
    const Shape square = shape_of(R"({"outer": [)" + edge(0, 0, 10, 0) + ", " + edge(10, 0, 10, 10) + ", " +
                                  edge(10, 10, 0, 10) + ", " + edge(0, 10, 0, 0) + "]}");
    EXPECT_NEAR(off_rims(square, {-0.125, 0, 0, -0.125}, {just(x + 5), just(y + 0.0625)}), 0.0625, 1e-7);
    EXPECT_NEAR(off_rims(square, {-0.125, 0, 0, -0.125}, {just(x + 0.0625), just(y + 5)}), 0.0625, 1e-7);
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_grown_ball_test

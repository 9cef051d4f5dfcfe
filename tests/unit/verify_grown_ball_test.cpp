// How large a ball the checker sees in a grown part, where holes and thin walls are grown over.

#include "verify/locate/grown_ball.hpp"

#include <gtest/gtest.h>

#include <string>

#include "verify/read/json.hpp"

namespace lekalo::verify {
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
  return covered_ball(plate(), {below, 0, 0, 0, bore, slot, slot, slot, slot}, {just(x), just(y)}, wanted);
}

/// The ball is as large as said, but for rounding, and the checker never sees a larger one.
void expect_ball(double x, double y, double radius, double bore, double slot, double below = 0) {
  SCOPED_TRACE(testing::Message() << x << " " << y);
  EXPECT_NEAR(ball(x, y, radius, bore, slot, below), radius, 1e-10);
  EXPECT_LE(ball(x, y, radius, bore, slot, below), radius);
  EXPECT_LE(ball(x, y, radius + 1, bore, slot, below), radius + 1e-12);
  EXPECT_LE(ball(x, y, radius + 1e-6, bore, slot, below), radius + 1e-12);
}

TEST(CoveredBall, ABoreThatIsGrownOverIsMaterialAndSoIsWhatLiesBeyondTheWall) {
  expect_ball(50, 10, 21, 15, 9);
  expect_ball(50, -3, 8, 15, 0);
  expect_ball(50, 2, 13, 15, 9);
}

TEST(CoveredBall, ASlotThatIsGrownOverIsCoveredByAllItsSides) {
  expect_ball(50, 30, 17, 15, 14);
  expect_ball(60, 30, 17, 15, 14);
  expect_ball(48, 42, 5, 0, 14);
}

TEST(CoveredBall, ABoreThatIsNotGrownOverIsNone) {
  expect_ball(50, 16.5, 5.5, 5, 9);
  EXPECT_EQ(ball(50, 10, 21, 5, 0), 0);
  EXPECT_EQ(ball(50, 10, 21, 0, 0), 0);
}

TEST(CoveredBall, ARimThatIsTakenOffCountsWhereNothingGrowsOverIt) {
  expect_ball(50, 10, 21, 15, 9, -2);
  // The bore reaches to x = 14, and at x = 12 the rim of 2 mm is off.
  EXPECT_NEAR(ball(12, 8, 5, 30, 0, -2), 5, 1e-10);
  EXPECT_LE(ball(12, 8, 7, 30, 0, -2), 6);
  // It reaches into the bore and the slot, which are grown over, and touches the rim.
  expect_ball(70, 20, 18, 9, 9, -2);
}

}  // namespace
}  // namespace lekalo::verify

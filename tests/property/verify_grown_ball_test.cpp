// Balls that the checker takes to lie in a grown part, against points of them.

#include <gtest/gtest.h>

#include <cmath>

#include "lekalo/base/random.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "support/region_cases.hpp"
#include "verify/locate/grown_ball.hpp"
#include "verify/shape/shape_distance.hpp"
#include "verify/shape/shape_inside.hpp"

namespace lekalo::verify::verify_grown_ball_test {
namespace {

Shape shape_of(const std::string& text) {
  std::string complaint;
  const auto json = parse_json(text, "shape");
  EXPECT_TRUE(json.has_value());
  Shape shape = read_shape(*json, "shape", complaint);
  EXPECT_EQ(complaint, "");
  return shape;
}
Vec at(double x, double y) { return {just(x), just(y)}; }

/// How far q is from being in the grown part, and negative in it.
double missing(const Shape& part, const std::vector<double>& growth, const Vec& q) {
  double off = 1e300, rim = -1e300;
  for (std::size_t k = 0; k < part.sides.size(); ++k) {
    const double d = distance(q, part.sides[k]).low;
    if (growth[k] < 0) {
      rim = std::max(rim, -growth[k] - d);
    } else {
      off = std::min(off, d - growth[k]);
    }
  }
  return holds(part, q).value_or(true) ? std::min(off, std::max(0.0, rim)) : off;
}

double plain(const Shape& part, const std::vector<double>& growth, const Vec& c) {
  double least = 1e300;
  for (std::size_t k = 0; k < part.sides.size(); ++k)
    least = std::min(least, distance(c, part.sides[k]).low + growth[k]);
  return least;
}

TEST(GrownBall, HoldsNoPointThatIsNotInTheGrownPart) {
  const std::size_t count = cases::region_case_count(20);
  std::size_t larger = 0, full = 0, beside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const cases::RegionCase one = cases::region_case(
        cases::seed(), i, i % 2 == 0 ? cases::RegionKind::rounded : cases::RegionKind::near_net, 16);
    SCOPED_TRACE(one.name);
    const Shape part = shape_of(io::regions_json(one.part));
    Random random(cases::seed(), 300 + i);
    for (int round = 0; round < 12; ++round) {
      std::vector<double> growth;
      const std::size_t rims = random.below(3) == 0 ? 2 : 0;
      for (std::size_t k = 0; k < part.sides.size(); ++k)
        growth.push_back(k < rims ? -0.3 : (random.below(2) == 0 ? 0 : random.uniform(0, 1.5)));
      // Every third time it is grown over its holes, and beyond it.
      if (round % 3 == 2)
        for (double& by : growth) by = by > 0 ? random.uniform(1, 30) : by;
      const double around = round % 3 == 2 ? 20 : 0;
      const Vec c = at(random.uniform(part.low_x - around, part.high_x + around),
                       random.uniform(part.low_y - around, part.high_y + around));
      const auto in = holds(part, c);
      if (!in) continue;
      const double off = missing(part, growth, c), known = *in ? plain(part, growth, c) : -off;
      const double wanted = std::max(0.0, known) + random.uniform(0, 0.4) * (1 + around);
      const double radius = grown_ball(part, growth, c, wanted);
      EXPECT_LE(radius, wanted);
      EXPECT_TRUE(off <= 1e-9 || radius == -kInfinity);
      EXPECT_GE(radius, known > 1e-9 ? known - 1e-9 : -kInfinity);
      if (!(radius > 0)) continue;
      beside += *in ? 0 : 1;
      larger += radius > known + 1e-6 ? 1 : 0, full += radius >= wanted - 1e-9 ? 1 : 0;
      for (int k = 0; k < 400; ++k) {
        const double turn = 6.283185307179586 * (k + random.uniform()) / 400,
                     far = radius * (1 - 1e-9) * (k % 2 == 0 ? 1 : std::sqrt(random.uniform()));
        const Vec q = at(c.x.low + far * std::cos(turn), c.y.low + far * std::sin(turn));
        EXPECT_LE(missing(part, growth, q), 1e-9) << round << ' ' << k;
      }
    }
  }
  EXPECT_GT(larger, 0U);
  EXPECT_GT(full, 0U);
  EXPECT_GT(beside, 0U);
}

/// A square of 10 with one side grown by 1: near its ends the sides beside it are covered by that.
TEST(GrownBall, IsAsLargeAsItCanBeWhereNeighboursGrowDifferently) {
  const Shape square = shape_of(R"({"units": "mm", "outer": [
    {"line": {"from": [0, 0], "to": [10, 0]}}, {"line": {"from": [10, 0], "to": [10, 10]}},
    {"line": {"from": [10, 10], "to": [0, 10]}}, {"line": {"from": [0, 10], "to": [0, 0]}}]})");
  // From (9, 0.5) the right side is 1 away, and is covered by the lower one's growth up to y = 1.
  const std::vector<double> growth{1, 0, 0, 0};
  // Where the circle leaves the lower side's reach: in (10, 1).
  EXPECT_EQ(grown_ball(square, growth, at(9, 0.5), 1.11), 1.11);
  EXPECT_LT(grown_ball(square, growth, at(9, 0.5), 1.12), std::hypot(1.0, 0.5));
  EXPECT_LE(grown_ball(square, {1, -0.25, 0, 0}, at(9, 0.5), 1.2), std::hypot(0.75, 0.5));
  EXPECT_NEAR(grown_ball(square, {0, 0, 0, 0}, at(9, 0.5), 1.2), 0.5, 1e-12);
}

}  // namespace
}  // namespace lekalo::verify::verify_grown_ball_test

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lekalo/geom/predicates.hpp"
#include "lekalo/locate/allowance.hpp"
#include "lekalo/phi/convex.hpp"
#include "support/cases.hpp"
#include "support/ring_distance.hpp"
#include "support/stopwatch.hpp"

namespace lekalo::allowance_contour_test {
namespace {

using geom::Point;
using geom::Ring;
using locate::Placement;

const Ring kSquare{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
const Ring kSmallSquare{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
// An L: concave at (4, 4).
const Ring kL{{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<locate::AllowanceSample> allowance(const Ring& part, const Ring& blank, const Placement& at,
                                               double step) {
  auto samples = locate::contour_allowance(part, blank, at, step);
  EXPECT_TRUE(samples.has_value());
  return samples ? *samples : std::vector<locate::AllowanceSample>{};
}

double least(const std::vector<locate::AllowanceSample>& samples) {
  double value = kInfinity;
  for (const auto& s : samples) value = std::min(value, s.allowance);
  return value;
}

/// What the tree answers quickly, edge by edge.
double brute_force(Point p, const Ring& ring) {
  const double distance = cases::distance_to_boundary(p, ring);
  switch (geom::locate_point(ring, p)) {
    case geom::PointLocation::boundary:
      return 0;
    case geom::PointLocation::inside:
      return distance;
    case geom::PointLocation::outside:
      return -distance;
  }
  return 0;
}

TEST(ContourAllowance, OfASquareInASquareIsTheDistanceToTheNearestSide) {
  const auto samples = allowance(kSmallSquare, kSquare, {1, 2, 0, 0}, kInfinity);
  ASSERT_EQ(samples.size(), 4u);
  const double expected[] = {1, 2, 4, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(samples[k].allowance, expected[k]) << k;
    EXPECT_EQ(samples[k].part_edge, k);
    EXPECT_EQ(samples[k].along, 0);
    EXPECT_EQ(samples[k].at, kSmallSquare[k] + (Point{1, 2}));
  }
}

TEST(ContourAllowance, IsNegativeWhereThePartSticksOutAndZeroOnTheOutline) {
  const auto samples = allowance(kSmallSquare, kSquare, {-3, 0, 0, 0}, kInfinity);
  EXPECT_EQ(samples[0].allowance, -3);
  EXPECT_EQ(samples[1].allowance, 0);
  EXPECT_EQ(samples[2].allowance, 1);
  EXPECT_EQ(samples[3].allowance, -3);
}

TEST(ContourAllowance, BeyondACornerIsTheDistanceToTheCorner) {
  const auto samples = allowance(kSmallSquare, kSquare, {13, 14, 0, 0}, kInfinity);
  EXPECT_EQ(samples[0].allowance, -5);
}

TEST(ContourAllowance, SeesTheConcaveCornerOfTheBlankBetweenTheVertices) {
  // A square whose side faces the corner (4, 4) of the L would pass it with its vertices alone.
  const Ring bar{{0, 0}, {8, 0}, {8, 1}, {0, 1}};
  const double half_turn_quarter = std::numbers::pi * 3 / 4;
  const auto at_vertices = allowance(bar, kL, {6.5, 1.5, half_turn_quarter, 0}, kInfinity);
  const auto fine = allowance(bar, kL, {6.5, 1.5, half_turn_quarter, 0}, 0.01);
  EXPECT_LT(least(fine), least(at_vertices));
}

TEST(ContourAllowance, KeepsTheStepAndTheOrderOfThePart) {
  const double step = 0.3;
  const auto samples = allowance(kSmallSquare, kSquare, {1, 2, 0.4, 0}, step);
  EXPECT_EQ(samples.size(), 4u * 14u);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto& next = samples[(i + 1) % samples.size()];
    EXPECT_LE(geom::norm(next.at - samples[i].at), step * (1 + 1e-12));
    if (i + 1 < samples.size()) {
      EXPECT_LT(samples[i].part_edge + samples[i].along, next.part_edge + next.along);
    }
  }
}

TEST(ContourAllowance, RefusesAStepThatIsNotPositiveOrTooSmall) {
  for (const double step : {0.0, -1.0, std::nan(""), 1e-9}) {
    const auto refused = locate::contour_allowance(kSmallSquare, kSquare, {}, step);
    ASSERT_FALSE(refused.has_value()) << step;
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
    EXPECT_NE(refused.error().message.find("step"), std::string::npos);
  }
}

TEST(ContourAllowance, LeastOverTheVerticesIsThePhiFunctionOfAPartInside) {
  for (std::uint64_t index = 0; index < 200; ++index) {
    const auto c = cases::random_case(cases::seed(), index);
    const auto samples = allowance(c.part.vertices(), c.blank.vertices(), {c.x, c.y, c.theta, 0}, kInfinity);
    const auto exact = phi::clearance_enclosure(c.part, c.blank, c.x, c.y, c.theta);
    if (!(exact.low > 0)) continue;
    EXPECT_NEAR(least(samples), exact.low, 64 * std::numeric_limits<double>::epsilon() * c.largest_coordinate)
        << c.name;
  }
}

TEST(ContourAllowance, EqualsBruteForceBitForBitInsideAndOutsideAnyShape) {
  Random random(cases::seed(), 7);
  const Ring star = [] {
    Ring ring;
    for (std::size_t i = 0; i < 40; ++i) {
      const auto [sine, cosine] = geom::sincos(6.283185307179586 * static_cast<double>(i) / 40);
      ring.push_back((i % 2 == 0 ? 10.0 : 4.0) * Point{cosine, sine});
    }
    return ring;
  }();
  const Ring clockwise(star.rbegin(), star.rend());
  for (const Ring& blank : {star, clockwise, kL, kSquare}) {
    Ring points;
    for (int i = 0; i < 500; ++i) points.push_back({random.uniform(-15, 15), random.uniform(-15, 15)});
    // On vertices, at their heights, on edges: where rays and boxes meet the outline.
    for (std::size_t i = 0; i < blank.size(); ++i) {
      points.push_back(blank[i]);
      points.push_back({random.uniform(-15, 15), blank[i].y});
      points.push_back(0.5 * (blank[i] + blank[i + 1 == blank.size() ? 0 : i + 1]));
    }
    for (const auto& s : allowance(points, blank, {}, kInfinity)) {
      EXPECT_EQ(s.allowance, brute_force(s.at, blank)) << s.at.x << ' ' << s.at.y;
    }
  }
}

TEST(Deviations, ArePositiveOutsideThePartAndNegativeInside) {
  const Ring probed{{1, 2}, {2, 4}, {5.5, 4}, {0, 2}, {3, 10}, {9, 10}};
  const std::vector<double> d = locate::deviations(probed, kSmallSquare, {1, 2, 0, 0});
  const std::vector<double> expected{0, -1, 0.5, 1, 4, std::sqrt(32.0)};
  ASSERT_EQ(d.size(), expected.size());
  for (std::size_t i = 0; i < d.size(); ++i) EXPECT_DOUBLE_EQ(d[i], expected[i]) << i;
  EXPECT_FALSE(std::signbit(d[0]));
}

TEST(Deviations, EqualBruteForceBitForBit) {
  for (std::uint64_t index = 0; index < 100; ++index) {
    const auto c = cases::random_case(cases::seed(), index);
    const auto d = locate::deviations(c.blank.vertices(), c.part.vertices(), {c.x, c.y, c.theta, 0});
    const auto pose = geom::BlankFromPart::from_angle(c.theta, {c.x, c.y});
    Ring placed;
    for (const Point p : c.part.vertices()) placed.push_back(pose(p));
    for (std::size_t i = 0; i < d.size(); ++i) {
      EXPECT_EQ(d[i], -brute_force(c.blank[i], placed)) << c.name;
    }
  }
}

TEST(Deviations, OfAMillionPointsTakeLittleTime) {
  const auto part = cases::superellipse(60, 50, 30);
  const Ring probed = cases::with_points_on_edges(cases::superellipse(100, 52, 32), 1'000'000);
  const cases::Stopwatch watch;
  const auto d = locate::deviations(probed, part.vertices(), {0.1, 0.1, 0.001, 0});
  const double seconds = watch.seconds();
  RecordProperty("seconds", std::to_string(seconds));
  ASSERT_EQ(d.size(), probed.size());
  EXPECT_GT(*std::min_element(d.begin(), d.end()), 1.0);
  EXPECT_LT(*std::max_element(d.begin(), d.end()), 4.0);
  // Half a second on a desktop; the limit only catches a cost that grows with points times edges.
  EXPECT_LT(seconds, 20 * cases::kSlowdown);
}

TEST(PlacementShift, OfAPureMoveIsTheMove) {
  const auto s = locate::placement_shift(kSquare, {1, 2, 0.5, 0}, {4, 6, 0.5, 0});
  EXPECT_EQ(s.dx, 3);
  EXPECT_EQ(s.dy, 4);
  EXPECT_EQ(s.dtheta, 0);
  EXPECT_DOUBLE_EQ(s.largest, 5);
}

TEST(PlacementShift, OfATurnIsLargestAtTheFarthestVertex) {
  const auto s = locate::placement_shift(kSquare, {0, 0, 0, 0}, {0, 0, std::numbers::pi / 2, 0});
  EXPECT_EQ(s.vertex, 2u);
  EXPECT_NEAR(s.largest, 20, 1e-12);
  EXPECT_DOUBLE_EQ(s.dtheta, std::numbers::pi / 2);
}

TEST(PlacementShift, TakesTheShorterWayRound) {
  const double turn = 2 * std::numbers::pi;
  EXPECT_NEAR(locate::placement_shift(kSquare, {0, 0, 0.1, 0}, {0, 0, turn - 0.1, 0}).dtheta, -0.2, 1e-14);
  EXPECT_NEAR(locate::placement_shift(kSquare, {0, 0, -3.1, 0}, {0, 0, 3.1, 0}).dtheta, 6.2 - turn, 1e-14);
  EXPECT_EQ(locate::placement_shift(kSquare, {0, 0, std::numbers::pi, 0}, {}).dtheta, std::numbers::pi);
}

}  // namespace
}  // namespace lekalo::allowance_contour_test

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "lekalo/geom/region_index.hpp"
#include "lekalo/locate/edge_allowance.hpp"
#include "support/region_cases.hpp"

namespace lekalo::test::edge_allowance_test {
namespace {

using cases::region_detail::circle;
using cases::region_detail::polygon;
using cases::region_detail::region;
using geom::Point;
using geom::Region;
using locate::EdgeAllowance;

constexpr double kTolerance = 1e-4, kInfinity = std::numeric_limits<double>::infinity();

std::vector<EdgeAllowance> allowances(const std::vector<Region>& part, const std::vector<Region>& blank,
                                      const geom::BlankFromPart& pose = {}, double step = 1) {
  auto found = locate::edge_allowances(part, blank, pose, step, kTolerance);
  EXPECT_TRUE(found.has_value());
  return found ? *found : std::vector<EdgeAllowance>{};
}

std::vector<Region> square(double low, double high) {
  return {region(polygon({{low, low}, {high, low}, {high, high}, {low, high}}))};
}

TEST(EdgeAllowances, OfASquareInASquareAreTheDistancesToTheNearestSide) {
  const auto edges = allowances(square(0, 4), square(0, 10), geom::BlankFromPart::from_angle(0, {1, 2}));
  ASSERT_EQ(edges.size(), 4U);
  // The lower edge from (1, 2) to (5, 2), the right one from (5, 2) to (5, 6).
  EXPECT_EQ(edges[0].least.allowance, 1);
  EXPECT_EQ(edges[0].most.allowance, 2);
  EXPECT_EQ(edges[1].least.allowance, 2);
  EXPECT_NEAR(edges[1].most.allowance, 5, kTolerance);
  for (const EdgeAllowance& edge : edges) {
    EXPECT_EQ(edge.length, 4);
    EXPECT_EQ(edge.samples.front().along, 0);
    EXPECT_EQ(edge.samples.back().along, 4);
    EXPECT_LE(edge.least_low, edge.least.allowance);
    EXPECT_GE(edge.most_high, edge.most.allowance);
    EXPECT_LE(edge.most_high - edge.most.allowance, kTolerance + 1e-12);
  }
  EXPECT_EQ(edges[3].least.blank_edge, 3U);
}

TEST(EdgeAllowances, OfAnEvenGapBetweenArcsAreEvenAndNeedNoLongSearch) {
  const std::vector<Region> part{region(circle({0, 0}, 30), {circle({0, 0}, 10)})};
  const std::vector<Region> blank{region(circle({5, 7}, 32), {circle({5, 7}, 9)})};
  const auto edges = allowances(part, blank, geom::BlankFromPart::from_angle(1, {5, 7}));
  ASSERT_EQ(edges.size(), 2U);
  const double expected[] = {2, 1};
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(edges[k].least.allowance, expected[k], 1e-12);
    EXPECT_NEAR(edges[k].most.allowance, expected[k], 1e-12);
    EXPECT_LE(edges[k].most_high, expected[k] + kTolerance + 1e-12);
    EXPECT_GE(edges[k].most_high, expected[k]);
    EXPECT_EQ(edges[k].least.blank_edge, k);
  }
  EXPECT_NEAR(edges[0].length, 60 * std::numbers::pi, 1e-12);
}

TEST(EdgeAllowances, AreNegativeWhereTheEdgeSticksOut) {
  // The bar reaches 3 mm out of the blank at one end and lies 1 mm inside along its sides.
  const std::vector<Region> bar{region(polygon({{1, 4}, {13, 4}, {13, 6}, {1, 6}}))};
  const auto edges = allowances(bar, square(0, 10));
  EXPECT_EQ(edges[1].least.allowance, -3);
  EXPECT_EQ(edges[1].most.allowance, -3);
  EXPECT_GE(edges[1].least_low, -3 - kTolerance - 1e-12);
  EXPECT_NEAR(edges[0].least.allowance, -3, kTolerance);
  EXPECT_NEAR(edges[0].most.allowance, 4, kTolerance);  // (6, 4): 4 mm from the right side and the lower one
  EXPECT_LE(edges[0].least_low, -3);
  EXPECT_GE(edges[0].most_high, 4);
  const auto beyond = allowances(square(20, 22), square(0, 10));
  EXPECT_NEAR(beyond[0].least.allowance, -std::hypot(10, 12), kTolerance);
  EXPECT_NEAR(beyond[0].most.allowance, -std::hypot(10, 10), 1e-12);
}

TEST(EdgeAllowances, AlongTheBoundaryItselfAreNothing) {
  for (const EdgeAllowance& edge : allowances(square(0, 10), square(0, 10))) {
    EXPECT_EQ(edge.least.allowance, 0);
    EXPECT_NEAR(edge.most.allowance, 0, 1e-9);
  }
}

/// The proved extremes against dense samples, and the samples against the definition.
TEST(EdgeAllowances, HoldForDenseSamplesOfRandomShapesInAndOutOfTheirBlanks) {
  for (std::uint64_t index = 0; index < 2; ++index) {
    for (const cases::RegionKind kind : cases::kRegionKinds) {
      const auto c = cases::region_case(cases::seed(), index, kind, 24);
      for (const double off : {0.0, 3.0}) {
        auto pose = c.pose();
        pose.translation.x += off;
        const geom::RegionIndex blank(c.blank);
        const auto edges = allowances(c.part, c.blank, pose, 5);
        const auto dense = allowances(c.part, c.blank, pose, 0.02);
        ASSERT_EQ(edges.size(), dense.size());
        for (std::size_t k = 0; k < edges.size(); ++k) {
          const EdgeAllowance& edge = edges[k];
          EXPECT_LE(edge.least_low, edge.least.allowance) << c.name << " edge " << k;
          EXPECT_GE(edge.most_high, edge.most.allowance) << c.name << " edge " << k;
          EXPECT_LE(edge.least.allowance - edge.least_low, kTolerance + 1e-9) << c.name << " edge " << k;
          EXPECT_LE(edge.most_high - edge.most.allowance, kTolerance + 1e-9) << c.name << " edge " << k;
          double least = kInfinity, most = -kInfinity;
          for (const locate::OutlinePoint& p : dense[k].samples) {
            least = std::min(least, p.allowance), most = std::max(most, p.allowance);
          }
          EXPECT_GE(least, edge.least_low) << c.name << " edge " << k;
          EXPECT_LE(most, edge.most_high) << c.name << " edge " << k;
          for (const locate::OutlinePoint& p : edge.samples) {
            const auto nearest = blank.nearest(p.in_blank);
            EXPECT_NEAR(std::abs(p.allowance), nearest.distance, 1e-9);
            if (std::abs(p.allowance) > 1e-9) {
              EXPECT_EQ(p.allowance > 0, blank.contains(p.in_blank));
            }
            EXPECT_LE(geom::norm(pose(p.in_part) - p.in_blank), 1e-12);
          }
        }
      }
    }
  }
}

TEST(EdgeAllowances, OfAMirroredPartAreThoseOfTheMirroredShape) {
  const auto c = cases::region_case(cases::seed(), 3, cases::RegionKind::rounded);
  const auto mirror = geom::BlankFromPart::from_angle(0, {}, true);
  geom::Contour outer = cases::region_detail::moved(c.part[0].outer, mirror);
  std::vector<geom::Contour> holes;
  for (const auto& hole : c.part[0].holes) holes.push_back(cases::region_detail::moved(hole, mirror));
  for (geom::Contour* contour : {&outer, &holes[0], &holes[1]})
    for (geom::Edge& e : *contour)
      if (e.kind != geom::EdgeKind::line)
        e.kind = e.kind == geom::EdgeKind::arc_ccw ? geom::EdgeKind::arc_cw : geom::EdgeKind::arc_ccw;
  const std::vector<Region> mirrored{region(outer, holes)};
  auto pose = c.pose();
  const auto plain = allowances(c.part, c.blank, pose);
  pose.mirrored = true;  // undoes the mirror of the shape
  const auto twice = allowances(mirrored, c.blank, pose);
  ASSERT_EQ(plain.size(), twice.size());
  double least = kInfinity, same = kInfinity, most = -kInfinity, same_most = -kInfinity;
  for (std::size_t k = 0; k < plain.size(); ++k) {
    least = std::min(least, plain[k].least.allowance), same = std::min(same, twice[k].least.allowance);
    most = std::max(most, plain[k].most.allowance), same_most = std::max(same_most, twice[k].most.allowance);
  }
  EXPECT_NEAR(least, same, 1e-9);
  EXPECT_NEAR(most, same_most, 2 * kTolerance);
}

TEST(EdgeAllowances, RefuseAStepThatIsNoneOrTooSmall) {
  for (const double step : {0.0, -1.0, std::nan(""), 1e-9}) {
    const auto refused = locate::edge_allowances(square(0, 4), square(0, 10), {}, step, kTolerance);
    ASSERT_FALSE(refused.has_value()) << step;
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
  }
  EXPECT_TRUE(locate::edge_allowances(square(0, 4), square(0, 10), {}, kInfinity, kTolerance).has_value());
  EXPECT_FALSE(locate::edge_allowances(square(0, 4), square(0, 10), {}, 1, 0).has_value());
}

TEST(MissingMaterial, IsFoundInsideThePartOverAHoleOfTheBlank) {
  const std::vector<Region> blank{
      region(polygon({{0, 0}, {40, 0}, {40, 20}, {0, 20}}), {circle({10, 10}, 3)})};
  const std::vector<Region> part{region(polygon({{1, 1}, {42, 1}, {42, 19}, {1, 19}}))};
  const auto places = locate::missing_material(part, blank, {}, 5, 4, 1e-3);
  ASSERT_GE(places.size(), 2U);
  EXPECT_NEAR(places[0].depth, 3, 3.0 / 32);
  EXPECT_LE(places[0].depth, 3 + 1e-9);
  EXPECT_NEAR(places[0].in_blank.x, 10, 0.3);
  EXPECT_NEAR(places[1].depth, 2, 2.0 / 32);
  EXPECT_NEAR(places[1].in_blank.x, 42, 0.1);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT(geom::norm(places[i].in_part - places[j].in_part), 4);
}

TEST(MissingMaterial, IsNothingWhereThePartLiesInTheBlank) {
  EXPECT_TRUE(locate::missing_material(square(1, 9), square(0, 10), {}, 5, 1, 1e-3).empty());
}

}  // namespace
}  // namespace lekalo::test::edge_allowance_test

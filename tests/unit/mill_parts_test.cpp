#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lekalo/geom/region_index.hpp"
#include "lekalo/geom/trig.hpp"
#include "mill/front/arrival.hpp"
#include "mill/front/load.hpp"
#include "mill/front/step_law.hpp"
#include "mill/path/arc_through.hpp"
#include "mill/path/edge_path.hpp"

namespace lekalo::mill::mill_parts_test {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;

Edge line(Point a, Point b) { return {EdgeKind::line, a, b, {}}; }

Region square(double half) {
  return *geom::make_region({line({-half, -half}, {half, -half}), line({half, -half}, {half, half}),
                             line({half, half}, {-half, half}), line({-half, half}, {-half, -half})});
}

Region disc(double r) { return *geom::make_region({{EdgeKind::arc_ccw, {r, 0}, {r, 0}, {0, 0}}}); }

TEST(MillParts, AStraightPassMeetsTheAngleOfItsStep) {
  // Cut: x <= 50. A pass along x = 50 + 2.4 going up has the material on its right.
  const geom::RegionIndex before({square(50)});
  const double angle = geom::direction_angle(0.2, std::sqrt(1 - 0.04)) * 180 / 3.141592653589793;  // 78.46
  for (const bool back : {false, true}) {
    const Point a{52.4, back ? 20.0 : -20.0}, b{52.4, back ? -20.0 : 20.0};
    const Load load = load_of({line(a, b)}, back, before, 3, 80, 0.5);
    EXPECT_NEAR(load.largest, angle, 1);
    EXPECT_NEAR(load.length, 40, 1e-9);
    EXPECT_EQ(load.beyond, 0);
  }
}

TEST(MillParts, AStraightPassMeetsTheArcOfItsStepOver) {
  EXPECT_NEAR(straight_pass_angle(0.5), 1.5707963267948966, 1e-15);
  EXPECT_NEAR(straight_pass_angle(0.25), 1.0471975511965976, 1e-15);
  EXPECT_NEAR(straight_pass_angle(0.4), std::acos(0.2), 1e-15);
}

TEST(MillParts, ARoundPassHoldsTheAngleOfTheStepLaw) {
  for (const double r0 : {3.0, 6.0, 20.0}) {
    const double r1 = r0 + step_for(r0, 3, 0.2);
    EXPECT_NEAR((r0 + 3) * (r0 + 3), r1 * r1 + 9 + 2 * r1 * 3 * 0.2, 1e-9);
    const Edge quarter{EdgeKind::arc_ccw, {r1, 0}, {0, r1}, {0, 0}};
    const Load load = load_of({quarter}, false, geom::RegionIndex({disc(r0)}), 3, 80, 0.3);
    EXPECT_NEAR(load.largest, 78.46, 1);
  }
}

TEST(MillParts, ArcsGoThroughPlacesOfACircle) {
  std::vector<Point> places;
  for (int i = 0; i <= 40; ++i) {
    const auto [sine, cosine] = geom::sincos(0.05 * i);
    places.push_back({10 * cosine, 10 * sine});
  }
  std::vector<Edge> edges;
  fit_arcs(places, 1e-3, edges);
  EXPECT_LE(edges.size(), 3U);
  EXPECT_NEAR(length_of(edges), 20, 0.01);
  for (const Edge& edge : edges) {
    EXPECT_EQ(edge.kind, EdgeKind::arc_ccw);
    EXPECT_NEAR(norm(edge.centre), 0, 1e-6);
  }
  EXPECT_EQ(edges.front().from, places.front());
  EXPECT_EQ(edges.back().to, places.back());
}

TEST(MillParts, FarFromWallsLevelLinesAreAStepApart) {
  const geom::RegionIndex allowed({square(100)});
  const std::vector<Region> start{disc(10)};
  const ArrivalField field(allowed, start, 0.5, {.tool_radius = 3, .step = 1.2, .cosine = 0.182});
  EXPECT_EQ(field.speed(90), 1.2);  // the law would allow more
  EXPECT_LT(field.speed(0.5), field.speed(3));
  for (const double time : {5.0, 20.0}) {
    const auto early = field.before(time);
    ASSERT_TRUE(early);
    ASSERT_EQ(early->size(), 1U);
    for (const Point p : places_on((*early)[0].outer, 0.5)) EXPECT_NEAR(norm(p), 10 + 1.2 * time, 0.05);
  }
  EXPECT_TRUE(field.reaches_all());
}

TEST(MillParts, NothingArrivesBehindAWall) {
  const Region left = *geom::make_region(
      {line({0, 0}, {10, 0}), line({10, 0}, {10, 10}), line({10, 10}, {0, 10}), line({0, 10}, {0, 0})});
  const Region right = *geom::make_region(
      {line({12, 0}, {22, 0}), line({22, 0}, {22, 10}), line({22, 10}, {12, 10}), line({12, 10}, {12, 0})});
  const Region start = *geom::make_region({{EdgeKind::arc_ccw, {7, 5}, {7, 5}, {5, 5}}});
  const ArrivalField field(geom::RegionIndex({left, right}), {start}, 0.25,
                           {.tool_radius = 3, .step = 2.4, .cosine = 0.182});
  EXPECT_FALSE(field.reaches_all());
  const auto early = field.before(field.last() + 1);
  ASSERT_TRUE(early);
  for (const Region& region : *early)
    for (const Point p : places_on(region.outer, 0.5)) EXPECT_LT(p.x, 11.5);
}

}  // namespace
}  // namespace lekalo::mill::mill_parts_test

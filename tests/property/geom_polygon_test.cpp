// The laws of lekalo/geom/polygon.hpp.

#include "lekalo/geom/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/cases.hpp"
#include "support/near_degenerate.hpp"

namespace lekalo::geom_polygon_test {
namespace {

using geom::Point;
using geom::Ring;

constexpr std::size_t kCount = 5000;

double eighths(Random& random) { return static_cast<double>(random.below(64000)) / 8 - 4000; }

Ring grid_ring(Random& random) {
  Ring ring(3 + random.below(30));
  for (Point& p : ring) p = {eighths(random), eighths(random)};
  return ring;
}

TEST(RingLaws, AreaOnAGridKnowsDirectionButNoStartAndNoPlace) {
  Random random(cases::seed(), 1);
  for (std::size_t i = 0; i < kCount; ++i) {
    const Ring ring = grid_ring(random);
    const double area = geom::signed_area(ring);
    ASSERT_EQ(geom::signed_area(Ring(ring.rbegin(), ring.rend())), -area);
    Ring turned = ring;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(random.below(ring.size())),
                turned.end());
    ASSERT_EQ(geom::signed_area(turned), area);
    Ring moved = ring;
    const Point by{eighths(random), eighths(random)};
    for (Point& p : moved) p = p + by;
    ASSERT_EQ(geom::signed_area(moved), area);
  }
}

TEST(RingLaws, BoundsHoldEveryPointAndTouchOneOnEverySide) {
  Random random(cases::seed(), 2);
  for (std::size_t i = 0; i < kCount; ++i) {
    const Ring ring = grid_ring(random);
    const geom::Box box = geom::bounds(ring);
    bool left = false, right = false, low = false, high = false;
    double largest = 0;
    for (const Point p : ring) {
      ASSERT_TRUE(box.low.x <= p.x && p.x <= box.high.x && box.low.y <= p.y && p.y <= box.high.y);
      left |= p.x == box.low.x, right |= p.x == box.high.x, low |= p.y == box.low.y,
          high |= p.y == box.high.y;
      largest = std::max({largest, p.x, -p.x, p.y, -p.y});
    }
    ASSERT_TRUE(left && right && low && high);
    ASSERT_EQ(geom::largest_coordinate(ring), largest);
  }
}

Ring at(const Ring& points, const std::vector<std::size_t>& indices) {
  Ring ring;
  for (const std::size_t i : indices) ring.push_back(points[i]);
  return ring;
}

/// Points of every hard kind, with duplicates.
Ring hard_cloud(Random& random) {
  const auto kind = cases::kPointKinds[random.below(cases::kPointKinds.size())];
  Ring points;
  while (points.size() < 1 + random.below(60)) {
    for (const Point p : cases::hard_points(random, kind)) points.push_back(p);
    if (random.below(3) == 0) points.push_back(points[random.below(points.size())]);
  }
  return points;
}

TEST(HullLaws, NoPointIsOutsideAndTheHullOfTheHullIsItself) {
  Random random(cases::seed(), 3);
  std::size_t polygons = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const Ring points = hard_cloud(random);
    const Ring hull = at(points, geom::convex_hull(points));
    ASSERT_EQ(at(hull, geom::convex_hull(hull)), hull);
    if (hull.size() < 3) continue;
    ++polygons;
    ASSERT_TRUE(geom::ConvexPolygon::make(hull)) << geom::ConvexPolygon::make(hull).error().message;
    for (std::size_t k = 0; k < hull.size(); ++k) {
      for (const Point p : points) {
        ASSERT_GE(geom::orientation(hull[k], hull[k + 1 == hull.size() ? 0 : k + 1], p), 0);
      }
    }
  }
  EXPECT_GT(polygons, kCount / 2);
}

TEST(HullLaws, StartsLeftmostThenLowestAndDoesNotDependOnTheOrderOfThePoints) {
  Random random(cases::seed(), 4);
  for (std::size_t i = 0; i < kCount; ++i) {
    Ring points = hard_cloud(random);
    const auto indices = geom::convex_hull(points);
    for (const std::size_t k : indices) {
      // Of equal points the first.
      const auto first = std::find(points.begin(), points.end(), points[k]);
      ASSERT_EQ(static_cast<std::size_t>(first - points.begin()), k);
    }
    const Ring hull = at(points, indices);
    for (const Point p : points) {
      ASSERT_TRUE(hull[0].x < p.x || (hull[0].x == p.x && hull[0].y <= p.y));
    }
    for (std::size_t k = points.size(); k > 1; --k) std::swap(points[k - 1], points[random.below(k)]);
    ASSERT_EQ(at(points, geom::convex_hull(points)), hull);
  }
}

TEST(HullLaws, PointsOnOneLineGiveItsTwoEnds) {
  Random random(cases::seed(), 5);
  for (std::size_t i = 0; i < kCount; ++i) {
    const Point a{eighths(random), eighths(random)}, step{eighths(random) / 100, eighths(random) / 100};
    // Few bits, so that multiples are exact.
    const Point along{std::nearbyint(step.x), std::nearbyint(step.y)};
    Ring points;
    for (std::size_t k = 0; k < 2 + random.below(10); ++k) {
      points.push_back(a + static_cast<double>(random.below(20)) * along);
    }
    const std::set<std::pair<double, double>> distinct = [&] {
      std::set<std::pair<double, double>> all;
      for (const Point p : points) all.emplace(p.x, p.y);
      return all;
    }();
    const Ring hull = at(points, geom::convex_hull(points));
    ASSERT_EQ(hull.size(), std::min<std::size_t>(2, distinct.size()));
    ASSERT_EQ(hull.front(), (Point{distinct.begin()->first, distinct.begin()->second}));
    ASSERT_EQ(hull.back(), (Point{distinct.rbegin()->first, distinct.rbegin()->second}));
  }
}

TEST(ConvexPolygonLaws, EveryFirstVertexIsAcceptedAndTheOtherDirectionIsNot) {
  Random random(cases::seed(), 6);
  for (std::size_t i = 0; i < kCount / 10; ++i) {
    Ring ring(3 + random.below(20));
    for (Point& p : ring) p = {eighths(random), eighths(random)};
    Ring hull = at(ring, geom::convex_hull(ring));
    if (hull.size() < 3) continue;
    for (std::size_t k = 0; k < hull.size(); ++k) {
      std::rotate(hull.begin(), hull.begin() + 1, hull.end());
      ASSERT_TRUE(geom::ConvexPolygon::make(hull));
      ASSERT_FALSE(geom::ConvexPolygon::make(Ring(hull.rbegin(), hull.rend())));
    }
  }
}

TEST(ConvexPolygonLaws, StarsThatTurnLeftMoreThanOnceAroundAreRefusedFromEveryStart) {
  for (std::size_t n = 5; n < 40; ++n) {
    const Ring corners = cases::regular_ngon(n, 100, {3, 7}, 0.1).vertices();
    for (std::size_t step = 2; 2 * step < n; ++step) {
      Ring star;
      std::set<std::size_t> used;
      for (std::size_t k = 0; used.insert(k).second; k = (k + step) % n) star.push_back(corners[k]);
      if (star.size() < n) continue;  // several polygons, not one star
      for (std::size_t start = 0; start < n; ++start) {
        std::rotate(star.begin(), star.begin() + 1, star.end());
        const auto made = geom::ConvexPolygon::make(star);
        ASSERT_FALSE(made);
        ASSERT_NE(made.error().message.find("second turn"), std::string::npos) << made.error().message;
      }
    }
  }
}

TEST(ConvexPolygonLaws, RefusesWhatIsNotStrictlyConvexOnceAround) {
  const auto refused = [](Ring ring) { return !geom::ConvexPolygon::make(std::move(ring)).has_value(); };
  EXPECT_TRUE(refused({}));
  EXPECT_TRUE(refused({{0, 0}, {1, 0}}));
  EXPECT_TRUE(refused({{0, 0}, {1, 0}, {2, 0}}));
  EXPECT_TRUE(refused({{0, 0}, {0, 1}, {1, 0}}));          // clockwise
  EXPECT_TRUE(refused({{0, 0}, {1, 0}, {2, 0}, {1, 2}}));  // collinear
  EXPECT_TRUE(refused({{0, 0}, {4, 0}, {1, 1}, {0, 4}}));  // reflex
  EXPECT_TRUE(refused({{0, 0}, {1, 0}, {1, 0}, {0, 1}}));  // a point twice
  EXPECT_TRUE(
      refused({{0, 3}, {-2, -3}, {3, 1}, {-3, 1}, {2, -3}}));  // a star: left turns only, twice around
  EXPECT_FALSE(refused({{0, 0}, {1, 0}, {0, 1}}));
}

}  // namespace
}  // namespace lekalo::geom_polygon_test

// The laws of geom/predicates.hpp and of the convex hull, on points that are often collinear or equal.

#include "lekalo/geom/predicates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/polygon.hpp"

namespace lekalo::geom {
namespace {

/// A grid so small that every coincidence happens, moved to where doubles are coarse.
Point grid_point(Random& random) {
  const auto coordinate = [&] { return static_cast<double>(random.below(5)) * 0x1p-20 + 1e6; };
  const double x = coordinate();
  return {x, coordinate()};
}

TEST(PredicateLaws, TurningThePointsKeepsOrTurnsTheSign) {
  Random random(1);
  for (int i = 0; i < 200000; ++i) {
    const Point a = grid_point(random), b = grid_point(random), c = grid_point(random),
                d = grid_point(random);
    EXPECT_EQ(orientation(a, b, c), orientation(b, c, a));
    EXPECT_EQ(orientation(a, b, c), -orientation(b, a, c));
    EXPECT_EQ(turn(a, b, c, d), -turn(c, d, a, b));
    EXPECT_EQ(turn(a, b, c, d), -turn(b, a, c, d));
    EXPECT_EQ(turn(a, b, a, c), orientation(a, b, c));
  }
}

TEST(PredicateLaws, SegmentsRelateTheSameInEveryOrder) {
  Random random(2);
  int seen[4] = {};
  for (int i = 0; i < 100000; ++i) {
    const Point a = grid_point(random), b = grid_point(random), c = grid_point(random),
                d = grid_point(random);
    const SegmentRelation relation = segment_relation(a, b, c, d);
    ++seen[static_cast<int>(relation)];
    EXPECT_EQ(relation, segment_relation(b, a, c, d));
    EXPECT_EQ(relation, segment_relation(a, b, d, c));
    EXPECT_EQ(relation, segment_relation(c, d, a, b));
  }
  for (const int count : seen) EXPECT_GT(count, 1000);
}

TEST(PredicateLaws, APointIsWhereTheGridSaysItIs) {
  // An L of unit squares: inside, boundary and outside can be read off the grid.
  const std::vector<Point> ring{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};
  for (std::size_t first = 0; first < ring.size(); ++first) {
    for (const bool reversed : {false, true}) {
      std::vector<Point> turned(ring);
      std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first), turned.end());
      if (reversed) std::reverse(turned.begin(), turned.end());
      std::vector<double> xy;
      for (const Point& p : turned) xy.push_back(p.x), xy.push_back(p.y);
      for (double x = -1; x <= 5; x += 0.5) {
        for (double y = -1; y <= 5; y += 0.5) {
          const bool closed = x >= 0 && y >= 0 && ((x <= 4 && y <= 2) || (x <= 2 && y <= 4));
          const bool open = x > 0 && y > 0 && ((x < 4 && y < 2) || (x < 2 && y < 4));
          const PointLocation expected = open     ? PointLocation::inside
                                         : closed ? PointLocation::boundary
                                                  : PointLocation::outside;
          EXPECT_EQ(locate_point(xy.data(), turned.size(), {x, y}), expected) << x << ' ' << y;
        }
      }
    }
  }
}

TEST(HullLaws, TheHullHoldsEveryPointAndIsItsOwnHull) {
  Random random(3);
  for (int i = 0; i < 5000; ++i) {
    Ring points;
    for (std::uint64_t n = random.below(12); n-- > 0;) points.push_back(grid_point(random));
    const std::vector<std::size_t> hull = convex_hull(points);
    if (hull.size() < 3) continue;
    Ring ring;
    for (const std::size_t k : hull) ring.push_back(points[k]);
    ASSERT_TRUE(ConvexPolygon::make(ring).has_value());
    for (std::size_t k = 0; k < ring.size(); ++k)
      for (const Point& p : points) EXPECT_GE(orientation(ring[k], ring[(k + 1) % ring.size()], p), 0);
    const std::vector<std::size_t> again = convex_hull(ring);
    ASSERT_EQ(again.size(), ring.size());
    for (std::size_t k = 0; k < again.size(); ++k) EXPECT_EQ(ring[again[k]], ring[k]);
  }
}

TEST(ConvexPolygonLaws, RefusesWhatIsNotStrictlyConvexOnceAround) {
  const auto refused = [](Ring ring) { return !ConvexPolygon::make(std::move(ring)).has_value(); };
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
}  // namespace lekalo::geom

// The laws of lekalo/geom/predicates.hpp, on points chosen to be hard.

#include "lekalo/geom/predicates.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "lekalo/geom/polygon.hpp"
#include "support/cases.hpp"
#include "support/near_degenerate.hpp"

namespace lekalo::geom_predicates_test {
namespace {

using geom::orientation;
using geom::Point;
using geom::segment_relation;
using geom::turn;

constexpr std::size_t kCount = 20000;

template <class Check>
void for_hard_points(const Check& check) {
  for (const cases::PointKind kind : cases::kPointKinds) {
    Random random(cases::seed(), 1 + static_cast<std::uint64_t>(kind));
    for (std::size_t i = 0; i < kCount && !testing::Test::HasFatalFailure(); ++i) {
      SCOPED_TRACE(testing::Message() << "kind " << static_cast<int>(kind) << " case " << i);
      const auto [a, b, c, d] = cases::hard_points(random, kind);
      check(a, b, c, d);
    }
  }
}

TEST(PredicateLaws, OrientationFollowsTheOrderOfItsPoints) {
  for_hard_points([](Point a, Point b, Point c, Point) {
    const int sign = orientation(a, b, c);
    ASSERT_EQ(sign, orientation(b, c, a));
    ASSERT_EQ(sign, orientation(c, a, b));
    ASSERT_EQ(sign, -orientation(b, a, c));
    ASSERT_EQ(sign, -orientation(c, b, a));
    ASSERT_EQ(0, orientation(a, a, b));
  });
}

TEST(PredicateLaws, TurnIsAntisymmetric) {
  for_hard_points([](Point a, Point b, Point c, Point d) {
    const int sign = turn(a, b, c, d);
    ASSERT_EQ(sign, -turn(c, d, a, b));
    ASSERT_EQ(sign, -turn(b, a, c, d));
    ASSERT_EQ(sign, -turn(a, b, d, c));
    ASSERT_EQ(turn(a, b, a, c), orientation(a, b, c));
    ASSERT_EQ(turn(a, b, a, b), 0);
  });
}

TEST(PredicateLaws, MirroringTurnsTheSign) {
  for_hard_points([](Point a, Point b, Point c, Point) {
    const auto mirror = [](Point p) { return Point{-p.x, p.y}; };
    const auto swap = [](Point p) { return Point{p.y, p.x}; };
    ASSERT_EQ(orientation(a, b, c), -orientation(mirror(a), mirror(b), mirror(c)));
    ASSERT_EQ(orientation(a, b, c), -orientation(swap(a), swap(b), swap(c)));
    ASSERT_EQ(orientation(a, b, c), orientation(-a, -b, -c));
  });
}

TEST(PredicateLaws, SegmentRelationKnowsNoOrderOrDirection) {
  for_hard_points([](Point a, Point b, Point c, Point d) {
    const auto relation = segment_relation(a, b, c, d);
    ASSERT_EQ(relation, segment_relation(c, d, a, b));
    ASSERT_EQ(relation, segment_relation(b, a, c, d));
    ASSERT_EQ(relation, segment_relation(a, b, d, c));
    ASSERT_EQ(relation, segment_relation(d, c, b, a));
    const auto itself = a == b ? geom::SegmentRelation::touch : geom::SegmentRelation::overlap;
    ASSERT_EQ(segment_relation(a, b, b, a), itself);
  });
}

TEST(PredicateLaws, LocatePointKnowsNoFirstVertexOrDirection) {
  Random random(cases::seed(), 50);
  for (std::size_t i = 0; i < kCount; ++i) {
    geom::Ring ring(1 + random.below(10));
    for (Point& p : ring) p = {static_cast<double>(random.below(5)), static_cast<double>(random.below(5))};
    const Point p{static_cast<double>(random.below(9)) / 2, static_cast<double>(random.below(9)) / 2};
    const auto location = geom::locate_point(ring, p);
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(random.below(ring.size())),
                ring.end());
    ASSERT_EQ(location, geom::locate_point(ring, p));
    std::reverse(ring.begin(), ring.end());
    ASSERT_EQ(location, geom::locate_point(ring, p));
    for (const Point vertex : ring)
      ASSERT_EQ(geom::locate_point(ring, vertex), geom::PointLocation::boundary);
  }
}

TEST(PredicateLaws, APointIsWhereTheGridSaysItIs) {
  // An L of unit squares: inside, boundary and outside can be read off the grid.
  const geom::Ring ring{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};
  for (std::size_t first = 0; first < ring.size(); ++first) {
    for (const bool reversed : {false, true}) {
      geom::Ring turned(ring);
      std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first), turned.end());
      if (reversed) std::reverse(turned.begin(), turned.end());
      for (double x = -1; x <= 5; x += 0.5) {
        for (double y = -1; y <= 5; y += 0.5) {
          const bool closed = x >= 0 && y >= 0 && ((x <= 4 && y <= 2) || (x <= 2 && y <= 4));
          const bool open = x > 0 && y > 0 && ((x < 4 && y < 2) || (x < 2 && y < 4));
          const geom::PointLocation expected = open     ? geom::PointLocation::inside
                                               : closed ? geom::PointLocation::boundary
                                                        : geom::PointLocation::outside;
          EXPECT_EQ(geom::locate_point(turned, {x, y}), expected) << x << ' ' << y;
        }
      }
    }
  }
}

TEST(PredicateLaws, ConvexPolygonsAreLocatedAsTheirSidesSay) {
  Random random(cases::seed(), 51);
  for (std::size_t i = 0; i < 300; ++i) {
    geom::Ring points(40);
    for (Point& p : points)
      p = {static_cast<double>(random.below(30)), static_cast<double>(random.below(30))};
    const geom::ConvexPolygon polygon = cases::hull(points);
    for (const Point p : points) {
      int least = 1;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        least = std::min(least, orientation(polygon[k], polygon[polygon.next(k)], p));
      }
      const auto expected = least < 0    ? geom::PointLocation::outside
                            : least == 0 ? geom::PointLocation::boundary
                                         : geom::PointLocation::inside;
      ASSERT_EQ(geom::locate_point(polygon.vertices(), p), expected);
    }
  }
}

}  // namespace
}  // namespace lekalo::geom_predicates_test

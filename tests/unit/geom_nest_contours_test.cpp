#include <gtest/gtest.h>

#include <limits>

#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/region_check.hpp"
#include "support/boolean_cases.hpp"
#include "support/cases.hpp"
#include "support/stopwatch.hpp"

namespace lekalo::geom::geom_nest_contours_test {
namespace {

Contour square(double x, double y, double side) { return cases::boolean_rectangle(x, y, side, side); }
std::string message(std::vector<Contour> contours) {
  const auto made = nest_contours(std::move(contours));
  return made ? "" : made.error().message;
}

TEST(NestContours, OfNoneIsNone) { EXPECT_TRUE(nest_contours({}).value().empty()); }

TEST(NestContours, OutlinesHolesAndIslandsInAnyOrderAndDirection) {
  const Contour outer = square(0, 0, 20), hole = square(2, 2, 10), island = square(4, 4, 5),
                pond = cases::boolean_circle({6, 6}, 1), apart = square(30, 0, 3);
  std::vector<Contour> contours{pond, apart, island, outer, hole};
  const std::vector<Region> wanted{make_region(apart).value(), make_region(island, {pond}).value(),
                                   make_region(outer, {hole}).value()};
  for (int turned = 0; turned < 32; ++turned) {
    std::vector<Contour> mixed = contours;
    for (std::size_t i = 0; i < mixed.size(); ++i)
      if ((turned >> i) % 2 != 0) mixed[i] = reversed(mixed[i]);
    const auto made = nest_contours(mixed);
    ASSERT_TRUE(made.has_value()) << made.error().message;
    EXPECT_EQ(*made, wanted) << turned;
  }
}

TEST(NestContours, EdgesKeepTheirDoubles) {
  const Contour odd = cases::boolean_polygon({{0.1, 0.2}, {1.0 / 3, 1e-7}, {0.7, 0.9}});
  EXPECT_EQ(nest_contours({odd}).value()[0].outer, odd);
}

TEST(NestContours, ArcsHoldWhatTheirChordsDoNot) {
  // The point of the inner contour lies beyond the chord, under the arc.
  const Contour half{{EdgeKind::arc_ccw, {5, 0}, {-5, 0}, {0, 0}}, {EdgeKind::line, {-5, 0}, {5, 0}, {}}};
  const auto made = nest_contours({cases::boolean_circle({0, 4}, 0.5), half});
  ASSERT_TRUE(made.has_value());
  ASSERT_EQ(made->size(), 1u);
  EXPECT_EQ((*made)[0].holes.size(), 1u);
  // Beside the arc, inside the box.
  EXPECT_EQ(nest_contours({cases::boolean_circle({4.6, 4.6}, 0.3), half}).value().size(), 2u);
}

TEST(NestContours, RaysThroughCornersAndTopsOfArcs) {
  // The first point of the inner one is level with corners and with the top of a circle.
  const Contour diamond = cases::boolean_polygon({{5, 0}, {0, 5}, {-5, 0}, {0, -5}});
  EXPECT_EQ(nest_contours({square(0, 0, 1), diamond}).value().size(), 1u);
  EXPECT_EQ(nest_contours({square(-20, 0, 1), diamond}).value().size(), 2u);
  EXPECT_EQ(nest_contours({square(-20, 5, 1), cases::boolean_circle({0, 0}, 5, 1)}).value().size(), 2u);
  EXPECT_EQ(nest_contours({square(-20, -5, 1), cases::boolean_circle({0, 0}, 5, 3)}).value().size(), 2u);
}

TEST(NestContours, WhatMeetsIsNamed) {
  EXPECT_NE(message({square(0, 0, 4), square(2, 2, 4)}).find("meets edge"), std::string::npos);
  EXPECT_NE(message({square(0, 0, 4), square(0, 0, 4)}).find("meets edge"), std::string::npos);
  EXPECT_NE(message({square(0, 0, 4), square(4, 0, 4)}).find("meets edge"), std::string::npos);
  EXPECT_NE(message({square(0, 0, 8), cases::boolean_circle({6, 4}, 2)}).find("meets edge"),
            std::string::npos);
  EXPECT_NE(
      message({cases::boolean_polygon({{0, 0}, {6, 0}, {10, 4}, {10, 0}, {6, 4}, {0, 4}})}).find("meets"),
      std::string::npos);
  // Crossing so that each first point lies in the other.
  EXPECT_NE(message({cases::boolean_polygon({{1, 1}, {9, 1}, {9, 3}, {1, 3}}),
                     cases::boolean_polygon({{2, 2}, {2, -5}, {0, -5}, {0, 9}, {2, 9}})})
                .find("meets"),
            std::string::npos);
}

TEST(NestContours, ABadContourIsNamedByItsNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message({square(0, 0, 4), cases::boolean_polygon({{1, 1}, {2, nan}, {3, 3}})}).substr(0, 10),
            "contour 1,");
  EXPECT_EQ(message({square(0, 0, 4), {}}).substr(0, 9), "contour 1");
  Contour open = square(0, 0, 4);
  open.pop_back();
  EXPECT_EQ(message({open}).substr(0, 9), "contour 0");
  EXPECT_EQ(message({square(0, 0, 4), cases::boolean_polygon({{1, 1}, {2, 1}, {3, 1}})}).substr(0, 9),
            "contour 1");
}

TEST(NestContours, ThousandsOfContoursTakeNoTime) {
  std::vector<Contour> contours;
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 100; ++j) contours.push_back(cases::boolean_circle({10.0 * i, 10.0 * j}, 3));
  contours.push_back(square(-10, -10, 1020));
  const cases::Stopwatch watch;
  const auto made = nest_contours(contours);
  ASSERT_TRUE(made.has_value()) << made.error().message;
  EXPECT_EQ(made->size(), 1u);
  EXPECT_EQ((*made)[0].holes.size(), 10000u);
  EXPECT_LT(watch.seconds(), 5 * cases::kSlowdown);
  // A thousand rings, each in the one before.
  contours.clear();
  for (int i = 0; i < 1000; ++i) contours.push_back(cases::boolean_circle({0, 0}, 1000 - 0.9 * i));
  EXPECT_EQ(nest_contours(contours).value().size(), 500u);
}

TEST(NestContours, RandomRegionsTakenApartComeTogetherAgain) {
  const std::size_t count = cases::case_count(300);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed(), 600 + i);
    const auto pieces = united(cases::boolean_operand(random, cases::BooleanKind::turned)).value().regions;
    if (fault_of(pieces)) continue;  // contours of a union may share points
    std::vector<Contour> contours;
    double area = 0;
    for (const Region& r : pieces) {
      area += geom::area(r);
      for (const Contour& h : r.holes) contours.push_back(h);
      contours.push_back(reversed(r.outer));
    }
    const auto made = nest_contours(contours);
    ASSERT_TRUE(made.has_value()) << made.error().message;
    EXPECT_EQ(made->size(), pieces.size()) << i;
    EXPECT_NEAR(cases::area_of(*made), area, 1e-12 * (1 + area));
  }
}

}  // namespace
}  // namespace lekalo::geom::geom_nest_contours_test

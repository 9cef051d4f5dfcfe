#include "lekalo/geom/region_check.hpp"

#include <gtest/gtest.h>

namespace lekalo::geom {
namespace {

Contour polygon(const std::vector<Point>& points) {
  Contour contour;
  for (std::size_t i = 0; i < points.size(); ++i)
    contour.push_back({EdgeKind::line, points[i], points[(i + 1) % points.size()], {}});
  return contour;
}
Contour square(double x, double y, double side) {
  return polygon({{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}});
}
Contour circle(Point centre, double radius) {
  const Point from = centre + Point{radius, 0};
  return {{EdgeKind::arc_ccw, from, from, centre}};
}
Region region(Contour outer, std::vector<Contour> holes = {}) {
  return make_region(std::move(outer), std::move(holes)).value();
}

TEST(RegionCheck, AcceptsWhatIsInOrder) {
  EXPECT_EQ(fault_of({region(square(0, 0, 10), {circle({5, 5}, 2)})}), std::nullopt);
  EXPECT_EQ(fault_of({region(square(0, 0, 10)), region(square(20, 0, 5))}), std::nullopt);
  // A piece in the hole of another.
  EXPECT_EQ(fault_of({region(square(0, 0, 10), {square(2, 2, 6)}), region(square(3, 3, 2))}), std::nullopt);
}

TEST(RegionCheck, NamesWhatMeets) {
  EXPECT_EQ(fault_of({region(polygon({{0, 0}, {10, 0}, {10, 10}, {4, -5}, {0, 10}}))}),
            "edge 0 of the outer contour meets edge 2 of the outer contour at (6, 0) mm");
  EXPECT_EQ(fault_of({region(square(0, 0, 10), {circle({9, 5}, 2)})}).value_or("").substr(0, 60),
            "edge 1 of the outer contour meets edge 0 of the hole 0 at (1");
  // Touching counts.
  EXPECT_TRUE(fault_of({region(square(0, 0, 10), {circle({8, 5}, 2)})}).has_value());
  // Back along the line it came.
  EXPECT_TRUE(fault_of({region(polygon({{0, 0}, {10, 0}, {10, 10}, {10, 4}, {0, 4}}))}).has_value());
}

TEST(RegionCheck, ACornerOnAnArcOfThreeEdgesMeetsIt) {
  // A half circle whose third corner, (3, 4), lies on the arc.
  EXPECT_EQ(fault_of({region({{EdgeKind::arc_ccw, {5, 0}, {-5, 0}, {0, 0}},
                              {EdgeKind::line, {-5, 0}, {3, 4}, {}},
                              {EdgeKind::line, {3, 4}, {5, 0}, {}}})})
                .value_or("")
                .substr(0, 60),
            "edge 0 of the outer contour meets edge 1 of the outer contou");
  EXPECT_EQ(fault_of({region({{EdgeKind::arc_ccw, {5, 0}, {-5, 0}, {0, 0}},
                              {EdgeKind::line, {-5, 0}, {3, 3}, {}},
                              {EdgeKind::line, {3, 3}, {5, 0}, {}}})}),
            std::nullopt);
}

TEST(RegionCheck, NamesWhatLiesInTheWrongPlace) {
  EXPECT_EQ(fault_of({region(square(0, 0, 10), {circle({20, 5}, 2)})}),
            "hole 0 lies outside the outer contour, at (22, 5) mm");
  EXPECT_EQ(fault_of({region(square(0, 0, 10), {circle({5, 5}, 3), circle({5, 5}, 1)})}),
            "hole 1 lies inside hole 0, at (6, 5) mm");
  EXPECT_EQ(fault_of({region(square(0, 0, 10)), region(square(2, 2, 1))}),
            "piece 1 lies in the material of piece 0, at (2, 2) mm");
}

}  // namespace
}  // namespace lekalo::geom

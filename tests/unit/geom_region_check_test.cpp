#include "lekalo/geom/region_check.hpp"

#include <gtest/gtest.h>

#include "lekalo/geom/same_outline.hpp"

namespace lekalo::geom::geom_region_check_test {
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

TEST(RegionCheck, TellsApartWhatIsNestedDeeply) {
  std::vector<Region> rings;
  for (int k = 0; k < 2000; ++k)
    rings.push_back(region(circle({0, 0}, 10.0 + 2 * k + 1), {circle({0, 0}, 10.0 + 2 * k)}));
  EXPECT_EQ(fault_of(rings), std::nullopt);
  // The hole of the innermost ring is filled by another piece, and then by one with a hole of its own inside.
  rings.push_back(region(circle({0, 0}, 9)));
  EXPECT_EQ(fault_of(rings), std::nullopt);
  rings.push_back(region(circle({1, 0}, 3)));
  EXPECT_EQ(fault_of(rings), "piece 2001 lies in the material of piece 2000, at (4, 0) mm");
}

TEST(RegionCheck, FindsTheInnermostContourBesideSlopesAndTips) {
  // A comb whose teeth lean over small squares, and squares beside it at the same heights.
  std::vector<Point> comb{{0, -5}, {200, -5}};
  for (int k = 10; k-- > 0;) {
    comb.push_back({20.0 * k + 19, 0});
    comb.push_back({20.0 * k + 25, 40});
    comb.push_back({20.0 * k, 0});
  }
  std::vector<Region> pieces{region(polygon(comb))};
  for (int k = 0; k < 9; ++k) pieces.push_back(region(square(20.0 * k + 28, 30, 4)));
  EXPECT_EQ(fault_of(pieces), std::nullopt);
  pieces.push_back(region(square(30, 5, 1)));
  EXPECT_EQ(fault_of(pieces), "piece 10 lies in the material of piece 0, at (30, 5) mm");
}

/// The radii of its ends differ by 8 mm. That is less than a millionth of the radius, and more than half of
/// the chord: engine and checker meant different curves by it.
TEST(RegionCheck, AShortArcAboutAFarCentreIsRefusedWhereItsRadiiDiffer) {
  const auto corner = [](Point to, Point centre) {
    return make_region({{EdgeKind::line, {8, 0}, {112, 0}, {}},
                        {EdgeKind::arc_ccw, {112, 0}, to, centre},
                        {EdgeKind::line, to, {8, 0}, {}}});
  };
  const auto fault = corner({120, 8}, {112, 1e9});
  ASSERT_FALSE(fault.has_value());
  EXPECT_NE(fault.error().message.find("they may differ by 1.42 mm"), std::string::npos)
      << fault.error().message;
  EXPECT_TRUE(corner({120, 0}, {116, 1e9}).has_value());
  EXPECT_TRUE(corner({120, 8}, {112, 8}).has_value());
}

TEST(RegionCheck, SaysWhenBoxesMeetTooOften) {
  std::vector<Contour> slots;
  for (int k = 0; k < 2500; ++k) {
    const double x = k, y = 0;
    slots.push_back(polygon({{x, y}, {x + 9000, y + 8000}, {x + 9000, y + 8000.3}, {x, y + 0.3}}));
  }
  const auto fault = fault_of({region(square(-10, -10, 20000), slots)});
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->substr(0, 40), "more than 8160064 pairs of its 10004 edg");
}

TEST(RegionCheck, SameOutlinesMayBeginAnywhereAndRunEitherWay) {
  const std::vector<Region> plate{region(square(0, 0, 10), {circle({3, 3}, 1), square(6, 6, 2)})};
  const std::vector<Region> other{
      region(polygon({{10, 10}, {0, 10}, {0, 0}, {10, 0}}), {square(6, 6, 2), circle({3, 3}, 1)})};
  EXPECT_TRUE(same_outline(plate, other));
  EXPECT_FALSE(same_outline(plate, {region(square(0, 0, 10), {circle({3, 3}, 1)})}));
  EXPECT_FALSE(same_outline(plate, {region(square(0, 0, 10), {circle({3, 3}, 1), square(6, 6, 2.0000001)})}));
}

}  // namespace
}  // namespace lekalo::geom::geom_region_check_test

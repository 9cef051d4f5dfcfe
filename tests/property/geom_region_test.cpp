// The laws of geom/region.hpp.

#include "lekalo/geom/region.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "lekalo/base/random.hpp"

namespace lekalo::geom::geom_region_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

Edge line(Point from, Point to) { return {EdgeKind::line, from, to, {}}; }

Contour rectangle(double x, double y, double w, double h) {
  const Point a{x, y}, b{x + w, y}, c{x + w, y + h}, d{x, y + h};
  return {line(a, b), line(b, c), line(c, d), line(d, a)};
}

/// A slot with round ends: two lines, two half circles.
Contour slot(double length, double radius) {
  const Point a{0, -radius}, b{length, -radius}, c{length, radius}, d{0, radius};
  return {line(a, b), {EdgeKind::arc_ccw, b, c, {length, 0}}, line(c, d), {EdgeKind::arc_ccw, d, a, {0, 0}}};
}

TEST(RegionLaws, AreaTurnsWithTheDirectionAndNotWithTheFirstEdge) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    Contour contour =
        rectangle(static_cast<double>(random.below(100)) / 8, 3, 1 + static_cast<double>(random.below(50)),
                  1 + static_cast<double>(random.below(50)) / 4);
    const double whole = signed_area(contour);
    EXPECT_GT(whole, 0);
    EXPECT_EQ(signed_area(reversed(contour)), -whole);
    EXPECT_EQ(reversed(reversed(contour)), contour);
    std::rotate(contour.begin(), contour.begin() + 1, contour.end());
    EXPECT_EQ(signed_area(contour), whole);
  }
}

TEST(RegionLaws, ArcsCountWithTheirSegments) {
  EXPECT_NEAR(signed_area(slot(20, 3)), 20 * 6 + kPi * 9, 1e-12);
  const Contour circle{{EdgeKind::arc_cw, {5, 0}, {5, 0}, {0, 0}}};
  EXPECT_NEAR(signed_area(circle), -kPi * 25, 1e-12);
  EXPECT_NEAR(arc_sweep(slot(20, 3)[1]), kPi, 1e-14);
  const Box box = bounds(slot(20, 3));
  EXPECT_NEAR(box.low.x, -3, 1e-12);
  EXPECT_NEAR(box.high.x, 23, 1e-12);
}

TEST(RegionLaws, MakeRegionTurnsContoursIntoTheirDirection) {
  const auto region =
      make_region(reversed(rectangle(0, 0, 40, 30)), {rectangle(5, 5, 4, 4), reversed(slot(8, 1))});
  ASSERT_TRUE(region.has_value());
  EXPECT_GT(signed_area(region->outer), 0);
  for (const Contour& hole : region->holes) EXPECT_LT(signed_area(hole), 0);
  EXPECT_NEAR(area(*region), 1200 - 16 - (16 + kPi), 1e-9);
  EXPECT_EQ(edges_in({*region, *region}), 2 * (4 + 4 + slot(8, 1).size()));
}

TEST(RegionLaws, MakeRegionRefusesWhatIsNoContour) {
  const auto refused = [](Contour outer) {
    const auto region = make_region(std::move(outer));
    return !region && region.error().code == ErrorCode::bad_input && !region.error().message.empty();
  };
  EXPECT_TRUE(refused({}));
  Contour open = rectangle(0, 0, 1, 1);
  open.pop_back();
  EXPECT_TRUE(refused(open));
  Contour nan = rectangle(0, 0, 1, 1);
  nan[0].from.x = nan[3].to.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused(nan));
  Contour doubtful = slot(20, 3);
  doubtful[1].centre.x += 5;
  doubtful[1].centre.y += 1;
  EXPECT_TRUE(refused(doubtful));
  EXPECT_TRUE(refused({line({0, 0}, {1, 1}), line({1, 1}, {0, 0})}));
}

}  // namespace
}  // namespace lekalo::geom::geom_region_test

// Clearance of regions against all pairs of edges, and of what sticks out against a grid.

#include "lekalo/phi/region.hpp"

#include <gtest/gtest.h>

#include "support/region_cases.hpp"

namespace lekalo::phi::phi_region_test {
namespace {

using geom::BlankFromPart;
using geom::Point;

TEST(RegionClearanceDifferential, ThePrunedSearchFindsWhatAllPairsFind) {
  for (const cases::RegionKind kind : cases::kRegionKinds) {
    const cases::RegionCase one = cases::region_case(cases::seed() + 9, 1, kind);
    const RegionClearance clearance(one.part, one.blank);
    Random random(cases::seed(), 5);
    int inside = 0;
    for (int i = 0; i < 60; ++i) {
      const double off = i % 2 == 0 ? 0.3 : 20;
      const BlankFromPart pose = BlankFromPart::from_angle(
          one.theta + random.uniform(-off, off) / 100,
          one.shift + Point{random.uniform(-off, off), random.uniform(-off, off)}, i % 5 == 4);
      double least = 1e300;
      for (const geom::Curve& a : clearance.part().curves())
        for (const geom::Curve& b : clearance.blank().curves())
          least = std::min(least, closest_points(placed(a, pose), b).distance);
      std::vector<RegionContact> contacts;
      const RegionClearance::Value value = clearance.at(pose, 1.0, &contacts);
      EXPECT_EQ(value.distance, least);
      inside += value.inside ? 1 : 0;
      for (const RegionContact& c : contacts) {
        EXPECT_LE(c.distance, least + 1.0);
        EXPECT_NEAR(norm(pose(c.part) - c.blank), c.distance, 1e-12);
      }
      if (!value.inside) {
        // Whatever the grid finds of the material outside is no deeper than what is said.
        const double depth = clearance.depth(pose, 1e-3);
        double found = 0;
        const geom::Box box = clearance.part().bounds();
        for (int x = 0; x <= 40; ++x)
          for (int y = 0; y <= 40; ++y) {
            const Point p =
                box.low + Point{(box.high.x - box.low.x) * x / 40, (box.high.y - box.low.y) * y / 40};
            if (!clearance.part().contains(p) || clearance.blank().contains(pose(p))) continue;
            found = std::max(found, clearance.blank().nearest(pose(p)).distance);
          }
        EXPECT_GE(depth, found);
        EXPECT_LE(depth, found + 5);
      }
    }
    EXPECT_GT(inside, 5);
    EXPECT_LT(inside, 55);
  }
}

TEST(RegionClearance, KnownDistances) {
  const auto circle = [](Point centre, double radius) {
    const Point from = centre + Point{radius, 0};
    return geom::Contour{{geom::EdgeKind::arc_ccw, from, from, centre}};
  };
  const auto region = [](geom::Contour outer, std::vector<geom::Contour> holes = {}) {
    return std::vector<geom::Region>{geom::make_region(std::move(outer), std::move(holes)).value()};
  };
  const RegionClearance ring(region(circle({0, 0}, 10), {circle({0, 0}, 5)}),
                             region(circle({0, 0}, 12), {circle({0, 0}, 4)}));
  EXPECT_EQ(ring.at(BlankFromPart::from_angle(0, {0, 0})).distance, 1);
  EXPECT_TRUE(ring.at(BlankFromPart::from_angle(0, {0, 0})).inside);
  EXPECT_NEAR(ring.at(BlankFromPart::from_angle(1, {0.25, 0})).distance, 0.75, 1e-14);
  EXPECT_EQ(ring.at(BlankFromPart::from_angle(0, {1.5, 0})).distance, 0);
  EXPECT_FALSE(ring.at(BlankFromPart::from_angle(0, {1.5, 0})).inside);
  // A disc over a hole of the blank: the outlines do not meet, the material is not there.
  const RegionClearance disc(region(circle({0, 0}, 5)), region(circle({0, 0}, 12), {circle({0, 0}, 4)}));
  EXPECT_FALSE(disc.at(BlankFromPart::from_angle(0, {0, 0})).inside);
  EXPECT_NEAR(disc.depth(BlankFromPart::from_angle(0, {0, 0}), 1e-3), 4, 0.02);
}

}  // namespace
}  // namespace lekalo::phi::phi_region_test

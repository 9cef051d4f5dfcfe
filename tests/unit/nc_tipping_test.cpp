// The ten cases that docs/design/micro-joints.md works by hand.

#include <gtest/gtest.h>

#include "lekalo/nc/joints.hpp"
#include "support/profile_parts.hpp"

namespace lekalo::nc::nc_tipping_test {
namespace {

using cases::box_contour;
using cases::circle_contour;
using cases::region_of_contours;
using cases::ring_contour;

geom::Region box(double width, double height) { return region_of_contours(box_contour(0, 0, width, height)); }
geom::Region angle() {
  return region_of_contours(ring_contour({{0, 0}, {200, 0}, {200, 20}, {20, 20}, {20, 200}, {0, 200}}));
}

TEST(NcTipping, PartsStandWhereTheirCentreOfMassIsSupportedForEveryPlaceOfTheSlats) {
  EXPECT_TRUE(tips(box(100, 100), {60})) << "one slat below its middle is no support";
  EXPECT_FALSE(tips(box(130, 130), {60}));
  EXPECT_TRUE(tips(box(20, 20), {60})) << "it falls between two slats";
  EXPECT_FALSE(tips(box(300, 20), {60}));
  EXPECT_TRUE(tips(box(20, 300), {60})) << "along the slats it lies on one of them or on none";
  EXPECT_FALSE(tips(box(20, 300), {60, true}));
  EXPECT_TRUE(tips(angle(), {60})) << "no slat has to be below the upright leg";
  EXPECT_FALSE(tips(angle(), {18}));
  EXPECT_FALSE(tips(region_of_contours(circle_contour({0, 0}, 65)), {60}));
  EXPECT_FALSE(
      tips(region_of_contours(circle_contour({0, 0}, 50), {circle_contour({0, 0}, 30, true)}), {30}));
  EXPECT_FALSE(tips(region_of_contours(ring_contour({{0, 0}, {150, 0}, {75, 130}})), {60}));
}

TEST(NcTipping, JointsSupportAPart) {
  const geom::Region small = box(20, 20);
  EXPECT_TRUE(tips(small, {60}, {{9.75, 20}, {10.25, 20}}));
  EXPECT_FALSE(tips(small, {60}, {{9.75, 20}, {10.25, 20}, {9.75, 0}, {10.25, 0}}));
  EXPECT_TRUE(tips(small, {60}, {{4.75, 20}, {5.25, 20}, {9.75, 0}, {10.25, 0}})) << "beside its middle";
  EXPECT_FALSE(tips(small, {60}, {{2, 20}, {18, 20}, {10, 0}}));
}

TEST(NcTipping, CentreAndSizeAreThoseOfTheMaterial) {
  const geom::Region plate = region_of_contours(box_contour(0, 0, 40, 20), {box_contour(20, 0.5, 19, 19)});
  // 800 less 361 square millimetres, about (20, 10) and (29.5, 10).
  EXPECT_NEAR(centre_of_mass(plate).x, (800 * 20 - 361 * 29.5) / (800 - 361), 1e-9);
  EXPECT_NEAR(centre_of_mass(plate).y, 10, 1e-9);
  EXPECT_NEAR(size_of(plate), std::hypot(40, 20), 1e-12);
  const geom::Region disc = region_of_contours(circle_contour({100, -50}, 30));
  EXPECT_NEAR(centre_of_mass(disc).x, 100, 0.01);
  EXPECT_NEAR(centre_of_mass(disc).y, -50, 0.01);
  EXPECT_NEAR(size_of(disc), 60, 0.02);
}

}  // namespace
}  // namespace lekalo::nc::nc_tipping_test

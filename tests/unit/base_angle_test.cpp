#include "lekalo/base/angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lekalo::base_angle_test {
namespace {

TEST(Angle, EveryConstantIsTheNearestDouble) {
  EXPECT_EQ(kPi, std::numbers::pi);
  EXPECT_EQ(kTurn, 6.283185307179586);
  EXPECT_EQ(kTurnAbove, std::nextafter(kTurn, 7.0));
  EXPECT_EQ(kDegree, 0.017453292519943295);
  EXPECT_EQ(kDegreesPerRadian, 57.29577951308232);
}

}  // namespace
}  // namespace lekalo::base_angle_test

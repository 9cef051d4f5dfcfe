#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "verify/drawn/drawn_file.hpp"
#include "verify/drawn/trailing_blade.hpp"

/// The tip of a blade that trails 0.5 mm behind its axis.
namespace lekalo::verify::verify_trailing_blade_test {
namespace {

constexpr double kOffset = 0.5, kWithin = 0.01;

/// Where the tip is when the axis has gone up by `way` and the blade pointed along +x before.
Place tip_after(double way) {
  const double phi = 2 * std::atan(std::exp(-way / kOffset));
  return {-kOffset * std::sin(phi), way - kOffset * std::cos(phi)};
}

TEST(VerifyTrailingBlade, TheTipFollowsItsCurveInStepsUntilItIsStraight) {
  TrailingBlade blade(kOffset, kWithin);
  std::vector<Stroke> lines;
  ASSERT_TRUE(blade.draw({0, 0}, {0, 20}, lines));
  const double step = std::sqrt(2 * kOffset * kWithin);
  // tan(phi / 2) is at most kWithin / 2 / kOffset when the rest is one line.
  const auto turning = static_cast<std::size_t>(std::ceil(-kOffset * std::log(kWithin / 2 / kOffset) / step));
  ASSERT_EQ(lines.size(), turning + 1);
  Place last{-kOffset, 0};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Place next = tip_after(i < turning ? static_cast<double>(i + 1) * step : 20);
    EXPECT_NEAR(length(lines[i].from - last), 0, 1e-12) << i;
    EXPECT_NEAR(length(lines[i].to - next), 0, 1e-12) << i;
    last = lines[i].to;
  }
}

TEST(VerifyTrailingBlade, AWayMayEndWhileTheBladeTurns) {
  TrailingBlade blade(kOffset, kWithin);
  std::vector<Stroke> lines;
  ASSERT_TRUE(blade.draw({0, 0}, {0, 0.25}, lines));
  EXPECT_EQ(lines.size(), 3U);
  EXPECT_NEAR(length(lines.back().to - tip_after(0.25)), 0, 1e-12);
  // It goes on from the direction that it has then.
  ASSERT_TRUE(blade.draw({0, 0.25}, {0, 0.4}, lines));
  EXPECT_NEAR(length(lines.back().to - tip_after(0.4)), 0, 1e-12);
}

TEST(VerifyTrailingBlade, ABladeIsPushedBackByHalfItsOffsetAtMost) {
  const auto pushed = [](double offset, double way) {
    TrailingBlade blade(offset, kWithin);
    std::vector<Stroke> lines;
    return blade.draw({0, 0}, {-way, 0}, lines);
  };
  EXPECT_TRUE(pushed(0.5, 0.2) && pushed(0.5, 0.249));
  EXPECT_FALSE(pushed(0.5, 0.251) || pushed(0.5, 1));
  // A unit of rounding may put any blade back.
  EXPECT_TRUE(pushed(0.02, 0.035));
  EXPECT_FALSE(pushed(0.02, 0.037));
}

}  // namespace
}  // namespace lekalo::verify::verify_trailing_blade_test

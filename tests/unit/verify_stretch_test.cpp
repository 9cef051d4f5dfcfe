#include "verify/shape/stretch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

/// Arcs that are hardly longer than their rounding are cut, too.
namespace lekalo::verify::verify_stretch_test {
namespace {

/// An arc about the origin between two directions.
Side arc(const Vec& first, const Vec& last, Sweep sweep) {
  Side side;
  side.arc = true, side.ccw = true, side.sweep = sweep;
  side.centre = {just(0), just(0)}, side.radius = just(1);
  side.first = first, side.last = last;
  side.from = first, side.to = last;
  return side;
}
bool same(const Vec& a, const Vec& b) {
  return a.x.low == b.x.low && a.x.high == b.x.high && a.y.low == b.y.low && a.y.high == b.y.high;
}
/// A direction that is surely known to a rounding, so many doubles further on.
Vec further(double x, double y, int steps) {
  for (int k = 0; k < steps; ++k) y = std::nextafter(y, 2.0);
  return {just(x), just(y)};
}

TEST(VerifyStretch, AnArcIsCutSurelyBetweenItsEndsOrNotAtAll) {
  int whole = 0, cut = 0;
  for (const auto& [x, y] : {std::array{0.8, 0.6}, {0.6, 0.8}, {0.28, 0.96}, {0.96, 0.28}})
    for (int steps = 1; steps <= 40; ++steps) {
      const Vec first{just(x), just(y)}, last = further(x, y, steps);
      const auto two = halves(arc(first, last, Sweep::less));
      EXPECT_TRUE(two[0].sweep == Sweep::less && two[1].sweep == Sweep::less);
      EXPECT_TRUE(same(two[0].first, first) && same(two[1].last, last)) << x << " " << steps;
      if (same(two[0].last, last) && same(two[1].first, first)) {
        ++whole;
        continue;
      }
      ++cut;
      EXPECT_TRUE(same(two[0].last, two[1].first));
      EXPECT_GT(cross(first, two[0].last).low, 0) << x << " " << steps;
      EXPECT_GT(cross(two[0].last, last).low, 0) << x << " " << steps;
    }
  EXPECT_GT(whole, 4);
  EXPECT_GT(cut, 4);
}

/// Its middle is not known, but a quarter turn from its beginning is surely on it.
TEST(VerifyStretch, AnArcOfHardlyLessThanAFullTurnIsCutBehindItsFirstQuarter) {
  const Vec first = further(0.8, 0.6, 1), last{just(0.8), just(0.6)};
  const auto two = halves(arc(first, last, Sweep::more));
  EXPECT_TRUE(two[0].sweep == Sweep::less && two[1].sweep == Sweep::more);
  EXPECT_TRUE(same(two[0].first, first) && same(two[1].last, last) && same(two[0].last, two[1].first));
  EXPECT_TRUE(same(two[0].last, {-first.y, first.x}));
}

}  // namespace
}  // namespace lekalo::verify::verify_stretch_test

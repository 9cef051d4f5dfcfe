// What a localisation of regions must be: reached, not beaten, and proved by its own certificate.

#include "lekalo/locate/region.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/region_cases.hpp"

namespace lekalo::locate::locate_region_test {
namespace {

using geom::BlankFromPart;
using geom::Point;

double clearance_at(const phi::RegionClearance& clearance, const BlankFromPart& pose) {
  const auto value = clearance.at(pose);
  return value.inside ? value.distance : -1;
}

/// The best that a search by random steps finds from a pose: nothing of the solver in it.
double climbed(const phi::RegionClearance& clearance, double theta, Point shift, Random& random, int steps) {
  double best = clearance_at(clearance, BlankFromPart::from_angle(theta, shift)), step = 1;
  for (int i = 0; i < steps; ++i) {
    const double t = theta + random.uniform(-step, step) / 50;
    const Point s = shift + Point{random.uniform(-step, step), random.uniform(-step, step)};
    // The part turns about its own middle, not about the origin.
    const double value = clearance_at(clearance, BlankFromPart::from_angle(t, s));
    if (value > best) {
      best = value, theta = t, shift = s;
    } else {
      step = std::max(1e-5, step * 0.97);
    }
  }
  return best;
}

TEST(LocateRegionProperty, IsReachedAndNotBeaten) {
  const std::size_t count = cases::region_case_count(4);
  for (const cases::RegionKind kind : cases::kRegionKinds) {
    for (std::size_t i = 0; i < count; ++i) {
      const cases::RegionCase one = cases::region_case(cases::seed(), i, kind);
      SCOPED_TRACE(one.name);
      const phi::RegionClearance clearance(one.part, one.blank);
      const double known = clearance_at(clearance, one.pose());
      ASSERT_GT(known, 0);
      RegionOptions options;
      options.run.work_limit = 60'000;
      const RegionResult result =
          locate_regions({one.part, one.blank, {}, Mirror::no, 0, 0}, options).value();
      EXPECT_GE(result.upper_bound, known);
      EXPECT_GE(result.best.clearance, known - options.gap);
      EXPECT_LE(result.best.clearance, result.upper_bound);
      if (result.status == Status::optimal) {
        EXPECT_LE(result.upper_bound - result.best.clearance, options.gap);
      }
      const BlankFromPart best = BlankFromPart::from_angle(result.best.theta, {result.best.x, result.best.y});
      EXPECT_LE(result.best.clearance, clearance_at(clearance, best));
      Random random(cases::seed(), 77 + i);
      EXPECT_LE(climbed(clearance, one.theta, one.shift, random, 3000), result.upper_bound);
      EXPECT_LE(climbed(clearance, result.best.theta, {result.best.x, result.best.y}, random, 3000),
                result.upper_bound);
    }
  }
}

}  // namespace
}  // namespace lekalo::locate::locate_region_test

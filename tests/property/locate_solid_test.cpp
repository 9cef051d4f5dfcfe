// Placements of solids: what is found is there, no small motion betters a climb, and no pose of the window
// has more than the bound.

#include "lekalo/locate/solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "lekalo/solid/mesh_clearance.hpp"
#include "support/cases.hpp"
#include "support/solid_brute_force.hpp"
#include "support/solid_cases.hpp"

namespace lekalo::locate_solid_test {
namespace {

using locate::SolidFreedom;
using locate::SolidProblem;
using solid::Motion;
using solid::Vector;

cases::SolidCase case_of(std::uint64_t k, Random& random) {
  switch (k % 5) {
    case 0:
      return cases::convex_in_convex(random, 16, random.uniform(0.5, 2));
    case 1:
      return cases::convex_in_convex(random, 16, 1, true);
    case 2:
      return cases::cored_block(random, 4);
    case 3:
      return cases::turned_part(random, 16);
    default:
      return cases::wavy_part(random, 10);
  }
}

/// The clearance of a pose, 0 where the part is not inside.
double clearance(const solid::MeshClearance& meter, const Motion& motion, double most) {
  const auto near = meter.nearest(motion, most);
  return !near ? most : near->low > 0 && meter.inside(motion) ? near->low : 0;
}

TEST(PlaceSolid, FindsAPlaceThatNoSmallMotionBetters) {
  Random random(cases::seed(), 61);
  for (std::uint64_t k = 0; k < cases::case_count(5); ++k) {
    const cases::SolidCase pair = case_of(k, random);
    SCOPED_TRACE(pair.kind);
    const auto placed = locate::place_solid({pair.part, pair.blank, {}, SolidFreedom::six}, {});
    ASSERT_TRUE(placed) << placed.error().message;
    ASSERT_TRUE(placed->inside);
    const Motion motion = motion_of(placed->pose);
    const auto exact = static_cast<double>(brute::clearance(pair.part, pair.blank, {}, motion));
    EXPECT_LE(placed->clearance, exact);
    EXPECT_GE(placed->clearance, exact - 1e-8);
    const solid::MeshClearance meter(pair.part, pair.blank);
    if (pair.optimum > 0) {
      EXPECT_NEAR(placed->clearance, pair.optimum, 1e-3);
    }
    double shares = 0;
    for (const locate::SolidTouch& touch : placed->contacts) shares += touch.multiplier;
    EXPECT_NEAR(shares, 1, 1e-9);
    for (int step = 0; step < 100; ++step) {
      const double size = std::pow(10.0, -step % 4);
      const Motion there = cases::near(motion, random, size / 50, size);
      EXPECT_LE(clearance(meter, there, placed->clearance + 0.1), placed->clearance + 1e-3) << size;
    }
  }
}

TEST(PlaceSolid, WhatIsLockedStays) {
  Random random(cases::seed(), 62);
  cases::SolidCase pair = cases::convex_in_convex(random, 16, 2);
  SolidProblem problem{pair.part, pair.blank, {}, SolidFreedom::xyz};
  problem.start.quaternion = {0.9998, 0.01, -0.005, 0.015};
  const auto shifted = locate::place_solid(problem, {});
  ASSERT_TRUE(shifted) << shifted.error().message;
  EXPECT_EQ(shifted->pose.quaternion, problem.start.quaternion);
  problem.start.quaternion = {1, 0, 0, 0};
  problem.freedom = SolidFreedom::c_xyz;
  const auto turned = locate::place_solid(problem, {});
  ASSERT_TRUE(turned) << turned.error().message;
  EXPECT_EQ(turned->pose.quaternion[1], 0);
  EXPECT_EQ(turned->pose.quaternion[2], 0);
}

TEST(PlaceSolid, RefusesWhatMakesNoSense) {
  const solid::Mesh mesh = cases::block({0, 0, 0}, {1, 1, 1});
  const auto refusal = [](const SolidProblem& problem, double gap = 0.01) {
    const auto placed = locate::place_solid(problem, {.gap = gap, .run = {}});
    return placed ? "placed" : placed.error().message;
  };
  EXPECT_EQ(refusal({{}, mesh, {}}), "part and blank must have triangles");
  EXPECT_EQ(refusal({mesh, mesh, {}}, 0), "gap 0 mm must be a positive number");
  EXPECT_EQ(refusal({mesh, mesh, {}, SolidFreedom::six, -1}),
            "a window of shifts by up to -1 mm must be a number from 0 to 1e+09");
  EXPECT_EQ(refusal({mesh, mesh, {}, SolidFreedom::six, 1, 2}),
            "a window of turns by up to 2 rad must lie between 0 and a quarter turn");
  EXPECT_EQ(refusal({mesh, mesh, {{0, 0, 0, 0}, {}}}),
            "the start is no pose: its quaternion must be of length 1, and its shift finite");
}

}  // namespace
}  // namespace lekalo::locate_solid_test

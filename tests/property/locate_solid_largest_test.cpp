// The smallest largest allowance of solids: known optima among placements that keep a margin, and what a
// placement says of its own holds for points all over it.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lekalo/locate/solid.hpp"
#include "lekalo/locate/solid_criterion.hpp"
#include "lekalo/solid/mesh_clearance.hpp"
#include "support/cases.hpp"
#include "support/prism.hpp"
#include "support/solid_cases.hpp"

namespace lekalo::locate::locate_solid_largest_test {
namespace {

using solid::Motion;
using solid::Vector;

/// A step with 1 mm of stock all around, but 2 over its lower face.
SolidProblem step_in_step() {
  SolidProblem problem;
  problem.part = cases::prism({{-10, -5}, {10, -5}, {10, 3}, {0, 3}, {0, 5}, {-10, 5}}, -5, 5);
  problem.blank = cases::prism({{-11, -6}, {11, -6}, {11, 5}, {1, 5}, {1, 6}, {-11, 6}}, -6, 6);
  problem.shift = 2;
  problem.freedom = SolidFreedom::xyz;
  problem.start.shift = {0.1, 0.2, -0.3};
  return problem;
}

/// Points all over the triangles with a demand, and the farthest of them from the blank's surface.
double sampled(const SolidProblem& problem, const Motion& motion) {
  const solid::TriangleTree tree(problem.blank);
  double most = 0;
  constexpr int kSteps = 12;
  for (std::size_t k = 0; k < problem.part.triangles.size(); ++k) {
    if (!problem.demands.empty() && !problem.demands[k]) continue;
    const auto& [a, b, c] = problem.part.triangles[k];
    const auto& v = problem.part.vertices;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j) {
        const Vector p = v[a] + static_cast<double>(i) / kSteps * (v[b] - v[a]) +
                         static_cast<double>(j) / kSteps * (v[c] - v[a]);
        most = std::max(most, tree.nearest(motion(p))->high);
      }
  }
  return most;
}

SolidPlacement chosen(const SolidProblem& problem, double give_up, const SolidOptions& options = {}) {
  const SolidPlacement best = place_solid(problem, {}).value();
  EXPECT_TRUE(best.inside);
  const double least = best.margin - give_up - 1e-6;
  const SolidPlacement made = smallest_largest(problem, best, least, options).value();
  EXPECT_TRUE(made.inside);
  EXPECT_GE(made.margin, least);
  EXPECT_LE(largest_allowance(problem, made.pose), largest_allowance(problem, best.pose));
  return made;
}

void expect_largest(const SolidProblem& problem, double give_up, double optimum) {
  const double found = largest_allowance(problem, chosen(problem, give_up).pose);
  EXPECT_GE(found, optimum - 1e-5);
  EXPECT_LE(found, optimum + 0.005);
}

TEST(SolidLargest, APartInALongBlankLiesInItsMiddle) {
  // All places along z from 0 to 3 have the margin 1, and nothing is given up.
  SolidProblem problem;
  problem.part = cases::block({-5, -5, -5}, {5, 5, 5});
  problem.blank = cases::block({-6, -6, -6}, {6, 6, 9});
  problem.start.shift = {0.1, 0.1, 0.3};
  problem.shift = 4, problem.turn = 0.03;
  for (const SolidFreedom freedom : {SolidFreedom::xyz, SolidFreedom::c_xyz, SolidFreedom::six}) {
    problem.freedom = freedom;
    expect_largest(problem, 0, 2.5);
  }
}

TEST(SolidLargest, AMarginThatIsGivenUpMovesTheDeepestPlaceOut) {
  // Below the step's edge of the blank the corner of the part's lies 1 along x and 2 along z away. As far as
  // the part goes there, along both, it lies deeper at its back and underside: until 1 + d is as much as the
  // way from the corner.
  for (const double give_up : {0.1, 0.3})
    expect_largest(step_in_step(), give_up, std::hypot(1 - give_up, 2 - give_up));
  for (const double give_up : {0.6, 0.9}) expect_largest(step_in_step(), give_up, 5 - std::sqrt(12));
}

TEST(SolidLargest, NothingIsGivenUpForNothing) {
  // Where 1 mm is left all around, all other places are deeper somewhere.
  SolidProblem problem;
  problem.part = cases::block({-5, -5, -5}, {5, 5, 5});
  problem.blank = cases::block({-6, -6, -6}, {6, 6, 6});
  problem.start.shift = {0.3, -0.2, -0.4};
  problem.shift = 2, problem.turn = 0.05;
  const SolidPlacement made = chosen(problem, 0.5);
  EXPECT_NEAR(largest_allowance(problem, made.pose), 1, 0.005);
  EXPECT_GE(made.margin, 0.99);
}

TEST(SolidLargest, FacesThatAreAsCastMayLieDeep) {
  SolidProblem problem;
  problem.part = cases::block({-5, -5, -5}, {5, 5, 5});
  problem.blank = cases::block({-6, -6, -6}, {6, 6, 9});
  problem.shift = 4, problem.turn = 0.03;
  problem.demands.assign(problem.part.triangles.size(), SolidDemand{});
  for (std::size_t k = 0; k < problem.part.triangles.size(); ++k) {
    const auto& [a, b, c] = problem.part.triangles[k];
    const auto& v = problem.part.vertices;
    if (v[a].z > 4.9 && v[b].z > 4.9 && v[c].z > 4.9) problem.demands[k].reset();
  }
  // Nothing draws the part up, and the underside has as little as the sides.
  expect_largest(problem, 0, 1);
}

TEST(SolidLargest, DatumsAndMaximaAreKept) {
  SolidProblem problem;
  problem.part = cases::block({-5, -5, -5}, {5, 5, 5});
  problem.blank = cases::block({-6, -6, -6}, {6, 6, 9});
  problem.shift = 4, problem.turn = 0.03;
  problem.datums.push_back({SolidDatum::On::point, {0, 0, 1}, {}, 0.2, {{{0, 0, 0}, 0}}});
  // The datum lets the part go up to 1.2.
  expect_largest(problem, 0, 2.8);
}

TEST(SolidLargest, WhatIsToldHoldsAllOver) {
  Random random(cases::seed(), 121);
  for (std::uint64_t k = 0; k < cases::case_count(3); ++k) {
    const cases::SolidCase pair =
        k % 2 == 0 ? cases::convex_in_convex(random, 12, 1.5) : cases::wavy_part(random, 5);
    SolidProblem problem{pair.part, pair.blank, {}};
    const SolidPlacement best = place_solid(problem, {}).value();
    if (!best.inside) continue;
    const double least = best.margin - random.uniform(0, 0.5 * best.margin);
    const SolidPlacement made = smallest_largest(problem, best, least, {}).value();
    ASSERT_TRUE(made.inside);
    EXPECT_GE(made.margin, least);
    const double told = largest_allowance(problem, made.pose), there = sampled(problem, motion_of(made.pose));
    EXPECT_GE(told, there);
    EXPECT_LE(told, largest_allowance(problem, best.pose));
    const solid::MeshClearance clearance(problem.part, problem.blank);
    EXPECT_TRUE(clearance.inside(motion_of(made.pose)));
    EXPECT_GE(clearance.nearest(motion_of(made.pose))->high, least);
  }
}

TEST(SolidLargest, ThreadsChangeNothing) {
  SolidOptions options;
  const SolidPlacement one = chosen(step_in_step(), 0.3, options);
  options.threads = 3;
  const SolidPlacement three = chosen(step_in_step(), 0.3, options);
  EXPECT_EQ(one.pose.quaternion, three.pose.quaternion);
  EXPECT_EQ(one.pose.shift, three.pose.shift);
  EXPECT_EQ(one.work, three.work);
}

TEST(SolidLargest, AStopLeavesThePlacement) {
  const SolidProblem problem = step_in_step();
  const SolidPlacement best = place_solid(problem, {}).value();
  const std::atomic<bool> stop{true};
  SolidOptions options;
  options.run.stop = &stop;
  const SolidPlacement made = smallest_largest(problem, best, best.margin - 0.3, options).value();
  EXPECT_EQ(made.pose.shift, best.pose.shift);
}

TEST(SolidLargest, APlacementWithLessMarginIsRefused) {
  const SolidProblem problem = step_in_step();
  const SolidPlacement best = place_solid(problem, {}).value();
  EXPECT_EQ(smallest_largest(problem, best, best.margin + 1, {}).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace lekalo::locate::locate_solid_largest_test

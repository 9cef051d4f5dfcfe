// The most even allowances of solids: known optima among placements that keep a margin and a largest
// allowance, and what a placement says of its own against points taken otherwise.

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/locate/solid.hpp"
#include "lekalo/locate/solid_criterion.hpp"
#include "lekalo/solid/mesh_clearance.hpp"
#include "support/cases.hpp"
#include "support/solid_cases.hpp"

namespace lekalo::locate::locate_solid_even_test {
namespace {

using solid::Motion;
using solid::Vector;

struct Evened {
  SolidPlacement shallow, made;
};

/// The placement after all three criteria, and that after two of them. Whatever it is, it keeps what it has
/// to.
Evened evened(const SolidProblem& problem, double give_up, const SolidOptions& options = {}) {
  const SolidPlacement best = place_solid(problem, {}).value();
  EXPECT_TRUE(best.inside);
  const double least = best.margin - give_up - 1e-6;
  const SolidPlacement shallow = smallest_largest(problem, best, least, options).value();
  const SolidPlacement made = most_even(problem, shallow, least, give_up, options).value();
  EXPECT_TRUE(made.inside);
  EXPECT_GE(made.margin, least);
  const double before = largest_allowance(problem, shallow.pose),
               after = largest_allowance(problem, made.pose);
  EXPECT_LE(after, (before + give_up) * (1 + 1.0 / 64) + options.gap);
  EXPECT_LE(allowance_deviation(problem, made.pose), allowance_deviation(problem, shallow.pose));
  return {shallow, made};
}

/// A block with 4 mm of stock at each side and 5 above and below together, of whose faces those demand
/// something that are not a side.
SolidProblem block_between(std::optional<double> top, std::optional<double> under) {
  SolidProblem problem;
  problem.part = cases::block({-5, -5, -5}, {5, 5, 5});
  problem.blank = cases::block({-9, -9, -6}, {9, 9, 9});
  problem.start.shift = {0.1, -0.2, 0.4};
  problem.shift = 4, problem.turn = 0.03;
  for (const auto& [a, b, c] : problem.part.triangles) {
    const auto& v = problem.part.vertices;
    const bool is_top = v[a].z + v[b].z + v[c].z > 14.9, is_under = v[a].z + v[b].z + v[c].z < -14.9;
    problem.demands.push_back(is_top || is_under ? std::optional(SolidDemand{}) : std::nullopt);
    problem.targets.push_back(is_top ? top : is_under ? under : std::nullopt);
  }
  return problem;
}

TEST(SolidEven, ABoxLiesInTheMiddleOfABox) {
  // The margin is 1 wherever it is turned nowhere and lies in the middle of x, and the largest allowance is
  // that along z; along y there is 1 mm to either side.
  SolidProblem problem;
  problem.part = cases::block({-5, -5, -5}, {5, 5, 5});
  problem.blank = cases::block({-6, -7, -8}, {6, 7, 8});
  problem.start.shift = {0.1, 0.9, 0.2};
  problem.shift = 3, problem.turn = 0.03;
  for (const SolidFreedom freedom : {SolidFreedom::xyz, SolidFreedom::c_xyz, SolidFreedom::six}) {
    problem.freedom = freedom;
    const SolidPose pose = evened(problem, 0.05).made.pose;
    EXPECT_NEAR(pose.shift.x, 0, 0.06);
    EXPECT_NEAR(pose.shift.y, 0, 0.05);
    EXPECT_NEAR(pose.shift.z, 0, 0.06);
  }
}

TEST(SolidEven, TargetsShiftThePartByHalfOfTheirDifference) {
  // In the middle, at 1.5, either face has 2.5.
  const SolidProblem problem = block_between(3, 2);
  const Evened all = evened(problem, 0.6);
  EXPECT_NEAR(all.shallow.pose.shift.z, 1.5, 0.01);
  EXPECT_NEAR(all.made.pose.shift.z, 1, 1e-3);
  EXPECT_LE(allowance_deviation(problem, all.made.pose), 1e-3);
  // As much as may be given up, of the margin and above the largest allowance.
  EXPECT_NEAR(evened(problem, 0.3).made.pose.shift.z, 1.2, 0.02);
  EXPECT_NEAR(evened(problem, 0).made.pose.shift.z, 1.5, 0.02);
}

TEST(SolidEven, ATargetOfOneFaceIsMetWhateverTheOthersHave) {
  EXPECT_NEAR(evened(block_between(3.25, std::nullopt), 1).made.pose.shift.z, 0.75, 1e-3);
}

TEST(SolidEven, WithoutTargetsBothFacesHaveTheSame) {
  const SolidProblem problem = block_between(std::nullopt, std::nullopt);
  const SolidPose pose = evened(problem, 0.6).made.pose;
  EXPECT_NEAR(pose.shift.z, 1.5, 0.02);
}

TEST(SolidEven, DatumsAreKept) {
  SolidProblem problem = block_between(3, 2);
  problem.datums.push_back({SolidDatum::On::point, {0, 0, 1.5}, {}, 0.2, {{{0, 0, 0}, 0}}});
  EXPECT_NEAR(evened(problem, 0.6).made.pose.shift.z, 1.3, 0.02);
}

TEST(SolidEven, MaximaAreKept) {
  SolidProblem problem = block_between(3, 2);
  problem.nears.push_back({{}, 2.8, 0});
  for (std::uint32_t t = 0; t < problem.targets.size(); ++t)
    if (problem.targets[t] == 3) problem.nears.back().triangles.push_back(t);
  EXPECT_NEAR(evened(problem, 0.6).made.pose.shift.z, 1.2, 0.02);
}

TEST(SolidEven, ALockedPartMovesWhereItMay) {
  SolidProblem problem = block_between(3, 2);
  problem.freedom = SolidFreedom::xyz;
  const SolidPlacement made = evened(problem, 0.6).made;
  EXPECT_EQ(made.pose.quaternion, problem.start.quaternion);
  EXPECT_NEAR(made.pose.shift.z, 1, 1e-3);
}

/// The deviation over many points of every triangle, each as heavy as its area.
double sampled_deviation(const SolidProblem& problem, const Motion& motion) {
  const solid::TriangleTree tree(problem.blank);
  constexpr int kSteps = 24;
  struct Point {
    double weight = 0, far = 0;
    std::optional<double> target;
  };
  std::vector<Point> points;
  double area = 0, free = 0, mean = 0;
  for (std::size_t t = 0; t < problem.part.triangles.size(); ++t) {
    if (!problem.demands.empty() && !problem.demands[t]) continue;
    const auto& [i, j, k] = problem.part.triangles[t];
    const Vector a = problem.part.vertices[i], b = problem.part.vertices[j] - a,
                 c = problem.part.vertices[k] - a;
    const double weight = norm(cross(b, c)) / (kSteps * kSteps);
    const auto add = [&](double u, double v) {
      const double far = tree.nearest(motion(a + u / kSteps * b + v / kSteps * c))->high;
      points.push_back({weight, far, problem.targets.empty() ? std::nullopt : problem.targets[t]});
      area += weight;
      if (!points.back().target) free += weight, mean += weight * far;
    };
    for (int u = 0; u < kSteps; ++u)
      for (int v = 0; u + v < kSteps; ++v) {
        add(u + 1.0 / 3, v + 1.0 / 3);
        if (u + v + 1 < kSteps) add(u + 2.0 / 3, v + 2.0 / 3);
      }
  }
  double squares = 0;
  for (const Point& one : points) {
    const double off = one.far - one.target.value_or(mean / free);
    squares += one.weight * off * off;
  }
  return std::sqrt(squares / area);
}

TEST(SolidEven, SixHundredPointsTellWhatManyDo) {
  Random random(cases::seed(), 122);
  for (std::uint64_t k = 0; k < cases::case_count(3); ++k) {
    const cases::SolidCase pair =
        k % 2 == 0 ? cases::convex_in_convex(random, 12, 1.5) : cases::wavy_part(random, 5);
    SolidProblem problem{pair.part, pair.blank, {}};
    if (k % 3 == 1)
      for (std::size_t t = 0; t < problem.part.triangles.size(); ++t)
        problem.targets.push_back(t % 2 == 0 ? std::optional(random.uniform(0.5, 2)) : std::nullopt);
    const SolidPlacement best = place_solid(problem, {}).value();
    if (!best.inside) continue;
    const SolidPose pose = evened(problem, random.uniform(0, 0.5 * best.margin)).made.pose;
    const double told = allowance_deviation(problem, pose),
                 there = sampled_deviation(problem, motion_of(pose));
    // Of bodies that are as far from each other everywhere only the rounding is left.
    EXPECT_NEAR(told, there, 0.15 * there + 1e-9);
  }
}

TEST(SolidEven, ThreadsChangeNothing) {
  SolidOptions options;
  const SolidPlacement one = evened(block_between(3, 2), 0.6, options).made;
  options.threads = 3;
  const SolidPlacement three = evened(block_between(3, 2), 0.6, options).made;
  EXPECT_EQ(one.pose.quaternion, three.pose.quaternion);
  EXPECT_EQ(one.pose.shift, three.pose.shift);
  EXPECT_EQ(one.work, three.work);
}

TEST(SolidEven, AStopLeavesThePlacement) {
  const SolidProblem problem = block_between(3, 2);
  const SolidPlacement best = place_solid(problem, {}).value();
  const std::atomic<bool> stop{true};
  SolidOptions options;
  options.run.stop = &stop;
  EXPECT_EQ(most_even(problem, best, best.margin - 0.6, 0.6, options).value().pose.shift, best.pose.shift);
}

TEST(SolidEven, WhatMakesNoSenseIsRefused) {
  SolidProblem problem = block_between(3, 2);
  const SolidPlacement best = place_solid(problem, {}).value();
  EXPECT_EQ(most_even(problem, best, best.margin + 1, 0, {}).error().code, ErrorCode::usage);
  problem.targets.front() = -1;
  EXPECT_EQ(most_even(problem, best, best.margin, 0, {}).error().code, ErrorCode::usage);
  problem.targets.pop_back();
  EXPECT_EQ(most_even(problem, best, best.margin, 0, {}).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace lekalo::locate::locate_solid_even_test

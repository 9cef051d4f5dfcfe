// Maxima of faces of solids: known optima under them, what no pose keeps is proved, and bounds hold for all
// poses that keep them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lekalo/locate/solid.hpp"
#include "lekalo/solid/mesh_clearance.hpp"
#include "support/cases.hpp"
#include "support/prism.hpp"
#include "support/solid_cases.hpp"

namespace lekalo::locate::locate_solid_maxima_test {
namespace {

using solid::Motion;
using solid::Vector;

constexpr double kMinimum = 0;

/// All faces demand an allowance of 0, and triangles whose middle is where `at` says have a maximum.
template <class At>
void hold(SolidProblem& problem, double most, const At& at) {
  problem.demands.assign(problem.part.triangles.size(), SolidDemand{kMinimum, 1});
  SolidNear near;
  near.within = most;
  for (std::uint32_t k = 0; k < problem.part.triangles.size(); ++k) {
    const auto& [a, b, c] = problem.part.triangles[k];
    const auto& v = problem.part.vertices;
    if (at(1.0 / 3 * (v[a] + v[b] + v[c]))) near.triangles.push_back(k);
  }
  problem.nears.push_back(std::move(near));
}

SolidProblem cube_in_cube() {
  SolidProblem problem;
  problem.part = cases::block({-5, -5, -5}, {5, 5, 5});
  problem.blank = cases::block({-6, -6, -6}, {6, 6, 6});
  problem.shift = 2, problem.turn = 0.05;
  problem.start.shift = {0.3, -0.2, -0.4};
  return problem;
}

/// A step whose upper face has 1 mm of stock, and its lower one 2 mm.
SolidProblem step_in_step() {
  SolidProblem problem;
  problem.part = cases::prism({{-10, -5}, {10, -5}, {10, 3}, {0, 3}, {0, 5}, {-10, 5}}, -5, 5);
  problem.blank = cases::prism({{-11, -6}, {11, -6}, {11, 5}, {1, 5}, {1, 6}, {-11, 6}}, -6, 6);
  problem.shift = 2;
  problem.start.shift = {0.1, 0.2, -0.3};
  return problem;
}

SolidResult located(const SolidProblem& problem, double gap, unsigned threads = 1) {
  SolidOptions options{.gap = gap, .run = {}};
  options.threads = threads;
  options.run.work_limit = 20'000;
  return locate_solid(problem, options).value();
}

/// Points all over the triangles of a demand, as placed, and the farthest of them from the blank's surface.
double sampled(const SolidProblem& problem, const SolidNear& near, const Motion& motion) {
  const solid::TriangleTree tree(problem.blank);
  double most = 0;
  constexpr int kSteps = 12;
  for (const std::uint32_t k : near.triangles) {
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

void expect_optimum(const SolidProblem& problem, double optimum, double gap, std::uint64_t most_boxes) {
  const SolidResult found = located(problem, gap);
  EXPECT_EQ(found.status, Status::optimal);
  ASSERT_TRUE(found.best.inside);
  EXPECT_GE(found.upper_bound, optimum - 1e-9);
  EXPECT_LE(found.best.margin, optimum + 1e-9);
  EXPECT_LE(found.upper_bound - found.best.margin, gap);
  EXPECT_LE(found.boxes, most_boxes);
  for (std::size_t k = 0; k < problem.nears.size(); ++k) {
    const double there = sampled(problem, problem.nears[k], motion_of(found.best.pose));
    EXPECT_LE(there, found.best.far[k]);
    EXPECT_LE(found.best.far[k], problem.nears[k].within);
  }
}

TEST(SolidMaxima, AFaceOfACubeMayNotLieDeep) {
  // The face itself has no more.
  SolidProblem problem = cube_in_cube();
  hold(problem, 0.8, [](Vector p) { return p.z > 4.9; });
  expect_optimum(problem, 0.8, 0.01, 300);
}

TEST(SolidMaxima, TheLowerFaceOfAStepDrawsTheUpperOneUp) {
  // Beside the step the lower face is near the edge of the blank's, 1 along x and 2 along z from it. With a
  // margin of t the part may be 1 - t higher and farther along x, so that t^2 + (1 + t)^2 is 1.5^2.
  const double optimum = (std::sqrt(14) - 2) / 4;
  for (const SolidFreedom freedom : {SolidFreedom::xyz, SolidFreedom::c_xyz}) {
    SolidProblem problem = step_in_step();
    problem.freedom = freedom, problem.turn = 0.05;
    hold(problem, 1.5, [](Vector p) { return std::abs(p.z - 3) < 0.1 && p.x > 0.1; });
    expect_optimum(problem, optimum, 0.01, 300);
  }
}

TEST(SolidMaxima, AFinishedFaceMayStickOutAsFar) {
  // The underside alone demands something; the top lies in the middle of a wide blank's.
  SolidProblem problem;
  problem.part = cases::block({-5, -5, -5}, {5, 5, 5});
  problem.blank = cases::block({-20, -20, -6}, {20, 20, 6});
  problem.shift = 4, problem.turn = 0.02;
  hold(problem, 0.8, [](Vector p) { return p.z > 4.9; });
  for (std::uint32_t k = 0; k < problem.part.triangles.size(); ++k) {
    const auto& v = problem.part.vertices;
    const auto& [a, b, c] = problem.part.triangles[k];
    if (std::max({v[a].z, v[b].z, v[c].z}) > -4.9) problem.demands[k].reset();
  }
  // It is 2.8 above the blank's then.
  expect_optimum(problem, 2.8, 0.01, 300);
  // And no deeper than that below it.
  problem.blank = cases::block({-20, -20, -9}, {20, 20, 9});
  problem.shift = 1;
  EXPECT_EQ(located(problem, 0.01).status, Status::infeasible);
}

/// A cube whose top is finished, with a rim, in a blank that is wider by 3 and as high.
SolidProblem flush_cube(double rim) {
  SolidProblem problem;
  problem.part = cases::block({-5, -5, -5}, {5, 5, 5});
  problem.blank = cases::block({-8, -8, -8}, {8, 8, 5});
  problem.shift = 1, problem.turn = 0.02;
  hold(problem, 0.2, [](Vector p) { return p.z > 4.9; });
  problem.nears.front().rim = rim;
  for (const std::uint32_t k : problem.nears.front().triangles) problem.demands[k].reset();
  return problem;
}

TEST(SolidMaxima, ARimDemandsNothing) {
  // The sides have 3 where they are farther from the top than that.
  expect_optimum(flush_cube(3.5), 3, 0.01, 300);
  // A narrow rim is as near to the top of the blank, and the cube may lie 0.2 deeper.
  expect_optimum(flush_cube(2), 2.2, 0.01, 300);
}

TEST(SolidMaxima, ARimThatHasAllOfThePartIsRefused) {
  EXPECT_EQ(locate_solid(flush_cube(20), {}).error().message,
            "nothing that demands an allowance is left beside the finished faces and their rims; make the "
            "rims narrower");
}

TEST(SolidMaxima, NothingBesideARimHasLess) {
  Random random(cases::seed(), 112);
  for (std::uint64_t k = 0; k < cases::case_count(2); ++k) {
    const cases::SolidCase pair =
        k % 2 == 0 ? cases::convex_in_convex(random, 12, 1.5) : cases::wavy_part(random, 5);
    SolidProblem problem{pair.part, pair.blank, {}};
    const Vector way = cases::direction(random);
    const solid::Box box = box_of(problem.part.vertices);
    const Vector middle = 0.5 * (box.low + box.high);
    hold(problem, 4, [&](Vector p) { return dot(way, p - middle) > 0.8 * norm(p - middle); });
    SolidNear& near = problem.nears.front();
    if (near.triangles.empty()) continue;
    for (const std::uint32_t t : near.triangles) problem.demands[t].reset();
    near.rim = random.uniform(0.5, 4);
    const SolidPlacement found = place_solid(problem, {}).value();
    if (!found.inside) continue;
    const Motion motion = motion_of(found.pose);
    const solid::TriangleTree blank(problem.blank);
    solid::Mesh face{problem.part.vertices, {}};
    for (const std::uint32_t t : near.triangles) face.triangles.push_back(problem.part.triangles[t]);
    const solid::TriangleTree finished(face);
    double least = 1e9;
    for (std::uint32_t t = 0; t < problem.part.triangles.size(); ++t) {
      if (!problem.demands[t]) continue;
      const auto& [a, b, c] = problem.part.triangles[t];
      const auto& v = problem.part.vertices;
      for (int i = 0; i <= 10; ++i)
        for (int j = 0; i + j <= 10; ++j) {
          const Vector p = v[a] + 0.1 * i * (v[b] - v[a]) + 0.1 * j * (v[c] - v[a]);
          if (finished.nearest(p)->low < near.rim) continue;
          EXPECT_TRUE(blank.holds(motion(p)));
          least = std::min(least, blank.nearest(motion(p))->high);
        }
    }
    EXPECT_LE(found.margin, least);
  }
}

TEST(SolidMaxima, WhatNoPoseKeepsIsProved) {
  // Top and bottom have 2 mm together.
  SolidProblem problem = cube_in_cube();
  hold(problem, 0.9, [](Vector p) { return p.z > 4.9; });
  hold(problem, 0.9, [](Vector p) { return p.z < -4.9; });
  const SolidResult found = located(problem, 0.01);
  EXPECT_EQ(found.status, Status::infeasible);
  EXPECT_FALSE(found.best.inside);
  EXPECT_LT(found.upper_bound, 0);
}

TEST(SolidMaxima, OneThatDoesNotMatterTakesNothing) {
  SolidProblem problem = cube_in_cube();
  hold(problem, 3, [](Vector p) { return p.z > 4.9; });
  expect_optimum(problem, 1, 0.01, 300);
}

TEST(SolidMaxima, TheBoundHoldsForAllPosesThatKeepThem) {
  Random random(cases::seed(), 111);
  for (std::uint64_t k = 0; k < cases::case_count(2); ++k) {
    const cases::SolidCase pair =
        k % 2 == 0 ? cases::convex_in_convex(random, 12, 1.5) : cases::wavy_part(random, 5);
    SolidProblem problem{pair.part, pair.blank, {}};
    problem.turn = 0.03, problem.shift = 2;
    const Vector way = cases::direction(random);
    const solid::Box box = box_of(problem.part.vertices);
    const Vector middle = 0.5 * (box.low + box.high);
    hold(problem, random.uniform(0.8, 2.5),
         [&](Vector p) { return dot(way, p - middle) > 0.7 * norm(p - middle); });
    if (problem.nears.front().triangles.empty()) continue;
    SolidOptions options{.gap = 0.05, .run = {}};
    options.run.work_limit = 400;
    const SolidResult found = locate_solid(problem, options).value();
    const solid::MeshClearance clearance(problem.part, problem.blank);
    const auto is_kept = [&](const Motion& motion) {
      return sampled(problem, problem.nears.front(), motion) <= problem.nears.front().within;
    };
    if (found.best.inside) {
      EXPECT_TRUE(is_kept(motion_of(found.best.pose)));
      EXPECT_LE(found.best.margin, found.upper_bound);
    }
    const Vector at = motion_of(problem.start)(middle);
    for (int pose = 0; pose < 40; ++pose) {
      const Motion turn = cases::turn(cases::direction(random), random.uniform(0, 0.02));
      Motion motion = turn;
      const Vector off{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      motion.shift = at + off - turn.turned(middle);
      const double margin = clearance.nearest(motion)->low;
      if (clearance.inside(motion) && margin > found.upper_bound) {
        EXPECT_FALSE(is_kept(motion));
      }
    }
  }
}

TEST(SolidMaxima, ThreadsChangeNothing) {
  SolidProblem problem = cube_in_cube();
  hold(problem, 0.8, [](Vector p) { return p.z > 4.9; });
  const SolidResult one = located(problem, 0.05), three = located(problem, 0.05, 3);
  EXPECT_EQ(one.best.pose.quaternion, three.best.pose.quaternion);
  EXPECT_EQ(one.best.pose.shift, three.best.pose.shift);
  EXPECT_EQ(one.upper_bound, three.upper_bound);
  EXPECT_EQ(one.proof.bodies, three.proof.bodies);
}

TEST(SolidMaxima, ThoseThatMakeNoSenseAreRefused) {
  SolidProblem problem = cube_in_cube();
  problem.nears.push_back({{12}, 1});
  EXPECT_EQ(
      place_solid(problem, {}).error().message,
      "1 triangles of the part's 12 that are to be within 1 mm of the blank's surface make no sense: there "
      "must be some, all of the part, and the distance above 0 up to 1e+09 mm");
}

}  // namespace
}  // namespace lekalo::locate::locate_solid_maxima_test

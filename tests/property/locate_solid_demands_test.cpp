// Demands by face of solids: known optima, what is found is there, and what cannot be had is proved.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "lekalo/locate/solid.hpp"
#include "support/cases.hpp"
#include "support/solid_brute_force.hpp"
#include "support/solid_cases.hpp"

namespace lekalo::locate::locate_solid_demands_test {
namespace {

using solid::Motion;
using solid::Vector;

/// A body of six faces in one whose faces are moved out, each by its own minimum and by its scale times
/// `margin`. The middle of each face has this demand, and all around it is as cast. With areas A and normals
/// n sum A n = 0, so the sum of A scale t is the same for all shifts, t what a face has: none has a larger
/// least t.
SolidProblem shifted_problem(Random& random, double margin) {
  std::vector<cases::HalfSpace> planes;
  for (const double side : {-1.0, 1.0})
    for (const Vector n : {Vector{side, 0.01, 0.02}, {-0.02, side, 0.01}, {0.01, -0.02, side}})
      planes.push_back({1 / norm(n) * n, random.uniform(60, 75)});
  SolidProblem problem;
  problem.freedom = SolidFreedom::xyz;
  const solid::Mesh whole = cases::polytope(planes);
  for (cases::HalfSpace& face : planes) {
    const SolidDemand demand{random.uniform(0.5, 3), random.uniform(0.5, 2)};
    for (const auto& [i, j, k] : whole.triangles) {
      const std::array<Vector, 3> t{whole.vertices[i], whole.vertices[j], whole.vertices[k]};
      if (!(dot(face.n, t[0]) > face.most - 1e-6 && dot(face.n, t[1]) > face.most - 1e-6 &&
            dot(face.n, t[2]) > face.most - 1e-6))
        continue;
      const Vector middle = 1.0 / 3 * (t[0] + t[1] + t[2]);
      const auto first = static_cast<std::uint32_t>(problem.part.vertices.size());
      for (const double share : {1.0, 0.5})
        for (const Vector p : t) problem.part.vertices.push_back(middle + share * (p - middle));
      problem.part.triangles.push_back({first + 3, first + 4, first + 5});
      problem.demands.emplace_back(demand);
      for (std::uint32_t n = 0; n < 3; ++n) {
        const std::uint32_t m = (n + 1) % 3;
        problem.part.triangles.push_back({first + n, first + m, first + 3 + n});
        problem.part.triangles.push_back({first + m, first + 3 + m, first + 3 + n});
        problem.demands.resize(problem.demands.size() + 2);
      }
    }
    face.most += demand.minimum + demand.scale * margin;
  }
  problem.blank = cases::polytope(planes);
  const Vector off{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
  for (Vector& p : problem.part.vertices) p = p + off;
  return problem;
}

/// Each vertex of a convex part is one of a triangle with one demand, and all other triangles demand less or
/// nothing. So the demand is that of the foremost vertices, and the optimum what is left of the clearance's.
SolidProblem turned_problem(Random& random, double margin, bool as_cast) {
  const SolidDemand demand{random.uniform(0.5, 2), random.uniform(0.75, 1.5)};
  const cases::SolidCase pair = cases::convex_in_convex(random, 14, demand.minimum + demand.scale * margin);
  SolidProblem problem{pair.part, pair.blank, {}};
  std::vector<bool> has(problem.part.vertices.size());
  for (const solid::Triangle& t : problem.part.triangles) {
    const bool needed = !has[t[0]] || !has[t[1]] || !has[t[2]];
    if (needed) has[t[0]] = has[t[1]] = has[t[2]] = true;
    std::optional<SolidDemand> less;
    if (!as_cast || random.below(2) == 0) less = {random.uniform(0, demand.minimum), demand.scale};
    problem.demands.push_back(needed ? std::optional(demand) : less);
  }
  return problem;
}

/// The least margin at a pose by its definition, and whether some triangle with a demand crosses the blank.
brute::Real margin(const SolidProblem& problem, const Motion& motion) {
  brute::Real least = std::numeric_limits<brute::Real>::infinity();
  for (std::size_t t = 0; t < problem.part.triangles.size(); ++t) {
    if (!problem.demands[t]) continue;
    const solid::Mesh one{problem.part.vertices, {problem.part.triangles[t]}};
    const brute::Real apart = brute::clearance(one, problem.blank, {}, motion);
    EXPECT_GT(apart, 0);
    least = std::min(least, (apart - problem.demands[t]->minimum) / problem.demands[t]->scale);
  }
  return least;
}

void expect_optimum(const SolidProblem& problem, double optimum, double gap) {
  const auto found = locate_solid(problem, {.gap = gap, .run = {}});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->status, optimum < 0 ? Status::infeasible : Status::optimal);
  ASSERT_TRUE(found->best.inside);
  EXPECT_GE(found->upper_bound, optimum);
  EXPECT_LE(found->upper_bound - found->best.margin, gap);
  EXPECT_LE(found->best.margin, optimum + 1e-9);
  const auto exact = static_cast<double>(margin(problem, motion_of(found->best.pose)));
  EXPECT_LE(found->best.margin, exact);
  EXPECT_GE(found->best.margin, exact - 1e-8);
}

TEST(SolidDemands, FacesWithTheirOwnDemandsInABlankGrownByThem) {
  Random random(cases::seed(), 71);
  for (std::uint64_t k = 0; k < cases::case_count(2); ++k) {
    const double optimum = random.uniform(0.5, 2);
    expect_optimum(shifted_problem(random, optimum), optimum, 0.01);
  }
}

TEST(SolidDemands, CornersWithOneDemandAndLessBesideThem) {
  Random random(cases::seed(), 72);
  for (std::uint64_t k = 0; k < cases::case_count(4); ++k) {
    const double optimum = random.uniform(0.5, 2);
    expect_optimum(turned_problem(random, optimum, k % 2 == 0), optimum, 0.02);
  }
}

TEST(SolidDemands, WhatCannotBeMetIsProved) {
  Random random(cases::seed(), 73);
  expect_optimum(shifted_problem(random, -0.25), -0.25, 0.01);
  expect_optimum(turned_problem(random, -0.25, true), -0.25, 0.02);
}

/// A turned part whose shaft sticks out of a blank that is too short for it.
SolidProblem flange_with_shaft() {
  SolidProblem problem;
  problem.part = cases::turned({{0, -30}, {20, -30}, {20, 0}, {10, 0}, {10, 40}, {0, 40}}, 12, 0);
  problem.blank = cases::turned({{0, -33}, {23, -33}, {23, 20}, {0, 20}}, 12, 0);
  for (const solid::Triangle& t : problem.part.triangles) {
    const bool of_shaft = std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
      const Vector p = problem.part.vertices[v];
      return p.z >= 0 && std::hypot(p.x, p.y) < 11;
    });
    problem.demands.push_back(of_shaft ? std::nullopt : std::optional(SolidDemand{1, 1}));
  }
  for (Vector& p : problem.part.vertices) p = p + Vector{0.7, -0.4, 0.5};
  problem.turn = 0.02;
  return problem;
}

TEST(SolidDemands, WhatIsAsCastMayStickOut) {
  SolidProblem problem = flange_with_shaft();
  // The sides of a prism in those of another are as far apart as their circles touch them inside.
  expect_optimum(problem, 3 * std::cos(std::numbers::pi / 12) - 1, 0.02);
  problem.demands.clear();
  const auto all = locate_solid(problem, {.gap = 0.05, .run = {}});
  ASSERT_TRUE(all) << all.error().message;
  EXPECT_FALSE(all->best.inside);
}

TEST(SolidDemands, AFaceOutsideOfTheBlankIsNotInside) {
  // Nothing of the shaft's end crosses the blank, and yet it is outside.
  SolidProblem problem = flange_with_shaft();
  for (std::size_t k = 0; k < problem.part.triangles.size(); ++k) {
    const auto& t = problem.part.triangles[k];
    if (std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return problem.part.vertices[v].z > 39; }))
      problem.demands[k] = SolidDemand{};
  }
  const auto found = locate_solid(problem, {.gap = 0.05, .run = {}});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_FALSE(found->best.inside);
  EXPECT_EQ(found->status, Status::infeasible);
}

TEST(SolidDemands, TheSameOfAllIsTheClearanceLessIt) {
  Random random(cases::seed(), 74);
  const cases::SolidCase pair = cases::convex_in_convex(random, 16, 1.5);
  SolidProblem problem{pair.part, pair.blank, {}};
  const auto plain = locate_solid(problem, {.gap = 0.05, .run = {}});
  ASSERT_TRUE(plain) << plain.error().message;
  problem.demands.assign(problem.part.triangles.size(), SolidDemand{0.25, 2});
  const auto found = locate_solid(problem, {.gap = 0.025, .run = {}});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->status, Status::optimal);
  EXPECT_NEAR(2 * found->best.margin + 0.25, found->best.clearance, 1e-9);
  EXPECT_NEAR(found->best.clearance, plain->best.clearance, 0.05 + 1e-9);
  EXPECT_GE(2 * found->upper_bound + 0.25, plain->best.clearance);
}

TEST(SolidDemands, ThreadsChangeNothing) {
  Random random(cases::seed(), 75);
  const SolidProblem problem = turned_problem(random, 1, true);
  const auto found = [&](unsigned threads) {
    SolidOptions options{.gap = 0.05, .run = {}};
    options.threads = threads;
    return locate_solid(problem, options).value();
  };
  const SolidResult one = found(1), three = found(3);
  EXPECT_EQ(one.best.pose.quaternion, three.best.pose.quaternion);
  EXPECT_EQ(one.best.pose.shift, three.best.pose.shift);
  EXPECT_EQ(one.best.margin, three.best.margin);
  EXPECT_EQ(one.upper_bound, three.upper_bound);
  EXPECT_EQ(one.boxes, three.boxes);
  EXPECT_EQ(one.proof.part_points.size(), three.proof.part_points.size());
  EXPECT_EQ(one.proof.trees.front().terms.size(), three.proof.trees.front().terms.size());
}

TEST(SolidDemands, DemandsThatMakeNoSenseAreRefused) {
  const solid::Mesh mesh = cases::block({0, 0, 0}, {1, 1, 1});
  const auto refusal = [&](std::vector<std::optional<SolidDemand>> demands) {
    SolidProblem problem{mesh, mesh, {}};
    problem.demands = std::move(demands);
    const auto placed = place_solid(problem, {});
    return placed ? "placed" : placed.error().message;
  };
  EXPECT_EQ(refusal({SolidDemand{}}), "there are 1 demands for the part's 12 triangles");
  EXPECT_EQ(refusal(std::vector<std::optional<SolidDemand>>(12)),
            "all of the part is as cast, so nothing is to be maximised");
  EXPECT_EQ(
      refusal(std::vector<std::optional<SolidDemand>>(12, SolidDemand{-1, 1})),
      "a demand of -1 mm in units of 1 makes no sense: the minimum must be a number from 0 to 1e+09, the "
      "scale one from 1e-06 to 1e+06");
}

}  // namespace
}  // namespace lekalo::locate::locate_solid_demands_test

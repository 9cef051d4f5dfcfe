// Placements of solids: what is found is there, no small motion betters a climb, and no pose of the window
// has more than the bound.

#include "lekalo/locate/solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <numbers>

#include "lekalo/base/stop.hpp"
#include "lekalo/solid/mesh_clearance.hpp"
#include "support/cases.hpp"
#include "support/castings.hpp"
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

/// The top of the part is a little outside the blank and within the width of its surface, where a pair of
/// triangles says that up is the way out.
TEST(PlaceSolid, LeavesASurfaceByItsInnerSide) {
  SolidProblem problem{
      cases::block({-20, -15, -10}, {20, 15, 10}), cases::block({-22, -17, -12}, {22, 17, 12}), {}};
  problem.start.shift = {0, 0, 2.01};
  problem.blank_widths.assign(problem.blank.triangles.size(), 0.05);
  const auto placed = locate::place_solid(problem, {});
  ASSERT_TRUE(placed) << placed.error().message;
  ASSERT_TRUE(placed->inside);
  EXPECT_NEAR(placed->clearance, 1.95, 1e-3);
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
  EXPECT_EQ(
      refusal({mesh, mesh, {}, SolidFreedom::six, 1, 2}),
      "a window of turns by up to 2 rad must lie between 0 and a quarter turn, or be half a turn, which is "
      "all of them");
  EXPECT_EQ(refusal({mesh, mesh, {}, SolidFreedom::six, 1, 1, -0.5}),
            "coordinates that are off by -0.5 mm must be off by a number from 0 to 1e+09");
  EXPECT_EQ(refusal({mesh, mesh, {{0, 0, 0, 0}, {}}}),
            "the start is no pose: its quaternion must be of length 1, and its shift finite");
}

/// No pose of the window near `motion` has more than `bound`.
void expect_bound(const cases::SolidCase& pair, const Motion& motion, double bound, Random& random) {
  const solid::MeshClearance meter(pair.part, pair.blank);
  for (int step = 0; step < 200; ++step) {
    const double size = std::pow(10.0, 0.5 - step % 7 * 0.5);
    const Motion there = cases::near(motion, random, size / 50, size);
    EXPECT_LE(clearance(meter, there, bound + 0.1), bound) << size;
  }
}

TEST(LocateSolid, WhatItFindsIsThereAndNoPoseHasMoreThanTheBound) {
  Random random(cases::seed(), 63);
  for (std::uint64_t k = 0; k < cases::case_count(5); ++k) {
    const cases::SolidCase pair = case_of(k, random);
    SCOPED_TRACE(pair.kind);
    for (const SolidFreedom freedom : {SolidFreedom::six, SolidFreedom::c_xyz, SolidFreedom::xyz}) {
      const auto found = locate::locate_solid({pair.part, pair.blank, {}, freedom}, {.gap = 0.05, .run = {}});
      ASSERT_TRUE(found) << found.error().message;
      const Motion motion = motion_of(found->best.pose);
      if (freedom != SolidFreedom::six) {
        // The generator has turned the part, so there is less room, or none.
        if (found->best.inside) {
          EXPECT_LE(found->best.clearance, found->upper_bound);
        }
        EXPECT_LE(found->upper_bound, found->best.clearance + 0.0501);
        continue;
      }
      ASSERT_EQ(found->status, locate::Status::optimal);
      EXPECT_LE(found->best.clearance,
                static_cast<double>(brute::clearance(pair.part, pair.blank, {}, motion)));
      EXPECT_LE(found->upper_bound - found->best.clearance, 0.05);
      EXPECT_GE(found->upper_bound, pair.optimum);
      expect_bound(pair, motion, found->upper_bound, random);
    }
  }
}

TEST(LocateSolid, AllRotationsHaveTheBestOneAmongThem) {
  Random random(cases::seed(), 66);
  for (std::uint64_t k = 0; k < cases::case_count(2); ++k) {
    const cases::SolidCase pair = cases::convex_in_convex(random, 16, 1.5);
    SolidProblem problem{pair.part, pair.blank, {}};
    for (double& q : problem.start.quaternion) q = random.uniform(-1, 1);
    const solid::Box box = box_of(pair.part.vertices);
    const Vector middle = 0.5 * (box.low + box.high);
    problem.start.shift = middle - motion_of(problem.start)(middle);
    problem.turn = SolidProblem::kAllTurns;
    const auto found = locate::locate_solid(problem, {.gap = 0.05, .run = {}});
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_EQ(found->status, locate::Status::optimal);
    EXPECT_GE(found->upper_bound, pair.optimum);
    EXPECT_GE(found->best.clearance, pair.optimum - 0.05);
    EXPECT_EQ(found->proof.trees.size(), 4U);
    expect_bound(pair, motion_of(found->best.pose), found->upper_bound, random);
    // A start is found from there, however far off the part is.
    problem.start.shift = problem.start.shift + Vector{1000, -500, 200};
    const auto start = locate::find_start(problem, {});
    ASSERT_TRUE(start) << start.error().message;
    const auto placed = locate::place_solid({pair.part, pair.blank, start->pose}, {});
    ASSERT_TRUE(placed && placed->inside);
    EXPECT_GE(placed->clearance, pair.optimum - 0.05);
  }
}

TEST(LocateSolid, FreedomsThatAreLockedAreBoundedByWhatIsLeft) {
  Random random(cases::seed(), 64);
  cases::SolidCase pair = cases::cored_block(random, 4);
  for (Vector& p : pair.part.vertices) p = pair.there(p);
  for (const SolidFreedom freedom : {SolidFreedom::xyz, SolidFreedom::c_xyz}) {
    const auto found = locate::locate_solid({pair.part, pair.blank, {}, freedom}, {.gap = 0.01, .run = {}});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->status, locate::Status::optimal);
    const solid::MeshClearance meter(pair.part, pair.blank);
    const Motion best = motion_of(found->best.pose);
    for (int step = 0; step < 200; ++step) {
      const double size = std::pow(10.0, 0.5 - step % 7 * 0.5);
      Motion there = best;
      if (freedom == SolidFreedom::c_xyz) {
        const Motion turn = cases::turn({0, 0, 1}, random.uniform(-0.01, 0.01) * size);
        for (std::size_t k = 0; k < 3; ++k) {
          const Vector row = turn.rotation[k];
          there.rotation[k] =
              row.x * best.rotation[0] + (row.y * best.rotation[1] + row.z * best.rotation[2]);
        }
      }
      there.shift = there.shift + Vector{random.uniform(-size, size), random.uniform(-size, size),
                                         random.uniform(-size, size)};
      EXPECT_LE(clearance(meter, there, found->upper_bound + 0.1), found->upper_bound);
    }
  }
}

TEST(LocateSolid, ThreadsChangeNothingOfAClimb) {
  Random random(cases::seed(), 66);
  for (int k = 0; k < 4; ++k) {
    const cases::SolidCase pair = cases::cored_block(random, 4);
    const auto found = [&](unsigned threads) {
      locate::SolidOptions options{.run = {}};
      options.threads = threads;
      return locate::place_solid({pair.part, pair.blank, {}}, options).value();
    };
    const locate::SolidPlacement one = found(1), three = found(3);
    EXPECT_EQ(one.pose.quaternion, three.pose.quaternion);
    EXPECT_EQ(one.pose.shift, three.pose.shift);
    EXPECT_EQ(one.clearance, three.clearance);
    EXPECT_EQ(one.work, three.work);
    ASSERT_EQ(one.contacts.size(), three.contacts.size());
    for (std::size_t i = 0; i < one.contacts.size(); ++i) {
      EXPECT_EQ(one.contacts[i].part_triangle, three.contacts[i].part_triangle);
      EXPECT_EQ(one.contacts[i].blank_triangle, three.contacts[i].blank_triangle);
      EXPECT_EQ(one.contacts[i].multiplier, three.contacts[i].multiplier);
    }
  }
}

TEST(LocateSolid, ThreadsChangeNothing) {
  Random random(cases::seed(), 65);
  const cases::SolidCase pair = cases::cored_block(random, 4);
  const auto found = [&](unsigned threads) {
    locate::SolidOptions options{.gap = 0.02, .run = {}};
    options.threads = threads;
    return locate::locate_solid({pair.part, pair.blank, {}}, options).value();
  };
  const locate::SolidResult one = found(1), three = found(3);
  EXPECT_EQ(one.best.pose.quaternion, three.best.pose.quaternion);
  EXPECT_EQ(one.best.pose.shift, three.best.pose.shift);
  EXPECT_EQ(one.best.clearance, three.best.clearance);
  EXPECT_EQ(one.upper_bound, three.upper_bound);
  EXPECT_EQ(one.boxes, three.boxes);
  EXPECT_EQ(one.best.work, three.best.work);
  const auto said = [](const locate::SolidProof& proof) {
    std::vector<double> all;
    for (const auto* balls : {&proof.part_balls, &proof.blank_balls})
      for (const auto& [centre, radius] : *balls)
        all.insert(all.end(), {centre.x, centre.y, centre.z, radius});
    for (const auto& [n, least] : proof.planes) all.insert(all.end(), {n.x, n.y, n.z, least});
    for (const locate::SolidTree& tree : proof.trees) {
      for (const auto& node : tree.nodes)
        all.insert(all.end(),
                   {static_cast<double>(node.axis), node.at, double(node.first), double(node.count)});
      for (const auto& term : tree.terms)
        all.insert(all.end(), {static_cast<double>(term.kind), double(term.part), double(term.blank),
                               double(term.multiplier)});
    }
    return all;
  };
  EXPECT_EQ(said(one.proof), said(three.proof));
}

TEST(LocateSolid, StoppedEarlyTheBoundHolds) {
  Random random(cases::seed(), 66);
  const cases::SolidCase pair = cases::convex_in_convex(random, 16, 1.25);
  locate::SolidOptions options{.gap = 1e-4, .run = {}};
  double fraction = 0;
  options.run.work_limit = 30;
  options.run.progress = [&](const Progress& progress) {
    EXPECT_GE(progress.fraction, fraction);
    fraction = progress.fraction;
  };
  const auto found = locate::locate_solid({pair.part, pair.blank, {}}, options);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->status, locate::Status::stopped);
  EXPECT_GE(found->upper_bound, 1.25);
  options.run.work_limit = std::numeric_limits<std::uint64_t>::max();
  fraction = 0;
  const auto whole = locate::locate_solid({pair.part, pair.blank, {}}, options);
  EXPECT_EQ(whole->status, locate::Status::optimal);
  EXPECT_NEAR(whole->best.clearance, 1.25, 1e-4);
  EXPECT_GE(whole->upper_bound, 1.25);
  EXPECT_GT(fraction, 0);
}

TEST(LocateSolid, ProgressIsToldFromTheBeginningAndAStopIsSeenWithinAMeasurement) {
  Random random(cases::seed(), 68);
  const cases::SolidCase pair = cases::convex_in_convex(random, 16, 1.25);
  const locate::SolidProblem problem{pair.part, pair.blank, {}};
  // Before any box is closed there were calls: before the trees, behind them, at each step of the climb.
  for (std::size_t stop_at = 0; stop_at < 8; ++stop_at) {
    SCOPED_TRACE(stop_at);
    std::atomic<bool> stop = false;
    std::size_t calls = 0;
    Progress told;
    locate::SolidOptions options{.gap = 1e-4, .run = {}};
    options.run.stop = &stop;
    options.run.progress = [&](const Progress& progress) {
      EXPECT_GE(progress.fraction, told.fraction);
      EXPECT_EQ(progress.fraction == 0, calls == 0);
      if (!stop) told = progress;
      stop = stop || calls == stop_at;
      ++calls;
    };
    const auto found = locate::locate_solid(problem, options);
    ASSERT_TRUE(found);
    EXPECT_GT(calls, stop_at);
    EXPECT_LT(told.fraction, 0.5);
    // The pose that it begins from is measured in any case, and each of the first boxes has its program.
    EXPECT_LE(found->best.work, std::max<std::uint64_t>(told.work, 2) + found->boxes);
    EXPECT_EQ(found->status, locate::Status::stopped);
    EXPECT_GE(found->upper_bound, 1.25);
    EXPECT_LE(found->best.clearance, 1.25);
  }
}

TEST(LocateSolid, AStopEndsTheJobUntilThereIsAPoseToShow) {
  Random random(cases::seed(), 69);
  const solid::Mesh body = cases::ring(random, 60, 40, 50, 10);
  for (const std::size_t stop_at : {0U, 2U}) {
    std::atomic<bool> stop = false;
    std::size_t calls = 0;
    locate::SolidOptions options;
    options.run.stop = &stop;
    options.run.progress = [&](const Progress&) { stop = stop || calls++ == stop_at; };
    const auto found = stoppable(options.run, [&] {
      return locate::locate_solid({body, body, {}}, options);
    });
    // The trees are not made to their end, but the climb keeps what it began from.
    ASSERT_EQ(found.has_value(), stop_at == 2);
    if (!found) continue;
    ASSERT_TRUE(*found) << (*found).error().message;
    EXPECT_EQ((*found)->status, locate::Status::stopped);
  }
}

TEST(LocateSolid, ABlankThatIsTooSmallIsProvedToBe) {
  Random random(cases::seed(), 67);
  const cases::SolidCase pair = cases::convex_in_convex(random, 16, 1);
  locate::SolidOptions options{.gap = 0.01, .run = {}};
  options.min_allowance = 1.05;
  const auto found = locate::locate_solid({pair.part, pair.blank, {}}, options);
  EXPECT_EQ(found->status, locate::Status::infeasible);
  // The part is larger than the blank.
  const auto swapped = locate::locate_solid({pair.blank, pair.part, {}}, options);
  EXPECT_EQ(swapped->status, locate::Status::infeasible);
  EXPECT_FALSE(swapped->best.inside);
  EXPECT_EQ(swapped->best.clearance, 0);
}

}  // namespace
}  // namespace lekalo::locate_solid_test

// Castings of real size, drawn and as a scanner sees them: no method tells more than the true blank has,
// which it does not know, and what cannot be had is proved, with the place.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "lekalo/locate/guaranteed_solid.hpp"
#include "lekalo/locate/solid.hpp"
#include "lekalo/locate/solid_reference.hpp"
#include "lekalo/solid/mesh_clearance.hpp"
#include "support/cases.hpp"
#include "support/castings.hpp"

namespace lekalo::locate::locate_castings_test {
namespace {

using solid::Motion;
using solid::Vector;

/// A blank as it is, and a judge of places in it.
class TrueBlank {
 public:
  TrueBlank(const solid::Mesh& part, const solid::Mesh& blank) : part_(part), pairs_(part, blank) {}

  /// Both by pairs of triangles and by points of the part alone.
  void expect_held(const SolidPlacement& placed) const {
    const Motion motion = motion_of(placed.pose);
    EXPECT_TRUE(pairs_.inside(motion));
    EXPECT_GE(pairs_.nearest(motion)->high, placed.clearance);
    for (std::size_t k = 0; k < part_.vertices.size(); k += 11) {
      const Vector p = motion(part_.vertices[k]);
      ASSERT_TRUE(pairs_.blank().holds(p));
      ASSERT_FALSE(pairs_.blank().nearest(p, placed.clearance * (1 - 1e-9)).has_value());
    }
  }
  [[nodiscard]] double at(const Motion& motion) const { return pairs_.nearest(motion)->low; }

 private:
  const solid::Mesh& part_;
  solid::MeshClearance pairs_;
};

TEST(LocateCastings, NothingTellsMoreThanTheTrueBlankHas) {
  const std::uint64_t seed = cases::kCastingSeed - 1 + cases::seed();
  std::size_t placed = 0, cut_in = 0;
  const std::size_t count = cases::case_count(1);
  for (std::size_t k = 0; k < count; ++k) {
    // The first of the usual seed is a small one.
    const std::uint64_t number = 16 + 31 * k;
    const cases::SolidCase drawn = cases::casting(number, seed);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", casting " << number << ", " << drawn.kind);
    const TrueBlank truth(drawn.part, drawn.blank);
    const double there = truth.at(drawn.there);
    ASSERT_GT(there, 0);
    SolidProblem problem{drawn.part, drawn.blank, {}};
    double losses = 0;
    if (k % 2 == 0) {
      Random random(seed, 10'000 + number);
      cases::CastingScan scan = cases::scan_of(drawn.blank, 1'000, 0.02, random);
      SolidScan said;
      said.guard = scan.guard, said.max_dip = 0;
      GuaranteedSolid made = guaranteed_solid(scan.mesh, said).value();
      problem.blank = std::move(scan.mesh), problem.blank_widths = std::move(made.widths);
      problem.blank_width_error = made.width_error;
      losses = scan.loss + scan.guard;
    }
    SolidOptions how;
    how.gap = 0.05, how.run.work_limit = 60;
    const SolidPlacement climbed = place_solid(problem, how).value();
    const SolidResult found = locate_solid(problem, how).value();
    for (const SolidPlacement& best : {climbed, found.best}) {
      ASSERT_TRUE(best.inside);
      truth.expect_held(best);
      EXPECT_GE(best.clearance, there - losses - how.gap);
      EXPECT_LE(best.clearance, found.upper_bound);
    }
    EXPECT_GE(found.upper_bound, there - losses);
    const SolidPlacement rival = place_solid_icp(problem, how).value();
    if (rival.inside) {
      truth.expect_held(rival);
      EXPECT_LE(rival.clearance, found.upper_bound);
    }
    ++placed;
    cut_in += rival.inside ? 0 : 1;
  }
  RecordProperty("placed", static_cast<int>(placed));
  RecordProperty("icp_cut_in", static_cast<int>(cut_in));
}

TEST(LocateCastings, WhatATipLeavesTooLittleForIsProvedWithThePlace) {
  const std::uint64_t seed = cases::seed();
  for (std::size_t k = 0; k < cases::case_count(2); ++k) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", plate " << k);
    Random random(seed, 20'000 + k);
    const cases::PinchedPlate drawn = cases::pinched_plate(random, 30);
    SolidProblem problem{drawn.part, drawn.blank, {}};
    // Every second one in a window far wider than its stock.
    problem.shift = k % 2 == 0 ? 5 : 0.5, problem.turn = k % 2 == 0 ? 0.0873 : 0.0175;
    SolidOptions how;
    how.min_allowance = drawn.optimum + 0.05, how.gap = 0.02;
    const SolidResult found = locate_solid(problem, how).value();
    EXPECT_EQ(found.status, Status::infeasible);
    EXPECT_LT(found.upper_bound, how.min_allowance);
    EXPECT_GE(found.upper_bound, drawn.optimum);
    ASSERT_TRUE(found.best.inside);
    // Both tips hold the least bad placement.
    for (const Vector tip : {drawn.above, drawn.below}) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const SolidTouch& touch : found.best.contacts)
        if (touch.multiplier > 0.1) nearest = std::min(nearest, norm(touch.blank - tip));
      EXPECT_LT(nearest, 2);
    }
  }
}

}  // namespace
}  // namespace lekalo::locate::locate_castings_test

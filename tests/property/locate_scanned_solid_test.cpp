#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "lekalo/locate/guaranteed_solid.hpp"
#include "lekalo/locate/solid.hpp"
#include "lekalo/solid/mesh_clearance.hpp"
#include "support/cases.hpp"
#include "support/scanned_blanks.hpp"
#include "support/solid_cases.hpp"

// Parts in scanned blanks: the placed part never leaves the true blank, which the search does not know, and
// no pose of the window has more clearance in the guaranteed blank than the bound.

namespace lekalo::locate::locate_scanned_solid_test {
namespace {

using cases::Bitten;
using solid::Motion;
using solid::Vector;

/// The blank taken in everywhere, and moved a little.
solid::Mesh part_in(const Bitten& blank, Random& random) {
  solid::Mesh part = cases::scanned(blank, 8 + static_cast<std::uint32_t>(random.below(5)), 0, random);
  const double share = random.uniform(0.85, 0.95);
  for (Vector& p : part.vertices) p = share * p;
  return cases::moved_back(std::move(part), cases::small_motion(random, 0.01, 0.4));
}

struct Scanned {
  Bitten blank;
  SolidProblem problem;
};

Scanned scanned_case(Random& random) {
  Scanned made{cases::bitten(random), {}};
  SolidScan scan;
  scan.guard = random.uniform(0, 0.1), scan.min_radius = made.blank.radius;
  made.problem.part = part_in(made.blank, random);
  made.problem.blank =
      cases::scanned(made.blank, static_cast<std::uint32_t>(220 / made.blank.radius), scan.guard, random);
  GuaranteedSolid guaranteed = guaranteed_solid(made.problem.blank, scan).value();
  made.problem.blank_widths = std::move(guaranteed.widths);
  made.problem.blank_width_error = guaranteed.width_error;
  if (!guaranteed.proved()) made.problem.blank_widths.clear();
  made.problem.shift = 1, made.problem.turn = 0.02;
  return made;
}

TEST(LocateScannedSolid, ThePlacedPartNeverLeavesTheTrueBlank) {
  const std::uint64_t seed = cases::seed();
  std::size_t inside = 0, closed = 0;
  for (std::size_t k = 0; k < cases::case_count(30); ++k) {
    Random random(seed, 1000 + k);
    const Scanned drawn = scanned_case(random);
    const SolidProblem& problem = drawn.problem;
    if (problem.blank_widths.empty()) continue;
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << k);
    SolidOptions how;
    how.gap = 0.02, how.run.work_limit = 1500;
    const auto found = locate_solid(problem, how);
    ASSERT_TRUE(found.has_value()) << found.error().message;
    if (found->status == Status::optimal) ++closed;
    const solid::MeshClearance meter(problem.part, problem.blank, problem.blank_widths);
    for (int i = 0; i < 50; ++i) {
      const SolidPose pose{
          {1, random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01)},
          {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}};
      const Motion there = motion_of(pose);
      const auto near = meter.nearest(there);
      if (near->high > 0 && meter.inside(there)) {
        EXPECT_LE(near->low, found->upper_bound);
      }
    }
    const SolidPlacement& best = found->best;
    if (!best.inside) continue;
    ++inside;
    EXPECT_LE(best.clearance, found->upper_bound);
    const Motion motion = motion_of(best.pose);
    for (std::size_t t = 0; t < problem.part.triangles.size(); ++t)
      for (int i = 0; i < 4; ++i)
        ASSERT_GE(drawn.blank.depth(motion(cases::of_triangle(problem.part, t, random))), best.clearance);
  }
  EXPECT_GT(inside, 0U) << "no part was placed, so nothing was tested";
  EXPECT_GT(closed, 0U) << "no bound was closed";
}

}  // namespace
}  // namespace lekalo::locate::locate_scanned_solid_test

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lekalo/locate/solid.hpp"
#include "lekalo/locate/touched_solid.hpp"
#include "support/cases.hpp"
#include "support/touched_castings.hpp"

// Castings of a metre whose true surface is known, touched at 200 places: all that is promised is material,
// the true place is among those that the touches leave, and a placed part never leaves the true casting.

namespace lekalo::locate::locate_touched_solid_test {
namespace {

using cases::TouchedCasting;
using solid::TriangleTree;
using solid::Vector;

struct Touched {
  cases::SolidCase solids;
  TouchedCasting casting;
  TouchStatement stated;
  TouchedSolid found;
};

Touched touched_case(Random& random) {
  cases::SolidCase solids = cases::large_cored_block(random);
  TouchStatement stated;
  stated.form = random.uniform(0.1, 1), stated.guard = random.uniform(0.005, 0.05);
  stated.ball = random.below(3) == 0 ? 0 : random.uniform(2, 8);
  if (!(0.5 * stated.ball > stated.guard)) stated.ball = 0;
  TouchedCasting casting(solids.blank, cases::small_motion(random, 0.01, 3),
                         random.uniform(0.5, 0.999) * stated.form, random);
  const bool along = random.below(2) == 0;
  const auto touches = cases::touches_of(casting, 200, 0.5 * stated.ball, stated.guard, random,
                                         along ? &stated.directions : nullptr);
  Result<TouchedSolid> found = touched_solid(casting.nominal(), touches, stated);
  EXPECT_TRUE(found.has_value()) << found.error().message;
  return {std::move(solids), std::move(casting), stated, found ? *std::move(found) : TouchedSolid{}};
}

TEST(LocateTouchedSolid, NothingPromisedIsAir) {
  const std::uint64_t seed = cases::seed();
  std::size_t promised = 0, air_without = 0;
  for (std::size_t k = 0; k < cases::case_count(3); ++k) {
    Random random(seed, 7000 + k);
    const Touched drawn = touched_case(random);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << k);
    const TouchedSolid& found = drawn.found;
    ASSERT_FALSE(found.widths.empty());
    EXPECT_LT(found.widest, 6 * (drawn.stated.form + drawn.stated.guard));
    EXPECT_TRUE(found.notices.empty());

    // The true place goes no farther from the one taken than is said.
    const solid::Motion moved = motion_of(found.proof.moved);
    const solid::Box& box = found.proof.around;
    for (const TouchWay& way : found.proof.ways) {
      const Vector corner{(way.corner & 1) != 0 ? box.high.x : box.low.x,
                          (way.corner & 2) != 0 ? box.high.y : box.low.y,
                          (way.corner & 4) != 0 ? box.high.z : box.low.z};
      const Vector off = drawn.casting.there()(corner) - moved(corner);
      const double along = way.axis == SolidTree::Axis::x   ? off.x
                           : way.axis == SolidTree::Axis::y ? off.y
                                                            : off.z;
      EXPECT_LE(way.above ? along : -along, way.at);
    }

    const TriangleTree tree(found.mesh);
    for (int i = 0; i < 1500; ++i) {
      const std::size_t t = random.below(found.mesh.triangles.size());
      const auto& corners = tree.corners(tree.place_in_order(static_cast<std::uint32_t>(t)));
      const Vector across = cross(corners[1] - corners[0], corners[2] - corners[0]);
      const Vector q = cases::of_triangle(found.mesh, t, random) -
                       random.uniform(0, 1.2) * found.widths[t] / norm(across) * across;
      if (!tree.holds(q)) continue;
      if (!drawn.casting.is_material(q)) ++air_without;
      if (!(tree.least_sum(q, found.widths, -1, -found.widest) > 0)) continue;
      ++promised;
      EXPECT_TRUE(drawn.casting.is_material(q)) << q.x << " " << q.y << " " << q.z;
    }
  }
  EXPECT_GT(promised, 0U);
  EXPECT_GT(air_without, 0U) << "without widths there would be no air inside, so nothing was tested";
}

TEST(LocateTouchedSolid, APlacedPartNeverLeavesTheTrueCasting) {
  const std::uint64_t seed = cases::seed();
  std::size_t inside = 0;
  for (std::size_t k = 0; k < cases::case_count(1); ++k) {
    Random random(seed, 8000 + k);
    Touched drawn = touched_case(random);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << k);
    SolidProblem problem;
    problem.part = std::move(drawn.solids.part), problem.blank = std::move(drawn.found.mesh);
    problem.blank_widths = std::move(drawn.found.widths);
    problem.blank_width_error = drawn.found.width_error;
    problem.shift = 25, problem.turn = 0.08;
    const auto found = place_solid(problem, {});
    ASSERT_TRUE(found.has_value()) << found.error().message;
    if (!found->inside) continue;
    ++inside;
    const solid::Motion motion = motion_of(found->pose);
    for (std::size_t t = 0; t < problem.part.triangles.size(); ++t)
      for (int i = 0; i < 4; ++i)
        ASSERT_TRUE(drawn.casting.is_material(motion(cases::of_triangle(problem.part, t, random))));
  }
  EXPECT_GT(inside, 0U) << "no part was placed, so nothing was tested";
}

}  // namespace
}  // namespace lekalo::locate::locate_touched_solid_test

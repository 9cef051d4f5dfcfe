// The clearance of a mesh in a mesh against every pair of triangles, measured feature by feature in long
// double.

#include "lekalo/solid/mesh_clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/cases.hpp"
#include "support/solid_brute_force.hpp"
#include "support/solid_cases.hpp"

namespace lekalo::solid_mesh_clearance_test {
namespace {

using solid::Mesh;
using solid::MeshClearance;
using solid::Motion;
using solid::Vector;

cases::SolidCase some_case(Random& random) {
  switch (random.below(4)) {
    case 0:
      return cases::convex_in_convex(random, 12, 1.5, true);
    case 1:
      return cases::cored_block(random, 3);
    case 2:
      return cases::turned_part(random, 12);
    default:
      return cases::wavy_part(random, 8);
  }
}

TEST(MeshClearance, IsTheLeastDistanceOfAllPairsOfTriangles) {
  Random random(cases::seed(), 51);
  std::size_t apart = 0, crossing = 0;
  for (std::size_t i = 0; i < cases::case_count(5); ++i) {
    const cases::SolidCase pair = some_case(random);
    for (const Mesh& mesh : {pair.part, pair.blank}) {
      const auto closed = solid::closed_mesh(mesh);
      ASSERT_TRUE(closed) << pair.kind << ": " << closed.error().message;
      EXPECT_EQ(closed->mesh.vertices.size(), mesh.vertices.size()) << pair.kind;
    }
    std::vector<double> widths;
    if (random.below(2) == 0)
      for (std::size_t k = 0; k < pair.blank.triangles.size(); ++k) widths.push_back(random.uniform(0, 0.3));
    const MeshClearance meter(pair.part, pair.blank, widths);
    std::optional<solid::NearPair> before;
    for (int k = 0; k < 3; ++k) {
      const Motion motion = k == 0 ? pair.there : cases::near(pair.there, random, 0.02, 0.5 * k);
      const auto exact = static_cast<double>(brute::clearance(pair.part, pair.blank, widths, motion));
      const auto found =
          meter.nearest(motion, std::numeric_limits<double>::infinity(), before ? &*before : nullptr);
      ASSERT_TRUE(found);
      EXPECT_LE(found->low, exact) << pair.kind;
      EXPECT_GE(found->high, exact) << pair.kind;
      if (exact > 1e-9) {
        EXPECT_LT(found->high - found->low, 1e-8) << pair.kind;  // some triangles are thin
        ++apart;
      } else if (widths.empty()) {
        EXPECT_LE(found->low, 0) << pair.kind;
        EXPECT_LT(found->high, 1e-9) << pair.kind;
        ++crossing;
      }
      const double width = widths.empty() ? 0 : widths[found->blank_triangle];
      EXPECT_NEAR(norm(found->part - found->blank) - width, found->high, 1e-9);
      EXPECT_FALSE(meter.nearest(motion, found->low - 1e-9));
      std::vector<solid::NearPair> pieces;
      meter.nearest_by_piece(motion, exact + 0.5, 10, pieces);
      EXPECT_LE(pieces.size(), 10u);
      double least = 1e300;
      for (const solid::NearPair& piece : pieces) least = std::min(least, piece.high);
      EXPECT_NEAR(least, found->high, 1e-11);
      before = found;
    }
  }
  EXPECT_GT(apart, 2u);
  EXPECT_GT(crossing, 0u);
}

TEST(MeshClearance, KnownStockIsFound) {
  Random random(cases::seed(), 52);
  for (std::size_t i = 0; i < cases::case_count(10); ++i) {
    const double stock = random.uniform(0.5, 3);
    const cases::SolidCase pair = cases::convex_in_convex(random, 20, stock);
    const MeshClearance meter(pair.part, pair.blank);
    EXPECT_TRUE(meter.inside(pair.there));
    EXPECT_NEAR(meter.nearest(pair.there)->high, stock, 1e-9);
  }
}

TEST(MeshClearance, APartBesideTheBlankOrAroundACoreIsNotInside) {
  const Mesh part = cases::block({0, 0, 0}, {10, 10, 10});
  const MeshClearance meter(part, cases::block({-1, -1, -1}, {11, 11, 11}));
  EXPECT_TRUE(meter.inside({}));
  EXPECT_NEAR(meter.nearest({})->low, 1, 1e-12);
  Motion beside;
  beside.shift = {20, 0, 0};
  EXPECT_FALSE(meter.inside(beside));
  // The surfaces are 3 mm apart or more, but the part swallows the void.
  Mesh hollow = cases::block({-5, -5, -5}, {15, 15, 15});
  cases::append(hollow, cases::block({4, 4, 4}, {6, 6, 6}));
  const MeshClearance swallowed(part, hollow);
  EXPECT_GT(swallowed.nearest({})->low, 3);
  EXPECT_FALSE(swallowed.inside({}));
  // Half of the part lies beside the blank.
  Mesh two = part;
  cases::append(two, cases::block({30, 0, 0}, {35, 5, 5}));
  EXPECT_FALSE(MeshClearance(two, cases::block({-1, -1, -1}, {11, 11, 11})).inside({}));
}

}  // namespace
}  // namespace lekalo::solid_mesh_clearance_test

// The clearance of a mesh in a mesh against every pair of triangles, measured feature by feature in long
// double.

#include "lekalo/solid/mesh_clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lekalo/base/stop.hpp"
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
      // Of those that cross any may be named.
      EXPECT_NEAR(std::max(least, 0.0), std::max(found->high, 0.0), 1e-11);
      // A near pair after some steps is a pair, and the nearest after enough of them.
      double patches = 1e300;
      for (const std::uint32_t patch : meter.part().patches(7)) {
        const auto all = meter.near_below(motion, patch, 0, 1e300, 1'000'000),
                   some = meter.near_below(motion, patch, 0, 1e300, 60);
        ASSERT_TRUE(all);
        patches = std::min(patches, all->high);
        if (!some) continue;
        EXPECT_GE(some->high, all->low - 1e-11);
        EXPECT_NEAR(norm(some->part - some->blank) - (widths.empty() ? 0 : widths[some->blank_triangle]),
                    some->high, 1e-9);
      }
      EXPECT_NEAR(std::max(patches, 0.0), std::max(found->high, 0.0), 1e-11);
      EXPECT_FALSE(meter.near_below(motion, 0, 0, 1e300, 0));
      before = found;
    }
  }
  EXPECT_GT(apart, 2u);
  EXPECT_GT(crossing, 0u);
}

/// A mesh that no axis of the frame suits: squeezed, so that many of its triangles are thin, and turned far.
Mesh squeezed(Mesh mesh, Random& random, const Motion& turn) {
  const double flat = std::pow(0.1, random.uniform(0, 4));
  for (Vector& p : mesh.vertices) p = turn({p.x, p.y, flat * p.z});
  return mesh;
}

TEST(MeshClearance, IsTheLeastDistanceOfTurnedAndDegenerateMeshes) {
  Random random(cases::seed(), 53);
  std::size_t apart = 0;
  for (std::size_t i = 0; i < cases::case_count(8); ++i) {
    const Motion turn = cases::small_motion(random, 3, 20);
    Mesh part = squeezed(cases::wavy_ball(6, 1, [](double, double) { return 0.0; }), random, turn),
         blank = squeezed(cases::wavy_ball(7, 1, [](double, double) { return 3.0; }), random, turn);
    // A corner twice, and three on a line.
    part.triangles.push_back({0, 0, 5});
    blank.vertices.push_back(0.5 * (blank.vertices[3] + blank.vertices[9]));
    blank.triangles.push_back({3, 9, static_cast<std::uint32_t>(blank.vertices.size() - 1)});
    const MeshClearance meter(part, blank);
    for (const double off : {0.0, 2.0, 200.0}) {
      const Motion motion = cases::small_motion(random, off > 100 ? 3 : 0.01 * off, off);
      const auto exact = static_cast<double>(brute::clearance(part, blank, {}, motion));
      const auto found = meter.nearest(motion);
      ASSERT_TRUE(found);
      EXPECT_LE(found->low, exact);
      EXPECT_GE(found->high, exact - 1e-15);
      if (exact > 1e-9) {
        EXPECT_LT(found->high - found->low, 1e-6);
        EXPECT_FALSE(meter.nearest(motion, exact - 1e-6));
        ++apart;
      }
    }
  }
  EXPECT_GT(apart, 2u);
}

/// A cube about the origin whose faces are cut into `n` by `n` squares.
Mesh fine_cube(double half, std::uint32_t n) {
  Mesh mesh;
  double Vector::*const axes[] = {&Vector::x, &Vector::y, &Vector::z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double side : {-half, half}) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j) {
          Vector p;
          p.*axes[axis] = side;
          p.*axes[(axis + 1) % 3] = half * (2.0 * i / n - 1);
          p.*axes[(axis + 2) % 3] = half * (2.0 * j / n - 1);
          mesh.vertices.push_back(p);
        }
      for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
          const std::uint32_t k = first + i * (n + 1) + j;
          mesh.triangles.push_back({k, k + n + 1, k + 1});
          mesh.triangles.push_back({k + 1, k + n + 1, k + n + 2});
        }
    }
  return closed_mesh(std::move(mesh)).value().mesh;
}

/// Every triangle of the faces is as near as any, and one of them is enough.
TEST(MeshClearance, AnEvenStockIsNotLookedAtTriangleByTriangle) {
  Random random(cases::seed(), 54);
  const Motion turn = cases::small_motion(random, 3, 30);
  Mesh part = fine_cube(20, 24), blank = fine_cube(21.5, 25);
  for (Mesh* mesh : {&part, &blank})
    for (Vector& p : mesh->vertices) p = turn(p);
  const MeshClearance meter(part, blank);
  std::vector<solid::NearPair> pieces;
  // The first makes the boxes.
  meter.nearest_by_piece({}, 10, 64, pieces);
  RunControl run;
  run.work_limit = 100'000;
  const auto found = stoppable(run, [&] {
    meter.nearest_by_piece({}, 10, 64, pieces);
    return pieces;
  });
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), 64u);
  for (const solid::NearPair& piece : *found) EXPECT_NEAR(piece.high, 1.5, 1e-10);
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
  EXPECT_NEAR(meter.nearest({})->low, 1, 1e-11);
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

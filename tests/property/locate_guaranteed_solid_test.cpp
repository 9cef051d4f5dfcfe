#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "lekalo/locate/guaranteed_solid.hpp"
#include "lekalo/solid/triangle_tree.hpp"
#include "support/cases.hpp"
#include "support/scanned_blanks.hpp"
#include "support/solid_brute_force.hpp"
#include "support/solid_cases.hpp"

// The claim of a scanned blank: whatever is inside the mesh and farther from each triangle than its width, is
// material. The true blanks are balls with dents, each the bite of a ball that comes from outside.

namespace lekalo::locate::locate_guaranteed_solid_test {
namespace {

using cases::Bitten;
using solid::Vector;

brute::Real distance(const solid::Mesh& mesh, const solid::Triangle& t, Vector p) {
  const brute::Corners corners{brute::wide(mesh.vertices[t[0]]), brute::wide(mesh.vertices[t[1]]),
                               brute::wide(mesh.vertices[t[2]])};
  brute::Real least = std::numeric_limits<brute::Real>::infinity();
  const brute::Wide q = brute::wide(p);
  brute::look_at_face(least, q, corners);
  for (std::size_t k = 0; k < 3; ++k) brute::look_at_edge(least, q, corners[k], corners[(k + 1) % 3]);
  return least;
}

/// The greatest part of a triangle's width within which air inside the mesh lies of it; above 1 the claim is
/// not true.
double worst(const Bitten& blank, const solid::Mesh& mesh, const GuaranteedSolid& made, Random& random) {
  const solid::TriangleTree tree(mesh);
  double worst = 0;
  for (int k = 0; k < 4'000; ++k) {
    const Vector u = cases::direction(random), q = (blank.reach(u) + random.uniform(-0.02, 0.6)) * u;
    if (blank.material(q) || !tree.holds(q)) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      nearest = std::min(nearest, static_cast<double>(distance(mesh, mesh.triangles[i], q)) / made.widths[i]);
    worst = std::max(worst, nearest);
  }
  return worst;
}

TEST(LocateGuaranteedSolid, NoAirLiesDeeperInTheMeshThanTheWidthOfATriangle) {
  const std::uint64_t seed = cases::seed();
  double most = 0;
  for (std::size_t k = 0; k < cases::case_count(6); ++k) {
    Random random(seed, k);
    const Bitten blank = cases::bitten(random);
    SolidScan scan;
    scan.guard = random.uniform(0, 0.1);
    scan.min_radius = blank.radius;
    const solid::Mesh mesh =
        cases::scanned(blank, 14 + static_cast<std::uint32_t>(random.below(10)), scan.guard, random);
    const auto made = guaranteed_solid(mesh, scan);
    ASSERT_TRUE(made.has_value()) << made.error().message;
    if (!made->proved()) continue;
    const double here = worst(blank, mesh, *made, random);
    EXPECT_LE(here, 1) << "seed " << seed << ", case " << k;
    most = std::max(most, here);
  }
  EXPECT_GT(most, 0.3) << "no air was found inside, so nothing was tested";
}

TEST(LocateGuaranteedSolid, ARightTriangleCountsByHalfItsLongestSide) {
  SolidScan scan;
  scan.min_radius = 5;
  const solid::Mesh mesh = cases::block({0, 0, 0}, {3, 4, 3});
  const auto made = guaranteed_solid(mesh, scan);
  ASSERT_TRUE(made.has_value());
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector side = mesh.vertices[mesh.triangles[k][i]] - mesh.vertices[mesh.triangles[k][(i + 1) % 3]];
      square = std::max(square, dot(side, side));
    }
    const double exact = 5 - std::sqrt(25 - square / 4);
    EXPECT_GE(made->widths[k], exact);
    EXPECT_LE(made->widths[k], exact + made->width_error);
    EXPECT_LT(made->width_error, 1e-12);
  }
}

TEST(LocateGuaranteedSolid, WidthsAreThoseOfTheCircleAroundEachTriangle) {
  const auto width = [](Vector a, Vector b, Vector c) {
    SolidScan scan;
    scan.min_radius = 3, scan.guard = 0.04;
    return guaranteed_solid({{a, b, c}, {{0, 1, 2}}}, scan)->widths.front();
  };
  const auto by_circle = [](double rho) { return 3 - std::sqrt(2.96 * 2.96 - rho * rho); };
  EXPECT_NEAR(width({0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}), by_circle(1 / std::sqrt(3.0)), 1e-12);
  EXPECT_NEAR(width({0, 0, 0}, {1, 0, 0}, {0.5, 0.1, 0}), by_circle(0.5), 1e-12)
      << "obtuse: half the longest";
  EXPECT_NEAR(width({0, 0, 7}, {0, 2, 7}, {1e-9, 1, 7}), by_circle(1), 1e-12) << "a needle";
  EXPECT_NEAR(width({0, 0, 0}, {1e-9, 2, 0}, {-1e-9, 2, 0}), by_circle(1), 1e-9) << "an acute needle";
}

TEST(LocateGuaranteedSolid, ATriangleTooWideForTheRadiusIsUnknown) {
  SolidScan scan;
  scan.min_radius = 3, scan.guard = 0.5;
  const solid::Mesh mesh{{{0, 0, 0}, {4.9, 0, 0}, {0, 0.1, 0}, {0, 0, 9}, {5.1, 0, 9}, {0, 0.1, 9}},
                         {{0, 1, 2}, {3, 4, 5}}};
  const auto made = guaranteed_solid(mesh, scan);
  ASSERT_TRUE(made.has_value());
  EXPECT_FALSE(made->proved());
  EXPECT_EQ(made->unknown, (std::vector<std::uint32_t>{1}));
  EXPECT_NEAR(made->unknown_area, 0.255, 1e-12);
}

TEST(LocateGuaranteedSolid, AStatementClosesTheUndersideAndWidensWhatTouchesIt) {
  SolidScan scan;
  scan.guard = 0.04, scan.min_radius = 3, scan.underside = SolidUnderside{-2, 0.3};
  // One triangle of the underside, one beside it by an edge, one by a corner, one away from it.
  const solid::Mesh mesh{
      {{0, 0, -2}, {90, 0, -2.2}, {0, 90, -1.8}, {0, 1, -1}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}},
      {{0, 1, 2}, {0, 3, 5}, {4, 5, 6}}};
  const auto made = guaranteed_solid(mesh, scan);
  ASSERT_TRUE(made.has_value());
  EXPECT_TRUE(made->proved());
  EXPECT_EQ(made->widths[0], 0.3);
  EXPECT_GT(made->widths[1], 0.3);
  EXPECT_NEAR(made->widths[2], 3 - std::sqrt(2.96 * 2.96 - 0.5), 1e-12);
  scan.underside.reset();
  EXPECT_EQ(guaranteed_solid(mesh, scan)->unknown, (std::vector<std::uint32_t>{0}));
}

TEST(LocateGuaranteedSolid, RadiusAndDipAreNotMixed) {
  SolidScan scan;
  scan.guard = 0.1, scan.min_radius = 3, scan.max_dip = 0.05;
  const solid::Mesh fine{{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 3, 4}}};
  const auto made = guaranteed_solid(fine, scan);
  ASSERT_TRUE(made.has_value());
  for (const double width : made->widths)
    EXPECT_NEAR(width, 0.15, 1e-12) << "the dip is the better one for the widest";
  scan.max_dip = 5;
  EXPECT_LT(guaranteed_solid(fine, scan)->widths[0], 0.102);
}

TEST(LocateGuaranteedSolid, NumbersThatMakeNoSenseAreRefused) {
  const solid::Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const auto refused = [&](SolidScan scan) { return !guaranteed_solid(mesh, scan).has_value(); };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused({0.1, {}, {}, {}})) << "neither radius nor dip";
  EXPECT_TRUE(refused({-0.1, 3.0, {}, {}}));
  EXPECT_TRUE(refused({nan, 3.0, {}, {}}));
  EXPECT_TRUE(refused({0.1, 0.1, {}, {}})) << "a radius that the guard eats up";
  EXPECT_TRUE(refused({0.1, {}, -1.0, {}}));
  EXPECT_TRUE(refused({0.1, 3.0, {}, SolidUnderside{0, 0}}));
  EXPECT_TRUE(refused({0.1, 3.0, {}, SolidUnderside{nan, 1}}));
  EXPECT_TRUE(refused({0.1, 3.0, {}, SolidUnderside{0, 3}}));
  EXPECT_FALSE(refused({0.1, {}, 0.0, SolidUnderside{0, 1}}));
}

}  // namespace
}  // namespace lekalo::locate::locate_guaranteed_solid_test

#include "lekalo/solid/principal_axes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/solid_cases.hpp"

namespace lekalo::solid_principal_axes_test {
namespace {

using solid::Vector;

TEST(PrincipalAxes, OfATurnedBlockAreItsEdgesTheLongestLast) {
  const solid::Motion there = cases::turn({1, 2, 3}, 0.7);
  solid::Mesh block = cases::block({-10, -20, -2}, {20, 20, 8});
  for (Vector& p : block.vertices) p = there(p) + Vector{1000, 2000, -500};
  const solid::PrincipalAxes found = principal_axes(block);
  EXPECT_NEAR(found.volume, 30 * 40 * 10, 1e-6);
  const Vector centre = there({5, 0, 3}) + Vector{1000, 2000, -500};
  EXPECT_NEAR(norm(found.centre - centre), 0, 1e-9);
  const std::array<Vector, 3> edges{there.turned({0, 0, 1}), there.turned({1, 0, 0}),
                                    there.turned({0, 1, 0})};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(std::abs(dot(found.axes[k], edges[k])), 1, 1e-9);
  EXPECT_NEAR(dot(cross(found.axes[0], found.axes[1]), found.axes[2]), 1, 1e-12);
}

TEST(PrincipalAxes, AVoidCountsAsNoMaterial) {
  solid::Mesh block = cases::block({0, 0, 0}, {10, 10, 10});
  solid::Mesh hollow = cases::block({6, 1, 1}, {9, 9, 9});
  for (auto& [a, b, c] : hollow.triangles) std::swap(b, c);
  cases::append(block, hollow);
  const solid::PrincipalAxes found = principal_axes(block);
  EXPECT_NEAR(found.volume, 1000 - 192, 1e-9);
  EXPECT_NEAR(found.centre.x, (1000 * 5 - 192 * 7.5) / (1000 - 192), 1e-9);
  EXPECT_NEAR(found.centre.y, 5, 1e-9);
}

TEST(PrincipalAxes, NothingIsSaidOfASurfaceWithoutVolume) {
  const solid::PrincipalAxes found = principal_axes(cases::block({1, 1, 1}, {2, 2, 1}));
  EXPECT_EQ(found.volume, 0);
  EXPECT_EQ(found.centre, Vector{});
}

}  // namespace
}  // namespace lekalo::solid_principal_axes_test

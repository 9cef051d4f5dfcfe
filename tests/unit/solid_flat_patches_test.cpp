#include "lekalo/solid/flat_patches.hpp"

#include <gtest/gtest.h>

#include "support/solids.hpp"

namespace lekalo::solid_flat_patches_test {
namespace {

TEST(FlatPatches, ADiscGoesOnAcrossTheDiagonalAndEndsAtTheBend) {
  const solid::Mesh mesh = cases::block({0, 0, 0}, {10, 20, 30});
  const solid::FlatPatches patches(mesh);
  // The first two triangles are the bottom.
  EXPECT_DOUBLE_EQ(patches.disc(0, {5, 10, 0}, 1e-9), 5);
  EXPECT_DOUBLE_EQ(patches.disc(1, {5, 10, 0}, 1e-9), 5);
  EXPECT_DOUBLE_EQ(patches.disc(0, {2, 3, 0}, 1e-9), 2);
  EXPECT_EQ(patches.disc(0, {0, 3, 0}, 1e-9), 0);
}

TEST(FlatPatches, AnEdgeOfFourTrianglesEndsIt) {
  // Two blocks that touch along an edge: the tops of both lie in one plane.
  solid::Mesh both = cases::block({0, 0, 0}, {10, 10, 10});
  cases::append(both, cases::block({10, 10, 0}, {20, 20, 10}));
  const solid::Mesh mesh = closed_mesh(both).value().mesh;
  const solid::FlatPatches patches(mesh);
  EXPECT_DOUBLE_EQ(patches.disc(2, {9, 9, 10}, 1e-9), 1);
}

}  // namespace
}  // namespace lekalo::solid_flat_patches_test

#include "lekalo/solid/symmetry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/solid_cases.hpp"

namespace lekalo::solid_symmetry_test {
namespace {

using solid::Symmetry;
using solid::Vector;

constexpr double kTolerance = 0.01;

/// The numbers of equal turns about the axes, the most first.
std::vector<std::uint32_t> turns_of(const Symmetry& found) {
  std::vector<std::uint32_t> turns;
  for (const solid::SymmetryAxis& axis : found.axes) turns.push_back(axis.turns);
  return turns;
}

solid::Mesh moved(solid::Mesh mesh) {
  solid::Motion there = cases::turn({1, -2, 3}, 0.7);
  there.shift = {100, -40, 7};
  for (Vector& p : mesh.vertices) p = there(p);
  return mesh;
}

/// A prism over an even polygon, whose middle is on the z axis.
solid::Mesh prism(std::uint32_t corners, double radius, double height) {
  return cases::turned({{0, 0}, {radius, 0}, {radius, height}, {0, height}}, corners, 0.3);
}

TEST(Symmetry, ABlockHasThreeHalfTurns) {
  const Symmetry found = symmetry(moved(cases::block({-10, -20, -2}, {20, 20, 8})), kTolerance);
  EXPECT_EQ(found.rotations, 4U);
  EXPECT_EQ(turns_of(found), (std::vector<std::uint32_t>{2, 2, 2}));
  const Vector along = cases::turn({1, -2, 3}, 0.7).turned({1, 0, 0});
  EXPECT_TRUE(std::any_of(found.axes.begin(), found.axes.end(), [&](const solid::SymmetryAxis& axis) {
    return std::abs(dot(axis.direction, along)) > 1 - 1e-9;
  }));
}

TEST(Symmetry, ACubeHasTwentyFourRotations) {
  const Symmetry found = symmetry(moved(cases::block({-5, -5, -5}, {5, 5, 5})), kTolerance);
  EXPECT_EQ(found.rotations, 24U);
  EXPECT_EQ(turns_of(found), (std::vector<std::uint32_t>{4, 4, 4, 3, 3, 3, 3, 2, 2, 2, 2, 2, 2}));
}

TEST(Symmetry, APrismHasItsCornersAndIsTurnedOver) {
  const Symmetry found = symmetry(moved(prism(5, 20, 30)), kTolerance);
  EXPECT_EQ(found.rotations, 10U);
  EXPECT_EQ(turns_of(found), (std::vector<std::uint32_t>{5, 2, 2, 2, 2, 2}));
}

TEST(Symmetry, ATurnedPartWithACollarHasItsAxisAlone) {
  const solid::Mesh part = cases::turned({{0, 0}, {20, 0}, {20, 5}, {10, 5}, {10, 40}, {0, 40}}, 24, 0.1);
  const Symmetry found = symmetry(moved(part), kTolerance);
  EXPECT_EQ(found.rotations, 24U);
  EXPECT_EQ(turns_of(found), (std::vector<std::uint32_t>{24}));
}

TEST(Symmetry, WithinTheToleranceFineFacetsAreRound) {
  const solid::Mesh fine = moved(prism(160, 20, 30));  // 4 um between the facets and the circle
  const Symmetry found = symmetry(fine, kTolerance);
  EXPECT_EQ(found.rotations, 0U);
  EXPECT_EQ(turns_of(found), (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(symmetry(fine, 0.001).rotations, 320U);
}

TEST(Symmetry, WhatIsOffByMoreThanTheToleranceIsNone) {
  const auto with = [](double off) {
    solid::Mesh block = cases::block({-10, -20, -2}, {20, 20, 8});
    for (Vector& p : block.vertices)
      if (p.x > 0) p.y *= 1 + off;
    return symmetry(block, kTolerance).rotations;
  };
  EXPECT_EQ(with(0), 4U);
  EXPECT_EQ(with(0.01), 2U);
  Random random(5);
  EXPECT_EQ(symmetry(cases::convex_in_convex(random, 20, 1).part, kTolerance).rotations, 1U);
  EXPECT_TRUE(symmetry(cases::convex_in_convex(random, 20, 1).part, kTolerance).axes.empty());
}

TEST(Symmetry, NothingIsSaidOfASurfaceWithoutVolume) {
  solid::Mesh inverted = cases::block({0, 0, 0}, {10, 10, 10});
  for (auto& [a, b, c] : inverted.triangles) std::swap(b, c);
  EXPECT_EQ(symmetry(inverted, kTolerance).rotations, 1U);
}

}  // namespace
}  // namespace lekalo::solid_symmetry_test

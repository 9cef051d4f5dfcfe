#include <gtest/gtest.h>

#include <cmath>

#include "lekalo/locate/solid_reference.hpp"
#include "support/solid_brute_force.hpp"
#include "support/solid_cases.hpp"

namespace lekalo::reference_solid_test {
namespace {

using locate::place_solid_axes;
using locate::place_solid_icp;
using locate::SolidFreedom;
using locate::SolidPlacement;
using locate::SolidProblem;
using solid::Vector;

/// An L of unequal legs, whose principal axes are all different.
solid::Mesh angle_piece(double stock) {
  solid::Mesh mesh;
  const double s = stock;
  for (const double z : {-10 - s, 10 + s})
    for (const auto& [x, y] : {std::array{-s, -s},
                               {60 + s, -s},
                               {60 + s, 15 + s},
                               {20 + s, 15 + s},
                               {20 + s, 35 + s},
                               {-s, 35 + s}})
      mesh.vertices.push_back({x, y, z});
  for (std::uint32_t k = 0; k < 6; ++k) {
    const std::uint32_t next = (k + 1) % 6;
    mesh.triangles.push_back({k, next, k + 6});
    mesh.triangles.push_back({next, next + 6, k + 6});
  }
  for (const auto& [a, b, c] : {solid::Triangle{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + 6, b + 6, c + 6});
  }
  return closed_mesh(std::move(mesh)).value().mesh;
}

/// The part is 3 degrees and some millimetres off where it has 1 mm all round.
SolidProblem even_stock() {
  solid::Motion there = cases::turn({1, -2, 2}, 0.05);
  there.shift = {1, -2, 0.5};
  return {cases::moved_back(angle_piece(0), there), angle_piece(1), {}};
}

TEST(PlaceSolidIcp, FindsTheEvenStock) {
  const SolidPlacement found = place_solid_icp(even_stock(), {}).value();
  EXPECT_TRUE(found.inside);
  // Beside corners and edges the nearest plane is one or the other, which moves the pose a little.
  EXPECT_GT(found.clearance, 0.9);
  EXPECT_LT(found.clearance, 1);
  EXPECT_LT(found.work, 100U);
  EXPECT_FALSE(found.contacts.empty());
}

TEST(PlaceSolidAxes, FindTheEvenStock) {
  const SolidPlacement found = place_solid_axes(even_stock(), {}).value();
  EXPECT_TRUE(found.inside);
  EXPECT_GT(found.clearance, 0.7);
  EXPECT_EQ(found.work, 4U);
}

/// Shifted alone, a part that lies askew has no room.
TEST(PlaceSolidIcp, TellsTheTrueClearanceWhereItCutsIn) {
  SolidProblem problem{cases::block({-20, -15, -10}, {20, 15, 10}),
                       cases::block({-20.1, -15.1, -10.1}, {20.1, 15.1, 10.1}),
                       {}};
  problem.part = cases::moved_back(std::move(problem.part), cases::turn({0, 0, 1}, 0.02));
  problem.freedom = SolidFreedom::xyz;
  const SolidPlacement found = place_solid_icp(problem, {}).value();
  EXPECT_FALSE(found.inside);
  EXPECT_EQ(found.clearance, 0);
  problem.freedom = SolidFreedom::six;
  const SolidPlacement turned = place_solid_icp(problem, {}).value();
  ASSERT_TRUE(turned.inside);
  const auto exact =
      static_cast<double>(brute::clearance(problem.part, problem.blank, {}, motion_of(turned.pose)));
  EXPECT_LE(turned.clearance, exact);
  EXPECT_GE(turned.clearance, exact - 1e-9);
}

TEST(PlaceSolidReference, StaysInTheWindowAndLeavesWhatIsLocked) {
  SolidProblem problem = even_stock();
  problem.shift = 0.25;
  for (const auto method : {place_solid_icp, place_solid_axes})
    for (const SolidFreedom freedom : {SolidFreedom::xyz, SolidFreedom::c_xyz, SolidFreedom::six}) {
      problem.freedom = freedom;
      problem.turn = 0.01;
      const SolidPlacement found = method(problem, {}).value();
      const auto [w, x, y, z] = found.pose.quaternion;
      const double most = std::tan(0.005) + 1e-12;
      EXPECT_LE(std::max({std::abs(x), std::abs(y), std::abs(z)}), most * w);
      if (freedom != SolidFreedom::six) {
        EXPECT_EQ(x, 0);
        EXPECT_EQ(y, 0);
      }
      if (freedom == SolidFreedom::xyz) {
        EXPECT_EQ(z, 0);
      }
      const solid::Box box = box_of(problem.part.vertices);
      const Vector middle = 0.5 * (box.low + box.high), moved = motion_of(found.pose)(middle) - middle;
      EXPECT_LE(std::max({std::abs(moved.x), std::abs(moved.y), std::abs(moved.z)}), 0.25 + 1e-12);
    }
}

TEST(PlaceSolidReference, RefusesWhatTheClimbRefuses) {
  SolidProblem problem = even_stock();
  problem.shift = -1;
  for (const auto method : {place_solid_icp, place_solid_axes}) {
    const auto refused = method(problem, {});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, locate::place_solid(problem, {}).error().message);
  }
}

TEST(PlaceSolidAxes, NeedAVolume) {
  const SolidProblem problem{cases::block({0, 0, 0}, {1, 1, 0}), cases::block({0, 0, 0}, {2, 2, 2}), {}};
  const auto refused = place_solid_axes(problem, {});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("a volume"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::reference_solid_test

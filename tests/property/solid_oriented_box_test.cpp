// Boxes along axes of their own: they hold their triangles, are as thin as these are flat, and no two points
// of a pair of them are nearer than their gap.

#include "lekalo/solid/oriented_box.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/cases.hpp"
#include "support/solid_cases.hpp"

namespace lekalo::solid_oriented_box_test {
namespace {

using solid::Motion;
using solid::OrientedBox;
using solid::TriangleTree;
using solid::Vector;

std::array<double, 3> half_widths(const OrientedBox& box) { return {box.half.x, box.half.y, box.half.z}; }

/// A place of the box, each part of it from -1 to 1.
Vector place(const OrientedBox& box, Random& random) {
  Vector p = box.middle;
  for (std::size_t i = 0; i < 3; ++i)
    p = p + std::clamp(random.uniform(-1.5, 1.5), -1.0, 1.0) * half_widths(box)[i] * box.axes[i];
  return p;
}

void expect_across(const OrientedBox& box) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_NEAR(dot(box.axes[i], box.axes[j]), i == j ? 1 : 0, 2e-15) << i << ' ' << j;
}

TEST(OrientedBox, HoldsTheTrianglesOfItsNode) {
  Random random(cases::seed(), 71);
  for (std::size_t i = 0; i < cases::case_count(10); ++i) {
    solid::Mesh mesh = cases::wavy_ball(10, random.uniform(0, 6), [](double, double) { return 0.0; });
    // Some are flattened until nearly all of their triangles are needles.
    const double flat = i % 3 == 0 ? 1 : std::pow(0.1, random.uniform(0, 12));
    const Motion motion = cases::small_motion(random, 3, 100);
    for (Vector& p : mesh.vertices) p = motion({p.x, p.y, flat * p.z});
    const TriangleTree tree(mesh, 1 + static_cast<std::uint32_t>(random.below(4)));
    const solid::OrientedBoxes boxes(tree);
    for (std::uint32_t at = 0; at < tree.nodes().size(); ++at) {
      const OrientedBox& box = boxes.of(tree, at);
      expect_across(box);
      const TriangleTree::Node& node = tree.nodes()[at];
      for (std::uint32_t k = node.begin; k < node.end; ++k)
        for (const Vector p : tree.corners(k))
          for (std::size_t axis = 0; axis < 3; ++axis)
            EXPECT_LE(std::abs(dot(box.axes[axis], p - box.middle)), half_widths(box)[axis] + 1e-12);
      const double thinnest = std::min({box.half.x, box.half.y, box.half.z});
      EXPECT_LT(thinnest, node.end - node.begin == 1 && i % 3 == 0 ? 1e-12 : 100);
    }
  }
}

TEST(OrientedBox, OfTrianglesWithoutAreaHoldsThem) {
  solid::Mesh mesh;
  mesh.vertices = {{1, 2, 3}, {4, 2, 3}, {2.5, 2, 3}, {1e-200, 0, 0}, {0, 1e-200, 0}, {0, 0, 1e-200}};
  mesh.triangles = {{0, 0, 0}, {0, 1, 2}, {0, 1, 1}, {3, 4, 5}};
  const TriangleTree tree(mesh, 1);
  const solid::OrientedBoxes boxes(tree);
  for (std::uint32_t at = 0; at < tree.nodes().size(); ++at) {
    const OrientedBox& box = boxes.of(tree, at);
    expect_across(box);
    const TriangleTree::Node& node = tree.nodes()[at];
    for (std::uint32_t k = node.begin; k < node.end; ++k)
      for (const Vector p : tree.corners(k))
        for (std::size_t axis = 0; axis < 3; ++axis)
          EXPECT_LE(std::abs(dot(box.axes[axis], p - box.middle)), half_widths(box)[axis] + 1e-14);
  }
}

TEST(OrientedBox, NoTwoPointsAreNearerThanTheGap) {
  Random random(cases::seed(), 72);
  std::size_t apart = 0;
  for (std::size_t i = 0; i < cases::case_count(2000); ++i) {
    const auto some = [&] {
      OrientedBox box;
      for (double* half : {&box.half.x, &box.half.y, &box.half.z})
        *half = random.below(4) == 0 ? 0 : random.uniform(0, 4);
      return moved(cases::small_motion(random, 3, 8), box);
    };
    const OrientedBox a = some(), b = some();
    const double gap = std::sqrt(squared_gap(a, b));
    if (gap > 0) ++apart;
    EXPECT_NEAR(gap, std::sqrt(squared_gap(b, a)), 1e-13);
    for (int k = 0; k < 20; ++k) EXPECT_GE(norm(place(a, random) - place(b, random)), gap - 1e-13);
  }
  EXPECT_GT(apart, cases::case_count(2000) / 4);
}

TEST(OrientedBox, PlatesThatFaceEachOtherAreAsFarApartAsTheirPlanes) {
  Random random(cases::seed(), 73);
  for (std::size_t i = 0; i < cases::case_count(100); ++i) {
    OrientedBox a, b;
    a.half = {random.uniform(1, 5), random.uniform(1, 5), 0};
    b.half = {random.uniform(1, 5), random.uniform(1, 5), 0};
    const double height = random.uniform(0.1, 3);
    b = moved(cases::turn({0, 0, 1}, random.uniform(-3, 3)), b);
    b.middle = {random.uniform(-1, 1), random.uniform(-1, 1), height};
    const Motion motion = cases::small_motion(random, 3, 10);
    EXPECT_NEAR(std::sqrt(squared_gap(moved(motion, a), moved(motion, b))), height, 1e-13);
  }
}

}  // namespace
}  // namespace lekalo::solid_oriented_box_test

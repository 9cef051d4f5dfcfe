// The checker's boxes in space, and the tree over them.

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "lekalo/base/random.hpp"
#include "verify/solid/box_tree.hpp"

namespace lekalo::verify::verify_solid_box_test {
namespace {

Box3 cube(double x, double y, double z, double half = 0) {
  return {{x - half, y - half, z - half}, {x + half, y + half, z + half}};
}

TEST(SolidBox, TheGapIsTheDistanceFromBelow) {
  const Box3 origin = cube(0, 0, 0, 1);
  for (const auto& [other, distance] : {std::pair(cube(5, 0, 0, 1), 3.0),
                                        {cube(-5, 0, 0, 1), 3},
                                        {cube(0, 7, 0, 2), 4},
                                        {cube(0, 0, -7, 2), 4},
                                        {cube(5, 7, 1, 1.0), 0},
                                        {cube(5, 6, 0, 1), 5},
                                        {cube(4, -4, 3, 1), 3},
                                        {cube(2, 2, -2, 1), 0},
                                        {cube(2.5, 0, 0, 2), 0}}) {
    const double real = distance != 0 || other.low[0] < 4 ? distance : std::hypot(3, 5);
    for (const double found : {gap(origin, other), gap(other, origin)}) {
      EXPECT_LE(found, real);
      EXPECT_GE(found, real - 1e-14);
    }
  }
}

/// Boxes on a coarse lattice, so that many of them touch.
std::vector<Box3> some(Random& random, std::size_t count) {
  std::vector<Box3> boxes;
  const auto place = [&] { return static_cast<double>(random.below(12)); };
  while (boxes.size() < count) boxes.push_back(cube(place(), place(), place(), 0.5));
  return boxes;
}

TEST(SolidBox, ATreeFindsWhatLookingAtAllFinds) {
  Random random(8);
  for (const std::size_t count : {1U, 2U, 4U, 5U, 9U, 70U}) {
    const std::vector<Box3> mine = some(random, count), its = some(random, 40);
    const BoxTree tree(mine), other(its);
    for (std::size_t k = 0; k < count; ++k)
      EXPECT_EQ(tree.box(static_cast<std::uint32_t>(k)).low, mine[k].low);
    for (const Box3& box : its) {
      std::multiset<std::uint32_t> found, all;
      const auto meets = [&](const Box3& b) { return !(gap(b, box) > 0); };
      for (const Box3& b : mine) EXPECT_EQ(meet(b, box), meets(b));
      tree.visit(meets, [&](std::uint32_t k) { found.insert(k); });
      for (std::uint32_t k = 0; k < count; ++k)
        if (meets(mine[k])) all.insert(k);
      EXPECT_EQ(found, all);
    }
    for (const double limit : {0.0, gap(mine[0], its[0]), 3.0, 100.0}) {
      std::multiset<std::pair<std::uint32_t, std::uint32_t>> found, all;
      tree.visit_pairs(other, limit, [&](std::uint32_t a, std::uint32_t b) { found.emplace(a, b); });
      for (std::uint32_t a = 0; a < count; ++a)
        for (std::uint32_t b = 0; b < its.size(); ++b)
          if (!(gap(mine[a], its[b]) > limit)) all.emplace(a, b);
      EXPECT_EQ(found, all) << count << " " << limit;
    }
  }
}

TEST(SolidBox, LittleIsLookedAt) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // A long row, the other directions of which are wide as well.
    std::vector<Box3> row;
    for (int k = 0; k < 1024; ++k) {
      const int at = k * 389 % 1024;
      Near3 p{0.001 * (k % 7), 0.001 * (k % 5), 0.001 * (k % 3)};
      p[axis] = at;
      row.push_back(cube(p[0], p[1], p[2], 0.25));
    }
    const BoxTree tree(row);
    std::size_t asked = 0, found = 0;
    tree.visit(
        [&](const Box3& box) {
          ++asked;
          return box.low[axis] <= 700 && 700 <= box.high[axis];
        },
        [&](std::uint32_t) { ++found; });
    EXPECT_EQ(found, 1U);
    EXPECT_LT(asked, 40U);
    // The nearest ones of two rows that begin beside each other, and of a row and a box, come first, so that
    // the limit shrinks.
    Near3 tip{};
    tip[axis] = -2;
    std::vector<Box3> other = row;
    for (Box3& box : other) box.low[axis] = -2 - box.low[axis] - 0.5, box.high[axis] = box.low[axis] + 0.5;
    Near3 end = tip;
    end[axis] = 1025;
    for (const std::vector<Box3>& its : {other, std::vector<Box3>{cube(tip[0], tip[1], tip[2], 0.25)},
                                         std::vector<Box3>{cube(end[0], end[1], end[2], 0.25)}})
      for (const bool swapped : {false, true}) {
        const BoxTree second(its);
        double limit = 1e9;
        std::size_t pairs = 0;
        const auto shrink = [&](std::uint32_t a, std::uint32_t b) {
          ++pairs;
          limit = std::min(limit, swapped ? gap(its[a], row[b]) : gap(row[a], its[b]));
        };
        (swapped ? second : tree).visit_pairs(swapped ? tree : second, limit, shrink);
        EXPECT_NEAR(limit, 1.5, 0.01);
        EXPECT_LE(pairs, 16U);
      }
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_box_test

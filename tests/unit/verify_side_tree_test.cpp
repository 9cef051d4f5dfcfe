#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "lekalo/base/random.hpp"
#include "support/cases.hpp"
#include "verify/shape/contour_tree.hpp"
#include "verify/shape/side_tree.hpp"

// The checker's tree over boxes, against all boxes.

namespace lekalo::verify::verify_side_tree_test {
namespace {

Box random_box(Random& random) {
  const double x = 100 * random.uniform(), y = 100 * random.uniform();
  return {x, y, x + 10 * random.uniform(), y + 10 * random.uniform()};
}

TEST(VerifySideTree, FindsWhatMeetsABoxAndWhatOverflowHasSpoiledEverywhere) {
  for (std::size_t n = 0; n < cases::case_count(200); ++n) {
    Random random(cases::seed(), n);
    std::vector<Box> boxes(random.below(60));
    std::set<std::uint32_t> expected;
    const Box asked = random_box(random);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      boxes[i] = random_box(random);
      const bool spoiled = n % 2 == 1 && random.below(3) == 0;
      if (spoiled) boxes[i].high_x = std::numeric_limits<double>::infinity();
      if (spoiled || meet(boxes[i], asked)) expected.insert(i);
    }
    std::vector<std::uint32_t> found;
    SideTree(boxes).visit([&](const Box& box) { return meet(box, asked); },
                          [&](std::uint32_t side) { found.push_back(side); });
    EXPECT_EQ(std::set<std::uint32_t>(found.begin(), found.end()), expected) << "case " << n;
    EXPECT_EQ(found.size(), expected.size()) << "case " << n;
  }
}

Box square_at(double x, double y) { return {x, y, x + 1, y + 1}; }

std::vector<std::uint32_t> order_of(const std::vector<Box>& boxes) {
  std::vector<std::uint32_t> order;
  SideTree(boxes).visit([](const Box&) { return true; }, [&](std::uint32_t side) { order.push_back(side); });
  return order;
}
using Order = std::vector<std::uint32_t>;

TEST(VerifySideTree, HalvesTheLongerWayAndKeepsTheOrderInALeaf) {
  EXPECT_EQ(order_of({square_at(3, 0), square_at(2, 0), square_at(1, 0), square_at(0, 0)}),
            (Order{0, 1, 2, 3}));
  std::vector<Box> row, column, both, tie;
  for (const double k : {5, 2, 7, 0, 3, 6, 1, 4}) {
    row.push_back(square_at(k, 0)), column.push_back(square_at(0, k));
    both.push_back(square_at(k, 7 - k)), tie.push_back(square_at(0, 0));
  }
  const Order lower{1, 3, 4, 6, 0, 2, 5, 7};
  EXPECT_EQ(order_of(row), lower);
  EXPECT_EQ(order_of(column), lower);
  EXPECT_EQ(order_of(both), lower) << "as wide as high: by x";
  EXPECT_EQ(order_of(tie), (Order{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(VerifySideTree, VisitsWhatIsWithinTheLimitTheNearerHalfFirst) {
  std::vector<Box> boxes;
  for (const double k : {-12, -11, -10, -9, 9, 10, 11, 12}) boxes.push_back(square_at(k, 0));
  const SideTree tree(boxes);
  const auto near = [&](const Box& from, double limit) {
    Order order;
    tree.visit_near(from, limit,
                    [&](std::size_t side) { order.push_back(static_cast<std::uint32_t>(side)); });
    return order;
  };
  const Box middle{0, 0, 1, 1};
  const double gap_left = gap(middle, boxes[3]), gap_right = gap(middle, boxes[4]);
  EXPECT_EQ(gap_left, gap_right);
  EXPECT_EQ(near(middle, gap_left), (Order{3, 4})) << "the bound itself counts, and the first half";
  EXPECT_EQ(near(middle, step_down(gap_left)), Order{});
  EXPECT_EQ(near({2, 0, 3, 1}, 1e9), (Order{4, 5, 6, 7, 0, 1, 2, 3}));
  EXPECT_EQ(near({-2, 0, -1, 1}, 1e9), (Order{0, 1, 2, 3, 4, 5, 6, 7}));
  // The limit shrinks on the way.
  double limit = 1e9;
  std::size_t looked = 0;
  tree.visit_near(middle, limit,
                  [&](std::size_t side) { ++looked, limit = std::min(limit, gap(middle, boxes[side])); });
  EXPECT_LT(looked, 8U);
}

TEST(VerifySideTree, GapsOfBoxesAreNotAboveTheirDistance) {
  for (const auto& [box, distance] : std::vector<std::pair<Box, double>>{{{0, 0, 1, 1}, 0},
                                                                         {{4, 0, 5, 1}, 3},
                                                                         {{-5, 0, -4, 1}, 4},
                                                                         {{0, 6, 1, 7}, 5},
                                                                         {{0, -3, 1, -2}, 2},
                                                                         {{4, 5, 5, 6}, 5},
                                                                         {{-4, -3, -3, -4}, 5}}) {
    EXPECT_LE(gap({0, 0, 1, 1}, box), distance);
    EXPECT_GE(gap({0, 0, 1, 1}, box), distance - 1e-14);
  }
}

TEST(VerifySideTree, BoxesThatTouchAreNotApart) {
  const Box a{0, 0, 1, 1};
  for (const auto& [x, y] : {std::pair{1, 0}, {0, 1}, {1, 1}, {0, 0}})
    for (const int sign : {1, -1}) {
      EXPECT_FALSE(surely_apart(a, square_at(sign * x, sign * y)));
      EXPECT_TRUE(meet(a, square_at(sign * x, sign * y)));
    }
  for (const auto& [x, y] : {std::pair{2, 0}, {0, 2}, {-2, 0}, {0, -2}}) {
    EXPECT_TRUE(surely_apart(a, square_at(x, y)));
    EXPECT_FALSE(meet(a, square_at(x, y)));
  }
}

TEST(VerifySideTree, AContourIsFewChainsBesideAPoint) {
  std::vector<Box> boxes;
  for (const double k : {0, 2, 4, 6}) boxes.push_back(square_at(k, 0));
  const ContourTree tree(SideTree(boxes), {0, 4});
  std::vector<std::pair<std::size_t, std::size_t>> chains;
  const auto chains_at = [&](double x) {
    chains.clear();
    tree.visit_chains(0, square_at(x, 0), [&](std::size_t first, std::size_t last) {
      chains.emplace_back(first, last);
      return true;
    });
    return chains;
  };
  using Chains = std::vector<std::pair<std::size_t, std::size_t>>;
  EXPECT_EQ(chains_at(20), (Chains{{0, 3}}));
  EXPECT_EQ(chains_at(0), (Chains{{0, 0}, {1, 1}, {2, 3}}));
}

}  // namespace
}  // namespace lekalo::verify::verify_side_tree_test

// Contacts of a certificate prove no more of a part that is grown, or has rims taken off, than is true.

#include "verify/locate/cover_tree.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "verify/locate/cover_bound.hpp"
#include "verify/shape/shape_inside.hpp"

namespace lekalo::verify::verify_cover_tree_test {
namespace {

Shape square(double from, double to) {
  const std::string text = fmt::format(
      R"({{"outer": [{{"line": {{"from": [{0}, {0}], "to": [{1}, {0}]}}}}, {{"line": {{"from": [{1}, {0}], "to": [{1}, {1}]}}}}, )"
      R"({{"line": {{"from": [{1}, {1}], "to": [{0}, {1}]}}}}, {{"line": {{"from": [{0}, {1}], "to": [{0}, {0}]}}}}]}})",
      from, to);
  std::string complaint;
  Shape read = read_shape(*parse_json(text, "shape"), "shape", complaint);
  EXPECT_EQ(complaint, "");
  return read;
}

/// Says whether one contact proves the bound for a square of 10 that lies in the lower left corner of one of
/// 100.
bool proves(const std::string& contact, double bound, const std::vector<double>& growth) {
  const Shape part = square(0, 10), blank = square(0, 100);
  const Vec origin{just(0), just(0)};
  const CoverTree::Problem problem{part,      blank,     origin,    0,      bound, Decimal{},
                                   Decimal{}, Decimal{}, Decimal{}, growth, {}};
  std::vector<std::string> findings;
  std::string complaint;
  const std::string tree = fmt::format(
      R"({{"mirrored": false, "theta": [0, 0], "x": [0, 0], "y": [0, 0], "nodes": [{{"contacts": [{}]}}]}})",
      contact);
  CoverTree(problem, findings).check(*parse_json(tree, "tree"), "tree", complaint);
  EXPECT_EQ(complaint, "");
  return findings.empty();
}

TEST(CoverTree, AMinimumThatReachesOverTheEdgeBesideItIsMissing) {
  // The upper side grows by 15, over the lower one and 5 beyond it, so that 5 are missing there.
  const std::vector<double> growth{0, 0, 15, 0};
  EXPECT_TRUE(proves("[5, 5, 10, 5, -1000, 1000, 1]", -5 + 1e-9, growth));
  EXPECT_FALSE(proves("[5, 5, 10, 5, -1000, 1000, 1]", -5 - 1e-9, growth));
  EXPECT_FALSE(proves("[5, 5, 11, 5, -1000, 1000, 1]", -5.5, growth));
}

/// Its ball once counted as one of radius 0, and so as a point of the part.
TEST(CoverTree, APlaceThatIsInNoGrowthIsNoPointOfThePart) {
  EXPECT_FALSE(proves("[5, -500, 3, 5, -1000, 1000, 1]", -400, {0, 0, 15, 0}));
  EXPECT_FALSE(proves("[5, -500, 0, 5, -1000, 1000, 1]", -400, {0, 0, 15, 0}));
}

/// Where two rims of 1 mm meet in a corner, the material behind them is further from the corner than either
/// is wide, and the corner once counted as 1 mm off it.
TEST(CoverTree, TheMaterialBehindTwoRimsIsFurtherThanEitherIsWide) {
  const std::vector<double> rims{-1, -1, -1, -1};
  const std::string corner = "[0, 0, 0, -1000, -1000, 1414.2135623730950, 1]";
  EXPECT_FALSE(proves(corner, 1.2, rims));
  EXPECT_TRUE(proves(corner, 2.3, rims));
  const std::string behind = "[0.9999999999, 0.9999999999, 0, -1000, -1000, 1414.2135623730950, 1]";
  EXPECT_FALSE(proves(behind, 1.41421356, rims));
  EXPECT_TRUE(proves(behind, 1.41421357, rims));
}

/// A square of 10 in one of 100, with a tree of one cell.
struct Tree {
  Shape part = square(0, 10), blank = square(0, 100);
  double bound = 0, pivot_off = 0;
  Decimal window_from, window_to;
  std::optional<Decimal> locked_x, locked_y;
  std::vector<double> growth = {};
  std::vector<CoverTree::Cap> caps = {};
  std::string theta = "[0, 0]", x = "[0, 0]", y = "[0, 0]", mirrored = "false";
  std::string nodes = R"([{"contacts": [[5, 5, 5, 5, -1000, 1000, 1]]}])";

  /// Returns the complaint, or the findings, each with a line.
  [[nodiscard]] std::string found() const {
    const CoverTree::Problem problem{part,      blank,    {just(0), just(0)}, pivot_off, bound, window_from,
                                     window_to, locked_x, locked_y,           growth,    caps};
    std::vector<std::string> findings;
    std::string complaint;
    const std::string tree = fmt::format(R"({{"mirrored": {}, "theta": {}, "x": {}, "y": {}, "nodes": {}}})",
                                         mirrored, theta, x, y, nodes);
    CoverTree(problem, findings).check(*parse_json(tree, "tree"), "tree", complaint);
    if (!complaint.empty()) return complaint;
    std::string all;
    for (const std::string& finding : findings) all += finding + "\n";
    return all;
  }
  [[nodiscard]] bool has(const std::string& words) const { return found().find(words) != std::string::npos; }
  [[nodiscard]] bool fails_to_prove() const { return has("its contacts do not prove"); }
};

Tree with_contact(const std::string& contact, double bound = 0) {
  Tree tree;
  tree.nodes = R"([{"contacts": [)" + contact + "]}]";
  tree.bound = bound;
  return tree;
}

TEST(CoverTree, WhatIsNoTreeIsRefused) {
  const auto nodes = [](const std::string& list) {
    Tree tree;
    tree.nodes = list;
    return tree.found();
  };
  const std::string neither = "tree.nodes[0] is neither a split nor a leaf";
  for (const char* split : {R"([["x"]])", R"([["x", 1, 2]])", "[[]]", "[[5, 1]]", R"([["z", 1]])"})
    EXPECT_EQ(nodes(split), neither) << split;
  EXPECT_EQ(nodes(R"([["x", "1"]])").find("field tree.nodes[0] is"), 0U) << nodes(R"([["x", "1"]])");
  EXPECT_EQ(nodes("5"), "tree.nodes is not a list");
  EXPECT_EQ(nodes(R"([{"contacts": [[5, 5, 5, 5, -1000, 1000, 1]], "more": 1}])"),
            "tree.nodes[0] has more than its contacts");
  EXPECT_EQ(nodes(R"([{"contacts": 5}])"), "tree.nodes[0]: it has no list of contacts");
  std::string nine = "[5, 5, 5, 5, -1000, 1000, 1]";
  for (int k = 0; k < 7; ++k) nine += ", [5, 5, 5, 5, -1000, 1000, 1]";
  EXPECT_EQ(with_contact(nine, 1).found().find("eight"), std::string::npos);
  EXPECT_EQ(with_contact(nine + ", [5, 5, 5, 5, -1000, 1000, 1]").found(),
            "tree.nodes[0]: it has more than eight contacts");
  for (const auto& [contact, told] : std::vector<std::pair<std::string, std::string>>{
           {"5", "a contact is not a list"},
           {"[5, 5, 5, 5, -1000, 1000]", "a contact is not seven numbers"},
           {R"([5, 5, 5, 5, "5", 1000, 1])", "a contact is not seven numbers"},
           {"[5, 5, 5, 5, -1000, 1000, null]", "a contact is not seven numbers"},
           {"[5, 5, -1, 5, -1000, 1000, 1]", "a radius or a multiplier is negative"},
           {"[5, 5, 5, 5, -1000, -1, 1]", "a radius or a multiplier is negative"},
           {"[5, 5, 5, 5, -1000, 1000, -1]", "a radius or a multiplier is negative"},
           {"[1000000000001, 5, 5, 5, -1000, 1000, 1]", "a contact is beyond all bounds"},
           {"[5, 5, 5, 5, -1000000000001, 1000, 1]", "a contact is beyond all bounds"},
           {"[5, 5, 5, 5, -1000, 1000, 1, 0]", "a contact names no cap of the demands"},
           {"[5, 5, 5, 5, -1000, 1000, 0]", "its multipliers sum to nothing"}})
    EXPECT_EQ(with_contact(contact).found(), "tree.nodes[0]: " + told) << contact;
  // The largest numbers that may be there.
  EXPECT_FALSE(with_contact("[-1000000000000, 1000000000000, 0, 5, -1000, 1000, 1]").has("beyond"));

  const auto range = [](const std::string& x) {
    Tree tree;
    tree.x = x;
    return tree.found();
  };
  EXPECT_EQ(range("[0]"), "tree.x is not two numbers");
  EXPECT_EQ(range("[0, 1, 2]"), "tree.x is not two numbers");
  EXPECT_EQ(range("[0, 1000000000001]"), "tree.x is beyond 1000000000000");
  EXPECT_EQ(range("[-1000000000001, 0]"), "tree.x is beyond 1000000000000");
  EXPECT_EQ(range("[-1000000000000, 1000000000000]").find("beyond"), std::string::npos);
}

TEST(CoverTree, LeavesThatProveTooLittleAreNamedThreeTimes) {
  Tree tree;
  tree.theta = "[0.25, 0.5]", tree.x = "[1, 2]", tree.y = "[3, 4]", tree.bound = -5;
  EXPECT_TRUE(tree.has(
      "tree.nodes[0]: its contacts do not prove that no placement with theta 0.25 to 0.5 and the pivot "
      "at x 1 to 2, y 3 to 4 has more clearance than -5 mm"))
      << tree.found();
  const std::string leaf = R"({"contacts": [[5, 5, 5, 5, -1000, 1000, 1]]})";
  tree.nodes = fmt::format(R"([["x", 1.5], ["y", 3.5], ["theta", 0.375], {0}, {0}, {0}, {0}])", leaf);
  const std::string all = tree.found();
  for (const int node : {3, 4, 5})
    EXPECT_TRUE(tree.has(fmt::format("tree.nodes[{}]: its contacts", node))) << all;
  EXPECT_FALSE(tree.has("tree.nodes[6]")) << all;
  EXPECT_TRUE(tree.has("theta 0.25 to 0.375 and the pivot at x 1 to 1.5, y 3 to 3.5 has")) << all;
  EXPECT_TRUE(tree.has("theta 0.375 to 0.5 and the pivot at x 1 to 1.5, y 3 to 3.5 has")) << all;
}

TEST(CoverTree, TheRootHoldsTheWindowAndTheBlank) {
  const std::string window = "does not cover the window",
                    box = "the box of the pivot does not cover the blank";
  Tree tree;
  tree.blank = square(-8, 8);
  // The next doubles beyond the blank are enough.
  tree.x = tree.y = "[-8.0000000000000017, 8.0000000000000017]";
  EXPECT_FALSE(tree.has(box)) << tree.found();
  EXPECT_FALSE(tree.has(window)) << tree.found();
  for (const char* range : {"[-8, 8.0000000000000017]", "[-8.0000000000000017, 8]"}) {
    Tree small = tree;
    small.x = range;
    EXPECT_TRUE(small.has(box)) << range;
    small = tree;
    small.y = range;
    EXPECT_TRUE(small.has(box)) << range;
  }
  tree.pivot_off = 1;
  EXPECT_TRUE(tree.has(box));
  tree.pivot_off = 0, tree.bound = -1;
  EXPECT_TRUE(tree.has(box));
  // What is locked is all that the root has to hold.
  tree.locked_x = Decimal{1, 0}, tree.bound = 0;
  for (const auto& [range, holds] : {std::pair{"[1, 1]", true},
                                     {"[1, 2]", true},
                                     {"[0, 1]", true},
                                     {"[2, 3]", false},
                                     {"[0, 0]", false}}) {
    tree.x = range;
    EXPECT_EQ(tree.has(box), !holds) << range;
  }
  const auto turned = [&](const std::string& theta, long from, long to) {
    Tree other;
    other.theta = theta, other.x = "[1, 2]", other.window_from = Decimal{from, 0},
    other.window_to = Decimal{to, 0};
    return other.found();
  };
  // A full turn holds every window, and the next double above it is the least one.
  EXPECT_EQ(turned("[0, 6.283185307179587]", 10, 370).find(window), std::string::npos);
  EXPECT_NE(turned("[0, 6.283185307179586]", 10, 370)
                .find("tree: theta from 0 to 6.283185307179586 does not cover the window"),
            std::string::npos)
      << turned("[0, 6.283185307179586]", 10, 370);
  EXPECT_EQ(turned("[0, 1.5707963267948967]", 0, 90).find(window), std::string::npos);
  EXPECT_NE(turned("[0, 1.5707963267948965]", 0, 90).find(window), std::string::npos);
  EXPECT_NE(turned("[0.0000000001, 1.6]", 0, 90).find(window), std::string::npos);
}

/// A point of the lower side, which lies on the blank's outline, in a ball of the blank's material.
TEST(CoverTree, ACapHasLeftWhatItsPointIsNotDeep) {
  const auto fails = [](const std::string& contact, double bound, std::vector<std::size_t> sides = {0}) {
    Tree tree = with_contact(contact, bound);
    tree.x = "[45, 45]", tree.caps = {{std::move(sides), 1}};
    return tree.found();
  };
  const auto proves = [&](const std::string& contact, double bound, std::vector<std::size_t> sides = {0}) {
    return fails(contact, bound, std::move(sides)).find("do not prove") == std::string::npos;
  };
  const std::string point = "[5, 0, 0, 50, 50, 50, 1, 0]";
  EXPECT_TRUE(proves(point, 1 + 1e-9));
  EXPECT_FALSE(proves(point, 1 - 1e-9));
  // The ball counts as far as it is material, and no further than it is written.
  EXPECT_FALSE(proves("[5, 0, 0, 50, 50, 60, 1, 0]", 1 - 1e-9));
  EXPECT_TRUE(proves("[5, 0, 0, 50, 50, 60, 1, 0]", 1 + 1e-9));
  EXPECT_TRUE(proves("[5, 0, 0, 50, 50, 49, 1, 0]", 2 + 1e-9));
  EXPECT_FALSE(proves("[5, 0, 0, 50, 50, 49, 1, 0]", 2 - 1e-9));
  // The same ball twice, and one beside it.
  EXPECT_TRUE(proves(point + ", " + point + ", [5, 0, 0, 50, 40, 40, 1, 0]", 1 + 1e-9));
  // A point beside the side is off it, and of several sides the nearest counts.
  EXPECT_TRUE(proves("[5, -2, 0, 50, 50, 50, 1, 0]", 5 + 1e-9));
  EXPECT_FALSE(proves("[5, -2, 0, 50, 50, 50, 1, 0]", 5 - 1e-9));
  EXPECT_TRUE(proves("[5, -2, 0, 50, 50, 50, 1, 0]", 5 + 1e-9, {0, 2}));
  EXPECT_TRUE(proves("[5, -2, 0, 50, 50, 50, 1, 0]", 5 + 1e-9, {2, 0}));
  for (const char* cap : {"-1", "1", "0.5", "\"0\"", "null", "1e300"})
    EXPECT_EQ(fails(fmt::format("[5, 0, 0, 50, 50, 50, 1, {}]", cap), 2),
              "tree.nodes[0]: a contact names no cap of the demands")
        << cap;
  EXPECT_EQ(fails("[5, 0, 0, 50, 50, 50, 1, 0, 0]", 2),
            "tree.nodes[0]: a contact has more than eight numbers");
}

/// Growing a part joins what is 2^-39 of its coordinates apart, here 1.8e-11 mm.
TEST(CoverTree, AGrownPartIsTakenToHaveWhatJoinsIt) {
  constexpr double kJoined = 10 * 0x1p-39 * (1 - 0x1p-10);
  EXPECT_TRUE(proves("[5, 5, 6, 5, -1000, 1000, 1]", -1 + 1.3 * kJoined, {1, 1, 1, 1}));
  EXPECT_FALSE(proves("[5, 5, 6, 5, -1000, 1000, 1]", -1 + 0.7 * kJoined, {1, 1, 1, 1}));
  // The widest growth counts where it is larger than the coordinates.
  EXPECT_TRUE(proves("[5, 5, 25, 5, -1000, 1000, 1]", -20 + 2.3 * kJoined, {20, 20, 20, 20}));
  EXPECT_FALSE(proves("[5, 5, 25, 5, -1000, 1000, 1]", -20 + 1.7 * kJoined, {20, 20, 20, 20}));
  // Nothing is joined where nothing is grown, and no side that is not.
  EXPECT_TRUE(proves("[5, 5, 5, 5, -1000, 1000, 1]", 5e-12, {0, 0, 0, 0}));
  EXPECT_TRUE(proves("[9, 5, 1.5, 9, -1000, 1000, 1]", 4 + 1.3 * kJoined, {1, 0, 0, 0}));
  EXPECT_FALSE(proves("[9, 5, 1.5, 9, -1000, 1000, 1]", 4 + 0.7 * kJoined, {1, 0, 0, 0}));
}

/// A ball counts as far as it is material of the part, or none of the blank's, and no further than written.
TEST(CoverTree, BallsAreNoLargerThanTheyAreFoundAndWritten) {
  EXPECT_TRUE(proves("[5, 5, 9, 5, -10, 20, 1]", 1e-9, {}));
  EXPECT_FALSE(proves("[5, 5, 9, 5, -10, 20, 1]", -1e-9, {}));
  EXPECT_TRUE(proves("[5, 5, 4, 5, -10, 9, 1]", 2 + 1e-9, {}));
  EXPECT_FALSE(proves("[5, 5, 4, 5, -10, 9, 1]", 2 - 1e-9, {}));
  // A centre beside the part is as far from it as from its nearest side.
  for (const std::vector<double>& growth : {std::vector<double>{}, {0, 0, 0, 0}}) {
    EXPECT_TRUE(proves("[5, -2, 0, 5, -1000, 1000, 1]", 1e-9, growth));
    EXPECT_FALSE(proves("[5, -2, 0, 5, -1000, 1000, 1]", -1e-9, growth));
  }
  // Where one side's growth covers the side beside it the ball reaches to where both end, the root of 5.
  EXPECT_TRUE(proves("[1, 9, 2.2, 1, -1000, 1000, 1]", 6.8 + 1e-9, {0, 0, 3, 0}));
  EXPECT_FALSE(proves("[1, 9, 2.3, 1, -1000, 1000, 1]", 6.75, {0, 0, 3, 0}));
  // In a rim about a corner the material is further off than either of the rims is left.
  const std::vector<double> rims{-1, -1, -1, -1};
  EXPECT_FALSE(proves("[0.5, 0.5, 0, -1000, -1000, 1414.2135623730950, 1]", 1.3, rims));
  EXPECT_TRUE(proves("[0.5, 0.5, 0, -1000, -1000, 1414.2135623730950, 1]", 1.415, rims));
  for (std::size_t k = 0; k < 4; ++k) {
    std::vector<double> one(4, 0);
    one[k] = -1;
    const Vec c{just(k == 1 ? 9.5 : k == 3 ? 0.5 : 5), just(k == 0 ? 0.5 : k == 2 ? 9.5 : 5)};
    const std::string contact = fmt::format("[{0}, {1}, 0, {0}, -1000, 1000, 1]", c.x.low, c.y.low);
    EXPECT_TRUE(proves(contact, c.y.low + 0.5 + 1e-9, one)) << k;
    EXPECT_FALSE(proves(contact, c.y.low + 0.5 - 1e-9, one)) << k;
  }
}

/// What a cell proves is what bound_over says of its balls, to the last place.
TEST(CoverTree, ABoundIsProvedToTheLastPlace) {
  const Shape blank = square(0, 100);
  BallTerm term;
  term.part = {just(5), just(5)}, term.blank = {just(5), just(-1000)}, term.multiplier = just(1);
  term.part_radius = 3, term.blank_radius = -signed_distance(term.blank, blank).high;
  const PoseCell here{{0, 0, 0}, {0, 0, 0}};
  const double least = bound_over(here, {term}).everywhere;
  EXPECT_NEAR(least, 2, 1e-11);
  for (const std::vector<double>& growth : {std::vector<double>{}, {0, 0, 0, 0}}) {
    EXPECT_TRUE(proves("[5, 5, 3, 5, -1000, 2000, 1]", least, growth));
    EXPECT_FALSE(proves("[5, 5, 3, 5, -1000, 2000, 1]", std::nextafter(least, 0), growth));
  }
}

/// Where the distance bends across the way that it grows, a cell proves more the smaller it is: 18 halvings
/// are made.
TEST(CoverTree, ACellIsHalvedEighteenTimes) {
  Tree tree = with_contact("[5, 5, 5, -700, -700, 1000, 1]");
  tree.x = tree.y = "[-1, 1]";
  const double most = 6 * std::sqrt(2) - 5;
  tree.bound = most + 4.5e-9;
  EXPECT_FALSE(tree.fails_to_prove());
  tree.bound = most + 3e-9;
  EXPECT_TRUE(tree.fails_to_prove());
  // Both halves have to be proved.
  tree = with_contact("[5, 5, 5, 5, -1000, 1000, 1]", 0.6);
  tree.y = "[0, 1]";
  EXPECT_TRUE(tree.fails_to_prove());
  tree.nodes = R"([{"contacts": [[5, 5, 5, 5, 1000, 900, 1]]}])", tree.bound = 89.6;
  EXPECT_TRUE(tree.fails_to_prove());
  tree.bound = 90.1;
  EXPECT_FALSE(tree.fails_to_prove());
}

TEST(CoverTree, TheBoundOfACellIsThatOfItsTerms) {
  const auto bound = [](const PoseCell& cell, double x, double to) {
    BallTerm term;
    term.part = {just(x), just(0)}, term.blank = {just(to), just(0)}, term.multiplier = just(1);
    return bound_over(cell, {term}).everywhere;
  };
  // About the other ball's centre, along either axis.
  EXPECT_NEAR(bound({{0, -1, 0}, {0, 1, 0}}, 5, 5), 1, 1e-12);
  EXPECT_NEAR(bound({{0, 0, -1}, {0, 0, 1}}, 5, 5), 1, 1e-12);
  // Turning by 0.1 about a pivot at 10: what is across, and the terms of second and third order along it.
  const double across = (10 * 0.1 + 0.05) * (10 * 0.1 + 0.05) / (2 * (10 - 0.05)), third = 0.001 * 10 / 6;
  EXPECT_NEAR(bound({{-0.1, 0, 0}, {0.1, 0, 0}}, 10, 0), 10 + across + third, 1e-9);
  EXPECT_NEAR(bound({{-0.1, 20, 0}, {0.1, 20, 0}}, -10, 0), 10 + across + third + 0.5 * 0.01 * 10, 1e-9);
}

}  // namespace
}  // namespace lekalo::verify::verify_cover_tree_test

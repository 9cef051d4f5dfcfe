#include "verify/origin/tree_check.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <array>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "verify/origin/tree.hpp"
#include "verify/read/json.hpp"

/// The outline of a region is held against a tree: it runs along sides of primitives, or there is a sentence.
namespace lekalo::verify::verify_tree_check_test {
namespace {

std::string rectangle(double x0, double y0, double x1, double y1) {
  return fmt::format(R"({{"rectangle": {{"corner": [{}, {}], "size": [{}, {}]}}}})", x0, y0, x1 - x0,
                     y1 - y0);
}
std::string disc(double x, double y, double radius) {
  return fmt::format(R"({{"circle": {{"centre": [{}, {}], "radius": {}}}}})", x, y, radius);
}
/// The half-plane is to the left of the line.
std::string half_plane(double x0, double y0, double x1, double y1) {
  return fmt::format(R"({{"half_plane": {{"from": [{}, {}], "to": [{}, {}]}}}})", x0, y0, x1, y1);
}
std::string combined(const std::string& word, const std::vector<std::string>& shapes) {
  return fmt::format(R"({{"{}": [{}]}})", word, fmt::join(shapes, ", "));
}
std::string unite(const std::vector<std::string>& shapes) { return combined("union", shapes); }
std::string intersect(const std::vector<std::string>& shapes) { return combined("intersection", shapes); }
std::string less(const std::vector<std::string>& shapes) { return combined("difference", shapes); }

using Place = std::array<double, 2>;
std::string line(const Place& a, const Place& b) {
  return fmt::format(R"({{"line": {{"from": [{}, {}], "to": [{}, {}]}}}})", a[0], a[1], b[0], b[1]);
}
std::string arc(const Place& a, const Place& b, const Place& c, bool ccw = true) {
  return fmt::format(R"({{"arc": {{"from": [{}, {}], "to": [{}, {}], "centre": [{}, {}], "ccw": {}}}}})",
                     a[0], a[1], b[0], b[1], c[0], c[1], ccw);
}
std::string polygon(const std::vector<Place>& p) {
  std::vector<std::string> edges;
  for (std::size_t k = 0; k < p.size(); ++k) edges.push_back(line(p[k], p[(k + 1) % p.size()]));
  return fmt::format("{}", fmt::join(edges, ", "));
}
std::string box(double x0, double y0, double x1, double y1) {
  return polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}
std::string circle(double x, double y, double radius, bool ccw = true) {
  return arc({x + radius, y}, {x + radius, y}, {x, y}, ccw);
}

/// Says what is wrong or open with a region of these edges and at most one hole; where nothing is, the
/// numbers of the primitives and their sides along which each of its edges runs.
std::string told(const std::string& shape, const std::string& outer, const std::string& hole, double reach) {
  const std::string region =
      fmt::format(R"({{"outer": [{}]{}}})", outer, hole.empty() ? "" : R"(, "holes": [[)" + hole + "]]");
  std::string complaint;
  const Tree tree = read_tree(*parse_json(shape, "t.json"), LengthUnit::millimetre, complaint);
  const Shape used = read_shape(*parse_json(region, "r.json"), "r.json", complaint, false);
  if (!complaint.empty()) return complaint;
  const TreeVerdict verdict = check_tree(tree, used, reach);
  if (!verdict.fault.empty()) return verdict.fault;
  if (!verdict.open.empty()) return "open: " + verdict.open;
  std::string text;
  for (const auto& sides : verdict.along) {
    text += text.empty() ? "" : " |";
    for (const auto& [primitive, side] : sides) text += fmt::format(" {}.{}", primitive, side);
  }
  return text;
}
std::string told(const std::string& shape, const std::string& outer) { return told(shape, outer, "", 1e-6); }

const std::string kSquare = rectangle(0, 0, 10, 10), kSquareBox = box(0, 0, 10, 10);

TEST(VerifyTreeCheck, EveryEdgeRunsAlongItsSides) {
  const Place low{3, -4}, high{3, 4};
  const std::string left = disc(0, 0, 5), right = disc(6, 0, 5);
  EXPECT_EQ(told(intersect({left, half_plane(3, 0, 3, 5)}), arc(high, low, {0, 0}) + ", " + line(low, high)),
            " 0.0 | 1.0");
  EXPECT_EQ(told(intersect({left, half_plane(3, 5, 3, 0)}), arc(low, high, {0, 0}) + ", " + line(high, low)),
            " 0.0 | 1.0");
  EXPECT_EQ(told(intersect({left, right}), arc(low, high, {0, 0}) + ", " + arc(high, low, {6, 0})),
            " 0.0 | 1.0");
  EXPECT_EQ(told(unite({left, right}), arc(high, low, {0, 0}) + ", " + arc(low, high, {6, 0})), " 0.0 | 1.0");
  EXPECT_EQ(told(less({left, right}), arc(high, low, {0, 0}) + ", " + arc(low, high, {6, 0}, false)),
            " 0.0 | 1.0");
  EXPECT_EQ(told(less({left, disc(0, 0, 3)}), circle(0, 0, 5), circle(0, 0, 3, false), 1e-6), " 0.0 | 1.0");
  EXPECT_EQ(told(intersect({kSquare, half_plane(6, 0, 6, 10), half_plane(0, 2, 10, 2)}), box(0, 2, 6, 10)),
            " 2.0 | 1.0 | 0.2 | 0.3");
  EXPECT_EQ(told(intersect({kSquare, half_plane(6, 0, 6, 10), half_plane(0, 1, 4, 4)}),
                 polygon({{0, 1}, {6, 5.5}, {6, 10}, {0, 10}})),
            " 2.0 | 1.0 | 0.2 | 0.3");
  EXPECT_EQ(told(intersect({rectangle(0, 0, 1000, 1), half_plane(300, 0, 301, 1)}),
                 polygon({{0, 0}, {300, 0}, {301, 1}, {0, 1}})),
            " 0.0 | 1.0 | 0.2 | 0.3");
  const std::vector<Place> cross{{0, -2}, {3, -2}, {3, -5}, {5, -5}, {5, -2}, {10, -2},
                                 {10, 2}, {5, 2},  {5, 5},  {3, 5},  {3, 2},  {0, 2}};
  std::string edges;
  for (std::size_t k = 0; k < cross.size(); ++k) {
    const Place &a = cross[k], &b = cross[(k + 1) % cross.size()];
    edges += (k > 0 ? ", " : "") + (k == 5 ? arc(a, b, {10, 0}) : k == 11 ? arc(a, b, {0, 0}) : line(a, b));
  }
  EXPECT_EQ(told(unite({R"({"slot": {"from": [0, 0], "to": [10, 0], "width": 4}})", rectangle(3, -5, 5, 5)}),
                 edges),
            " 0.0 | 1.3 | 1.0 | 1.1 | 0.0 | 0.1 | 0.2 | 1.1 | 1.2 | 1.3 | 0.2 | 0.3");
}

TEST(VerifyTreeCheck, ASideIsCutWhereEdgesMeetIt) {
  const std::string tree = less({kSquare, rectangle(2, -1, 3, 1), rectangle(6, -1, 7, 1)});
  EXPECT_EQ(told(tree, polygon({{0, 0},
                                {2, 0},
                                {2, 1},
                                {3, 1},
                                {3, 0},
                                {6, 0},
                                {6, 1},
                                {7, 1},
                                {7, 0},
                                {10, 0},
                                {10, 10},
                                {0, 10}})),
            " 0.0 | 1.3 | 1.2 | 1.1 | 0.0 | 2.3 | 2.2 | 2.1 | 0.0 | 0.1 | 0.2 | 0.3");
  EXPECT_EQ(told(tree, polygon({{0, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 0}, {10, 0}, {10, 10}, {0, 10}})),
            "its material about (3, 0) is not that of the tree");
}

/// The stretches beside the place where they touch are told from the circle by their ends, because the line
/// through them is hardly known at its centre.
TEST(VerifyTreeCheck, ACircleMayTouchALine) {
  EXPECT_EQ(told(less({rectangle(-10, -8, 10, -3), disc(0, 0, 3)}), box(-10, -8, 10, -3), "", 1e-8),
            " 0.0 | 0.1 | 0.2 | 0.3");
}

TEST(VerifyTreeCheck, MaterialOnTheWrongHandIsToldByTheFirstEdgeThatHasIt) {
  const auto about = [](const char* place) {
    return fmt::format("its material about {} is not that of the tree", place);
  };
  // It is outside the edge at 10, beside its first or its second half.
  EXPECT_EQ(told(unite({kSquare, rectangle(10, 0, 15, 5)}), kSquareBox), about("(10, 0)"));
  EXPECT_EQ(told(unite({kSquare, rectangle(10, 5, 15, 10)}), kSquareBox), about("(10, 0)"));
  // It is missing within that edge.
  EXPECT_EQ(told(less({kSquare, rectangle(5, 0, 10, 5)}), kSquareBox), about("(0, 0)"));
  EXPECT_EQ(told(less({kSquare, rectangle(5, 5, 10, 10)}), kSquareBox), about("(10, 0)"));
  EXPECT_EQ(told(less({unite({kSquare, rectangle(10, 0, 15, 10)}), rectangle(5, 0, 10, 10)}), kSquareBox),
            about("(0, 0)"));
  // An outline crosses the edge near one end or in the midst of it.
  EXPECT_EQ(told(less({kSquare, disc(9, 0, 0.25)}), kSquareBox), about("(0, 0)"));
  EXPECT_EQ(told(less({kSquare, disc(4, 0, 0.25)}), kSquareBox), about("(0, 0)"));
  EXPECT_EQ(told(unite({kSquare, disc(10, 8, 1)}), kSquareBox), about("(10, 0)"));
  EXPECT_EQ(told(intersect({kSquare, half_plane(6, 0, 6, 10), half_plane(0, -0.5, 10, -0.5)}), kSquareBox),
            about("(0, 0)"));
  // The end of an edge in a half-plane does not tell of all of it.
  EXPECT_EQ(told(intersect({kSquare, half_plane(4, 20, 4, 0)}), kSquareBox), about("(0, 0)"));
  EXPECT_EQ(told(intersect({kSquare, half_plane(4, 0, 4, 20)}), kSquareBox), about("(0, 0)"));
  EXPECT_EQ(told(unite({disc(0, 0, 5), rectangle(-5, 5, 5, 7)}), box(-5, 5, 5, 7)), about("(-5, 5)"));
}

TEST(VerifyTreeCheck, WhatTheRegionLacksIsToldByTheFirstSideOfIt) {
  EXPECT_EQ(
      told(intersect({unite({kSquare, rectangle(20, 0, 30, 10)}), half_plane(26, 0, 26, 20)}), kSquareBox),
      "it lacks the outline of the tree about (20, 0)");
  EXPECT_EQ(told(intersect({unite({kSquare, R"({"polygon": [[20, 5], [30, 2], [30, 8]]})"}),
                            half_plane(26, 0, 26, 20)}),
                 kSquareBox),
            "it lacks the outline of the tree about (20, 5)");
  // The stretch behind the half-plane is looked at later, and changes nothing.
  EXPECT_EQ(told(intersect({unite({rectangle(40, 0, 50, 10), rectangle(20, 0, 30, 10)}),
                            half_plane(24, 20, 24, 0)}),
                 box(40, 0, 50, 10)),
            "it lacks the outline of the tree about (20, 0)");
  EXPECT_EQ(told(unite({kSquare, disc(20, 5, 1)}), kSquareBox).substr(0, 32),
            "it lacks the outline of the tree");
  EXPECT_EQ(told(less({disc(0, 0, 5), disc(0, 0, 3)}), circle(0, 0, 5)).substr(0, 32),
            "it lacks the outline of the tree");
}

TEST(VerifyTreeCheck, AnOutlineOffItsSideIsOpenAndFarOffIsNone) {
  const auto off = [](double by) { return told(kSquare, box(0, 0, 10 + by, 10), "", 0.001).substr(0, 24); };
  EXPECT_EQ(off(0.0009), " 0.0 | 0.1 | 0.2 | 0.3");
  EXPECT_EQ(off(0.0015), "open: its outline about ");
  EXPECT_EQ(off(0.005), "open: its outline about ");
  EXPECT_EQ(off(0.007), "open: its outline about ");
  EXPECT_EQ(off(0.009), "its outline at (10.00899");
  // An edge may leave its side on the way.
  EXPECT_EQ(told(kSquare, polygon({{0, 0}, {10, 0}, {10.0015, 10}, {0, 10}}), "", 0.001).substr(0, 29),
            "open: its outline about (10.0");
  // The first of two is told.
  EXPECT_EQ(told(kSquare, box(0, 0, 10.005, 10.005), "", 0.001).substr(0, 31),
            "open: its outline about (10.004");
}

TEST(VerifyTreeCheck, AnOutlineBesideAnotherAtTheDistanceThatIsAskedAboutIsNone) {
  // Beside an edge the region is asked on the other outline, within its material and outside it.
  EXPECT_EQ(
      told(rectangle(0, 0, 100, 50), box(0, 0, 100, 50), polygon({{10, 2}, {10, 40}, {90, 40}, {90, 2}}), 1)
          .substr(0, 14),
      "its outline at");
  EXPECT_EQ(told(rectangle(0, 0, 10, 50),
                 polygon({{0, 0}, {30, 0}, {30, 50}, {12, 50}, {12, 5}, {10, 5}, {10, 50}, {0, 50}}), "", 1)
                .substr(0, 14),
            "its outline at");
}

TEST(VerifyTreeCheck, WhatIsHeldByAThirdIsNoOutlineHoweverNearTwoOthersRun) {
  const std::string edges = polygon({{0, 0}, {5, 0}, {5, -5}, {20, -5}, {20, 20}, {5, 20}, {5, 10}, {0, 10}});
  EXPECT_EQ(told(unite({kSquare, rectangle(0, 0, 10.000002, 10), rectangle(5, -5, 20, 20)}), edges),
            " 0.0 1.0 | 2.3 | 2.0 | 2.1 | 2.2 | 2.3 | 0.2 1.2 | 0.3 1.3");
}

TEST(VerifyTreeCheck, ACircleIsFollowedWhenItIsLargerThanWhatIsAskedBesideIt) {
  EXPECT_EQ(told(disc(0, 0, 1), circle(0, 0, 1), "", 0.2499), " 0.0");
  EXPECT_EQ(told(disc(0, 0, 1), circle(0, 0, 1), "", 0.25).substr(0, 18), "open: its outline ");
}

TEST(VerifyTreeCheck, AHalfPlaneTellsOfAPieceOnlyWhatNothingNearToItChanges) {
  // The half-planes alone say that there is nothing along their lines outside, and a bar says otherwise.
  const std::string cut = intersect({kSquare, half_plane(6, 0, 6, 10), half_plane(0, 8, 0, 2)});
  const std::string open_cut = intersect({kSquare, half_plane(6, 0, 6, 10), half_plane(0, 2, 10, 2)});
  const std::string bar = rectangle(5, -3, 7, 6);
  EXPECT_EQ(told(cut, box(0, 0, 6, 10)), " 0.0 | 1.0 | 0.2 | 0.3 2.0");
  EXPECT_EQ(told(unite({open_cut, bar}),
                 polygon({{0, 2}, {5, 2}, {5, -3}, {7, -3}, {7, 6}, {6, 6}, {6, 10}, {0, 10}})),
            " 2.0 | 0.0 3.3 | 3.0 | 0.0 2.0 3.1 | 3.2 | 1.0 | 0.2 | 0.3");
  EXPECT_EQ(told(unite({open_cut, rectangle(8, 4, 12, 6)}), box(0, 2, 6, 10)).substr(0, 32),
            "it lacks the outline of the tree");
  EXPECT_EQ(told(less({bar, open_cut}), polygon({{5, -3}, {7, -3}, {7, 6}, {6, 6}, {6, 2}, {5, 2}})),
            " 0.0 | 0.1 1.0 3.0 | 0.2 | 2.0 | 3.0 | 0.3 1.0");
}

TEST(VerifyTreeCheck, AShapeOfHalfPlanesAloneMayHaveNoEnd) {
  const std::vector<std::string> planes{half_plane(0, 0, 4, 0), half_plane(4, 0, 0, 3),
                                        half_plane(0, 3, 0, 0)};
  const std::string triangle = polygon({{0, 0}, {4, 0}, {0, 3}});
  EXPECT_EQ(told(intersect(planes), triangle), "open: the shape may have no end");
  EXPECT_EQ(told(intersect({kSquare, planes[0], planes[1], planes[2]}), triangle),
            " 0.0 1.0 | 2.0 | 0.3 3.0");
}

}  // namespace
}  // namespace lekalo::verify::verify_tree_check_test

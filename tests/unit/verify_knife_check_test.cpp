#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "verify/drawn/knife_check.hpp"

/// A tangential knife along outlines, looked at stroke by stroke.
namespace lekalo::verify::verify_knife_check_test {
namespace {

constexpr double kTurnAbove = 0.3;

DrawnLine drawn(std::vector<Stroke> edges, bool closed) { return {"CUT", std::move(edges), closed}; }

/// A plate of 40 x 20.
DrawnLine plate() {
  return drawn({line_between({0, 0}, {40, 0}), line_between({40, 0}, {40, 20}),
                line_between({40, 20}, {0, 20}), line_between({0, 20}, {0, 0})},
               true);
}
/// A stroke along each of its sides, the first of them another one.
std::vector<DrawnLine> strokes_with(const Stroke& first) {
  std::vector<DrawnLine> strokes;
  for (const Stroke& edge : plate().edges) strokes.push_back(drawn({edge}, false));
  strokes[0].edges[0] = first;
  return strokes;
}

std::string notes;  ///< of the last that was judged

std::string judged(const std::vector<DrawnLine>& strokes, const DrawnLine& contour = plate()) {
  std::vector<const DrawnLine*> cut;
  for (const DrawnLine& stroke : strokes) cut.push_back(&stroke);
  KnifeWords words;
  words.turn_above = kTurnAbove;
  ClaimReport report;
  check_knife(cut, {&contour}, words, report);
  notes.clear();
  for (const std::string& note : report.notes) notes += note + "\n";
  std::string text;
  for (const std::string& finding : report.findings) text += finding + "\n";
  return text;
}
bool leaves(const std::string& said) {
  return said.find("the tip of the knife leaves the outlines at") != std::string::npos;
}

TEST(VerifyKnifeCheck, AStrokeAlongEachSideCutsThePlate) {
  EXPECT_EQ(judged(strokes_with(plate().edges[0])), "");
  EXPECT_EQ(notes, "the tip of the knife follows 1 outlines within 0.1 mm\n");
  EXPECT_NE(judged(strokes_with(line_between({0, -1}, {40, -1}))), "");
  EXPECT_EQ(notes, "");
}

// Its middle is near enough.
TEST(VerifyKnifeCheck, NeitherEndOfAStrokeLeavesTheOutline) {
  EXPECT_TRUE(leaves(judged(strokes_with(line_between({0, -0.18}, {40, 0})))));
  EXPECT_TRUE(leaves(judged(strokes_with(line_between({0, 0}, {40, -0.18})))));
}

// Both ends of the stroke and its middle are within 0.0914 mm of the circle, and a place between them is
// 0.1028 mm away.
TEST(VerifyKnifeCheck, AStrokeBesideAnArcIsLookedAtAllAlong) {
  const double whole = std::sqrt(20 * 0.09685 / 0.53), from = 0.75 * whole, off = 10 - from * from / 20;
  const DrawnLine circle = drawn({arc_about({8, 6}, {8, 6}, {}, true)}, true);  // of quarters from there
  const auto along = [&](double y) {
    return judged({drawn({line_between({-from, y}, {whole - from, y})}, false)}, circle);
  };
  EXPECT_TRUE(leaves(along(off)));
  EXPECT_FALSE(leaves(along(off + 0.02)));
}

TEST(VerifyKnifeCheck, EveryCornerIsLifted) {
  std::vector<DrawnLine> strokes = strokes_with(plate().edges[0]);
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<DrawnLine> fewer = strokes;
    const std::size_t next = (i + 1) % 4;
    fewer[i].edges.push_back(fewer[next].edges[0]);
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(next));
    EXPECT_NE(judged(fewer).find("the knife is not lifted at the corner"), std::string::npos) << i;
  }
}

// The knife is lifted where one stroke ends at a corner and another begins there.
TEST(VerifyKnifeCheck, AtACornerOneStrokeEndsAndOneBegins) {
  const std::string lifted = "the knife is not lifted at the corner (40.000, 0.000)";
  std::vector<DrawnLine> strokes = strokes_with(plate().edges[0]);
  std::vector<DrawnLine> none_begins = strokes, none_ends = strokes;
  none_begins[1].edges.insert(none_begins[1].edges.begin(), line_between({20, 0}, {40, 0}));
  EXPECT_NE(judged(none_begins).find(lifted), std::string::npos) << judged(none_begins);
  none_ends[0].edges.push_back(line_between({40, 0}, {40, 10}));
  EXPECT_NE(judged(none_ends).find(lifted), std::string::npos) << judged(none_ends);
}

// A thousandth of a radian is for the rounding of directions.
TEST(VerifyKnifeCheck, CornersThatTurnAsSharplyAsItsWordsSayMayBeCutThrough) {
  const auto bent = [](double by) {
    const double turn = kTurnAbove + by;
    DrawnLine contour = plate();
    const Place tip{20, -20 * std::tan(turn / 2)};
    contour.edges.erase(contour.edges.begin());
    contour.edges.insert(contour.edges.begin(), {line_between({0, 0}, tip), line_between(tip, {40, 0})});
    std::vector<DrawnLine> strokes = strokes_with(contour.edges[0]);
    strokes[0].edges.push_back(contour.edges[1]);
    return judged(strokes, contour);
  };
  EXPECT_EQ(bent(0.0009), "");
  EXPECT_NE(bent(0.0011).find("is not lifted at the corner (20.000"), std::string::npos) << bent(0.0011);
}

}  // namespace
}  // namespace lekalo::verify::verify_knife_check_test

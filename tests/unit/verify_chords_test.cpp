// Polygons of drawings: chords at the very bound of what an arc allows.

#include "verify/layout/chords.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace lekalo::verify::verify_chords_test {
namespace {

constexpr std::int64_t kMm = 1 << 20;
constexpr double kStep = 0x1p-20;

std::string line(double from_x, double from_y, double to_x, double to_y) {
  return fmt::format(R"({{"line": {{"from": [{}, {}], "to": [{}, {}]}}}})", from_x, from_y, to_x, to_y);
}
std::string arc(double from_x, double from_y, double to_x, double to_y, double centre_x, double centre_y,
                bool ccw = true) {
  return fmt::format(R"({{"arc": {{"from": [{}, {}], "to": [{}, {}], "centre": [{}, {}], "ccw": {}}}}})",
                     from_x, from_y, to_x, to_y, centre_x, centre_y, ccw);
}

/// The fault of loops beside a drawing: edges of the outer contour, and of holes, separated by commas.
std::string said(const std::vector<GridLoop>& loops, const std::vector<std::string>& contours, ChordSide side,
                 double tolerance) {
  std::string text = fmt::format(R"({{"outer": [{}], "holes": [)", contours[0]), complaint;
  for (std::size_t k = 1; k < contours.size(); ++k)
    text += fmt::format("{}[{}]", k > 1 ? ", " : "", contours[k]);
  text += "]}";
  const auto parsed = parse_json(text, "drawing");
  EXPECT_TRUE(parsed) << text;
  const Shape drawn = read_shape(*parsed, "curves", complaint);
  EXPECT_EQ(complaint, "");
  return fault_of_chords(loops, drawn, side, tolerance).value_or("");
}

// Half of the circle of radius 5 mm above its diameter. Chords of it through (4, 3), (0, 5) and (-4, 3) are
// inside; those through (5, 5) and (-5, 5) are outside, and their corners 5 * sqrt(2) - 5 mm beyond the
// circle.
const std::string kHalf = arc(5, 0, -5, 0, 0, 0) + ", " + line(-5, 0, 5, 0);

struct Move {
  std::size_t point;
  std::int64_t x, y;
};
GridLoop moved(GridLoop loop, const std::vector<Move>& moves) {
  for (const auto& [point, x, y] : moves) loop[point].x += x, loop[point].y += y;
  return loop;
}

struct Case {
  std::vector<Move> moves;  ///< in steps
  double tolerance;
  std::string_view words;  ///< of the fault; none where there is none
};
void expect(const GridLoop& loop, const std::string& drawing, ChordSide side,
            const std::vector<Case>& cases) {
  int number = 0;
  for (const auto& [moves, tolerance, words] : cases) {
    const std::string sentence = said({moved(loop, moves)}, {drawing}, side, tolerance);
    EXPECT_TRUE(words.empty() ? sentence.empty() : sentence.find(words) != std::string::npos)
        << "case " << number << ": " << sentence;
    ++number;
  }
}

constexpr std::string_view kCuts = "a chord cuts into an arc",
                           kFar = "a chord is farther from an arc than the tolerance",
                           kReaches = "a chord reaches out of an arc",
                           kMissing = "no point is where edge 0 of the drawing ends";

TEST(VerifyChords, ChordsOutsideAnArc) {
  const GridLoop loop{{5 * kMm, 0}, {5 * kMm, 5 * kMm + 3}, {-5 * kMm, 5 * kMm + 3}, {-5 * kMm, 0}};
  expect(loop, kHalf, ChordSide::outside,
         {{{}, 3, ""},
          {{{1, 0, -2}, {2, 0, -2}}, 3, kCuts},  // one step beyond the circle, of two
          {{{0, -3, 0}}, 3, ""},                 // the ends of an arc have four steps
          {{{0, -3, 0}, {1, -3, 0}}, 3, ""},     // and so have their chords
          {{{1, -kMm, 0}}, 3, kCuts},
          {{{3, 3, 0}}, 3, ""},
          {{{3, 3, 0}, {2, 3, 0}}, 3, ""},
          {{{2, kMm, 0}}, 3, kCuts},
          {{{0, 0, -4}}, 3, ""},
          {{{0, 5, 0}}, 3, "begins"},
          {{{3, 0, -5}}, 3, kMissing},
          {{}, 2, kFar}});
  // Corners of which one is exactly as far from the centre as it may be: (4, 3) and (8, 6) are 5 and 10 mm
  // from it.
  const GridLoop far{{5 * kMm, 0}, {8 * kMm, 6 * kMm}, {-6 * kMm, 8 * kMm}, {-5 * kMm, 0}};
  expect(far, kHalf, ChordSide::outside,
         {{{}, 5 - 3 * kStep, ""},
          {{}, 5 - 5 * kStep, kFar},
          {{{1, 0, 3}}, 5 - 3 * kStep, kFar},
          {{{2, 0, 3}}, 5 - 3 * kStep, kFar}});
}

TEST(VerifyChords, ASingleChordMayCutIn) {
  expect({{5 * kMm, 0}, {0, 5 * kMm}, {0, 0}},
         arc(5, 0, 0, 5, 0, 0) + ", " + line(0, 5, 0, 0) + ", " + line(0, 0, 5, 0), ChordSide::outside,
         {{{}, 3, kCuts}});
}

TEST(VerifyChords, ChordsInsideAnArc) {
  const GridLoop loop{{5 * kMm, 0}, {4 * kMm, 3 * kMm}, {0, 5 * kMm}, {-4 * kMm, 3 * kMm}, {-5 * kMm, 0}};
  const std::vector<Move> in{{2, 0, -3}, {1, -3, -3}, {3, 3, -3}};
  const auto with = [&](const std::vector<Move>& more) {
    std::vector<Move> all = in;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  expect(loop, kHalf, ChordSide::inside,
         {{in, 1, ""},
          {with({{2, 0, 2}}), 1, kReaches},  // one step inside, of two
          {with({{1, 2, 2}}), 1, kReaches},
          {with({{3, -2, 2}}), 1, kReaches},
          {with({{0, 3, 0}}), 1, ""},  // the ends of the arc have four steps
          {with({{4, -3, 0}}), 1, ""},
          {with({{0, 5, 0}}), 1, "begins"},
          {with({{4, -5, 0}}), 1, kMissing},
          {in, 0.2, kFar}});
  // The chord from (4, 3) to (-4, 3) is 3 mm from the centre, but for the step by which it is moved.
  const GridLoop low{{5 * kMm, 0}, {4 * kMm - 4, 3 * kMm}, {-4 * kMm + 4, 3 * kMm}, {-5 * kMm, 0}};
  expect(
      low, kHalf, ChordSide::inside,
      {{{}, 2 - 3 * kStep, ""}, {{}, 2 - 5 * kStep, kFar}, {{{1, 0, -3}, {2, 0, -3}}, 2 - 3 * kStep, kFar}});
  // The nearest point of a chord is its end, on either side: there the chord turns back.
  const std::string left = arc(0, 5, -5, 0, 0, 0) + ", " + line(-5, 0, 0, 5);
  EXPECT_EQ(said({{{0, 5 * kMm}, {-3 * kMm + 3, 4 * kMm - 3}, {-4 * kMm + 3, 3 * kMm - 3}, {-5 * kMm, 0}}},
                 {left}, ChordSide::inside, 0.5),
            "");
  EXPECT_NE(said({{{0, 5 * kMm}, {-1 * kMm, 4 * kMm}, {-4 * kMm, 2 * kMm}, {-5 * kMm, 0}}}, {left},
                 ChordSide::inside, 0.5),
            "");
}

TEST(VerifyChords, LoopsRunEitherWayAndBeginAnywhere) {
  const GridLoop outside{{5 * kMm, 0}, {5 * kMm, 5 * kMm + 3}, {-5 * kMm, 5 * kMm + 3}, {-5 * kMm, 0}};
  const GridLoop inside{{5 * kMm, 0}, {0, 5 * kMm - 3}, {-5 * kMm, 0}};
  const std::string clockwise = arc(-5, 0, 5, 0, 0, 0, false) + ", " + line(5, 0, -5, 0);
  const std::string square = line(-20, -20, 20, -20) + ", " + line(20, -20, 20, 20) + ", " +
                             line(20, 20, -20, 20) + ", " + line(-20, 20, -20, -20);
  const GridLoop around{
      {-20 * kMm, -20 * kMm}, {20 * kMm, -20 * kMm}, {20 * kMm, 20 * kMm}, {-20 * kMm, 20 * kMm}};
  for (const bool is_outside : {false, true})
    for (std::size_t first = 0; first < 3; ++first)
      for (const bool reversed : {false, true})
        for (const std::string& drawing : {kHalf, clockwise}) {
          GridLoop loop = is_outside ? outside : inside;
          std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(first), loop.end());
          if (reversed) std::reverse(loop.begin(), loop.end());
          const ChordSide side = is_outside ? ChordSide::outside : ChordSide::inside,
                          other = is_outside ? ChordSide::inside : ChordSide::outside;
          EXPECT_EQ(said({loop}, {drawing}, side, 3), "");
          EXPECT_NE(said({loop}, {drawing}, other, 3), "");
          // Of a hole the material is on the other side.
          EXPECT_EQ(said({around, loop}, {square, drawing}, other, 3), "");
          EXPECT_EQ(said({around, loop}, {square, drawing}, side, 3).substr(0, 8), "hole 0: ");
        }
}

TEST(VerifyChords, EveryEdgeOfTheDrawingHasItsPoints) {
  const std::string square =
      line(0, 0, 8, 0) + ", " + line(8, 0, 8, 8) + ", " + line(8, 8, 0, 8) + ", " + line(0, 8, 0, 0);
  const GridLoop loop{{0, 0}, {8 * kMm, 0}, {8 * kMm, 8 * kMm}, {0, 8 * kMm}};
  expect(loop, square, ChordSide::outside,
         {{{}, 1, ""},
          {{{1, 4, 0}}, 1, ""},
          {{{1, 5, 0}}, 1, "no point is where edge 0 of the drawing ends"},
          {{{2, 0, 5}}, 1, "no point is where edge 1 of the drawing ends"},
          {{{0, -5, 0}}, 1, "no point is where edge 0 of the drawing begins"}});
  GridLoop more = loop;
  more.push_back({-3 * kMm, 4 * kMm});
  EXPECT_NE(said({more}, {square}, ChordSide::outside, 1), "");
  EXPECT_NE(said({{{0, 0}, {8 * kMm, 0}, {8 * kMm, 8 * kMm}}}, {square}, ChordSide::outside, 1), "");
  EXPECT_EQ(said({loop, loop}, {square}, ChordSide::outside, 1), "it has 2 loops and its curves 1 contours");
  // Faults say of which hole they are.
  const std::string small = line(3, 3, 5, 3) + ", " + line(5, 3, 5, 5) + ", " + line(5, 5, 3, 3);
  const GridLoop hole{{3 * kMm, 3 * kMm}, {5 * kMm, 3 * kMm}, {5 * kMm, 5 * kMm}};
  EXPECT_EQ(said({loop, hole}, {square, small}, ChordSide::outside, 1), "");
  EXPECT_EQ(said({loop, moved(hole, {{0, 9, 0}})}, {square, small}, ChordSide::outside, 1),
            "hole 0: no point is where edge 0 of the drawing begins");
  EXPECT_EQ(said({moved(loop, {{0, 9, 0}}), hole}, {square, small}, ChordSide::outside, 1),
            "no point is where edge 0 of the drawing begins");
}

TEST(VerifyChords, FullTurnsAndArcsOfAFewSteps) {
  const std::string circle = arc(5, 0, 5, 0, 0, 0);
  const GridLoop around{{5 * kMm, 0},
                        {5 * kMm, 5 * kMm + 3},
                        {-5 * kMm - 3, 5 * kMm + 3},
                        {-5 * kMm - 3, -5 * kMm - 3},
                        {5 * kMm, -5 * kMm - 3}};
  EXPECT_EQ(said({around}, {circle}, ChordSide::outside, 3), "");
  EXPECT_EQ(said({{{5 * kMm, 0}, {0, 5 * kMm - 3}, {-5 * kMm + 3, 0}, {0, -5 * kMm + 3}}}, {circle},
                 ChordSide::inside, 3),
            "");
  // A line, an arc of two steps that is gone from the polygon, and lines back.
  const double two = 2 * kStep;
  const std::string rounded = line(0, 0, 8, 0) + ", " + arc(8, 0, 8 + two, two, 8, two) + ", " +
                              line(8 + two, two, 8 + two, 8) + ", " + line(8 + two, 8, 0, 0);
  EXPECT_EQ(said({{{0, 0}, {8 * kMm, 0}, {8 * kMm + 2, 8 * kMm}}}, {rounded}, ChordSide::outside, 1), "");
  // An arc of 100 steps is not to be gone.
  const double hundred = 100 * kStep;
  const std::string larger = line(0, 0, 8, 0) + ", " + arc(8, 0, 8 + hundred, hundred, 8, hundred) + ", " +
                             line(8 + hundred, hundred, 8 + hundred, 8) + ", " + line(8 + hundred, 8, 0, 0);
  EXPECT_NE(said({{{0, 0}, {8 * kMm, 0}, {8 * kMm + 100, 8 * kMm}}}, {larger}, ChordSide::outside, 1), "");
  EXPECT_EQ(said({{{0, 0}, {8 * kMm, 0}, {8 * kMm + 100, 0}, {8 * kMm + 100, 100}, {8 * kMm + 100, 8 * kMm}}},
                 {larger}, ChordSide::outside, 1),
            "");
}

TEST(VerifyChords, ChordsThatRunAtTheCentreAreNearestAtTheirEnds) {
  EXPECT_EQ(said({{{5 * kMm, 0},
                   {8 * kMm, 6 * kMm},
                   {4 * kMm, 3 * kMm + 1},
                   {6 * kMm, 8 * kMm},
                   {-6 * kMm, 8 * kMm},
                   {-5 * kMm, 0}}},
                 {kHalf}, ChordSide::outside, 6),
            "a chord cuts into an arc (edge 0 of the drawing)");
  EXPECT_EQ(
      said(
          {{{5 * kMm, 0}, {4 * kMm - 4, 3 * kMm - 3}, {kMm, kMm}, {3 * kMm - 3, 4 * kMm - 4}, {-5 * kMm, 0}}},
          {kHalf}, ChordSide::inside, 3),
      "a chord is farther from an arc than the tolerance (edge 0 of the drawing)");
}

TEST(VerifyChords, ChordsTurnAsTheArcDoes) {
  // They run beneath the circle, and the arc above it.
  const GridLoop below{{5 * kMm, 0}, {5 * kMm, -5 * kMm - 3}, {-5 * kMm, -5 * kMm - 3}, {-5 * kMm, 0}};
  EXPECT_EQ(said({below}, {kHalf}, ChordSide::inside, 3),
            "the chords of an arc do not run around its centre with it (edge 0 of the drawing)");
  // The ends of an arc of two steps may be anywhere in it.
  const double two = 2 * kStep;
  const std::string rounded = line(0, 0, 8, 0) + ", " + arc(8, 0, 8 + two, two, 8, two) + ", " +
                              line(8 + two, two, 8 + two, 8) + ", " + line(8 + two, 8, 0, 0);
  EXPECT_EQ(said({{{0, 0}, {8 * kMm - 2, 0}, {8 * kMm + 2, 4}, {8 * kMm + 2, 8 * kMm}}}, {rounded},
                 ChordSide::outside, 1),
            "");
}

TEST(VerifyChords, RadiiThatDifferAreABand) {
  const std::string wider = arc(5, 0, -5.0005, 0, 0, 0) + ", " + line(-5.0005, 0, 5, 0);
  const std::int64_t left = -5243404;  // -5.0005 mm
  EXPECT_EQ(said({{{5 * kMm, 0}, {5 * kMm, 5 * kMm + 3}, {left, 5 * kMm + 3}, {left, 0}}}, {wider},
                 ChordSide::outside, 3),
            "a chord cuts into an arc (edge 0 of the drawing)");
  EXPECT_EQ(said({{{5 * kMm, 0}, {5 * kMm, 5 * kMm + 600}, {left - 3, 5 * kMm + 600}, {left, 0}}}, {wider},
                 ChordSide::outside, 3),
            "");
  EXPECT_EQ(said({{{5 * kMm, 0}, {0, 5 * kMm + 100}, {left, 0}}}, {wider}, ChordSide::inside, 3),
            "a chord reaches out of an arc (edge 0 of the drawing)");
  EXPECT_EQ(said({{{5 * kMm, 0}, {0, 5 * kMm - 3}, {left, 0}}}, {wider}, ChordSide::inside, 3), "");
  // One chord beside a short arc whose ends are not equally far from the centre.
  const std::string shorter =
      arc(5, 0, 5.0005, 0.01, 0, 0) + ", " + line(5.0005, 0.01, 0, 0) + ", " + line(0, 0, 5, 0);
  EXPECT_EQ(said({{{5 * kMm, 0}, {5243404, 10486}, {0, 0}}}, {shorter}, ChordSide::outside, 3), "");
}

TEST(VerifyChords, OfPointsNearAVertexTheNearestIsItsOwn) {
  const auto with = [&](const std::vector<GridPoint>& ends) {
    GridLoop loop{{5 * kMm, 0}, {5 * kMm, 5 * kMm + 3}, {-5 * kMm - 3, 5 * kMm + 3}};
    loop.insert(loop.end(), ends.begin(), ends.end());
    return said({loop}, {kHalf}, ChordSide::outside, 3);
  };
  EXPECT_EQ(with({{-5 * kMm - 3, 2}, {-5 * kMm, 0}}), "");
  EXPECT_EQ(with({{-5 * kMm - 3, 2}, {-5 * kMm - 3, -2}}), "") << "of two as near the last one";
  EXPECT_EQ(with({{-5 * kMm, 0}, {-5 * kMm, -3}}), "no point is where edge 1 of the drawing ends");
  // The beginning of an arc that comes back is not its end.
  const double two = 2 * kStep;
  const std::string around = arc(5, 0, 5, -two, 0, 0) + ", " + line(5, -two, 5, 0);
  EXPECT_EQ(said({{{5 * kMm, 0},
                   {5 * kMm, 5 * kMm + 3},
                   {-5 * kMm - 3, 5 * kMm + 3},
                   {-5 * kMm - 3, -5 * kMm - 3},
                   {5 * kMm, -5 * kMm - 3},
                   {5 * kMm, -2}}},
                 {around}, ChordSide::outside, 3),
            "");
}

TEST(VerifyChords, WhatIsShorterThanEightStepsMayBeGoneButForALargeArc) {
  // One point stands for both ends of the last edge, which are as many steps to both sides of it.
  const auto gone = [](int half, const std::string& edge) {
    const double off = half * kStep;
    return said(
        {{{8 * kMm, 8 * kMm}, {0, 16 * kMm}, {0, 0}}},
        {line(8, 8 + off, 0, 16) + ", " + line(0, 16, 0, 0) + ", " + line(0, 0, 8, 8 - off) + ", " + edge},
        ChordSide::outside, 1);
  };
  const double two = 2 * kStep, three = 3 * kStep, four = 4 * kStep, large = 400 * kStep;
  EXPECT_EQ(gone(3, line(8, 8 - three, 8, 8 + three)), "");
  EXPECT_EQ(gone(3, arc(8, 8 - three, 8, 8 + three, 8 - four, 8)), "") << "of a radius of five steps";
  EXPECT_EQ(gone(2, arc(8, 8 - two, 8, 8 + two, 8 - large, 8)), "") << "ends that are near each other";
  EXPECT_EQ(gone(3, arc(8, 8 - three, 8, 8 + three, 8 - large, 8)),
            "the arc of edge 3 of the drawing is missing");
  EXPECT_EQ(gone(3, arc(8, 8 - three, 8, 8 + three, 8 + large, 8)),
            "the arc of edge 3 of the drawing is missing")
      << "nearly a full turn";
}

}  // namespace
}  // namespace lekalo::verify::verify_chords_test

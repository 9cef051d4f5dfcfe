// Where the middle of a tool may be: the index of strokes, the air beyond open edges, the rim of the tool,
// and the places of a pocket.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "verify/pocket/pocket_reach.hpp"
#include "verify/pocket/rim_cover.hpp"

namespace lekalo::verify::verify_reach_test {
namespace {

constexpr double kPi = 3.141592653589793, kInfinity = std::numeric_limits<double>::infinity();

Stroke line(Place from, Place to) { return {false, true, from, to, {}, 0}; }
Stroke arc(Place from, Place to, Place centre, bool ccw = true) {
  return {true, ccw, from, to, centre, length(from - centre)};
}

// ---- the index --------------------------------------------------------------------------------------------

TEST(VerifyStrokeIndex, FindsWhatIsNearAsALookAtAllDoes) {
  std::mt19937 random(7);
  const auto anywhere = [&](double low, double high) {
    return low + (high - low) * (random() / 4294967296.0);
  };
  std::vector<Stroke> strokes;
  std::vector<double> wider;
  for (int k = 0; k < 60; ++k) {
    const Place at{anywhere(-5, 25), anywhere(0, 12)};
    if (k % 3 == 0)
      strokes.push_back(arc(at + Place{2, 0}, at + Place{0, 2}, at));
    else
      strokes.push_back(line(at, at + Place{anywhere(-3, 3), anywhere(-3, 3)}));
    wider.push_back(anywhere(-1, 1.5));
  }
  StrokeIndex index({0, 0}, {20, 12}, 1.5);  // some of them lie beyond it
  for (std::uint32_t i = 0; i < strokes.size(); ++i) index.add(i, strokes[i]);
  const double widest = *std::max_element(wider.begin(), wider.end());
  for (int k = 0; k < 300; ++k) {
    const Place p{anywhere(-15, 40), anywhere(-15, 30)};
    double least = kInfinity, lessened = kInfinity;
    for (std::size_t i = 0; i < strokes.size(); ++i) {
      least = std::min(least, distance(p, strokes[i]));
      lessened = std::min(lessened, distance(p, strokes[i]) - wider[i]);
    }
    EXPECT_EQ(index.nearest(p, strokes), least);
    EXPECT_EQ(index.nearest(p, strokes, wider, widest), lessened);
    const double reach = anywhere(0, 4);
    std::vector<std::uint32_t> near{99};
    index.near(p, reach, near);
    EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
    EXPECT_EQ(std::adjacent_find(near.begin(), near.end()), near.end());
    for (std::uint32_t i = 0; i < strokes.size(); ++i)
      if (distance(p, strokes[i]) <= reach) {
        EXPECT_TRUE(std::binary_search(near.begin(), near.end(), i)) << i;
      }
  }
  // It is of use: where nothing is, little is given.
  std::vector<std::uint32_t> near;
  index.near({10, 6}, 0.1, near);
  EXPECT_LT(near.size(), 20U);
}

TEST(VerifyStrokeIndex, WithinASquareABoxIsNearThatIsNoFartherOff) {
  StrokeIndex index({0, 0}, {8, 8}, 16);
  const Stroke all[] = {line({1, 4}, {3, 4}), line({5, 4}, {7, 4}), line({4, 1}, {4, 3}),
                        line({4, 5}, {4, 7})};
  for (std::uint32_t i = 0; i < 4; ++i) index.add(i, all[i]);
  const auto near = [&](Place p) {
    std::vector<std::uint32_t> numbers;
    index.near(p, 1, numbers);
    return numbers;
  };
  EXPECT_EQ(near({4, 4}), (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(near({2, 2.5}), (std::vector<std::uint32_t>{}));
  EXPECT_EQ(near({6, 5.5}), (std::vector<std::uint32_t>{}));
  EXPECT_EQ(near({2, 4}), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(near({6, 4}), (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(near({4, 2}), (std::vector<std::uint32_t>{2}));
  EXPECT_EQ(near({4, 6}), (std::vector<std::uint32_t>{3}));
}

TEST(VerifyStrokeIndex, AnEmptyOneHasNothingNear) {
  const StrokeIndex none;
  std::vector<std::uint32_t> near{1, 2};
  none.near({0, 0}, 5, near);
  EXPECT_TRUE(near.empty());
  EXPECT_EQ(none.nearest({0, 0}, {}), kInfinity);
  EXPECT_EQ(StrokeIndex({0, 0}, {9, 9}, 1).nearest({100, 100}, {}), kInfinity);
}

TEST(VerifyStrokeIndex, ABoxHoldsItsStroke) {
  Place low, high;
  box_of(line({3, 1}, {1, 4}), low, high);
  EXPECT_EQ(low.x, 1);
  EXPECT_EQ(low.y, 1);
  EXPECT_EQ(high.x, 3);
  EXPECT_EQ(high.y, 4);
  // An arc may go beyond its ends by as much as it bulges.
  box_of(arc({std::sqrt(2.0), -std::sqrt(2.0)}, {std::sqrt(2.0), std::sqrt(2.0)}, {0, 0}), low, high);
  EXPECT_GE(high.x, 2);
  EXPECT_LE(high.x, 2 + 1e-8);
  EXPECT_LE(low.x, std::sqrt(2.0));
}

// ---- air --------------------------------------------------------------------------------------------------

const std::vector<Stroke> kSquare{line({0, 0}, {10, 0}), line({10, 0}, {10, 10}), line({10, 10}, {0, 10}),
                                  line({0, 10}, {0, 0})};

TEST(VerifyAir, AStripStandsStraightOutOfAnOpenEdge) {
  const Air air(kSquare, {0, 1, 0, 0}, 4);
  EXPECT_FALSE(air.empty());
  for (const Place p : {Place{10, 5}, {14, 5}, {12, 0}, {12, 10}, {10, 0}, {14, 10}})
    EXPECT_TRUE(air.in_strips(p));
  for (const Place p : {Place{9.999, 5}, {14.001, 5}, {12, -0.001}, {12, 10.001}})
    EXPECT_FALSE(air.in_strips(p));
  EXPECT_TRUE(air.in_drawing({5, 5}));
  EXPECT_FALSE(air.in_drawing({-1, 5}));
  EXPECT_FALSE(air.in_drawing({12, 5}));
  EXPECT_TRUE(air.holds({12, 5}));
  EXPECT_FALSE(air.holds({5, 5}));
  EXPECT_EQ(air.from_borders({12, 5}), 2);
  EXPECT_EQ(air.from_borders({20, 5}), 6);
  EXPECT_EQ(air.from_borders({11.5, 1}), 1);
  EXPECT_EQ(air.sides().size(), 3U);
  const Air none(kSquare, {0, 0, 0, 0}, 4);
  EXPECT_TRUE(none.empty());
  EXPECT_FALSE(none.in_strips({12, 5}));
  EXPECT_EQ(none.from_borders({12, 5}), kInfinity);
}

TEST(VerifyAir, BordersNearAPlaceAreThoseOfItsStripAndOfTheDrawingInIt) {
  const Air air(kSquare, {0, 1, 0, 0}, 4);
  const auto count = [&](double x, double y, double reach) { return air.borders_near({x, y}, reach).size(); };
  // Four of the strip, and of the drawing the edge itself and its two neighbours.
  EXPECT_EQ(count(20, 5, 6), 7U);
  EXPECT_EQ(count(20, 5, 5.9), 0U);
  EXPECT_EQ(count(4, 5, 6), 7U);
  EXPECT_EQ(count(4, 5, 5.9), 0U);
  EXPECT_EQ(count(12, -3, 3), 7U);
  EXPECT_EQ(count(12, -3, 2.9), 0U);
  EXPECT_EQ(count(12, 13, 3), 7U);
  EXPECT_EQ(count(12, 13, 2.9), 0U);
}

TEST(VerifyAir, OfEverySideTheEdgeAndItsNeighboursAreInTheStrip) {
  const Place beside[] = {{5, -2}, {12, 5}, {5, 12}, {-2, 5}};
  for (std::size_t side = 0; side < 4; ++side) {
    std::vector<char> open(4, 0);
    open[side] = 1;
    const Air air(kSquare, open, 4);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(air.in_strips(beside[k]), k == side);
      EXPECT_EQ(air.borders_near(beside[k], 1).size(), k == side ? 7U : 0U);
    }
  }
}

TEST(VerifyAir, WhereAStripMeetsTheDrawingTheDrawingCounts) {
  std::vector<Stroke> drawn = kSquare;
  for (const Stroke& s : kSquare) drawn.push_back(line(s.from + Place{12, 0}, s.to + Place{12, 0}));
  std::vector<char> open(8, 0);
  open[1] = 1;
  const Air air(drawn, open, 4);
  EXPECT_TRUE(air.holds({11, 5}));
  EXPECT_TRUE(air.in_strips({13, 5}));
  EXPECT_FALSE(air.holds({13, 5}));
}

TEST(VerifyAir, TheStripOfAnArcLiesBetweenTwoCircles) {
  // Out of a disc, and into an island.
  const Air out({arc({5, 0}, {0, 5}, {0, 0})}, {1}, 4);
  for (const Place p : {Place{5, 0}, {9, 0}, {0, 5}, {0, 9}, {4, 4}}) EXPECT_TRUE(out.in_strips(p));
  for (const Place p : {Place{4.999, 0}, {9.001, 0}, {6, -0.001}, {-0.001, 6}, {-4, -4}, {3, 3}, {7, 7}})
    EXPECT_FALSE(out.in_strips(p));
  EXPECT_EQ(out.sides().size(), 3U);
  EXPECT_NEAR(out.from_borders({4.2, 5.6}), 2, 1e-12);
  const Air in({arc({5, 0}, {0, -5}, {0, 0}, false)}, {1}, 2);
  for (const Place p : {Place{5, 0}, {3, 0}, {0, -4}, {2.5, -2.5}}) EXPECT_TRUE(in.in_strips(p));
  for (const Place p : {Place{5.001, 0}, {2.999, 0}, {4, 0.001}, {-0.001, -4}, {-3, 3}})
    EXPECT_FALSE(in.in_strips(p));
  // A strip as wide as the island and wider goes to its middle.
  const Air whole({arc({5, 0}, {0, -5}, {0, 0}, false)}, {1}, 6);
  EXPECT_TRUE(whole.in_strips({0.1, -0.1}));
  EXPECT_TRUE(whole.in_strips({0, 0}));
  EXPECT_FALSE(whole.in_strips({-0.1, 0.1}));
  EXPECT_EQ(whole.sides().size(), 2U);
}

// ---- the rim ----------------------------------------------------------------------------------------------

/// A tool of 3 mm that came along y = 0 to (10, 0), and what was swept before.
RimCover rim(const std::vector<std::pair<Stroke, double>>& swept) {
  RimCover cover;
  cover.begin({10, 0}, 3, line({0, 0}, {10, 0}));
  for (const auto& [stroke, radius] : swept) cover.add(stroke, radius);
  return cover;
}
constexpr double kDegree = kPi / 180;

TEST(VerifyRimCover, InFullMaterialTheLeadingHalfIsOpen) {
  const RimCover open = rim({});
  EXPECT_NEAR(open.open_angle(), kPi, 1e-7);
  EXPECT_NEAR(open.open_left(), kPi / 2, 1e-7);
  EXPECT_NEAR(open.open_width(), 6, 1e-9);
  EXPECT_FALSE(open.nothing_left());
  EXPECT_TRUE(open.may_meet({14, 0}, 2));
  EXPECT_FALSE(open.may_meet({20, 0}, 2));
}

TEST(VerifyRimCover, BesideAPassTheRestOfTheRimIsOpen) {
  // A band up to 1 mm to the left of the middle, or to the right of it.
  for (const bool left : {true, false}) {
    const RimCover beside = rim({{line({0, left ? -2.0 : 2.0}, {20, left ? -2.0 : 2.0}), 3}});
    EXPECT_NEAR(beside.open_angle(), std::acos(1 / 3.0), 1e-7);
    EXPECT_NEAR(beside.open_left(), left ? std::acos(1 / 3.0) : 0, 1e-7);
    EXPECT_NEAR(beside.open_width(), 2, 1e-9);
  }
  // Both leave what lies between them; a wider tool takes more.
  EXPECT_NEAR(rim({{line({0, -4}, {20, -4}), 3}, {line({0, 4}, {20, 4}), 3}}).open_width(), 2, 1e-9);
  EXPECT_NEAR(rim({{line({0, -4}, {20, -4}), 5}}).open_width(), 2, 1e-9);
  EXPECT_TRUE(rim({{line({0, 0}, {20, 0}), 3}}).nothing_left());
  EXPECT_EQ(rim({{line({0, 0}, {20, 0}), 3}}).open_angle(), 0);
  EXPECT_EQ(rim({{line({0, -8}, {20, -8}), 3}}).open_width(), rim({}).open_width());
}

TEST(VerifyRimCover, AHoleAheadTakesWhatLiesInIt) {
  // Of a disc of 3 mm about a place 3 mm ahead 60 degrees to either side are gone.
  const Stroke hole = line({13, 0}, {13, 0});
  EXPECT_NEAR(rim({{hole, 3}}).open_angle(), 60 * kDegree, 1e-7);
  EXPECT_NEAR(rim({{hole, 3}}).open_left(), 30 * kDegree, 1e-7);
  EXPECT_NEAR(rim({{hole, 3}}).open_width(), 6 - 3 * std::sqrt(3.0), 1e-9);
  // The end of a slot that comes from ahead is round too.
  EXPECT_NEAR(rim({{line({30, 0}, {13, 0}), 3}}).open_angle(), 60 * kDegree, 1e-7);
  EXPECT_NEAR(rim({{line({13, 0}, {30, 0}), 3}}).open_angle(), 60 * kDegree, 1e-7);
  EXPECT_NEAR(rim({{line({10, 3}, {10, 30}), 3}}).open_left(), 30 * kDegree, 1e-7);
}

TEST(VerifyRimCover, ASweptArcTakesItsRing) {
  // A ring about (10, 0) from 2 to 4 mm, of which only the first quarter to the left was swept.
  const Stroke quarter = arc({13, 0}, {10, 3}, {10, 0});
  const RimCover left = rim({{quarter, 1}});
  EXPECT_NEAR(left.open_left(), 0, 1e-7);
  EXPECT_NEAR(left.open_angle(), kPi / 2 - 2 * std::asin(1 / 6.0), 1e-7);
  const RimCover right = rim({{arc({10, -3}, {13, 0}, {10, 0}), 1}});
  EXPECT_NEAR(right.open_left(), kPi / 2 - 2 * std::asin(1 / 6.0), 1e-7);
  // One that is swept too far out or in takes nothing.
  EXPECT_NEAR(rim({{arc({15, 0}, {10, 5}, {10, 0}), 1.9}}).open_angle(), kPi, 1e-7);
  EXPECT_NEAR(rim({{arc({11, 0}, {10, 1}, {10, 0}), 1.9}}).open_angle(), kPi, 1e-7);
  // A wide tool about a small arc takes all that is near it.
  EXPECT_NEAR(rim({{arc({11, 0}, {10, 1}, {10, 0}), 2.1}}).open_left(), 0, 1e-7);
}

TEST(VerifyRimCover, WhatTheToolCameAlongIsGone) {
  // On a wide arc all of the leading half is ahead of what it swept.
  RimCover cover;
  cover.begin({10, 10}, 3, arc({20, 0}, {10, 10}, {10, 0}));
  EXPECT_NEAR(cover.open_angle(), kPi, 1e-4);
  // Round a small one some of the inner side was swept on the way: there cos a + sin a is below -1/3.
  RimCover tight;
  tight.begin({1, 0}, 3, arc({0, -1}, {1, 0}, {0, 0}));
  EXPECT_NEAR(tight.open_angle(), kPi / 4 + std::acos(-std::sqrt(2.0) / 6), 1e-6);
}

TEST(VerifyRimCover, BeyondAnOpenEdgeNothingIsMet) {
  const Air air(kSquare, {0, 1, 0, 0}, 4);
  RimCover cover;
  cover.begin({9, 5}, 3, line({0, 5}, {9, 5}));
  cover.add_air(air);
  // Short of x = 10: 3 cos(a) < 1.
  EXPECT_NEAR(cover.open_angle(), kPi - 2 * std::acos(1 / 3.0), 1e-7);
  RimCover inside;
  inside.begin({5, 5}, 3, line({0, 5}, {5, 5}));
  inside.add_air(air);
  EXPECT_NEAR(inside.open_angle(), kPi, 1e-7);
}

// ---- places of a pocket -----------------------------------------------------------------------------------

std::string edge(Place from, Place to, bool open = false) {
  return fmt::format(R"({{"line": {{"from": [{}, {}], "to": [{}, {}]}}{}}})", from.x, from.y, to.x, to.y,
                     open ? R"(, "open": true)" : "");
}
std::string contour(std::vector<Place> corners, bool backwards, int open = -1) {
  if (backwards) std::reverse(corners.begin(), corners.end());
  std::string text = "[";
  for (std::size_t k = 0; k < corners.size(); ++k)
    text += (k == 0 ? "" : ", ") +
            edge(corners[k], corners[(k + 1) % corners.size()], static_cast<int>(k) == open);
  return text + "]";
}
const std::vector<Place> kRoom{{0, 0}, {40, 0}, {40, 20}, {0, 20}},
    kIsland{{15, 8}, {25, 8}, {25, 12}, {15, 12}};

PocketReach reach(const std::string& pocket, double clearance, double air = 12) {
  auto made = PocketReach::make({"pocket.json", pocket}, clearance, air);
  if (!made) throw std::runtime_error(made.error().message);
  return *std::move(made);
}

TEST(VerifyPocketReach, DepthIsTheDistanceFromTheOutline) {
  for (const bool backwards : {false, true}) {
    const PocketReach room = reach("{\"outer\": " + contour(kRoom, backwards) + "}", 3);
    EXPECT_EQ(room.depth({20, 10}), 10);
    EXPECT_EQ(room.depth({5, 10}), 5);
    EXPECT_EQ(room.depth({-1, 10}), -1);
    EXPECT_EQ(room.depth({20, 21}), -1);
    EXPECT_EQ(room.depth({43, 24}), -5);
    EXPECT_TRUE(room.in_drawing({0.001, 0.001}));
    EXPECT_TRUE(room.in_drawing({39.999, 19.999}));
    EXPECT_FALSE(room.in_drawing({40.001, 10}));
    EXPECT_FALSE(room.in_drawing({-0.001, 10}));
    EXPECT_FALSE(room.in_drawing({20, -0.001}));
    EXPECT_FALSE(room.in_drawing({20, 20.001}));
    EXPECT_TRUE(room.allowed({3, 10}));
    EXPECT_FALSE(room.allowed({2.9999, 10}));
    EXPECT_TRUE(room.allowed({2.9999, 10}, 0.001));
    EXPECT_TRUE(room.allowed({2.75, 10}, 0.25));
    EXPECT_TRUE(room.allowed({3 - 5e-10, 10}));
    EXPECT_FALSE(room.allowed({3 - 1.5e-9, 10}));
    EXPECT_EQ(room.from_allowed({20, 10}), 0);
    EXPECT_NEAR(room.from_allowed({1, 10}), 2, 1e-12);
    EXPECT_NEAR(room.from_allowed({1, 1}), std::hypot(2, 2), 1e-12);
    EXPECT_EQ(room.limit().size(), 4U);
    EXPECT_EQ(room.clearance(), 3);
    EXPECT_EQ(room.high().x, 40);
    EXPECT_EQ(room.low().y, 0);
  }
  const auto narrow =
      PocketReach::make({"pocket.json", "{\"outer\": " + contour(kRoom, false) + "}"}, 10.1, 12);
  EXPECT_FALSE(narrow);
}

TEST(VerifyPocketReach, AnIslandKeepsTheToolAwayRoundItsCorners) {
  for (const bool backwards : {false, true}) {
    const PocketReach room = reach(
        "{\"outer\": " + contour(kRoom, false) + ", \"holes\": [" + contour(kIsland, backwards) + "]}", 3);
    EXPECT_EQ(room.depth({20, 10}), -2);
    EXPECT_EQ(room.depth({20, 4}), 4);
    EXPECT_NEAR(room.depth({14, 7}), std::sqrt(2), 1e-12);
    EXPECT_NEAR(room.from_allowed({14, 7}), 3 - std::sqrt(2), 1e-12);
    EXPECT_NEAR(room.from_allowed({26, 13}), 3 - std::sqrt(2), 1e-12);
    EXPECT_NEAR(room.from_allowed({20, 13}), 2, 1e-12);
    EXPECT_FALSE(room.in_drawing({20, 10}));
    EXPECT_GE(room.limit().size(), 12U);
  }
}

TEST(VerifyPocketReach, ADiscIsAsDeepAsItsRadius) {
  const PocketReach disc =
      reach(R"({"outer": [{"arc": {"from": [8, 1], "to": [8, 1], "centre": [1, 1], "ccw": true}}]})", 3);
  EXPECT_NEAR(disc.depth({1, 1}), 7, 1e-12);
  EXPECT_NEAR(disc.depth({4, 5}), 2, 1e-12);
  EXPECT_NEAR(disc.depth({7, 9}), -3, 1e-12);
  EXPECT_NEAR(disc.from_allowed({4, 5}), 1, 1e-12);
  // Arcs that begin elsewhere are cut where they are lowest, highest and outermost.
  for (const bool ccw : {true, false}) {
    const PocketReach turned =
        reach(fmt::format(R"({{"outer": [{{"arc": {{"from": [3, 4], "to": [-3, -4], )"
                          R"("centre": [0, 0], "ccw": {0}}}}}, {{"arc": {{"from": [-3, -4], )"
                          R"("to": [3, 4], "centre": [0, 0], "ccw": {0}}}}}]}})",
                          ccw),
              2);
    for (int degrees = 1; degrees < 360; degrees += 2)
      for (const double r : {0.5, 2.5, 4.5, 4.999, 5.001, 6.0}) {
        const Place p{r * std::cos(degrees * kDegree), r * std::sin(degrees * kDegree)};
        EXPECT_NEAR(turned.depth(p), 5 - r, 1e-9) << degrees;
        EXPECT_NEAR(turned.from_allowed(p), std::max(0.0, r - 3), 1e-9) << degrees;
      }
  }
  // Three quarters of a circle, about an inner corner that the tool goes round.
  const PocketReach three = reach(
      R"({"outer": [{"line": {"from": [0, 0], "to": [10, 0]}}, {"arc": {"from": [10, 0], "to": [0, -10], "centre": [0, 0], "ccw": true}},
       {"line": {"from": [0, -10], "to": [0, 0]}}]})",
      2);
  EXPECT_NEAR(three.depth({-1, 1}), std::sqrt(2), 1e-12);
  EXPECT_NEAR(three.from_allowed({-1, 1}), 2 - std::sqrt(2), 1e-12);
  EXPECT_NEAR(three.depth({5, -5}), -5, 1e-12);
  EXPECT_NEAR(three.from_allowed({3, 1}), 1, 1e-12);
  EXPECT_NEAR(three.from_allowed({-9, 0}), 1, 1e-12);
}

TEST(VerifyPocketReach, BeyondAnOpenEdgeTheToolMayStand) {
  for (const bool backwards : {false, true}) {
    // The second edge is that on the right, backwards too.
    const PocketReach room = reach("{\"outer\": " + contour(kRoom, backwards, 1) + "}", 3);
    EXPECT_NEAR(room.high().x, 52, 1e-12);
    EXPECT_NEAR(room.depth({40, 10}), 10, 1e-12);
    EXPECT_NEAR(room.depth({45, 10}), 7, 1e-12);
    EXPECT_NEAR(room.depth({45, 2}), 2, 1e-12);
    EXPECT_NEAR(room.depth({53, 10}), -1, 1e-12);
    EXPECT_TRUE(room.inside({45, 10}));
    EXPECT_FALSE(room.in_drawing({45, 10}));
    EXPECT_FALSE(room.inside({45, -0.1}));
    EXPECT_TRUE(room.allowed({49, 10}));
    EXPECT_FALSE(room.allowed({49.1, 10}));
  }
}

TEST(VerifyPocketReach, WhatIsNoPocketIsRefused) {
  const auto says = [](const char* text) {
    const auto made = PocketReach::make({"pocket.json", text}, 3, 12);
    return made ? "" : made.error().message;
  };
  EXPECT_TRUE(says("{").starts_with("pocket.json:"));
  EXPECT_TRUE(says("{}").starts_with("pocket.json: "));
  EXPECT_EQ(
      says(
          R"({"outer": [{"line": {"from": [0, 0], "to": [10, 0]}}, {"line": {"from": [10, 0], "to": [0, 10]}},
      {"line": {"from": [0, 10], "to": [10, 10]}}, {"line": {"from": [10, 10], "to": [0, 0]}}]})"),
      "pocket.json: sides 1 and 3 meet, or cannot be told from it");
}

}  // namespace
}  // namespace lekalo::verify::verify_reach_test

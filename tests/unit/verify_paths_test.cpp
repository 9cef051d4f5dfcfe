// The strokes that a program's path is made of, the cuts among them, and the time that a machine takes.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/verify/simulate.hpp"
#include "verify/pocket/cut_path.hpp"
#include "verify/pocket/stroke.hpp"

namespace lekalo::verify::verify_paths_test {
namespace {

constexpr double kPi = 3.141592653589793;

Stroke line(Place from, Place to) { return {false, true, from, to, {}, 0}; }
/// A quarter turn or less of the circle of radius 2 about (1, 1), between two of its directions.
Stroke arc(Place from, Place to, bool ccw = true) {
  const Place centre{1, 1};
  return {true, ccw, centre + 2 * from, centre + 2 * to, centre, 2};
}
const Stroke kQuarter = arc({1, 0}, {0, 1});      // from (3, 1) to (1, 3)
const Stroke kBack = arc({0, 1}, {1, 0}, false);  // the same, clockwise

void expect_place(Place found, Place wanted) {
  EXPECT_NEAR(found.x, wanted.x, 1e-12);
  EXPECT_NEAR(found.y, wanted.y, 1e-12);
}

TEST(VerifyStroke, AnglesAreThoseFromOneDirectionToTheOther) {
  for (int degrees = -179; degrees <= 180; ++degrees) {
    const double angle = degrees * kPi / 180;
    for (const double turn : {0.0, 0.7, 2.0, -2.5}) {
      const Place a{2 * std::cos(turn), 2 * std::sin(turn)},
          b{0.5 * std::cos(turn + angle), 0.5 * std::sin(turn + angle)};
      const double found = angle_between(a, b);
      EXPECT_LE(std::abs(std::remainder(found - angle, 2 * kPi)), 2e-15) << degrees << " " << turn;
    }
  }
  EXPECT_EQ(angle_between({1, 0}, {3, 0}), 0);
  EXPECT_EQ(angle_between({1, 0}, {-1, 0}), kPi);
  EXPECT_EQ(angle_between({-1, 0}, {1, 0}), kPi);
  EXPECT_EQ(angle_between({1, 0}, {0, 2}), kPi / 2);
  EXPECT_EQ(angle_between({1, 0}, {0, -2}), -kPi / 2);
  EXPECT_EQ(angle_between({0, 0}, {1, 2}), 0);
  EXPECT_EQ(angle_between({1, 2}, {0, 0}), 0);
}

TEST(VerifyStroke, ThePlaceThatIsNearestIsBetweenTheEndsOrOneOfThem) {
  const Stroke level = line({1, 1}, {5, 1});
  expect_place(nearest_on(level, {3, 4}), {3, 1});
  expect_place(nearest_on(level, {0, 3}), {1, 1});
  expect_place(nearest_on(level, {7, 3}), {5, 1});
  expect_place(nearest_on(line({2, 3}, {2, 3}), {7, 3}), {2, 3});
  for (const Stroke& s : {kQuarter, kBack}) {
    expect_place(nearest_on(s, {2, 2}), {1 + std::sqrt(2), 1 + std::sqrt(2)});
    expect_place(nearest_on(s, {9, 9}), {1 + std::sqrt(2), 1 + std::sqrt(2)});
    expect_place(nearest_on(s, {5, 1}), {3, 1});
    expect_place(nearest_on(s, {1, 1.5}), {1, 3});
    expect_place(nearest_on(s, {5, 0}), {3, 1});
    expect_place(nearest_on(s, {0, 5}), {1, 3});
    expect_place(nearest_on(s, {0, -0.5}), {3, 1});  // behind the centre
    expect_place(nearest_on(s, {-0.5, 0}), {1, 3});
  }
  expect_place(nearest_on(kQuarter, {1, 1}), {3, 1});  // from the centre both ends are as near
  expect_place(nearest_on(kQuarter, {-1, -1}), {3, 1});
  // An arc whose end is a rounding before its beginning is there, and not opposite.
  expect_place(nearest_on({true, true, {3, 1}, {3, 1 - 1e-9}, {1, 1}, 2}, {-5, 1}), {3, 1});
  EXPECT_NEAR(distance({5, 1}, kQuarter), 2, 1e-12);
  EXPECT_NEAR(distance({2, 2}, kQuarter), 2 - std::sqrt(2), 1e-12);
}

TEST(VerifyStroke, StrokesAreAsFarApartAsTheirNearestPlaces) {
  const auto apart = [](const Stroke& a, const Stroke& b, double wanted) {
    EXPECT_NEAR(distance_apart(a, b), wanted, 1e-12);
    EXPECT_NEAR(distance_apart(b, a), wanted, 1e-12);
  };
  apart(line({0, 0}, {4, 0}), line({2, 3}, {2, 9}), 3);
  apart(line({0, 0}, {4, 0}), line({7, 4}, {9, 9}), 5);
  // Past the middle of the arc, past its ends, and from within.
  apart(kQuarter, line({0, 6}, {6, 0}), (6 - 2) / std::sqrt(2) - 2);
  apart(kQuarter, line({5, 0}, {5, 9}), 2);
  apart(kQuarter, line({5, 1.5}, {5, 9}), std::hypot(4, 0.5) - 2);
  apart(kQuarter, line({1, 1}, {1.5, 1.5}), 2 - std::sqrt(0.5));
  apart(kQuarter, line({-4, 1}, {-4, 2}), std::sqrt(26));
  apart(kQuarter, line({4, 4}, {4, 4}), std::sqrt(18) - 2);
  // Two arcs whose circles are side by side, one in the other, and about one centre.
  const Stroke turned_away{true, true, {7, 5}, {5, 7}, {5, 5}, 2};
  apart(kQuarter, turned_away, distance({7, 5}, kQuarter));
  const Stroke facing{true, true, {3, 5}, {5, 3}, {5, 5}, 2};
  apart(kQuarter, facing, std::sqrt(32) - 4);
  const Stroke within{true, true, {2, 1}, {1, 2}, {1, 1}, 1};
  apart(kQuarter, within, 1);
}

std::vector<Place> crossings(const Stroke& a, const Stroke& b) {
  std::vector<Place> places;
  add_crossings(a, b, places);
  return places;
}

TEST(VerifyStroke, CrossingsLieOnBoth) {
  const auto one = [](const Stroke& a, const Stroke& b, Place wanted) {
    for (const auto& places : {crossings(a, b), crossings(b, a)}) {
      ASSERT_EQ(places.size(), 1U);
      expect_place(places[0], wanted);
    }
  };
  const auto none = [](const Stroke& a, const Stroke& b) {
    EXPECT_TRUE(crossings(a, b).empty());
    EXPECT_TRUE(crossings(b, a).empty());
  };
  one(line({0, 0}, {4, 4}), line({0, 4}, {4, 0}), {2, 2});
  one(line({0, 0}, {4, 0}), line({4, 0}, {4, 4}), {4, 0});
  none(line({0, 0}, {4, 0}), line({4.1, -1}, {4.1, 4}));
  none(line({0, 0}, {4, 0}), line({2, 0.1}, {2, 4}));
  none(line({0, 0}, {4, 0}), line({0, 1}, {4, 1}));
  none(line({0, 0}, {4, 0}), line({1, 0}, {3, 0}));
  one(kQuarter, line({1, 1}, {5, 5}), {1 + std::sqrt(2), 1 + std::sqrt(2)});
  one(kQuarter, line({-5, 2}, {5, 2}), {1 + std::sqrt(3), 2});
  one(kBack, line({2, -5}, {2, 5}), {2, 1 + std::sqrt(3)});
  none(kQuarter, line({-5, 0}, {5, 0}));
  none(kQuarter, line({3.1, 0}, {3.1, 5}));
  none(kQuarter, line({2, 2}, {2, 2}));
  EXPECT_EQ(crossings(kQuarter, line({1, 3}, {3, 1})).size(), 2U);
  // A tangent point is found from both sides.
  EXPECT_EQ(crossings(kQuarter, line({3, 0}, {3, 5})).size(), 2U);
  EXPECT_EQ(crossings(kQuarter, {true, false, {5, -1}, {3, 1}, {5, 1}, 2}).size(), 2U);
  // So close, two circles are one, and two lines parallel.
  const auto beside = [](double by) { return Stroke{true, true, {2 + by, 0}, {by, 2}, {by, 0}, 2}; };
  EXPECT_EQ(crossings(beside(0), beside(1e-12)).size(), 0U);
  EXPECT_EQ(crossings(beside(0), beside(1.5e-12)).size(), 1U);
  EXPECT_EQ(crossings(line({0, 0}, {1, 0}), line({0, 0}, {1, 1e-12})).size(), 0U);
  EXPECT_EQ(crossings(line({0, 0}, {1, 0}), line({0, 0}, {1, 1.5e-12})).size(), 1U);
  one(kQuarter, {true, true, {1, 1}, {3, 3}, {1, 3}, 2}, {1 + std::sqrt(3), 2});
  none(kQuarter, {true, true, {9, 3}, {7, 5}, {7, 3}, 2});
  none(kQuarter, {true, true, {2, 1}, {1, 2}, {1, 1}, 1});
  none(kQuarter, {true, true, {1.5, 1}, {1.1, 1.4}, {1.1, 1}, 0.4});
}

TEST(VerifyStroke, ARayIsCrossedByWhatBeginsOnItAndNotByWhatEndsOnIt) {
  const Stroke up = line({2, 1}, {4, 3}), down = line({4, 3}, {2, 1});
  for (const Stroke& s : {up, down}) {
    EXPECT_TRUE(crosses_ray_to_the_right(s, {0, 2}));
    EXPECT_TRUE(crosses_ray_to_the_right(s, {2.9, 2}));
    EXPECT_FALSE(crosses_ray_to_the_right(s, {3, 2}));
    EXPECT_FALSE(crosses_ray_to_the_right(s, {3.1, 2}));
    EXPECT_TRUE(crosses_ray_to_the_right(s, {0, 1}));
    EXPECT_FALSE(crosses_ray_to_the_right(s, {0, 3}));
    EXPECT_FALSE(crosses_ray_to_the_right(s, {0, 0.9}));
    EXPECT_FALSE(crosses_ray_to_the_right(s, {0, 3.1}));
  }
  EXPECT_FALSE(crosses_ray_to_the_right(line({1, 2}, {5, 2}), {0, 2}));
  for (const Stroke& s : {kQuarter, kBack}) {
    EXPECT_TRUE(crosses_ray_to_the_right(s, {1 + std::sqrt(3) - 1e-9, 2}));
    EXPECT_FALSE(crosses_ray_to_the_right(s, {1 + std::sqrt(3) + 1e-9, 2}));
    EXPECT_TRUE(crosses_ray_to_the_right(s, {0, 1}));
    EXPECT_FALSE(crosses_ray_to_the_right(s, {0, 3}));
  }
  const Stroke five{true, true, {5, 0}, {3, 4}, {0, 0}, 5};
  EXPECT_TRUE(crosses_ray_to_the_right(five, {3.999, 3}));
  EXPECT_FALSE(crosses_ray_to_the_right(five, {4, 3}));
  // An end may be a rounding farther out than the radius.
  const Stroke high{true, true, {2, 0}, {0, 2 + 1e-9}, {0, 0}, 2};
  EXPECT_TRUE(crosses_ray_to_the_right(high, {-1, 2 + 5e-10}));
  EXPECT_FALSE(crosses_ray_to_the_right(high, {1, 2 + 5e-10}));
  const Stroke left = arc({0, 1}, {-1, 0});
  EXPECT_TRUE(crosses_ray_to_the_right(left, {1 - std::sqrt(3) - 1e-9, 2}));
  EXPECT_FALSE(crosses_ray_to_the_right(left, {1 - std::sqrt(3) + 1e-9, 2}));
}

TEST(VerifyStroke, SharesOfTheWayRunFromEndToEnd) {
  expect_place(at_share(line({1, 1}, {5, 9}), 0.25), {2, 3});
  for (const Stroke& s : {line({1, 1}, {5, 9}), kQuarter, kBack}) {
    EXPECT_EQ(at_share(s, 0).x, s.from.x);
    EXPECT_EQ(at_share(s, -1).x, s.from.x);
    EXPECT_EQ(at_share(s, 1).x, s.to.x);
    EXPECT_EQ(at_share(s, 2).x, s.to.x);
  }
  for (int degrees = 0; degrees < 360; ++degrees) {
    const double angle = degrees * kPi / 180;
    const Stroke s = arc({std::cos(angle), std::sin(angle)}, {std::cos(angle + 1), std::sin(angle + 1)});
    EXPECT_EQ(at_share(s, 0).x, s.from.x);
    EXPECT_EQ(at_share(s, 1).x, s.to.x);
  }
  expect_place(at_share(kQuarter, 0.5), {1 + std::sqrt(2), 1 + std::sqrt(2)});
  expect_place(heading(kQuarter, {3, 1}), {0, 1});
  expect_place(heading(kBack, {3, 1}), {0, -1});
  expect_place(heading(line({1, 1}, {5, 1}), {3, 1}), {1, 0});
}

/// The strokes of an arc: as many as this, one after another, no longer than that, and all of them so long.
void expect_arc(Place from, Place to, bool ccw, double longest, std::size_t count, double degrees) {
  std::vector<Stroke> strokes;
  const Place centre{1, 2};
  add_arc(centre + 3 * from, centre + 3 * to, centre, ccw, longest, strokes);
  EXPECT_EQ(strokes.size(), count) << degrees;
  double whole = 0;
  Place at = centre + 3 * from;
  for (const Stroke& s : strokes) {
    EXPECT_TRUE(s.arc);
    EXPECT_EQ(s.ccw, ccw);
    EXPECT_LE(length(s), longest);
    expect_place(s.from, at);
    at = s.to, whole += length(s);
  }
  expect_place(at, centre + 3 * to);
  EXPECT_NEAR(whole, 3 * degrees * kPi / 180, 1e-9);
}

TEST(VerifyStroke, ArcsAreCutIntoQuartersAndTheseIntoHalves) {
  const auto at = [](double degrees) {
    return Place{std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180)};
  };
  for (const bool ccw : {true, false}) {
    const double hand = ccw ? 1 : -1;
    for (const double begin : {0.0, 77.0}) {
      const Place from = at(begin);
      expect_arc(from, at(begin + 30 * hand), ccw, 100, 1, 30);
      expect_arc(from, at(begin + 89 * hand), ccw, 100, 1, 89);
      expect_arc(from, at(begin + 91 * hand), ccw, 100, 2, 91);
      expect_arc(from, at(begin + 179 * hand), ccw, 100, 2, 179);
      expect_arc(from, at(begin + 181 * hand), ccw, 100, 3, 181);
      expect_arc(from, at(begin + 269 * hand), ccw, 100, 3, 269);
      expect_arc(from, at(begin + 271 * hand), ccw, 100, 4, 271);
      expect_arc(from, at(begin + 359 * hand), ccw, 100, 4, 359);
      expect_arc(from, from, ccw, 100, 4, 360);
      expect_arc(from, from, ccw, 4.8, 4, 360);  // a quarter is 4.712
      expect_arc(from, from, ccw, 4.7, 8, 360);
      expect_arc(from, from, ccw, 1.2, 16, 360);
    }
    // Ends of one x or one y are no full turn, nor are two in one direction.
    expect_arc({0.8, -0.6 * hand}, {0.8, 0.6 * hand}, ccw, 100, 1, 2 * std::atan(0.75) * 180 / kPi);
    expect_arc({0.6, 0.8 * hand}, {-0.6, 0.8 * hand}, ccw, 100, 1, 2 * std::atan(0.75) * 180 / kPi);
    expect_arc({1, 0}, {1 + 1e-9, 0}, ccw, 100, 1, 0);
    expect_arc({1, 0}, {-1.5e-9, hand}, ccw, 100, 2, 90 + 1.5e-9 * 180 / kPi);
    expect_arc({1, 0}, {0, hand}, ccw, 100, 1, 90);
    expect_arc({1, 0}, {-1, 0}, ccw, 100, 2, 180);
    expect_arc({1, 0}, {0, -hand}, ccw, 100, 3, 270);
  }
}

TEST(VerifyStroke, LinesAreCutIntoPiecesOfOneLength) {
  const auto count = [](double length, double longest) {
    std::vector<Stroke> strokes;
    add_line({1, 1}, {1 + length, 1}, longest, strokes);
    EXPECT_EQ(strokes.back().to.x, 1 + length);
    EXPECT_EQ(strokes.front().from.x, 1);
    return strokes.size();
  };
  EXPECT_EQ(count(0, 2), 1U);
  EXPECT_EQ(count(2, 2), 1U);
  EXPECT_EQ(count(2.1, 2), 2U);
  EXPECT_EQ(count(8, 2), 4U);
}

// ---- cuts -------------------------------------------------------------------------------------------------

Move straight(Place from, double from_z, Place to, double to_z, bool rapid = false) {
  return {.rapid = rapid,
          .from = from,
          .to = to,
          .centre = {},
          .from_z = from_z,
          .to_z = to_z,
          .feed = 600,
          .line = 7};
}
CutPath cuts(const std::vector<Move>& moves, double longest = 100) {
  auto path = cut_path(moves, 0, 3, longest, "p");
  EXPECT_TRUE(path);
  return path ? *path : CutPath{};
}

TEST(VerifyCutPath, CutsAreWhatRunsBelowTheTop) {
  EXPECT_TRUE(cuts({straight({0, 0}, 0, {10, 0}, 0)}).cuts.empty());
  EXPECT_TRUE(cuts({straight({0, 0}, 5, {10, 0}, 0)}).cuts.empty());
  EXPECT_EQ(cuts({straight({0, 0}, -1, {10, 0}, -1)}).cuts.size(), 1U);
  // Down from 5 to -5, and up again: of each way half is a cut.
  for (const bool up : {false, true}) {
    const CutPath path = cuts({straight({0, 0}, up ? -5 : 5, {10, 0}, up ? 5 : -5)});
    ASSERT_EQ(path.cuts.size(), 1U);
    const Cut& cut = path.cuts[0];
    expect_place(cut.stroke.from, {up ? 0.0 : 5.0, 0});
    expect_place(cut.stroke.to, {up ? 5.0 : 10.0, 0});
    EXPECT_EQ(cut.from_z, up ? -5 : 0);
    EXPECT_EQ(cut.to_z, up ? 0 : -5);
    EXPECT_EQ(cut.line, 7U);
    EXPECT_EQ(cut.radius, 3);
    EXPECT_FALSE(cut.rapid);
    EXPECT_EQ(path.deepest, -5);
    EXPECT_EQ(path.strokes.size(), 1U);
  }
  // In pieces, those above are none.
  const CutPath path = cuts({straight({0, 0}, 5, {10, 0}, -5, true)}, 1);
  ASSERT_EQ(path.cuts.size(), 5U);
  EXPECT_TRUE(path.cuts[0].rapid);
  EXPECT_EQ(path.cuts[0].from_z, 0);
  EXPECT_EQ(path.cuts[4].to_z, -5);
  EXPECT_NEAR(path.cuts[2].to_z, -3, 1e-12);
  EXPECT_EQ(cuts({straight({0, 0}, -5, {10, 0}, 5)}, 1).cuts.size(), 5U);
  // Straight down there is a place and no stroke.
  const CutPath plunge = cuts({straight({4, 4}, 5, {4, 4}, -2)});
  ASSERT_EQ(plunge.cuts.size(), 1U);
  expect_place(plunge.cuts[0].stroke.from, {4, 4});
  EXPECT_EQ(plunge.cuts[0].from_z, 0);
  EXPECT_EQ(plunge.cuts[0].to_z, -2);
}

TEST(VerifyCutPath, EntriesAreCountedFromWhereTheToolComesDown) {
  const std::vector<Move> pass{straight({0, 0}, 5, {0, 0}, -1), straight({0, 0}, -1, {9, 0}, -1),
                               straight({9, 0}, -1, {9, 0}, 5)};
  std::vector<Move> twice = pass;
  twice.insert(twice.end(), pass.begin(), pass.end());
  EXPECT_EQ(cuts({}).retracts, 0U);
  EXPECT_EQ(cuts(pass).retracts, 0U);
  EXPECT_EQ(cuts(twice).retracts, 1U);
  const std::vector<Cut> found = cuts(twice).cuts;
  std::vector<std::size_t> entries;
  for (const Cut& cut : found) entries.push_back(cut.entry);
  EXPECT_EQ(entries, (std::vector<std::size_t>{1, 1, 1, 2, 2, 2}));
  // Up to the top itself is out; a move along it as well.
  EXPECT_EQ(cuts({straight({0, 0}, -1, {9, 0}, 0), straight({9, 0}, 0, {12, 0}, -1)}).cuts[1].entry, 2U);
  EXPECT_EQ(cuts({straight({0, 0}, -1, {9, 0}, -0.5), straight({9, 0}, -0.5, {12, 0}, -1)}).cuts[1].entry,
            1U);
  EXPECT_EQ(cuts({straight({0, 0}, -1, {9, 0}, -1), straight({9, 0}, 0, {9, 0}, 0),
                  straight({9, 0}, -1, {12, 0}, -1)})
                .cuts[1]
                .entry,
            2U);
}

TEST(VerifyCutPath, HelicesTurnAsOftenAsTheySay) {
  Move helix{.arc = true,
             .from = {4, 0},
             .to = {4, 0},
             .centre = {0, 0},
             .from_z = 0,
             .to_z = -3,
             .turns = 3,
             .feed = 600,
             .line = 7};
  const CutPath path = cuts({helix});
  ASSERT_EQ(path.cuts.size(), 12U);
  EXPECT_EQ(path.cuts.back().to_z, -3);
  EXPECT_NEAR(path.cuts[3].to_z, -1, 1e-12);
  EXPECT_EQ(path.cuts[4].from_z, path.cuts[3].to_z);
  for (const Cut& cut : path.cuts) {
    EXPECT_TRUE(cut.stroke.arc);
    EXPECT_EQ(cut.feed, 600);
  }
  helix.to = {0, 4};
  EXPECT_EQ(cuts({helix}).cuts.size(), 9U);
  // What goes below by less than a rounding does so at a place.
  helix.from_z = 1, helix.to_z = -1e-18, helix.turns = 1;
  const CutPath touching = cuts({helix});
  ASSERT_EQ(touching.cuts.size(), 1U);
  EXPECT_FALSE(touching.cuts[0].stroke.arc);
}

TEST(VerifyCutPath, APathThatIsTooLongForItsToolIsRefused) {
  // What a program may have hangs on its moves: a line of some bytes takes no more memory than others do.
  for (const auto& [moves, most] : {std::pair<std::size_t, std::size_t>{1, 210'000},
                                    {2, 220'000},
                                    {130, 1'500'000},
                                    {131, 1'500'524},
                                    {1000, 1'504'000}}) {
    std::vector<Move> all(moves, straight({0, 0}, 5, {1, 0}, 5));
    const auto with_length = [&](std::size_t length) {
      all.back() = straight({0, 0}, -1, {static_cast<double>(length), 0}, -1);
      return cut_path(all, 0, 3, 1, "p");
    };
    const auto path = with_length(most);
    ASSERT_FALSE(path) << moves;
    EXPECT_TRUE(path.error().message.starts_with(fmt::format(
        "p:7: the path in the stock is longer than {} half radii of the tool, which is the most for {} "
        "moves; correct a place that lies too far off",
        most, moves)))
        << path.error().message;
    const auto shorter = with_length(most - 1);
    ASSERT_TRUE(shorter) << moves;
    EXPECT_EQ(shorter->cuts.size(), most - 1);
    EXPECT_LE(shorter->cuts.capacity(), most);
  }
  Move helix{.arc = true,
             .from = {4, 0},
             .to = {4, 0},
             .centre = {0, 0},
             .from_z = -1,
             .to_z = -3,
             .turns = 10'000,
             .line = 7};
  EXPECT_FALSE(cut_path({helix}, 0, 3, 0.16, "p"));
  // Above the stock it may be as long as it is.
  for (const double from_z : {0.0, 1.0})
    for (const double to_z : {0.0, 1.0})
      EXPECT_TRUE(cut_path({straight({0, 0}, from_z, {1e6, 0}, to_z)}, 0, 3, 1e-3, "p"));
}

TEST(VerifyCutPath, ACutThatRunsWhereAWiderOneRanAsDeepIsRepeated) {
  const auto cut = [](const Stroke& stroke, double z, double radius) {
    Cut one;
    one.stroke = stroke, one.from_z = one.to_z = z, one.radius = radius;
    return one;
  };
  const Stroke there = line({1, 1}, {5, 3}), back = line({5, 3}, {1, 1}), up = line({1, 1}, {1, 3}),
               down = line({1, 3}, {1, 1});
  const auto again = [](const std::vector<Cut>& all) {
    std::string text;
    for (const bool one : repeated(all)) text += one ? 'r' : '-';
    return text;
  };
  EXPECT_EQ(again({cut(there, -1, 3), cut(there, -1, 3)}), "-r");
  EXPECT_EQ(again({cut(there, -1, 3), cut(back, -1, 3)}), "-r");
  EXPECT_EQ(again({cut(up, -1, 3), cut(down, -1, 3)}), "-r");
  EXPECT_EQ(again({cut(there, -1, 3), cut(line({1, 1}, {5, 3.5}), -1, 3)}), "--");
  EXPECT_EQ(again({cut(there, -1, 3), cut(there, -0.5, 3)}), "-r");
  EXPECT_EQ(again({cut(there, -1, 3), cut(there, -1.5, 3)}), "--");
  EXPECT_EQ(again({cut(there, -1, 3), cut(there, -1, 2)}), "-r");
  EXPECT_EQ(again({cut(there, -1, 3), cut(there, -1, 4)}), "--");
  // The deepest and widest so far counts.
  EXPECT_EQ(again({cut(there, -1, 3), cut(there, -2, 3), cut(there, -2, 3), cut(there, -1, 3)}), "--rr");
  EXPECT_EQ(again({cut(there, -1, 3), cut(there, -2, 4), cut(there, -1.5, 3.5)}), "--r");
  EXPECT_EQ(again({cut(there, -1, 3), cut(there, -1, 4), cut(there, -1, 4)}), "--r");
  EXPECT_EQ(again({cut(there, -1, 3), cut(there, -0.5, 4), cut(there, -1, 3)}), "--r");
  EXPECT_EQ(again({cut(there, -1, 3), cut(there, -2, 2), cut(there, -1, 3), cut(there, -2, 2)}), "--r-");
  // Arcs have a centre; two lines have none.
  EXPECT_EQ(again({cut(kQuarter, -1, 3), cut(kQuarter, -1, 3)}), "-r");
  EXPECT_EQ(again({cut(kQuarter, -1, 3), cut(kBack, -1, 3)}), "-r");
  EXPECT_EQ(again({cut(kQuarter, -1, 3), cut(line({3, 1}, {1, 3}), -1, 3)}), "--");
  EXPECT_EQ(again({cut({true, true, {2, 0}, {0, 2}, {0, 0}, 2}, -1, 3), cut(line({2, 0}, {0, 2}), -1, 3)}),
            "--");
  Stroke moved = there;
  moved.centre = {7, 7}, moved.ccw = false;
  EXPECT_EQ(again({cut(there, -1, 3), cut(moved, -1, 3)}), "-r");
  // A cut that is not level repeats nothing and is not repeated.
  Cut ramp = cut(there, -1, 3);
  ramp.to_z = -2;
  EXPECT_EQ(again({ramp, ramp}), "--");
  EXPECT_EQ(again({cut(there, -5, 3), ramp}), "--");
}

// ---- time -------------------------------------------------------------------------------------------------

double seconds(const std::vector<Move>& moves) {
  SimulateOptions options;
  options.acceleration = 500, options.rapid_feed = 6000;
  return machine_seconds(moves, options);
}
Move fed(Place from, Place to, double feed, double from_z = 0, double to_z = 0) {
  Move move = straight(from, from_z, to, to_z);
  move.feed = feed;
  return move;
}

TEST(VerifyMachineTime, AMoveSpeedsUpAndSlowsDown) {
  EXPECT_EQ(seconds({}), 0);
  EXPECT_EQ(seconds({fed({1, 1}, {1, 1}, 600)}), 0);
  // To 10 mm/s and back takes 0.04 s and 0.2 mm.
  EXPECT_NEAR(seconds({fed({0, 0}, {20, 0}, 600)}), 0.04 + 19.8 / 10, 1e-12);
  EXPECT_NEAR(seconds({fed({0, 0}, {0.2, 0}, 600)}), 0.04, 1e-12);
  // Less than that is too short for its feed.
  EXPECT_NEAR(seconds({fed({0, 0}, {0.05, 0}, 600)}), 2 * std::sqrt(0.05 / 500), 1e-12);
  EXPECT_NEAR(seconds({fed({0, 0}, {3, 0}, 600, 0, -4)}), 0.04 + 4.8 / 10, 1e-12);
  EXPECT_NEAR(seconds({fed({0, 0}, {0, 0}, 600, 0, -5)}), 0.04 + 4.8 / 10, 1e-12);
  // A rapid is as fast as the machine: 100 mm/s take 0.2 s and 10 mm each.
  EXPECT_NEAR(seconds({straight({0, 0}, 0, {50, 0}, 0, true)}), 0.4 + 30.0 / 100, 1e-12);
}

TEST(VerifyMachineTime, ACornerIsAsFastAsItsAngleAllows) {
  // Straight on without slowing down, and back from standing still.
  EXPECT_NEAR(seconds({fed({0, 0}, {10, 0}, 600), fed({10, 0}, {20, 0}, 600)}), 0.04 + 19.8 / 10, 1e-9);
  EXPECT_NEAR(seconds({fed({0, 0}, {10, 0}, 600), fed({10, 0}, {0, 0}, 600)}), 2 * (0.04 + 9.8 / 10), 1e-9);
  // The slower of two feeds holds at the joint: from 10 to 20 mm/s takes 0.02 s and 0.3 mm.
  const double both = (0.02 + 9.9 / 10) + (0.02 + 0.04 + (10 - 0.3 - 0.4) / 20);
  EXPECT_NEAR(seconds({fed({0, 0}, {10, 0}, 600), fed({10, 0}, {20, 0}, 1200)}), both, 1e-9);
  EXPECT_NEAR(seconds({fed({0, 0}, {10, 0}, 1200), fed({10, 0}, {20, 0}, 600)}), both, 1e-9);
  // Short pieces cannot stop within themselves: the speed is that from which all of the rest can.
  std::vector<Move> pieces{fed({0, 0}, {10, 0}, 6000)};
  for (int k = 0; k < 10; ++k) pieces.push_back(fed({10 + 0.1 * k, 0}, {10.1 + 0.1 * k, 0}, 6000));
  EXPECT_NEAR(seconds(pieces), seconds({fed({0, 0}, {11, 0}, 6000)}), 1e-9);
  std::reverse(pieces.begin(), pieces.end());
  for (Move& move : pieces) std::swap(move.from, move.to);
  EXPECT_NEAR(seconds(pieces), seconds({fed({0, 0}, {11, 0}, 6000)}), 1e-9);
  // At a right angle the way that leaves the corner by 0.01 mm has the radius 0.01 s / (1 - s), s =
  // sqrt(1/2).
  const double s = std::sqrt(0.5), slow = std::sqrt(500 * 0.01 * s / (1 - s));
  const double square = 2 * ((20 - slow) / 500 + (10 - (200 - slow * slow) / 1000) / 10);
  EXPECT_NEAR(seconds({fed({0, 0}, {10, 0}, 600), fed({10, 0}, {10, 10}, 600)}), square, 1e-9);
  EXPECT_NEAR(seconds({fed({0, 0}, {10, 0}, 600), fed({10, 0}, {10, 0}, 600, 0, -10)}), square, 1e-9);
  EXPECT_NEAR(seconds({fed({0, 0}, {0, 0}, 600, 10, 0), fed({0, 0}, {10, 0}, 600)}), square, 1e-9);
  // 0.1 rad within 0.5 mm are a radius of 5 mm and 50 mm/s, where the corner alone would allow more.
  const Place far{20 + 20 * std::cos(0.1), 20 * std::sin(0.1)};
  EXPECT_NEAR(seconds({fed({0, 0}, {20, 0}, 6000), fed({20, 0}, far, 6000)}),
              2 * ((200.0 - 50) / 500 + (20 - 17.5) / 100), 1e-9);
}

TEST(VerifyMachineTime, AnArcIsAsFastAsItsRadiusAllows) {
  const auto circle = [](double radius, double feed, double rise = 0, int turns = 1) {
    return seconds({Move{.arc = true,
                         .from = {radius, 0},
                         .to = {radius, 0},
                         .centre = {0, 0},
                         .to_z = rise,
                         .turns = turns,
                         .feed = feed}});
  };
  // The square of the speed is the acceleration times the radius: sqrt(500) mm/s on 1 mm.
  const double v = std::sqrt(500.0), way = 2 * kPi;
  EXPECT_NEAR(circle(1, 6000), 2 * v / 500 + (way - 1) / v, 1e-9);
  EXPECT_NEAR(circle(1, 600), 0.04 + (way - 0.2) / 10, 1e-9);
  EXPECT_NEAR(circle(1, 6000, 0, 3), 2 * v / 500 + (3 * way - 1) / v, 1e-9);
  // Along a helix the part of the speed across its axis counts.
  const double whole = std::hypot(way, 3), level = way / whole, w = v / level;
  EXPECT_NEAR(circle(1, 6000, 3), 2 * w / 500 + (whole - w * w / 500) / w, 1e-6);
  EXPECT_NEAR(circle(1, 6000, -3), circle(1, 6000, 3), 1e-12);
  // What is left of it beyond its full turns may be no way at all.
  Move twice;
  twice.arc = true, twice.turns = 2, twice.feed = 6000;
  twice.from = {1, 0}, twice.to = {1 + 1e-9, 0};
  EXPECT_NEAR(seconds({twice}), circle(1, 6000), 1e-9);
  // A wide one is not cut into pieces of a quarter of a millimetre.
  EXPECT_NEAR(circle(1e6, 6000), 0.4 + (2e6 * kPi - 20) / 100, 1e-3);
}

TEST(VerifyMachineTime, ManyShortLinesAreAsSlowAsTheCurveThatTheyFollow) {
  // A circle of 1 mm in 60 chords is not faster than the circle, where each corner alone would be.
  std::vector<Move> chords;
  for (int k = 0; k < 60; ++k) {
    const auto at = [](int i) { return Place{std::cos(i * kPi / 30), std::sin(i * kPi / 30)}; };
    chords.push_back(fed(at(k), at(k + 1), 6000));
  }
  const double v = std::sqrt(500.0);
  EXPECT_NEAR(seconds(chords), 2 * v / 500 + (2 * kPi - 1) / v, 0.015);
}

// ---- options ----------------------------------------------------------------------------------------------

TEST(VerifySimulateOptions, AreWithinTheirBounds) {
  struct Bounds {
    const char* what;
    double SimulateOptions::*option;
    double low, high;
  };
  const Bounds all[] = {{"a tool diameter of ", &SimulateOptions::tool_diameter, 1e-3, 1e4},
                        {"a stock to leave of ", &SimulateOptions::stock_to_leave, 0, 1e4},
                        {"a step-over of ", &SimulateOptions::step_over, 1e-3, 1},
                        {"a top of ", &SimulateOptions::top, -1e6, 1e6},
                        {"an acceleration of ", &SimulateOptions::acceleration, 1e-3, 1e9},
                        {"a rapid feed of ", &SimulateOptions::rapid_feed, 1e-3, 1e9},
                        {"a spacing of ", &SimulateOptions::spacing, 1e-4, 10}};
  // Behind the options the program is refused.
  const auto said = [](const SimulateOptions& options, double earlier = 1) {
    const auto report = simulate({"p", "G41\n"}, {"q", "{}"}, options, {{{"e", ""}, earlier}});
    return report ? "" : report.error().message;
  };
  for (const Bounds& one : all)
    for (const auto& [value, inside] : {std::pair{one.low, true},
                                        {one.high, true},
                                        {one.low - 1e-5 * std::max(1e-3, std::abs(one.low)), false},
                                        {one.high * 1.00001, false},
                                        {std::nan(""), false}}) {
      SimulateOptions options;
      options.tool_diameter = 6;
      options.*one.option = value;
      EXPECT_EQ(said(options).starts_with(one.what), !inside) << one.what << value << said(options);
    }
  SimulateOptions options;
  options.tool_diameter = 6;
  EXPECT_TRUE(said(options, 1e-3).starts_with("p:1"));
  EXPECT_TRUE(said(options, 1e4).starts_with("p:1"));
  EXPECT_TRUE(said(options, 0.9e-3).starts_with("an earlier tool's diameter"));
  EXPECT_TRUE(said(options, 1.1e4).starts_with("an earlier tool's diameter"));
}

}  // namespace
}  // namespace lekalo::verify::verify_paths_test

// The checker's places of a pocket's walls: which of them a path cuts, and when the tool is beside them.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "verify/heat/wall_places.hpp"

namespace lekalo::verify_wall_places_test {
namespace {

/// Two seconds along the wall at X 0, with the tool's middle at X `x`.
verify::CutPiece beside(double x, double from_z, double to_z, double start = 0) {
  verify::CutPiece piece;
  piece.start = start, piece.seconds = 2, piece.line = 1;
  piece.from_x = piece.to_x = x, piece.from_y = 4, piece.to_y = 6, piece.length = 2;
  piece.from_z = from_z, piece.to_z = to_z;
  return piece;
}

/// Of a tool of 6 mm and a block 10 mm thick, looking at the first of two stations. They refer to the path.
struct Places : verify::WallPlaces {
  explicit Places(std::vector<verify::CutPiece> pieces, double spacing = 5)
      : Places(std::make_unique<verify::CutHistory>(verify::CutHistory{std::move(pieces), 20}), spacing) {}

 private:
  Places(std::unique_ptr<verify::CutHistory> path, double spacing)
      : WallPlaces({{0, 5, {-1, 0}}, {20, 5, {1, 0}}}, *path, 0, 10, 3, spacing), path_(std::move(path)) {
    go_to(0);
  }
  std::unique_ptr<verify::CutHistory> path_;
};

TEST(VerifyWallPlaces, APassIsBesideAPlaceInTheMiddleOfItsTime) {
  const Places places({beside(3, -4, -4)});
  ASSERT_EQ(places.heights(), 1U);
  EXPECT_TRUE(places.cut(0).is_cut && !places.cut(0).near_limit);
  EXPECT_TRUE(places.visited(0, 1) && places.visited(0, 1 + 1.9e-6) && places.visited(0, 1 - 1.9e-6));
  EXPECT_FALSE(places.visited(0, 1 + 2.1e-6) || places.visited(0, 1 - 2.1e-6) || places.visited(0, 0));
}

TEST(VerifyWallPlaces, OnlyMotionsBelowTheTopThatAreNoRapidsCut) {
  // A dwell has no line.
  verify::CutPiece dwell = beside(3, -4, -4, 2), rapid = beside(3, -4, -4, 4), second = beside(3, -4, -4, 6);
  dwell.line = 0, rapid.rapid = true, second.line = 2;
  const Places places({beside(3, -4, -4), dwell, rapid, second});
  EXPECT_TRUE(places.visited(0, 1) && places.visited(0, 7));
  EXPECT_FALSE(places.visited(0, 3) || places.visited(0, 5));
  for (const verify::CutPiece& alone : {dwell, rapid, beside(3, 0, 0)})
    EXPECT_FALSE(Places({alone}).cut(0).is_cut);
}

// It is as deep as its higher end, and borders no level.
TEST(VerifyWallPlaces, ARampCutsToItsHigherEnd) {
  for (const auto& [from, to] : {std::pair{-8.0, -1.0}, {-1.0, -8.0}}) {
    const Places places({beside(3.02, -8, -8), beside(3, from, to, 2)}, 2);
    ASSERT_EQ(places.heights(), 4U);
    EXPECT_TRUE(places.visited(0, 3)) << "at Z -1";
    EXPECT_FALSE(places.visited(1, 3)) << "at Z -3";
    EXPECT_TRUE(places.visited(1, 1));
  }
}

TEST(VerifyWallPlaces, APassAsNearAsTheNearestIsBesideThePlaceToo) {
  const Places places({beside(3, -4, -4), beside(3.029, -4, -4, 2), beside(3.031, -4, -4, 4)});
  EXPECT_TRUE(places.visited(0, 1) && places.visited(0, 3));
  EXPECT_FALSE(places.visited(0, 5));
}

TEST(VerifyWallPlaces, TheRimHasToComeWithinATenth) {
  const auto cut = [](double x) { return Places({beside(x, -4, -4)}).cut(0); };
  EXPECT_TRUE(cut(3.0999999).is_cut && !cut(3.0999999).near_limit);
  EXPECT_TRUE(cut(3.1 - 5e-10).near_limit && cut(3.1 + 5e-10).near_limit);
  EXPECT_FALSE(cut(3.1000001).is_cut || cut(3.1000001).near_limit);
  EXPECT_FALSE(Places({}).cut(0).is_cut);
}

TEST(VerifyWallPlaces, APlaceIsFoundWithinWhatItIsRoundedBy) {
  const Places places({beside(3, -4, -4)});
  for (const double off : {1.9e-6, -1.9e-6}) {
    const auto which = places.find(off, 5 + off, -2 + off);
    ASSERT_TRUE(which);
    EXPECT_TRUE(which->station == 0 && which->height == 0);
  }
  EXPECT_EQ(places.find(20, 5, -2)->station, 1U);
  for (const double off : {2.1e-6, -2.1e-6})
    EXPECT_FALSE(places.find(off, 5, -2) || places.find(0, 5 + off, -2) || places.find(0, 5, -2 + off));
}

// The path of a program is no deeper than the block.
TEST(VerifyWallPlaces, HeightsDivideWhatIsCutOfTheBlock) {
  EXPECT_EQ(Places({beside(3, -4, -4)}, 1).heights(), 4U);
  EXPECT_EQ(Places({beside(3, -40, -40)}, 1).heights(), 10U);
  EXPECT_TRUE(Places({beside(3, -4, -4)}, 4).find(0, 5, -2));
  EXPECT_TRUE(Places({beside(3, -40, -40)}, 10).find(0, 5, -5));
}

// What cuts a place on the border of two levels would be a matter of rounding.
TEST(VerifyWallPlaces, HeightsStandInsideOfLevels) {
  const auto at = [](const Places& places, std::vector<double> heights) {
    EXPECT_EQ(places.heights(), heights.size());
    for (const double z : heights) EXPECT_TRUE(places.find(0, 5, z)) << z;
  };
  for (const double spacing : {2.0, 3.0, 4.0, 50.0})
    at(Places({beside(3, -2, -2), beside(3, -4, -4)}, spacing), {-1, -3});
  at(Places({beside(3, -4, -4), beside(3, -1, -1)}, 1), {-0.5, -1.5, -2.5, -3.5});
  at(Places({beside(3, -4, -4), beside(3, -1, -1)}, 2), {-0.5, -1.75, -3.25});
  // Depths that a hundredth parts are one level, the deepest cut's above all.
  at(Places({beside(3, -2, -2), beside(3, -2.0099, -2.0099), beside(3, -4, -4)}, 2), {-1, -3});
  at(Places({beside(3, -2, -2), beside(3, -2.5, -2.5), beside(3, -4, -4)}, 2), {-1, -2.25, -3.25});
  at(Places({beside(3, -2, -2), beside(3, -3.9901, -3.9901), beside(3, -4, -4)}, 2), {-1, -3});
  at(Places({beside(3, -0.009, -0.009)}, 2), {-0.0045});
  // Flat passes below the block border nothing.
  at(Places({beside(3, -12, -12), beside(3, -40, -40)}, 5), {-2.5, -7.5});
}

TEST(VerifyWallPlaces, MorePlacesThanTheLimitAreTold) {
  EXPECT_FALSE(Places({beside(3, -4, -4)}, 4).too_many());
  // Of one station, so that heights alone are too many.
  const verify::CutHistory history{{beside(3, -10, -10)}, 20};
  EXPECT_TRUE(verify::WallPlaces({{0, 5, {-1, 0}}}, history, 0, 10, 3, 9e-6).too_many());
  EXPECT_FALSE(verify::WallPlaces({{0, 5, {-1, 0}}}, history, 0, 10, 3, 1e-5).too_many());
}

TEST(VerifyWallPlaces, AVisitLastsUntilTheToolWasAwayForAFifthOfASecond) {
  const double away = 0.2;
  for (const double start : {2.0, 2 + away}) {
    const auto visits = Places({beside(3, -4, -4), beside(3, -4, -4, start)}).visits(0, 0);
    ASSERT_EQ(visits.size(), 1U) << start;
    EXPECT_EQ(visits[0].start, 0);
    EXPECT_EQ(visits[0].end, start + 2);
  }
  const auto visits = Places({beside(3, -4, -4), beside(3.02, -4, -4, 2.001 + away)}).visits(0, 0);
  ASSERT_EQ(visits.size(), 2U);
  EXPECT_EQ(visits[0].end, 2);
  EXPECT_EQ(visits[1].start, 2.001 + away);
  EXPECT_DOUBLE_EQ(visits[0].distance, 3);
  EXPECT_DOUBLE_EQ(visits[1].distance, 3.02);
}

TEST(VerifyWallPlaces, APassThatIsNotAsDeepOrNotAsNearIsNoVisit) {
  const Places places({beside(3, -8, -8), beside(3, -1, -1, 10)}, 2);
  ASSERT_EQ(places.heights(), 5U);
  EXPECT_EQ(places.visits(0, 0).size(), 2U) << "at Z -0.5";
  ASSERT_EQ(places.visits(1, 0).size(), 1U) << "at Z -1.875";
  EXPECT_EQ(places.visits(1, 0)[0].start, 0);
  const Places farther({beside(3, -4, -4), beside(3.05, -4, -4, 10)});
  EXPECT_EQ(farther.visits(0, 0).size(), 1U);
  EXPECT_EQ(farther.visits(0, 0.021).size(), 2U);
}

TEST(VerifyWallPlaces, OfPassesThatAreAsNearTheFirstSaysTheDirection) {
  for (const double side : {1.0, -1.0}) {
    const auto visits = Places({beside(3 * side, -4, -4), beside(-3 * side, -4, -4, 2)}).visits(0, 0);
    ASSERT_EQ(visits.size(), 1U);
    EXPECT_EQ(visits[0].towards[0], -side);
    EXPECT_EQ(visits[0].towards[1], 0);
  }
}

// The chord is 0.035 mm farther away.
TEST(VerifyWallPlaces, AVisitIsAsNearAsTheArcInEitherDirection) {
  for (const double turn : {0.1, -0.1}) {
    verify::CutPiece piece = beside(3, -4, -4);
    piece.centre = {10, 5};
    piece.from_x = piece.to_x = 10 - 7 * std::cos(turn);
    piece.from_y = 5 + 7 * std::sin(turn), piece.to_y = 5 - 7 * std::sin(turn);
    const auto visits = Places({piece}).visits(0, 0);
    ASSERT_EQ(visits.size(), 1U);
    EXPECT_NEAR(visits[0].distance, 3, 1e-9) << turn;
    EXPECT_NEAR(visits[0].towards[0], -1, 1e-9) << turn;
  }
}

// Passes far apart from each other, in every direction.
TEST(VerifyWallPlaces, EveryPassNearAStationIsLookedAt) {
  std::vector<verify::CutPiece> pieces;
  std::vector<verify::WallStation> stations;
  for (const double x : {-90.0, 3.0, 70.0})
    for (const double y : {-80.0, 0.0, 60.0}) {
      verify::CutPiece piece = beside(x, -4, -4, 2 * static_cast<double>(pieces.size()));
      piece.from_y += y, piece.to_y += y;
      pieces.push_back(piece);
      stations.push_back({x - 3, y + 5, {-1, 0}});
    }
  const verify::CutHistory path{pieces, 20};
  verify::WallPlaces places(stations, path, 0, 10, 3, 5);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const auto which = places.find(stations[i].x, stations[i].y, -2);
    ASSERT_TRUE(which);
    places.go_to(which->station);
    for (std::size_t k = 0; k < pieces.size(); ++k)
      EXPECT_EQ(places.visited(0, pieces[k].start + 1), k == i) << i << ' ' << k;
  }
}

}  // namespace
}  // namespace lekalo::verify_wall_places_test

// Where and when a temperature can be measured, by the checker, and the heat that it supports.

#include "verify/heat/measured_places.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace lekalo::verify::verify_measured_places_test {
namespace {

const std::string kAir = "is in the air, since the tool was there before";
/// A place may be as far outside of what holds it, mm and s.
constexpr double kAside = 0.01 + 1e-6, kSeconds = 1e-6;

using Ends = std::array<std::array<double, 3>, 2>;

CutHistory history_of(const Ends& ends, double start = 0) {
  CutPiece piece;
  piece.start = start, piece.seconds = 1;
  piece.from_x = ends[0][0], piece.from_y = ends[0][1], piece.from_z = ends[0][2];
  piece.to_x = ends[1][0], piece.to_y = ends[1][1], piece.to_z = ends[1][2];
  return {{piece}, 10};
}

std::string said(const CutHistory& history, const std::array<double, 3>& at, double seconds = 5) {
  return no_place_for({20, 1, at, seconds, {1}}, history, {-20, -20, 30, 30, 10, {}}, 6, 0);
}

TEST(VerifyMeasuredPlaces, APlaceIsTakenOffWellInsideTheRimAndWellAboveTheTip) {
  const Ends level{{{0, 0, -4}, {10, 0, -4}}}, along_y{{{0, 0, -4}, {0, 10, -4}}},
      sinks{{{0, 0, 0}, {10, 0, -4}}}, rises{{{0, 0, -4}, {10, 0, 0}}}, slants{{{0, 0, -4}, {6, 8, -4}}},
      plunge{{{0, 0, 5}, {0, 0, -4}}}, lift{{{0, 0, -4}, {0, 0, 5}}};
  struct Case {
    const Ends& way;
    std::array<double, 3> at;
    bool is_air;
  };
  for (const Case& c : {Case{level, {5, 0, -2}, true},
                        {level, {5, 2.98, -2}, true},
                        {level, {5, -2.98, -2}, true},
                        {level, {5, 3, -2}, false},
                        {level, {5, -3, -2}, false},
                        {level, {12.98, 0, -2}, true},
                        {level, {13, 0, -2}, false},
                        {level, {-2.98, 0, -2}, true},
                        {level, {-3, 0, -2}, false},
                        {level, {12.5, 2, -2}, false},
                        {level, {5, 0, -3.98}, true},
                        {level, {5, 0, -4}, false},
                        {along_y, {2.98, 5, -2}, true},
                        {along_y, {3, 5, -2}, false},
                        {slants, {3 + 2.98 * 0.8, 4 - 2.98 * 0.6, -2}, true},
                        {slants, {3 + 3 * 0.8, 4 - 3 * 0.6, -2}, false},
                        {slants, {6 + 2.98 * 0.6, 8 + 2.98 * 0.8, -2}, true},
                        {slants, {6 + 3 * 0.6, 8 + 3 * 0.8, -2}, false},
                        // The tip is at -0.4 of X while the rim is about the place, at most to its end.
                        {sinks, {8, 0, -3.98}, true},
                        {sinks, {8, 0, -4}, false},
                        {sinks, {1, 0, -1.58}, true},
                        {sinks, {1, 0, -1.6}, false},
                        {sinks, {-2, 0, -0.3}, true},
                        {sinks, {-2, 0, -0.4}, false},
                        {rises, {8, 0, -1.98}, true},
                        {rises, {8, 0, -2}, false},
                        {rises, {2, 0, -3.98}, true},
                        {rises, {2, 0, -4}, false},
                        {plunge, {2.98, 0, -3.98}, true},
                        {plunge, {0, 2.98, -3.98}, true},
                        {plunge, {3, 0, -2}, false},
                        {plunge, {2.2, 2.2, -2}, false},
                        {plunge, {0, 0, -4}, false},
                        {lift, {2.98, 0, -3.98}, true}})
    EXPECT_EQ(said(history_of(c.way), c.at), c.is_air ? kAir : "")
        << c.way[1][0] << ' ' << c.way[1][2] << ": " << c.at[0] << ' ' << c.at[1] << ' ' << c.at[2];
}

TEST(VerifyMeasuredPlaces, APlaceExactlyAtTheRimOrTheTipIsNotTakenOff) {
  const double reach = 3 - kAside, tip = -2 - kAside, step = 1e-9;
  const auto level = [](double z) { return history_of({{{0, 0, z}, {8, 0, z}}}); };
  EXPECT_EQ(said(level(tip), {4, 0, -2}), "");
  EXPECT_EQ(said(level(tip - step), {4, 0, -2}), kAir);
  EXPECT_EQ(said(level(-4), {-reach, 0, -2}), "");
  EXPECT_EQ(said(level(-4), {-reach + step, 0, -2}), kAir);
  EXPECT_EQ(said(level(-4), {4, reach, -2}), "");
  EXPECT_EQ(said(level(-4), {4, reach - step, -2}), kAir);
  const auto plunge = [](double z) { return history_of({{{0, 0, 5}, {0, 0, z}}}); };
  EXPECT_EQ(said(plunge(tip), {0, 0, -2}), "");
  EXPECT_EQ(said(plunge(tip - step), {0, 0, -2}), kAir);
  EXPECT_EQ(said(plunge(-4), {reach, 0, -2}), "");
  EXPECT_EQ(said(plunge(-4), {reach - step, 0, -2}), kAir);
}

TEST(VerifyMeasuredPlaces, TheToolHasToHaveComeBefore) {
  const Ends level{{{0, 0, -4}, {10, 0, -4}}};
  const double seconds = 2;
  EXPECT_EQ(said(history_of(level, seconds - kSeconds), {5, 0, -2}, seconds), kAir);
  EXPECT_EQ(said(history_of(level, seconds), {5, 0, -2}, seconds), "");
}

TEST(VerifyMeasuredPlaces, TimesAreThoseOfTheProgramAndPlacesThoseOfTheStock) {
  const CutHistory far = history_of({{{0, 0, 5}, {10, 0, 5}}});
  const std::string time = "is outside of the program's time", stock = "is outside of the stock";
  for (const double seconds : {0.0, 10.0, 10 + kSeconds}) EXPECT_EQ(said(far, {0, 0, -5}, seconds), "");
  for (const double seconds : {-1e-9, 10 + 2 * kSeconds}) EXPECT_EQ(said(far, {0, 0, -5}, seconds), time);
  for (const std::array<double, 3>& at :
       {std::array{-20.0, 0.0, -5.0}, {30.0, 30.0, -5.0}, {0.0, 0.0, kAside}, {0.0, 0.0, -10.01}})
    EXPECT_EQ(said(far, at), "") << at[0] << ' ' << at[2];
  for (const std::array<double, 3>& at :
       {std::array{-20.02, 0.0, -5.0}, {0.0, 30.02, -5.0}, {0.0, 0.0, 0.02}, {0.0, 0.0, -10.02}})
    EXPECT_EQ(said(far, at), stock) << at[0] << ' ' << at[2];
}

TEST(VerifyMeasuredPlaces, TheHeatIsWhatMakesThePlaceAsWarmWithSomeFilm) {
  // 4 to 6 K above the surroundings, of which all of 100 J make 8 to 16 K.
  const CheckedRange heat = supported_heat({25, 1, {}, 0, {16, 12, 8}}, 20, 100);
  EXPECT_DOUBLE_EQ(heat.least, 25);
  EXPECT_DOUBLE_EQ(heat.greatest, 75);
  // Colder than the surroundings, as far as the uncertainty goes: no heat may be enough, none is taken away.
  const CheckedRange none = supported_heat({20.001, 1, {}, 0, {10}}, 20, 100);
  EXPECT_EQ(none.least, 0);
  EXPECT_NEAR(none.greatest, 10.01, 1e-9);
}

}  // namespace
}  // namespace lekalo::verify::verify_measured_places_test

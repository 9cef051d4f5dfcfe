// Corrected profiles: pressed again the surface is a cylinder.

#include "lekalo/fit/corrected.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lekalo/fit/closed_form.hpp"
#include "lekalo/fit/turning.hpp"
#include "verify/fit/turning_check.hpp"

namespace lekalo::fit_corrected_test {
namespace {

using fit::Assembly;
using fit::Corrected;
using fit::Surface;

Corrected made(double bore, double yield, const std::vector<double>& ends, Surface surface) {
  const fit::Material shaft{"steel", 210000, 0.3, 900, 0, 0}, hub{"steel", 210000, 0.3, yield, 0, 0};
  const Assembly assembly{{{bore, 18, 54, shaft}, {18, 36, 18, hub}}};
  fit::Pressing pressing(assembly);
  std::vector<std::vector<double>> interferences;
  std::vector<fit::Pressed> pressed;
  for (const double mm : ends) {
    interferences.push_back({mm});
    pressed.push_back(pressing.press({mm}).value());
  }
  return fit::corrected(assembly, interferences, pressed, ends.size() / 2, surface, 18.05).value();
}

TEST(Corrected, PressedAgainTheSurfaceIsACylinder) {
  for (const auto& [bore, yield, surface] : {std::tuple{0.0, 900.0, Surface::outside},
                                             {0.0, 340.0, Surface::outside},
                                             {8.0, 900.0, Surface::bore},
                                             {8.0, 340.0, Surface::bore}}) {
    const Corrected c = made(bore, yield, {0.033, 0.060, 0.087}, surface);
    const fit::Variation& mean = c.variations[1];
    EXPECT_GT(mean.before, 0.0005);
    EXPECT_LE(mean.after, std::max(0.001, 0.05 * mean.before)) << bore << " " << yield;
    EXPECT_LE(mean.after, 0.0003) << "rounding to a tenth of a micrometre, and little else";
    // At the least interference as much may be left the other way round.
    EXPECT_LT(c.variations[2].after, c.variations[2].before);
    for (std::size_t i = 1; i < c.profile.size(); ++i) EXPECT_LT(c.profile[i - 1].z, c.profile[i].z);
  }
}

// The hub grows more at its ends, so less is left there; a bore closes most in the middle.
TEST(Corrected, WhatGrowsMoreIsTurnedSmaller) {
  const Corrected outside = made(0, 900, {0.04}, Surface::outside),
                  bore = made(8, 900, {0.04}, Surface::bore);
  EXPECT_LT(outside.profile.back().diameter, outside.profile.front().diameter);
  EXPECT_LT(outside.profile.front().diameter, 36);
  EXPECT_GT(bore.profile.front().diameter, 8);
  EXPECT_GT(bore.profile.front().diameter, bore.profile.back().diameter);
}

// The bore of an elastic hub stays a cylinder under an even pressure, so that of a seat that becomes a
// cylinder is even, and in the mean the same as before.
TEST(Corrected, ASeatThatBecomesACylinderIsPressedEvenly) {
  for (const auto& [bore, yield, ends] : {std::tuple{0.0, 900.0, std::vector<double>{0.04}},
                                          {8.0, 900.0, std::vector<double>{0.04}},
                                          {14.0, 900.0, std::vector<double>{0.02}},
                                          {0.0, 340.0, std::vector<double>{0.033, 0.060, 0.087}},
                                          {6.0, 340.0, std::vector<double>{0.033, 0.060, 0.087}}}) {
    const Corrected c = made(bore, yield, ends, Surface::seat);
    const fit::Variation& mean = c.variations[ends.size() / 2];
    EXPECT_GT(mean.before, 0.0005);
    EXPECT_LE(mean.after, 0.05 * mean.before) << bore << " " << yield;
    EXPECT_EQ(c.profile.back().z, 9) << "the seat ends with the hub";
    EXPECT_LT(c.profile.back().diameter, c.profile.front().diameter) << "less gives way at the end";
    if (yield < 900) continue;
    const fit::Pressed& p = c.pressed[0];
    EXPECT_EQ(p.state, fit::State::elastic);
    // A tenth of a micrometre is some megapascals where it lies on one element.
    EXPECT_NEAR(p.seats[0].middle_mpa, p.seats[0].pressure_mpa, 0.01 * p.seats[0].pressure_mpa);
    fit::Pressing without({{{bore, 18, 54, {"steel", 210000, 0.3, 900, 0, 0}},
                            {18, 36, 18, {"steel", 210000, 0.3, 900, 0, 0}}}});
    const double before = (*without.press(p.interference)).seats[0].pressure_mpa;
    EXPECT_NEAR(p.seats[0].pressure_mpa, before, 2e-3 * before);
    const double lame =
        fit::lame_displacement({18, 36, 18, {"steel", 210000, 0.3, 900, 0, 0}}, 18, before, 0);
    EXPECT_NEAR(p.rings[1].outer.front().diameter, 2 * lame, 2e-3 * lame);
    EXPECT_NEAR(p.rings[1].outer.back().diameter, 2 * lame, 2e-3 * lame);
  }
}

// The end of the shaft gives way more, so the profile is not its own mirror; its files are those of all of
// it.
TEST(Corrected, BesideTheEndOfTheShaftAProfileHasTwoSides) {
  const Assembly assembly{
      {{8, 18, 54, {"steel", 210000, 0.3, 900, 0, 0}, -16}, {18, 36, 18, {"steel", 210000, 0.3, 900, 0, 0}}}};
  fit::Pressing pressing(assembly);
  const std::vector<fit::Pressed> pressed{pressing.press({0.04}).value()};
  for (const Surface surface : {Surface::outside, Surface::bore, Surface::seat}) {
    const Corrected c = fit::corrected(assembly, {{0.04}}, pressed, 0, surface, 18.04).value();
    EXPECT_LE(c.variations[0].after, std::max(0.0002, 0.05 * c.variations[0].before));
    EXPECT_NE(c.profile.front().diameter, c.profile.back().diameter);
    const verify::TurningClaim claim{false,
                                     false,
                                     surface == Surface::bore   ? verify::TurnedSurface::bore
                                     : surface == Surface::seat ? verify::TurnedSurface::seat
                                                                : verify::TurnedSurface::outside,
                                     50,
                                     1000,
                                     surface == Surface::outside ? 9.0 : 11.0};
    std::vector<verify::ProfilePoint> points;
    for (auto p = c.profile.rbegin(); p != c.profile.rend(); ++p) points.push_back({p->z, p->diameter});
    EXPECT_EQ(verify::fault_of_turning(fit::turning_program(c, {}), points, claim), std::nullopt);
    EXPECT_EQ(verify::fault_of_profile_table(fit::profile_csv(c), points), std::nullopt);
  }
}

TEST(Corrected, ASolidShaftHasNoBore) {
  const Assembly solid{
      {{0, 18, 54, {"steel", 210000, 0.3, 900, 0, 0}}, {18, 36, 18, {"steel", 210000, 0.3, 900, 0, 0}}}};
  fit::Pressing pressing(solid);
  const std::vector<fit::Pressed> pressed{pressing.press({0.03}).value()};
  EXPECT_FALSE(fit::corrected(solid, {{0.03}}, pressed, 0, Surface::bore));
}

}  // namespace
}  // namespace lekalo::fit_corrected_test

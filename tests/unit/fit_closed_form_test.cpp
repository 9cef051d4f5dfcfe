// Closed forms of interference fits: against published figures, against each other, and against the equations
// that they solve.

#include "lekalo/fit/closed_form.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lekalo::fit_closed_form_test {
namespace {

using fit::Assembly;
using fit::Material;
using fit::Ring;

Material steel(double yield) { return {"steel", 210000, 0.3, yield, 0, 11.5e-6}; }

Assembly pair(double bore, double diameter, double outer, double length, const Material& m) {
  return {{{bore, diameter, length, m}, {diameter, outer, length, m}}};
}

TEST(ClosedForm, PressuresArePublishedOnes) {
  // Textbook examples: 100/150 with 0.1 mm, 58.3 MPa; 25/50 with 20 um, 63 MPa.
  EXPECT_NEAR(fit::compound_pressures(pair(0, 100, 150, 50, steel(0)), {0.1})[0], 58.333333333, 1e-8);
  EXPECT_NEAR(fit::compound_pressures(pair(0, 25, 50, 50, steel(0)), {0.02})[0], 63, 1e-9);
}

/// The radius grows by so much where a ring spins, mm (thin disc; kg/m3, rad/s).
double grown_by_spin(const Ring& ring, double r, double density, double speed) {
  const double a = ring.inner_diameter / 2, b = ring.outer_diameter / 2, nu = ring.material.poisson;
  const double load = density * 1e-12 * speed * speed;  // N/mm4
  return load * (3 + nu) * (1 - nu) / (8 * ring.material.youngs_mpa) * r *
         (a * a + b * b + (1 + nu) / (1 - nu) * a * a * b * b / (r * r) - (1 + nu) / (3 + nu) * r * r);
}

// D. Croccolo, N. Vincenzi, A generalized theory for shaft-hub couplings, 2009 (figures: eng-tools.dev, A3):
// three cylinders with radial interferences of 0.025 and 0.01 mm, 150 MPa outside, 30 MPa in the bore, 420
// rad/s. Pressures of 161.4 and 175.0 MPa close both seats to what their last digit stands for.
TEST(ClosedForm, ThreeSpinningCylindersCloseUnderThePublishedPressures) {
  const Material iron{"steel", 206000, 0.29, 0, 0, 0}, light{"aluminium", 70000, 0.33, 0, 0, 0};
  const Ring outer{49.976, 70, 50, iron}, middle{29.99, 49.976, 50, light}, inner{20, 29.99, 50, iron};
  const double p1 = 161.4, p2 = 175.0;
  const auto at = [](const Ring& ring, double r, double in, double out, double density) {
    return fit::lame_displacement(ring, r, in, out) + grown_by_spin(ring, r, density, 420);
  };
  const double first = at(outer, 24.988, p1, 150, 7850) - at(middle, 24.988, p2, p1, 2770),
               second = at(middle, 14.995, p2, p1, 2770) - at(inner, 14.995, 30, p2, 7850);
  EXPECT_NEAR(first, 0.025, 6e-5);
  EXPECT_NEAR(second, 0.010, 6e-5);
}

TEST(ClosedForm, SeatsOfCompoundCylindersMeet) {
  const Assembly three{
      {{20, 40, 30, steel(0)}, {40, 60, 30, {"al", 70000, 0.33, 0, 0, 0}}, {60, 90, 30, steel(0)}}};
  const std::vector<double> z{0.03, 0.05};
  const std::vector<double> p = fit::compound_pressures(three, z);
  const double first = fit::lame_displacement(three.rings[1], 20, p[0], p[1]) -
                       fit::lame_displacement(three.rings[0], 20, 0, p[0]);
  const double second = fit::lame_displacement(three.rings[2], 30, p[1], 0) -
                        fit::lame_displacement(three.rings[1], 30, p[0], p[1]);
  EXPECT_NEAR(2 * first, z[0], 1e-9 * z[0]);
  EXPECT_NEAR(2 * second, z[1], 1e-9 * z[1]);
}

TEST(ClosedForm, ElasticPlasticFiguresAreThoseOfTheNotes) {
  // C45 with 340 MPa, 18/36: pressure and growth of the hub's outer diameter.
  Assembly fit = pair(0, 18, 36, 18, steel(340));
  fit.rings[0].material.yield_mpa = 0;
  const auto at = [&](double um) { return *fit::din_7190(fit, um / 1000); };
  EXPECT_EQ(at(33).state, fit::State::elastic);
  EXPECT_EQ(at(34).state, fit::State::plastic);
  EXPECT_NEAR(at(87).pressure_mpa, 255.9, 0.05);
  EXPECT_NEAR(at(87).hub_outer_growth, 0.0435, 1e-9);
  EXPECT_NEAR(at(121).pressure_mpa, 271.1, 0.05);
  EXPECT_NEAR(at(121).hub_outer_growth, 0.0605, 1e-9);
  EXPECT_TRUE(fit::din_7190(fit, 0.1345));
  EXPECT_FALSE(fit::din_7190(fit, 0.1347)) << "the hub has yielded through";
}

/// Tresca's zone by its differential equations, from its border inwards: equilibrium, and strains whose
/// plastic parts cancel.
struct Zone {
  double pressure = 0, displacement = 0;
};
Zone integrated(double border, double seat, double outer, double strength, double youngs, double poisson) {
  const double edge = strength / 2 * (1 - border * border / (outer * outer));
  double stress = -edge, r = border;
  // r u, whose derivative is r times the elastic change of area
  double ru = r * (edge * r / youngs / (outer * outer - r * r)) *
              ((1 - poisson) * r * r + (1 + poisson) * outer * outer);
  const int steps = 20000;
  const double h = (seat - border) / steps;
  for (int i = 0; i < steps; ++i) {
    const auto rate = [&](double at, double s) { return at * (1 - poisson) / youngs * (2 * s + strength); };
    const double middle = stress + strength * std::log((r + h / 2) / r),
                 end = stress + strength * std::log((r + h) / r);
    ru += h / 6 * (rate(r, stress) + 4 * rate(r + h / 2, middle) + rate(r + h, end));
    stress = end;
    r += h;
  }
  return {-stress, ru / seat};
}

TEST(ClosedForm, ElasticPlasticFormSolvesItsEquations) {
  Assembly fit = pair(0, 18, 36, 18, steel(340));
  fit.rings[0].material.yield_mpa = 0;
  for (const double um : {40.0, 87.0, 121.0, 134.0}) {
    const fit::DinFit din = *fit::din_7190(fit, um / 1000);
    const Zone zone = integrated(9 * din.zeta, 9, 18, 2 * 340 / std::numbers::sqrt3, 210000, 0.3);
    EXPECT_NEAR(zone.pressure, din.pressure_mpa, 1e-6 * din.pressure_mpa) << um;
    const double shaft = 0.7 * zone.pressure * 9 / 210000;
    EXPECT_NEAR(2 * (zone.displacement + shaft), um / 1000, 1e-6 * um / 1000) << um;
  }
}

TEST(ClosedForm, SaysNothingWhereItDoesNotHold) {
  EXPECT_FALSE(fit::din_7190(pair(6, 18, 36, 18, steel(340)), 0.1)) << "hollow shaft, and the hub yields";
  EXPECT_TRUE(fit::din_7190(pair(6, 18, 36, 18, steel(340)), 0.02)) << "elastic";
  Assembly hardens = pair(0, 18, 36, 18, steel(340));
  hardens.rings[1].material.hardening_mpa = 1000;
  EXPECT_FALSE(fit::din_7190(hardens, 0.087));
}

TEST(ClosedForm, ShrinkingNeedsInterferenceAndClearance) {
  const Ring hub{18, 36, 18, steel(340)};
  EXPECT_NEAR(*fit::shrink_difference(hub, 0.087, 0.018), 0.105 / (18 * 11.5e-6), 1e-9);
  Ring unknown = hub;
  unknown.material.expansion_per_k = 0;
  EXPECT_FALSE(fit::shrink_difference(unknown, 0.087, 0.018));
}

}  // namespace
}  // namespace lekalo::fit_closed_form_test

// Elements of pressed rings against closed forms, and against figures of another program for finite lengths.

#include "lekalo/fit/pressing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lekalo/fit/closed_form.hpp"

namespace lekalo::fit_pressing_test {
namespace {

using fit::Assembly;
using fit::Growth;
using fit::Material;
using fit::Pressed;
using fit::Pressing;
using fit::State;

constexpr double kPi = 3.14159265358979323846;

Material steel(double yield = 0) { return {"steel", 210000, 0.3, yield, 0, 0}; }

/// The growth at a place, by the parabolas of the elements.
double growth_at(const std::vector<Growth>& surface, double z) {
  for (std::size_t i = 0; i + 2 < surface.size(); i += 2) {
    const double a = surface[i].z, b = surface[i + 2].z;
    if (z > b) continue;
    const double t = (z - a) / (b - a);
    return surface[i].diameter * (1 - t) * (1 - 2 * t) + 4 * surface[i + 1].diameter * t * (1 - t) +
           surface[i + 2].diameter * t * (2 * t - 1);
  }
  return surface.back().diameter;
}

/// The integral over both halves, by Simpson's rule, as the elements have it.
double integral(const std::vector<Growth>& surface) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < surface.size(); i += 2)
    sum += (surface[i + 2].z - surface[i].z) / 6 *
           (surface[i].diameter + 4 * surface[i + 1].diameter + surface[i + 2].diameter);
  return 2 * sum;
}

TEST(Pressing, RingsOfOneLengthAreLamesTo1e9) {
  const Assembly two{{{6, 18, 6, steel()}, {18, 36, 6, {"al", 70000, 0.33, 0, 0, 0}}}};
  Pressing pressing(two, {1, 1.0 / 72});
  const Pressed pressed = *pressing.press({0.03});
  const double p = fit::compound_pressures(two, {0.03})[0];
  EXPECT_EQ(pressed.state, State::elastic);
  EXPECT_NEAR(pressed.seats[0].pressure_mpa, p, 1e-9 * p);
  for (const auto& [surface, r, ring] : {std::tuple{&pressed.rings[1].outer, 18.0, 1},
                                         {&pressed.rings[0].inner, 3.0, 0},
                                         {&pressed.rings[0].outer, 9.0, 0}})
    for (const Growth& g : *surface) {
      const double lame = 2 * fit::lame_displacement(two.rings[static_cast<std::size_t>(ring)], r,
                                                     ring == 1 ? p : 0, ring == 0 ? p : 0);
      EXPECT_NEAR(g.diameter, lame, 1e-9 * std::abs(lame)) << r << " at " << g.z;
    }
}

TEST(Pressing, CompoundCylindersAreLamesTo1e9) {
  const Assembly three{
      {{20, 40, 10, steel()}, {40, 60, 10, {"al", 70000, 0.33, 0, 0, 0}}, {60, 90, 10, steel()}}};
  Pressing pressing(three, {1, 1.0 / 56});
  const Pressed pressed = *pressing.press({0.03, 0.05});
  const std::vector<double> p = fit::compound_pressures(three, {0.03, 0.05});
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(pressed.seats[i].pressure_mpa, p[i], 1e-9 * p[i]) << i;
}

// Ideally plastic, without stress along the axis: pressure and outer growth by the zone's differential
// equation and Lame's ring around it. How the zone came to be does not matter to either.
struct Zone {
  double pressure = 0, growth = 0;
};
Zone mises_zone(double border, double seat, double outer, double yield, double youngs) {
  const double even = (outer * outer + border * border) / (outer * outer - border * border);
  const double edge = yield / std::sqrt(even * even + even + 1);
  const auto around = [&](double radial) {
    return (radial + std::sqrt(4 * yield * yield - 3 * radial * radial)) / 2;
  };
  double stress = -edge, r = border;
  const int steps = 4000;
  const double h = (seat - border) / steps;
  const auto rate = [&](double at, double s) { return (around(s) - s) / at; };
  for (int i = 0; i < steps; ++i, r += h) {
    const double k1 = rate(r, stress), k2 = rate(r + h / 2, stress + h / 2 * k1);
    const double k3 = rate(r + h / 2, stress + h / 2 * k2), k4 = rate(r + h, stress + h * k3);
    stress += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return {-stress, 2 * 2 * edge * border * border * outer / (youngs * (outer * outer - border * border))};
}

TEST(Pressing, YieldingFollowsVonMisesInPlaneStress) {
  const Assembly disc{{{0, 18, 0.5, steel()}, {18, 36, 0.5, steel(340)}}};
  Pressing pressing(disc, {1, 1.0 / 20});
  for (const double um : {60.0, 87.0}) {
    const Pressed pressed = *pressing.press({um / 1000});
    ASSERT_EQ(pressed.state, State::plastic);
    double low = 9, high = 18;  // the zone whose outer growth this is
    for (int i = 0; i < 100; ++i) {
      const double middle = (low + high) / 2;
      (mises_zone(middle, 9, 18, 340, 210000).growth < pressed.rings[1].outer[0].diameter ? low : high) =
          middle;
    }
    const double p = mises_zone(low, 9, 18, 340, 210000).pressure;
    EXPECT_NEAR(pressed.seats[0].pressure_mpa, p, 2e-3 * p) << um;
  }
}

TEST(Pressing, DinFormLiesWithinFivePercent) {
  Assembly disc{{{0, 18, 0.5, steel()}, {18, 36, 0.5, steel(340)}}};
  Pressing pressing(disc, {1, 1.0 / 10});
  for (const double um : {40.0, 87.0, 121.0}) {
    const Pressed pressed = *pressing.press({um / 1000});
    const fit::DinFit din = *fit::din_7190(disc, um / 1000);
    EXPECT_NEAR(pressed.seats[0].pressure_mpa, din.pressure_mpa, 0.05 * din.pressure_mpa) << um;
    EXPECT_NEAR(pressed.rings[1].outer[0].diameter, din.hub_outer_growth, 0.05 * din.hub_outer_growth) << um;
  }
}

// A hub that is soft presses evenly, since a ring that grows evenly with free ends is Lame's.
Assembly evenly_pressed(double bore, double diameter, double hub_length, double shaft_length) {
  return {{{bore, diameter, shaft_length, steel()},
           {diameter, 2 * diameter, hub_length, {"soft", 1, 0.3, 0, 0, 0}}}};
}

TEST(Pressing, TheEdgeOfALongPressureHasHalfTheDisplacement) {
  Pressing pressing(evenly_pressed(0, 20, 80, 200));
  const Pressed pressed = *pressing.press({0.1});
  const std::vector<Growth>& shaft = pressed.rings[0].outer;
  const double far = growth_at(shaft, 0);
  EXPECT_NEAR(growth_at(shaft, 40), far / 2, 2e-3 * std::abs(far));
  const double lame = 2 * fit::lame_displacement({0, 20, 200, steel()}, 10, 0, pressed.seats[0].pressure_mpa);
  EXPECT_NEAR(far, lame, 2e-3 * std::abs(lame));
}

/// A pressure of 1 MPa on |z| < half moves the surface of an endless solid cylinder so far, by Fourier's
/// integral: under a pressure cos(k z) it moves by (1 - nu) R / G times the factor.
double by_fourier_and_bessel(double radius, double half, double z) {
  const double nu = 0.3, shear = 210000 / 2.6;
  const auto factor = [&](double x) {
    const double i0 = std::cyl_bessel_i(0.0, x), i1 = std::cyl_bessel_i(1.0, x);
    return i1 * i1 / (x * x * (i0 * i0 - i1 * i1) - 2 * (1 - nu) * i1 * i1);
  };
  const double step = 0.02, end = 200;
  double sum = 0;
  for (double x = step / 2; x < end; x += step)
    sum += step * factor(x) * std::sin(x * half / radius) / x * std::cos(x * z / radius);
  return -(1 - nu) * radius / shear * 2 / kPi * sum;
}

TEST(Pressing, ABandOfPressureIsThatOfFourierAndBessel) {
  for (const double length : {6.0, 18.0, 40.0}) {
    Pressing pressing(evenly_pressed(0, 18, length, 160));
    const Pressed pressed = *pressing.press({0.1});
    const double pressure = pressed.seats[0].pressure_mpa, far = 0.7 * pressure * 9 / 210000;
    for (const double part : {0.0, 0.3, 0.7, 0.9, 1.0, 1.1, 1.5, 2.0})
      EXPECT_NEAR(growth_at(pressed.rings[0].outer, part * length / 2) / 2,
                  pressure * by_fourier_and_bessel(9, length / 2, part * length / 2), 3e-3 * far)
          << length << " at " << part;
  }
}

TEST(Pressing, AThinTubeBesideThePressureIsABeamOnItsFoundation) {
  const double radius = 49, wall = 2;
  Pressing pressing(evenly_pressed(2 * radius - wall, 2 * radius + wall, 100, 160));
  const Pressed pressed = *pressing.press({0.1});
  const std::vector<Growth>& shaft = pressed.rings[0].outer;
  const double far = growth_at(shaft, 0), beta = std::pow(3 * (1 - 0.09), 0.25) / std::sqrt(radius * wall);
  for (const double z : {0.0, 2.0, 4.0, 8.0, 12.0})
    EXPECT_NEAR(growth_at(shaft, 50 + z), far / 2 * std::exp(-beta * z) * std::cos(beta * z),
                0.02 * std::abs(far))
        << z;
}

// Betti with a ring that grows evenly: whatever the pressure along the seat, the mean growth is Lame's.
TEST(Pressing, MeanGrowthsAreThoseOfTheMeanPressure) {
  const Assembly fit{{{8, 18, 54, steel()}, {18, 36, 18, steel()}}};
  Pressing pressing(fit);
  const Pressed pressed = *pressing.press({0.04});
  const double force = pressed.seats[0].force_n, p = force / (kPi * 18 * 18),
               on_shaft = force / (kPi * 18 * 54);
  const auto lame = [&](std::size_t ring, double r, double in, double out, double length) {
    return 2 * length * fit::lame_displacement(fit.rings[ring], r, in, out);
  };
  const double hub_outer = lame(1, 18, p, 0, 18), hub_bore = lame(1, 9, p, 0, 18);
  const double shaft = lame(0, 9, 0, on_shaft, 54), bore = lame(0, 4, 0, on_shaft, 54);
  EXPECT_NEAR(integral(pressed.rings[1].outer), hub_outer, 1e-5 * hub_outer);
  EXPECT_NEAR(integral(pressed.rings[1].inner), hub_bore, 1e-5 * hub_bore);
  EXPECT_NEAR(integral(pressed.rings[0].outer), shaft, 1e-5 * std::abs(shaft));
  EXPECT_NEAR(integral(pressed.rings[0].inner), bore, 1e-5 * std::abs(bore));
}

struct Finite {
  double bore, yield, um;
  double middle, edge, hub_middle, hub_end;  // radius of the shaft, outer diameter of the hub, um
};

// Figures of CalculiX 2.20 for a hub 18 long; those at an edge depend on the mesh there.
TEST(Pressing, FiniteLengthsAreThoseOfCalculix) {
  for (const Finite& f : {Finite{0, 0, 40, -5.26, -3.22, 20.11, 20.98},
                          Finite{12, 0, 40, -10.67, -7.38, 0, 0}, Finite{0, 340, 87, 0, 0, 43.9, 46.1}}) {
    Pressing pressing({{{f.bore, 18, 54, steel()}, {18, 36, 18, steel(f.yield)}}});
    const Pressed pressed = *pressing.press({f.um / 1000});
    const auto near = [](double ours, double theirs) {
      if (theirs == 0) return;  // not among the figures
      EXPECT_NEAR(ours, theirs, std::max(0.01 * std::abs(theirs), 0.05));
    };
    near(500 * growth_at(pressed.rings[0].outer, 0), f.middle);
    near(500 * growth_at(pressed.rings[0].outer, 9), f.edge);
    near(1000 * pressed.rings[1].outer.front().diameter, f.hub_middle);
    near(1000 * pressed.rings[1].outer.back().diameter, f.hub_end);
  }
}

TEST(Pressing, ReleasedPartsAreElasticAgain) {
  Pressing elastic({{{0, 18, 54, steel()}, {18, 36, 18, steel(1000)}}});
  (void)*elastic.press({0.04});
  const Pressed apart = *elastic.released();
  for (const fit::RingGrowth& ring : apart.rings)
    for (const Growth& g : ring.outer) EXPECT_NEAR(g.diameter, 0, 1e-9);
  // Unloading of an ideally plastic disc is elastic: what stays is the growth less Lame's of the pressure.
  const Assembly disc{{{0, 18, 0.5, steel()}, {18, 36, 0.5, steel(340)}}};
  Pressing plastic(disc, {1, 1.0 / 10});
  const Pressed pressed = *plastic.press({0.06}), after = *plastic.released();
  const double back = 2 * fit::lame_displacement(disc.rings[1], 18, pressed.seats[0].pressure_mpa, 0);
  EXPECT_NEAR(after.rings[1].outer[0].diameter, pressed.rings[1].outer[0].diameter - back, 2e-5);
  EXPECT_GT(after.rings[1].inner[0].diameter, 0.001);
}

// A hub that is out of the middle by hardly anything is as one in the middle; one at the left end mirrors one
// at the right end.
TEST(Pressing, AHubSitsAnywhereOnTheShaft) {
  const auto pressed_at = [](double middle, double yield) {
    Pressing pressing({{{6, 18, 54, steel(), middle}, {18, 36, 18, steel(yield)}}});
    return *pressing.press({0.06});
  };
  for (const double yield : {0.0, 340.0}) {
    const Pressed half = pressed_at(0, yield), whole = pressed_at(1e-3, yield);
    EXPECT_NEAR(whole.seats[0].force_n, half.seats[0].force_n, 2e-3 * half.seats[0].force_n);
    EXPECT_NEAR(whole.seats[0].touching_mm, half.seats[0].touching_mm, 1e-9);
    for (const double z : {0.0, 4.0, 9.0, 12.0, 20.0}) {
      const double there = growth_at(half.rings[0].outer, z),
                   most = 2e-3 * std::abs(half.rings[0].outer[0].diameter);
      EXPECT_NEAR(growth_at(whole.rings[0].outer, z), there, most) << z;
      EXPECT_NEAR(growth_at(whole.rings[0].outer, -z), there, most) << z;
    }
    const Pressed right = pressed_at(-15, yield), left = pressed_at(15, yield);
    ASSERT_EQ(right.rings[0].inner.size(), left.rings[0].inner.size());
    EXPECT_NEAR(right.seats[0].force_n, left.seats[0].force_n, 1e-6 * left.seats[0].force_n);
    for (std::size_t i = 0; i < left.rings[0].inner.size(); ++i) {
      const Growth &a = left.rings[0].inner[i], &b = right.rings[0].inner[left.rings[0].inner.size() - 1 - i];
      EXPECT_NEAR(a.z, -b.z, 1e-12);
      EXPECT_NEAR(a.diameter, b.diameter, 1e-8);
    }
  }
}

TEST(Pressing, HardeningCarriesMore) {
  Pressing ideal({{{0, 18, 54, steel()}, {18, 36, 18, steel(340)}}});
  Material hard = steel(340);
  hard.hardening_mpa = 5000;
  Pressing hardens({{{0, 18, 54, steel()}, {18, 36, 18, hard}}});
  EXPECT_GT((*hardens.press({0.12})).seats[0].force_n, 1.02 * (*ideal.press({0.12})).seats[0].force_n);
}

TEST(Pressing, AHistoryIsTheSameInStepsAndAtOnce) {
  const Assembly fit{{{0, 18, 54, steel()}, {18, 36, 18, steel(340)}}};
  Pressing once(fit), steps(fit);
  (void)*steps.press({0.04});
  (void)*steps.press({0.06});
  const double a = (*once.press({0.087})).rings[1].outer[0].diameter,
               b = (*steps.press({0.087})).rings[1].outer[0].diameter;
  EXPECT_NEAR(a, b, 2e-3 * a);
}

TEST(Assembly, WhatIsNoneIsRefusedByName) {
  const auto says = [](const Assembly& a) {
    const auto checked = fit::check_assembly(a);
    return checked ? std::string() : checked.error().message;
  };
  const Material m = steel(340);
  EXPECT_EQ(says({{{0, 18, 54, m}, {18, 36, 18, m}}}), "");
  EXPECT_EQ(says({{{0, 18, 54, m}, {18, 18, 18, m}}}),
            "the hub: its inner diameter is 18 mm, not below its outer diameter of 18 mm");
  EXPECT_EQ(says({{{20, 18, 54, m}, {18, 36, 18, m}}}),
            "the shaft: its inner diameter is 20 mm, not below its outer diameter of 18 mm");
  EXPECT_NE(says({{{0, 18, 54, m}, {18, 18.1, 18, m}}}).find("a shell"), std::string::npos);
  EXPECT_NE(says({{{0, 18, 54, m}, {20, 36, 18, m}}}).find("sits on has 18 mm"), std::string::npos);
  EXPECT_NE(says({{{0, 18, 54, m, 18.1}, {18, 36, 18, m}}}).find("over the end of the shaft by 0.1 mm"),
            std::string::npos);
  EXPECT_NE(says({{{0, 18, 54, m}, {18, 36, 18, m, 1}}}).find("not at z = 0"), std::string::npos);
  EXPECT_NE(says({{{0, 18, -1, m}, {18, 36, 18, m}}}).find("length is -1 mm"), std::string::npos);
  EXPECT_NE(says({{{0, 18, 54, steel(1e5)}, {18, 36, 18, m}}}).find("yield stress"), std::string::npos);
}

/// The whole profile came with the first step, however small that was: no step was small enough, and the
/// answer was that a part does not harden, of parts that do.
TEST(Pressing, ALargeProfileOfASeatComesStepByStepAndPartsThatHardenCarryIt) {
  const Material hard{"hard", 206000, 0.3, 340, 1000, 0};
  const Assembly assembly{{{16, 40, 60, hard}, {40, 60, 40, hard}}};
  Pressing pressing(assembly, {1.0 / 6, 1.0 / 3},
                    {{0, true, [](double z) { return 0.2 * (1 - z * z / 400); }}});
  const auto pressed = pressing.press({0.03});
  ASSERT_TRUE(pressed) << pressed.error().message;
  EXPECT_EQ(pressed->state, State::full);
  EXPECT_NEAR(pressed->seats[0].pressure_mpa, 142.26, 0.01);
  EXPECT_NEAR(in_middle(pressed->rings[1].outer).diameter, 0.30797, 1e-5);
}

}  // namespace
}  // namespace lekalo::fit_pressing_test

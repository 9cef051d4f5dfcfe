// Thermoelastic displacement of voxels against closed forms. S. Timoshenko & J. Goodier, Theory of
// Elasticity, 3rd edition, 1970: linear temperature and no stress 151, disc and ring 150, plates of any
// temperature across 149.

#include "lekalo/heat/expansion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "lekalo/heat/conduction.hpp"

namespace lekalo::heat_expansion_test {
namespace {

using heat::Body;
using heat::Elastic;
using heat::Expansion;
using heat::Grid;
using heat::Holding;
using heat::Place;
using heat::Side;

constexpr double kAlpha = 23.6e-6;
constexpr Elastic kAluminium{68900, 0.33, kAlpha};

std::vector<double> temperatures(const Grid& grid, const std::function<double(Place)>& of_place) {
  std::vector<double> all;
  for (std::size_t k = 0; k < grid.count[2]; ++k)
    for (std::size_t j = 0; j < grid.count[1]; ++j)
      for (std::size_t i = 0; i < grid.count[0]; ++i) all.push_back(of_place(grid.middle(i, j, k)));
  return all;
}

Expansion solved(const Body& body, const std::function<double(Place)>& temperature,
                 const Holding& holding = {}, double part = 1e-6) {
  Expansion expansion(body.grid(), kAluminium, holding);
  expansion.follow(body);
  const auto done = expansion.solve(temperatures(body.grid(), temperature), part);
  EXPECT_TRUE(done) << done.error().message;
  return expansion;
}

double largest(const std::vector<double>& all) { return *std::max_element(all.begin(), all.end()); }

Body with_a_pocket() {
  Body body(*Grid::divide({0, 0, -8}, {24, 20, 0}, 1.3));
  body.cut({{8, 10, -3.4}, {15, 11, -3.4}, 4});
  body.settle();
  return body;
}

TEST(Expansion, AFreeBodyThatIsWarmAllThroughGrowsWithoutStress) {
  const Body body = with_a_pocket();
  Holding free;
  free.datum = Place{0, 0, -8};
  const Expansion expansion = solved(
      body, [](Place) { return 10.0; }, free, 1e-9);
  for (const Place p : {Place{24, 20, 0}, Place{24, 0, -8}, Place{11, 5.9, -2}, Place{3, 17, -5}}) {
    const Place by = expansion.moved(p);
    EXPECT_NEAR(by.x, 10 * kAlpha * p.x, 1e-7 * 10 * kAlpha * 24);
    EXPECT_NEAR(by.y, 10 * kAlpha * p.y, 1e-7 * 10 * kAlpha * 24);
    EXPECT_NEAR(by.z, 10 * kAlpha * (p.z + 8), 1e-7 * 10 * kAlpha * 24);
  }
  EXPECT_LT(largest(expansion.mises()), 1e-6 * kAluminium.youngs_mpa * kAlpha * 10);
}

TEST(Expansion, ALinearTemperatureBendsABodyExactlyAndWithoutStress) {
  const Body body = with_a_pocket();
  const double slope = 2;  // K/mm
  const Place d{3.9, 2.6, -8};
  Holding free;
  free.datum = d;
  const Expansion expansion = solved(
      body, [&](Place p) { return slope * (p.z + 8); }, free, 1e-10);
  // u = alpha slope (x z, y z, (z^2 - x^2 - y^2) / 2) and a rigid motion; a turn at the underside's middle
  // and the shift of the datum. Nodes alone are exact, and linear between them.
  const double cx = 12, cy = 10;
  const auto form = [&](Place p) {
    const double x = p.x - cx, y = p.y - cy, z = p.z + 8;
    return Place{x * z, y * z, (z * z - x * x - y * y) / 2};
  };
  const Grid& grid = body.grid();
  double off = 0;
  for (std::size_t k = 0; k <= grid.count[2]; k += 2)
    for (std::size_t j = 0; j <= grid.count[1]; j += 3)
      for (std::size_t i = 0; i <= grid.count[0]; i += 3) {
        const Place p{grid.pitch.x * static_cast<double>(i), grid.pitch.y * static_cast<double>(j),
                      grid.pitch.z * static_cast<double>(k) - 8};
        if (body.at_corner(i, j, k) <= 0) continue;
        const Place by = expansion.moved(p), zero = expansion.moved({0, 0, -8});
        const Place is = form(p), at_zero = form({0, 0, -8});
        off = std::max({off, std::abs(by.x - zero.x - kAlpha * slope * (is.x - at_zero.x)),
                        std::abs(by.y - zero.y - kAlpha * slope * (is.y - at_zero.y)),
                        std::abs(by.z - zero.z - kAlpha * slope * (is.z - at_zero.z))});
      }
  EXPECT_LT(off, 2e-8 * kAlpha * slope * 24 * 24);
  EXPECT_LT(largest(expansion.mises()), 1e-6 * kAluminium.youngs_mpa * kAlpha * slope * 8);
  const Place datum = expansion.moved(d);
  EXPECT_NEAR(std::hypot(datum.x, datum.y, datum.z), 0, 1e-12);
}

/// Largest error of the displacement in a free ring whose temperature falls with the square of the radius, as
/// a part of the largest displacement.
double ring_error(double pitch) {
  const double bore = 8, outside = 24;
  const Body body(*Grid::divide({-25, -25, 0}, {25, 25, pitch}, pitch), [&](Place p) {
    const double r = std::hypot(p.x, p.y);
    return std::min(r - bore, outside - r);
  });
  const auto warm = [](double r) { return 40 * (1 - r * r / 800); };
  Holding free;
  const Expansion expansion = solved(
      body, [&](Place p) { return warm(std::hypot(p.x, p.y)); }, free);
  const auto moment = [](double r) { return 40 * (r * r / 2 - r * r * r * r / 3200); };  // of T r
  const double nu = kAluminium.poisson, a2 = bore * bore, b2 = outside * outside;
  const auto form = [&](double r) {
    return kAlpha / r *
           ((1 + nu) * (moment(r) - moment(bore)) +
            ((1 - nu) * r * r + (1 + nu) * a2) / (b2 - a2) * (moment(outside) - moment(bore)));
  };
  double off = 0;
  for (int n = 0; n < 90; ++n) {
    const double angle = 0.0698 * n;
    for (const double r : {bore, 12.0, 16.0, 20.0, outside}) {
      const Place p{r * std::cos(angle), r * std::sin(angle), pitch / 2}, by = expansion.moved(p);
      off = std::max(off, std::hypot(by.x - form(r) * std::cos(angle), by.y - form(r) * std::sin(angle)));
    }
  }
  return off / form(outside);
}

TEST(Expansion, AHoleInAWarmDiscConvergesToItsClosedForm) {
  const double coarse = ring_error(2), fine = ring_error(1);
  RecordProperty("parts", std::to_string(coarse) + " " + std::to_string(fine));
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(fine, 0.02);
  EXPECT_LT(fine, 0.7 * coarse);
}

/// The same in a disc whose hole is heated evenly, with the temperature that conduction finds.
double heated_error(double pitch) {
  const double bore = 8, outside = 24, watts = 10, seconds = 40;
  const Body body(*Grid::divide({-25, -25, 0}, {25, 25, pitch}, pitch), [&](Place p) {
    const double r = std::hypot(p.x, p.y);
    return std::min(r - bore, outside - r);
  });
  const Grid& grid = body.grid();
  const heat::Conductor metal{0.02, 2.42e-3};
  heat::Conduction conduction(body, metal, {});
  std::vector<heat::Source> sources;
  double wall = 0;
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const Place p = grid.middle(n % grid.count[0], n / grid.count[0], 0);
    if (!(std::hypot(p.x, p.y) < 16 && body.wall(n) > 0)) continue;
    sources.push_back({n, body.wall(n)});
    wall += body.wall(n);
  }
  for (heat::Source& source : sources) source.watts *= watts * pitch / wall;
  for (int n = 0; n < 40; ++n) EXPECT_TRUE(conduction.step(seconds / 40, sources));
  Expansion expansion(grid, kAluminium, {});
  expansion.follow(body);
  EXPECT_TRUE(expansion.solve(conduction.temperatures()));

  // T = c (r^2 / 2 - b^2 ln r) + a shift by the heat that is there; moments are of T r.
  const double a2 = bore * bore, b2 = outside * outside, pi = 3.14159265358979323846;
  const double c = watts / (pi * (b2 - a2)) / (2 * metal.conductivity);
  const auto shape = [&](double r) {
    const double r2 = r * r;
    return c * (r2 * r2 / 8 - b2 * (r2 / 2 * std::log(r) - r2 / 4));
  };
  const double heat_of_disc = watts * seconds / (2 * pi * metal.heat_capacity);
  const double shift = (heat_of_disc - shape(outside) + shape(bore)) / ((b2 - a2) / 2);
  const auto moment = [&](double r) { return shape(r) - shape(bore) + shift * (r * r - a2) / 2; };
  const double nu = kAluminium.poisson;
  double off = 0, largest_one = 0;
  for (int n = 0; n < 90; ++n)
    for (const double r : {bore + 2 * pitch, 16.0, 20.0, outside}) {
      const double angle = 0.0698 * n, x = std::cos(angle), y = std::sin(angle);
      const double form =
          kAlpha / r *
          ((1 + nu) * moment(r) + ((1 - nu) * r * r + (1 + nu) * a2) / (b2 - a2) * moment(outside));
      const Place by = expansion.moved({r * x, r * y, pitch / 2});
      off = std::max(off, std::hypot(by.x - form * x, by.y - form * y));
      largest_one = std::max(largest_one, form);
    }
  return off / largest_one;
}

TEST(Expansion, AHeatedHoleMovesADiscAsItsClosedFormDoes) {
  const double coarse = heated_error(2), fine = heated_error(1);
  RecordProperty("parts", std::to_string(coarse) + " " + std::to_string(fine));
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(fine, 0.005);
  EXPECT_GT(std::log2(coarse / fine), 1.5);
}

struct PlateErrors {
  double stress = 0, width = 0;
};
/// A plate whose temperature is a parabola across, even in z, so that it stays flat: as parts of the largest
/// stress, and of the growth.
PlateErrors plate_errors(double pitch) {
  const Body body(*Grid::divide({-24, -24, -4}, {24, 24, 4}, pitch));
  const Expansion expansion = solved(body, [](Place p) { return p.z * p.z; });
  const double mean = 16.0 / 3, whole = kAluminium.youngs_mpa * kAlpha / (1 - kAluminium.poisson);
  const std::vector<double> stress = expansion.mises();
  const Grid& grid = body.grid();
  PlateErrors off;
  for (std::size_t k = 0; k < grid.count[2]; ++k) {
    const double z = grid.middle(0, 0, k).z, form = whole * std::abs(mean - z * z);
    const double is = stress[grid.cell(grid.count[0] / 2, grid.count[1] / 2, k)];
    off.stress = std::max(off.stress, std::abs(is - form) / (whole * (16 - mean)));
  }
  const double wide = expansion.moved({10, 0, 0}).x - expansion.moved({-10, 0, 0}).x;
  off.width = std::abs(wide / (20 * kAlpha * mean) - 1);
  return off;
}

TEST(Expansion, ATemperatureAcrossAPlateConvergesToItsClosedForm) {
  const PlateErrors coarse = plate_errors(2), fine = plate_errors(1);
  EXPECT_LT(fine.stress, 0.03);
  EXPECT_GT(std::log2(coarse.stress / fine.stress), 1.5);
  EXPECT_LT(fine.width, 0.02);
  EXPECT_GT(std::log2(coarse.width / fine.width), 1.8);
}

TEST(Expansion, ABarBetweenJawsIsPressedByWhatItCannotGrow) {
  const Body body(*Grid::divide({0, 0, 0}, {64, 8, 8}, 2));
  Holding vice;
  vice.held[of(Side::x_low)] = vice.held[of(Side::x_high)] = true;
  const Expansion expansion = solved(
      body, [](Place) { return 20.0; }, vice);
  // The jaws hold the ends across as well, so that the middle is pressed a little more than by its own
  // growth.
  const double growth = kAlpha * 20, stress = expansion.mises()[body.grid().cell(16, 1, 1)];
  const double along = (expansion.moved({34, 4, 4}).x - expansion.moved({30, 4, 4}).x) / 4;
  EXPECT_NEAR(stress, kAluminium.youngs_mpa * (growth - along), 0.001 * stress);
  EXPECT_NEAR(stress, kAluminium.youngs_mpa * growth, 0.06 * stress);
  const double across = (expansion.moved({32, 8, 4}).y - expansion.moved({32, 0, 4}).y) / 8;
  EXPECT_NEAR(across, growth + kAluminium.poisson * (growth - along), 0.001 * across);
  EXPECT_EQ(expansion.moved({64, 3, 3}).x, 0);
}

TEST(Expansion, APlateUnderABodyHoldsItsUndersideAndLetsTheTopGrow) {
  Holding plate;
  plate.held[of(Side::z_low)] = true;
  const Body body(*Grid::divide({0, 0, 0}, {24, 24, 24}, 2));
  const Expansion expansion = solved(
      body, [](Place) { return 20.0; }, plate);
  const Place foot = expansion.moved({24, 12, 0}), top = expansion.moved({24, 12, 24});
  EXPECT_EQ(foot.x, 0);
  EXPECT_NEAR(top.x, 12 * kAlpha * 20, 0.1 * top.x);
  EXPECT_NEAR(expansion.moved({12, 12, 24}).x, 0, 1e-9);
}

TEST(Expansion, AnyNumberOfThreadsGivesTheSameBits) {
  std::vector<std::vector<double>> all;
  for (const unsigned threads : {1U, 2U, 3U}) {
    Body body(*Grid::divide({0, 0, -10}, {45, 35, 0}, 1));
    body.cut({{10, 15, -4.3}, {30, 15, -4.3}, 5});
    body.settle();
    Expansion expansion(body.grid(), kAluminium, {}, threads);
    expansion.follow(body);
    ASSERT_TRUE(expansion.solve(temperatures(body.grid(), [](Place p) { return p.x * p.y / 100; }), 1e-2));
    const Place by = expansion.moved({45, 35, 0});
    all.push_back({by.x, by.y, by.z, largest(expansion.mises())});
  }
  EXPECT_EQ(all[0], all[1]);
  EXPECT_EQ(all[0], all[2]);
}

}  // namespace
}  // namespace lekalo::heat_expansion_test

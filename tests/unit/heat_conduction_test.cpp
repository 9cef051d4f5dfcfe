// Conduction in voxels against closed forms. H. S. Carslaw & J. C. Jaeger, Conduction of Heat in Solids, 2nd
// edition, 1959: moving line source and band 10.7, slab 2.5.

#include "lekalo/heat/conduction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace lekalo::heat_conduction_test {
namespace {

using heat::Body;
using heat::Conduction;
using heat::Conductor;
using heat::Films;
using heat::Grid;
using heat::HeatBook;
using heat::Place;
using heat::Side;
using heat::Source;

constexpr double kPi = 3.14159265358979323846;

/// By Simpson's rule.
double integral(const std::function<double(double)>& f, double low, double high, int parts) {
  double sum = f(low) + f(high);
  for (int n = 1; n < 2 * parts; ++n) sum += (n % 2 == 1 ? 4 : 2) * f(low + (high - low) * n / (2 * parts));
  return sum * (high - low) / (6 * parts);
}

void step(Conduction& conduction, double seconds, const std::vector<Source>& sources = {}) {
  const auto done = conduction.step(seconds, sources);
  ASSERT_TRUE(done) << done.error().message;
}

TEST(Conduction, ASmallBodyCoolsAsOne) {
  const Body body(*Grid::divide({0, 0, 0}, {10, 8, 6}, 1),
                  [](Place p) { return 4 - std::hypot(p.x - 5, p.y - 4); });
  Films films;
  films.sides.fill(1e-5), films.cut = 1e-5;
  Conduction conduction(body, {0.167, 2.42e-3}, films);
  conduction.set(std::vector<double>(body.grid().size(), 50));
  double area = 0;
  for (std::size_t n = 0; n < body.grid().size(); ++n) area += body.wall(n);
  for (std::size_t n = 0; n < 80; ++n)
    area += body.open(2, n % 10, n / 10, 0) + body.open(2, n % 10, n / 10, 6);
  const double constant = 2.42e-3 * body.volume() / (1e-5 * area), seconds = 200;
  for (int n = 0; n < 40; ++n) step(conduction, seconds / 40);
  const double expected = 50 * std::exp(-seconds / constant);
  EXPECT_NEAR(conduction.temperature(body.grid().cell(5, 4, 3)), expected, 0.002 * 50);
  EXPECT_NEAR(area, kPi * 8 * 6 + 2 * kPi * 16, 0.02 * area);
  EXPECT_LT(conduction.book().balance(), 1e-6);
}

TEST(Conduction, ASlabHeldColdIsTheErrorFunction) {
  const Body body(*Grid::divide({0, 0, 0}, {4, 4, 60}, 1));
  Films films;
  films.sides[of(Side::z_high)] = heat::kNoResistance;
  const Conductor metal{0.05, 3.69e-3};
  Conduction conduction(body, metal, films);
  conduction.set(std::vector<double>(body.grid().size(), 1));
  const double diffusivity = metal.conductivity / metal.heat_capacity, seconds = 12;
  for (int n = 0; n < 48; ++n) step(conduction, seconds / 48);
  for (std::size_t k = 20; k < 58; ++k) {
    const double deep = 60 - (static_cast<double>(k) + 0.5);
    EXPECT_NEAR(conduction.temperature(body.grid().cell(1, 2, k)),
                std::erf(deep / std::sqrt(4 * diffusivity * seconds)), 0.01)
        << deep;
  }
  EXPECT_LT(conduction.book().balance(), 1e-6);
  // What left is the integral of the gradient at the surface.
  EXPECT_NEAR(conduction.book().lost, 16 * 2 * metal.conductivity * std::sqrt(seconds / (kPi * diffusivity)),
              0.01 * conduction.book().lost);
}

/// Largest error of a cosine along two axes that decays, in space and time at once.
double cosine_error(double pitch) {
  const Body body(*Grid::divide({0, 0, 0}, {16, 8, 2}, pitch));
  const Grid& grid = body.grid();
  const double diffusivity = 20, waves = kPi * kPi * (1.0 / 256 + 1.0 / 64);
  Conduction conduction(body, {0.05, 0.05 / diffusivity}, {});
  const auto form = [](Place p) { return std::cos(kPi * p.x / 16) * std::cos(kPi * p.y / 8); };
  std::vector<double> first;
  for (std::size_t n = 0; n < grid.size(); ++n)
    first.push_back(form(grid.middle(n % grid.count[0], n / grid.count[0] % grid.count[1], 0)));
  conduction.set(first);
  const int steps = static_cast<int>(std::lround(8 / pitch));
  for (int n = 0; n < steps; ++n) step(conduction, 1.0 / (diffusivity * waves) / steps);
  double worst = 0;
  for (std::size_t n = 0; n < grid.size(); ++n)
    worst = std::max(worst, std::abs(conduction.temperature(n) - first[n] * std::exp(-1)));
  return worst;
}

TEST(Conduction, ErrorsFallWithTheSquareOfVoxelAndStep) {
  const double coarse = cosine_error(1), fine = cosine_error(0.5);
  EXPECT_LT(coarse, 0.005);
  EXPECT_GT(std::log2(coarse / fine), 1.9);
}

/// A source at a place along a line of voxels: three of them, with its middle and its second moment.
std::vector<Source> line_at(const Grid& grid, double at, std::size_t j, double watts) {
  const double voxels = (at - grid.low.x) / grid.pitch.x - 0.5, nearest = std::round(voxels),
               off = voxels - nearest;
  const auto i = static_cast<std::size_t>(nearest);
  return {{grid.cell(i - 1, j, 0), watts * off * (off - 1) / 2},
          {grid.cell(i, j, 0), watts * (1 - off * off)},
          {grid.cell(i + 1, j, 0), watts * off * (off + 1) / 2}};
}

/// The temperature that a line of 1 W/mm brings about, which has moved along x for some seconds and is at x =
/// 0 now, in an endless plate; times 4 pi k.
double line_source(double x, double y, double diffusivity, double speed, double seconds) {
  // Over the logarithm of the time since; before the first the source was too near to matter.
  return integral(
      [&](double s) {
        const double since = std::exp(s), dx = x + speed * since;
        return std::exp(-(dx * dx + y * y) / (4 * diffusivity * since));
      },
      std::log((x * x + y * y) / (4 * diffusivity) / 60), std::log(seconds), 200);
}

struct LineErrors {
  double part = 0;   ///< largest error further than two voxels away, as a part of the temperature
  double whole = 0;  ///< largest error further than 2 mm away, by 7 W/mm / (4 pi k)
};
LineErrors line_errors(double pitch, int steps, double far) {
  const double diffusivity = 10, speed = 2, begin = 20 + pitch / 2, seconds = 10;
  const Body body(*Grid::divide({0, 0, 0}, {61, 41, pitch}, pitch));
  const Grid& grid = body.grid();
  const Conductor metal{0.05, 0.005};
  Conduction conduction(body, metal, {});
  const std::size_t row = grid.count[1] / 2;
  const double line = grid.middle(0, row, 0).y;
  for (int n = 0; n < steps; ++n)
    step(conduction, seconds / steps,
         line_at(grid, begin + speed * seconds * (n + 0.5) / steps, row, 7 * pitch));
  const double at = begin + speed * seconds, factor = 7 / (4 * kPi * metal.conductivity);
  LineErrors errors;
  for (std::size_t j = 0; j < grid.count[1]; ++j)
    for (std::size_t i = 0; i < grid.count[0]; ++i) {
      const Place p = grid.middle(i, j, 0);
      const double r = std::hypot(p.x - at, p.y - line);
      if (r < 2.01 * pitch || r > far) continue;
      // Insulated borders are mirrors; in those across x the source moves the other way.
      double expected = 0;
      for (const double y : {line, -line, 82 - line}) {
        expected += line_source(p.x - at, p.y - y, diffusivity, speed, seconds);
        for (const double x : {-at, 122 - at})
          expected += line_source(x - p.x, p.y - y, diffusivity, speed, seconds);
      }
      expected *= factor;
      const double off = std::abs(conduction.temperature(grid.cell(i, j, 0)) - expected);
      // Far ahead of the source it is as cold as nothing.
      errors.part = std::max(errors.part, off / (expected + 0.01 * factor));
      if (r > 2.01) errors.whole = std::max(errors.whole, off / factor);
    }
  EXPECT_LT(conduction.book().balance(), 1e-6);
  return errors;
}

TEST(Conduction, AMovingLineSourceInAPlateIsRosenthals) {
  const double k0 =
      std::exp(-0.1 * 3) * std::cyl_bessel_k(0, 0.1 * 5);  // the closed form of one that always moved
  EXPECT_NEAR(line_source(3, 4, 10, 2, 2000), 2 * k0, 1e-6);

  const LineErrors coarse = line_errors(1, 100, 18), fine = line_errors(0.5, 200, 6);
  RecordProperty("parts", std::to_string(coarse.part) + " " + std::to_string(fine.part));
  EXPECT_LT(coarse.part, 0.005);
  EXPECT_LT(fine.part, 0.0025);
  EXPECT_GT(std::log2(coarse.whole / fine.whole), 1.9);
  // In short steps neighbours share less of the capacity, so that nothing swings.
  EXPECT_LT(line_errors(1, 400, 12).part, 0.01);
}

TEST(Conduction, AMovingBandOnAHalfSpaceIsJaegers) {
  const Body body(*Grid::divide({0, 0, -50}, {150, 1, 0}, 1));
  const Conductor metal{0.05, 0.005};
  const double diffusivity = 10, speed = 2, begin = 20, seconds = 50, half = 4;
  Conduction conduction(body, metal, {});
  const int steps = 200;
  for (int n = 0; n < steps; ++n) {
    // The band moves by half a voxel a step, from one voxel's border to the middle of the next.
    const double at = begin + speed * seconds * (n + 0.5) / steps;
    std::vector<Source> sources;
    for (std::size_t i = 0; i < 150; ++i) {
      const double a = static_cast<double>(i), share = std::min(a + 1, at + half) - std::max(a, at - half);
      if (share > 0) sources.push_back({body.grid().cell(i, 0, 49), share});
    }
    step(conduction, seconds / steps, sources);
  }
  const double x = begin + speed * seconds, peclet = speed / (2 * diffusivity);
  const double factor = 2 * 1 * diffusivity / (kPi * metal.conductivity * speed);
  for (std::size_t k = 38; k < 48; ++k)
    for (std::size_t i = 100; i < 134; ++i) {
      const Place p = body.grid().middle(i, 0, k);
      const double dx = p.x - x;
      const double expected =
          factor *
          integral([&](double u) { return std::exp(-u) * std::cyl_bessel_k(0, std::hypot(u, peclet * p.z)); },
                   peclet * (dx - half), peclet * (dx + half), 60);
      EXPECT_NEAR(conduction.temperature(body.grid().cell(i, 0, k)), expected,
                  0.01 * expected + 0.0005 * factor)
          << dx << " " << p.z;
    }
  EXPECT_LT(conduction.book().balance(), 1e-6);
}

/// Largest error of a ring that is heated evenly on its bore, as a part of the difference between its
/// surfaces, further than two voxels from the bore; the mean is taken from both.
double ring_error(double pitch, double x = 0, double y = 0) {
  const double bore = 8, outside = 24, watts = 10;
  const Body body(*Grid::divide({-25, -25, 0}, {25, 25, pitch}, pitch), [&](Place p) {
    const double r = std::hypot(p.x - x, p.y - y);
    return std::min(r - bore, outside - r);
  });
  const Grid& grid = body.grid();
  const Conductor metal{0.167, 2.42e-3};
  Conduction conduction(body, metal, {});
  double bore_wall = 0;
  const auto radius = [&](std::size_t n) {
    const Place p = grid.middle(n % grid.count[0], n / grid.count[0], 0);
    return std::hypot(p.x - x, p.y - y);
  };
  for (std::size_t n = 0; n < grid.size(); ++n) bore_wall += radius(n) < 16 ? body.wall(n) : 0;
  std::vector<Source> sources;
  for (std::size_t n = 0; n < grid.size(); ++n)
    if (radius(n) < 16 && body.wall(n) > 0) sources.push_back({n, watts * pitch * body.wall(n) / bore_wall});
  for (int n = 0; n < 40; ++n) step(conduction, 1, sources);
  // Every place gets warmer alike: k (r T')' / r = W / area, T' = 0 outside.
  const double all = watts / (kPi * (outside * outside - bore * bore));
  const auto form = [&](double r) {
    return all / (2 * metal.conductivity) * (r * r / 2 - outside * outside * std::log(r));
  };
  double shift = 0, volume = 0, worst = 0;
  for (std::size_t n = 0; n < grid.size(); ++n)
    if (body.share(n) == 1) shift += conduction.temperature(n) - form(radius(n)), volume += 1;
  shift /= volume;
  for (std::size_t n = 0; n < grid.size(); ++n)
    if (body.share(n) > 0 && radius(n) > bore + 2 * pitch)
      worst = std::max(worst, std::abs(conduction.temperature(n) - form(radius(n)) - shift));
  EXPECT_LT(conduction.book().balance(), 1e-6);
  return worst / (form(bore) - form(outside));
}

TEST(Conduction, AHeatedHoleInADiscConvergesToItsClosedForm) {
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.3, 0.7}}) {
    const double coarse = ring_error(2, x, y), fine = ring_error(1, x, y);
    EXPECT_LT(coarse, 0.005) << x;
    EXPECT_LT(fine, 0.0015) << x;
    EXPECT_GT(std::log2(coarse / fine), 1.5) << x;
  }
}

// The matrix of a step has nothing above 0 beside its diagonal, whatever the pitches and the length of a
// step.
TEST(Conduction, NothingBecomesColderThanItsSurroundings) {
  for (const double high : {2.0, 7.0})
    for (const double seconds : {0.001, 0.05, 1.0}) {
      Body body(*Grid::divide({0, 0, -high}, {21, 15, 0}, 1.3));
      body.cut({{6, 7, -0.6 * high}, {12, 8, -0.6 * high}, 3});
      body.settle();
      Conduction conduction(body, {0.05, 3.69e-3}, {});
      const std::size_t heated = body.grid().cell(2, 2, 0);
      double least = 0, most = 0;
      for (int n = 0; n < 4; ++n) step(conduction, seconds, {{heated, 50}});
      for (const double t : conduction.temperatures()) least = std::min(least, t), most = std::max(most, t);
      EXPECT_GT(most, 0);
      EXPECT_GE(least, -1e-6 * most) << high << " " << seconds;
    }
}

TEST(Conduction, HeatLeavesWithWhatIsCutAwayAndTheBookBalances) {
  Body body(*Grid::divide({0, 0, -10}, {40, 30, 0}, 1.3));
  Films films;
  films.sides.fill(2e-5), films.cut = 1e-3;
  Conduction conduction(body, {0.167, 2.42e-3}, films);
  double brought = 0;
  for (int n = 0; n < 30; ++n) {
    const double x = 8 + 0.8 * n;
    body.cut({{x, 14, -3.7}, {x + 0.8, 14.5, -3.7}, 4});
    const auto changed = body.settle();
    conduction.follow(body, changed);
    std::vector<Source> sources;
    for (const auto& c : changed)
      if (c.after > 0) sources.push_back({c.cell, 2});
    brought += 0.2 * 2 * static_cast<double>(sources.size());
    step(conduction, 0.2, sources);
  }
  const HeatBook& book = conduction.book();
  EXPECT_NEAR(book.in, brought, 1e-9 * brought);
  EXPECT_GT(book.removed, 0.02 * book.in);
  EXPECT_GT(book.lost, 0.001 * book.in);
  EXPECT_LT(book.balance(), 1e-6);
}

TEST(Conduction, AnyNumberOfThreadsGivesTheSameBits) {
  std::vector<std::vector<double>> all;
  for (const unsigned threads : {1U, 2U, 3U}) {
    Body body(*Grid::divide({0, 0, -30}, {80, 70, 0}, 1));  // so many voxels that threads are worth it
    body.cut({{10, 15, -4.3}, {30, 15, -4.3}, 5});
    body.settle();
    Films films;
    films.sides.fill(1e-5);
    Conduction conduction(body, {0.167, 2.42e-3}, films, threads);
    step(conduction, 0.5, {{body.grid().cell(3, 3, 3), 20}});
    all.push_back(conduction.temperatures());
  }
  EXPECT_EQ(all[0], all[1]);
  EXPECT_EQ(all[0], all[2]);
}

}  // namespace
}  // namespace lekalo::heat_conduction_test

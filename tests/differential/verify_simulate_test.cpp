#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/verify/simulate.hpp"
#include "support/cases.hpp"
#include "verify/pocket/cut_path.hpp"

// Against a raster: the same figures from thousands of discs along the path, counted.

namespace lekalo::verify::verify_simulate_test {
namespace {

constexpr double kPi = 3.141592653589793, kRadius = 3, kWidth = 40, kHeight = 30, kStep = 0.02;
/// Of a path that turns with a radius of 0.3 mm. Lengths and places that differ by less than kTogether are
/// the same: a program writes 9 decimals.
constexpr double kBetween = 2e-4, kTogether = 1e-6;

struct Spot {
  double x, y;
};

struct Drawn {
  std::string program;
  std::vector<Spot> path;     ///< at most kStep apart, with every corner
  std::vector<double> along;  ///< for each spot of it, the length of the path up to there
  void go_on_to(Spot to, double length) {
    path.push_back(to);
    along.push_back(length);
  }
};

Drawn random_path(Random& random) {
  Drawn drawn;
  const auto rounded = [](double v) { return std::round(v * 1e3) / 1e3; };
  Spot at{rounded(random.uniform(4, kWidth - 4)), rounded(random.uniform(4, kHeight - 4))};
  drawn.program = fmt::format("G21 G90 G17\nG0 X{} Y{} Z5\nG1 Z-1 F300\n", at.x, at.y);
  drawn.go_on_to(at, 0);
  for (int i = 0; i < 8; ++i) {
    const double so_far = drawn.along.back();
    if (random.below(2) == 0) {
      const Spot to{rounded(random.uniform(4, kWidth - 4)), rounded(random.uniform(4, kHeight - 4))};
      const double whole = std::hypot(to.x - at.x, to.y - at.y);
      for (double s = kStep; s < whole; s += kStep)
        drawn.go_on_to({at.x + s / whole * (to.x - at.x), at.y + s / whole * (to.y - at.y)}, so_far + s);
      drawn.go_on_to(to, so_far + whole);
      drawn.program += fmt::format("G1 X{} Y{} F1500\n", to.x, to.y);
      at = to;
    } else {  // any sweep about a centre within 6 mm, small radii among them
      const double radius = random.uniform(0.3, 6), begin = random.uniform(0, 2 * kPi);
      const double sweep = random.uniform(0.1, 2 * kPi - 0.1);
      const bool ccw = random.below(2) == 0;
      const Spot centre{at.x - radius * std::cos(begin), at.y - radius * std::sin(begin)};
      Spot to{};
      for (double s = kStep;; s += kStep) {
        const double turn = std::min(sweep, s / radius), angle = begin + (ccw ? turn : -turn);
        to = {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
        drawn.go_on_to(to, so_far + turn * radius);
        if (s / radius >= sweep) break;
      }
      drawn.program += fmt::format("G{} X{:.9f} Y{:.9f} I{:.9f} J{:.9f} F1500\n", ccw ? 3 : 2, to.x, to.y,
                                   centre.x - at.x, centre.y - at.y);
      at = to;
    }
  }
  return drawn;
}

const std::string kPocket =
    R"({"units":"mm","outer":[{"line":{"from":[0,0],"to":[40,0]}},{"line":{"from":[40,0],"to":[40,30]}},)"
    R"({"line":{"from":[40,30],"to":[0,30]}},{"line":{"from":[0,30],"to":[0,0]}}]})";

TEST(VerifySimulateRaster, EngagementAndCoverageAreThoseOfManyDiscs) {
  for (std::size_t i = 0; i < cases::case_count(3); ++i) {
    Random random(cases::seed(), i + 1);
    const Drawn drawn = random_path(random);
    SCOPED_TRACE(fmt::format("seed {} case {}\n{}", cases::seed(), i, drawn.program));
    SimulateOptions options;
    options.tool_diameter = 2 * kRadius;
    const auto report = simulate({"random.ngc", drawn.program}, {"pocket.json", kPocket}, options);
    ASSERT_TRUE(report) << report.error().message;

    double done = 0;
    std::size_t number = 0, upto = 0;
    const auto apart = [](const Spot& a, const EngagementSample& b) {
      return std::hypot(a.x - b.x, a.y - b.y);
    };
    for (const EngagementSample& sample : report->samples) {
      done += sample.length;
      if (number++ % 97 != 0) continue;
      // The discs up to a sample are those up to its length along the path. Its place does not tell: the path
      // passes close by before a corner that it has yet to cut out.
      while (upto < drawn.path.size() && drawn.along[upto] < done - kTogether) ++upto;
      std::vector<std::size_t> near;
      for (std::size_t p = 0; p < upto; ++p)
        if (apart(drawn.path[p], sample) < 2 * kRadius + kStep) near.push_back(p);
      int open_low = 0, open_high = 0;
      constexpr int kRim = 360;
      for (int k = 0; k < kRim; ++k) {
        const double angle = 2 * kPi * (k + 0.5) / kRim;
        const Spot rim{sample.x + kRadius * std::cos(angle), sample.y + kRadius * std::sin(angle)};
        bool low = true, high = true;
        for (const std::size_t p : near) {
          const double off = std::hypot(rim.x - drawn.path[p].x, rim.y - drawn.path[p].y) - kRadius;
          // What the tool sweeps between two spots reaches this far beyond their discs. The last discs lie so
          // close that all of the rim ahead is within that, so they count by how far back they are.
          low = low && off > kBetween * std::min(1.0, (done - drawn.along[p]) / kStep);
          high = high && off > -kTogether;
        }
        open_low += low ? 1 : 0;
        open_high += high ? 1 : 0;
      }
      EXPECT_GE(sample.engagement, 360.0 * open_low / kRim - 1.5) << "at " << done;
      EXPECT_LE(sample.engagement, 360.0 * open_high / kRim + 1.5) << "at " << done;
    }

    // Coverage: squares of 0.2 mm by their middles.
    std::size_t reachable = 0, cut = 0;
    for (double y = 0.1; y < kHeight; y += 0.2) {
      for (double x = 0.1; x < kWidth; x += 0.2) {
        const double dx = std::max({3 - x, x - (kWidth - 3), 0.0}),
                     dy = std::max({3 - y, y - (kHeight - 3), 0.0});
        if (std::hypot(dx, dy) > kRadius) continue;
        ++reachable;
        bool held = false;
        for (std::size_t p = 0; p < drawn.path.size() && !held; p += 2)
          held = std::hypot(x - drawn.path[p].x, y - drawn.path[p].y) <= kRadius;
        cut += held ? 1 : 0;
      }
    }
    EXPECT_NEAR(report->coverage_percent, 100.0 * static_cast<double>(cut) / static_cast<double>(reachable),
                0.15);
    EXPECT_NEAR(report->reachable_mm2, 0.04 * static_cast<double>(reachable), 2);

    double gouge = 0;
    for (const Spot& p : drawn.path) {
      // Outside, the nearest place of the pocket may be its corner.
      const double aside = std::max(-p.x, p.x - kWidth), above = std::max(-p.y, p.y - kHeight);
      const double outside = std::hypot(std::max(aside, 0.0), std::max(above, 0.0));
      gouge = std::max(gouge, kRadius + (outside > 0 ? outside : std::max(aside, above)));
    }
    EXPECT_NEAR(report->gouge_mm, gouge, 0.021);
  }
}

/// A star of many chords whose tips and valleys are rounded by none of the tools below.
std::string wavy_star(Random& random, int chords) {
  const double size = random.uniform(10, 30), wave = random.uniform(0.05, 0.3);
  const double tips = static_cast<double>(3 + random.below(8));
  std::string text = R"({"units":"mm","outer":[)";
  const auto corner = [&](int i) {
    const double angle = 2 * kPi * (i % chords) / chords, r = size * (1 + wave * std::cos(tips * angle));
    return fmt::format("[{:.6f},{:.6f}]", r * std::cos(angle), r * std::sin(angle));
  };
  for (int i = 0; i < chords; ++i)
    text += fmt::format(R"({}{{"line":{{"from":{},"to":{}}}}})", i == 0 ? "" : ",", corner(i), corner(i + 1));
  return text + "]}";
}

TEST(VerifySimulateRaster, UnreachableSpotsAreThoseOfEveryNode) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < cases::case_count(6); ++i) {
    Random random(cases::seed(), 100 + i);
    const double radius = random.uniform(1, 4);
    const double stock = random.below(2) == 0 ? 0 : random.uniform(0, 0.5);
    const std::string pocket = wavy_star(random, static_cast<int>(20 + random.below(200)));
    SCOPED_TRACE(
        fmt::format("seed {} case {}: radius {} stock {}\n{}", cases::seed(), i, radius, stock, pocket));
    const auto reach = PocketReach::make({"star.json", pocket}, radius + stock, 0);
    ASSERT_TRUE(reach) << reach.error().message;
    SimulateReport report;
    find_unreachable(*reach, radius, report);
    double area = 0, farthest = 0;
    for (const UnreachableSpot& spot : report.unreachable) {
      area += spot.area_mm2;
      farthest = std::max(farthest, spot.distance_mm);
    }
    const Place size = reach->high() - reach->low();
    const double step = std::max(radius / 12, std::max(size.x, size.y) / 2000);
    std::size_t nodes = 0;
    float most = 0;
    for (double y = 0.5; y * step <= size.y + step; ++y)
      for (double x = 0.5; x * step <= size.x + step; ++x) {
        const Place p = reach->low() + step * Place{x, y};
        if (!reach->in_drawing(p)) continue;
        const auto off = static_cast<float>(reach->from_allowed(p) - radius);
        if (off > 0) ++nodes;
        most = std::max(most, off);
      }
    EXPECT_NEAR(area, static_cast<double>(nodes) * step * step,
                1e-6 * step * step * (1 + static_cast<double>(nodes)));
    EXPECT_EQ(farthest, static_cast<double>(most));
    found += nodes;
  }
  EXPECT_GT(found, 100U);
}

}  // namespace
}  // namespace lekalo::verify::verify_simulate_test

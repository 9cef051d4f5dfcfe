#include "lekalo/verify/cut_history.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "support/cases.hpp"

// Against heights on a raster, lowered by thousands of discs along the path.

namespace lekalo::verify::verify_cut_history_test {
namespace {

constexpr double kRadius = 3, kWidth = 40, kHeight = 30, kCell = 0.1, kStep = 0.05;

/// A stock whose top is at 0, in cells.
class Raster {
 public:
  /// Takes off what a disc meets above z, and returns its volume.
  double disc(double x, double y, double z) {
    double taken = 0;
    const auto index = [](double at) { return static_cast<int>(std::floor(at / kCell)); };
    for (int j = std::max(0, index(y - kRadius)); j <= std::min(kRows - 1, index(y + kRadius)); ++j)
      for (int i = std::max(0, index(x - kRadius)); i <= std::min(kColumns - 1, index(x + kRadius)); ++i) {
        const double dx = (i + 0.5) * kCell - x, dy = (j + 0.5) * kCell - y;
        double& height = heights_[static_cast<std::size_t>(j * kColumns + i)];
        if (dx * dx + dy * dy > kRadius * kRadius || height <= z) continue;
        taken += (height - z) * kCell * kCell;
        height = z;
      }
    return taken;
  }

 private:
  static constexpr int kColumns = static_cast<int>(kWidth / kCell), kRows = static_cast<int>(kHeight / kCell);
  std::vector<double> heights_ = std::vector<double>(static_cast<std::size_t>(kColumns * kRows), 0.0);
};

TEST(VerifyCutHistory, VolumesAreThoseOfARaster) {
  const std::string pocket = fmt::format(
      R"({{"units":"mm","outer":[{{"line":{{"from":[0,0],"to":[{0},0]}}}},{{"line":{{"from":[{0},0],"to":[{0},{1}]}}}},)"
      R"({{"line":{{"from":[{0},{1}],"to":[0,{1}]}}}},{{"line":{{"from":[0,{1}],"to":[0,0]}}}}]}})",
      kWidth, kHeight);
  SimulateOptions options;
  options.tool_diameter = 2 * kRadius;
  const std::size_t count = cases::case_count(6);
  for (std::size_t k = 0; k < count; ++k) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), k));
    Random random(cases::seed(), k);
    Raster raster;
    std::string program = "G21 G90 G17 F600\nG0 X10 Y10 Z0\n";
    double x = 10, y = 10, z = 0, sunk = 0, counted = 0;
    const auto go = [&](double to_x, double to_y, double to_z, bool arc) {
      if (arc) {
        // Half a turn about the middle, on the level or down.
        program += fmt::format("G3 X{:.4f} Y{:.4f} Z{:.4f} I{:.4f} J{:.4f}\n", to_x, to_y, to_z,
                               (to_x - x) / 2, (to_y - y) / 2);
      } else {
        program += fmt::format("G1 X{:.4f} Y{:.4f} Z{:.4f}\n", to_x, to_y, to_z);
      }
      const double chord = std::hypot(to_x - x, to_y - y), way = arc ? chord * 1.5708 : chord;
      const double longest = std::hypot(way, to_z - z);
      const int steps = std::max(1, static_cast<int>(std::ceil(longest / kStep)));
      const double mx = (x + to_x) / 2, my = (y + to_y) / 2;
      for (int s = 1; s <= steps; ++s) {
        const double t = static_cast<double>(s) / steps;
        double at_x = x + t * (to_x - x), at_y = y + t * (to_y - y);
        if (arc) {
          const double c = std::cos(t * 3.141592653589793), n = std::sin(t * 3.141592653589793);
          at_x = mx + c * (x - mx) - n * (y - my), at_y = my + n * (x - mx) + c * (y - my);
        }
        counted += raster.disc(at_x, at_y, z + t * (to_z - z));
      }
      // A ramp's floor is a staircase, half a step too high in the mean, on which more than once may be cut.
      if (to_z < z && chord > 0)
        sunk += 0.5 * (z - to_z) * std::min(1.0, 0.5 * kRadius / way) * (2 * kRadius * way + 29);
      x = to_x, y = to_y, z = to_z;
    };
    const auto below = [&](double most) { return std::round(1e4 * random.uniform(most, 0)) / 1e4; };
    const auto place = [&](double low, double high) {
      return std::round(1e4 * random.uniform(low, high)) / 1e4;
    };
    for (int m = 0; m < 8; ++m) switch (m == 0 ? 0 : random.below(4)) {
        case 0:
          go(x, y, std::min(-0.1, below(-4)), false);
          break;
        case 1:
          go(place(4, kWidth - 4), place(4, kHeight - 4), below(-4), false);
          break;
        case 2: {
          const double to_x = std::clamp(x + place(-4, 4), 9.0, kWidth - 9);
          go(to_x, y < kHeight / 2 ? y + 4 : y - 4, random.below(2) == 0 ? z : z - 0.5, true);
          break;
        }
        default:
          go(place(4, kWidth - 4), place(4, kHeight - 4), z, false);
      }
    const auto made = cut_history({"p.ngc", program}, {"pocket.json", pocket}, options, {}, 0.2);
    ASSERT_TRUE(made) << made.error().message;
    double volume = 0;
    for (const CutPiece& piece : made->pieces) volume += piece.volume();
    EXPECT_GT(volume, 0.98 * counted - 0.5) << program;
    EXPECT_LT(volume, 1.02 * counted + 0.5 + sunk) << program;
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_cut_history_test

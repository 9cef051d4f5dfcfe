// The program of a cell against every corner, edge and face point of a fine grid, and by its own multipliers.

#include "locate/search/cell_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lekalo/base/random.hpp"
#include "support/cases.hpp"

namespace lekalo::locate::locate_cell_program_test {
namespace {

TEST(CellProgram, BoundsWhatAGridFindsAndReachesIt) {
  Random random(cases::seed(), 71);
  for (int k = 0; k < 300; ++k) {
    SCOPED_TRACE(k);
    std::vector<CellRow> rows(1 + random.below(40));
    for (CellRow& row : rows) {
      row.level = random.uniform(0, 2);
      for (double& s : row.slope) s = random.below(6) == 0 ? 0 : random.uniform(-1, 1);
    }
    std::array<double, 3> half{};
    for (double& h : half) h = random.below(8) == 0 ? 0 : random.uniform(0.05, 3);
    const CellSolution solution = solve_cell(rows, half);
    const auto lowest = [&](const std::array<double, 3>& z) {
      double least = 1e300;
      for (const CellRow& row : rows)
        least = std::min(least, row.level + row.slope[0] * z[0] + row.slope[1] * z[1] + row.slope[2] * z[2]);
      return least;
    };
    // The multipliers prove it.
    double sum = 0, level = 0;
    std::array<double, 3> slope{};
    ASSERT_GE(solution.rows, 1u);
    for (std::size_t j = 0; j < solution.rows; ++j) {
      EXPECT_GE(solution.multiplier[j], 0);
      sum += solution.multiplier[j];
      level += solution.multiplier[j] * rows[solution.row[j]].level;
      for (std::size_t i = 0; i < 3; ++i) slope[i] += solution.multiplier[j] * rows[solution.row[j]].slope[i];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    for (std::size_t i = 0; i < 3; ++i) level += std::abs(slope[i]) * half[i];
    EXPECT_NEAR(level, solution.bound, 1e-12);
    // No grid point beats it, and its own point reaches it.
    double best = -1e300;
    for (int x = -8; x <= 8; ++x)
      for (int y = -8; y <= 8; ++y)
        for (int t = -8; t <= 8; ++t)
          best = std::max(best, lowest({half[0] * x / 8, half[1] * y / 8, half[2] * t / 8}));
    EXPECT_GE(solution.bound, best - 1e-12);
    EXPECT_NEAR(lowest(solution.z), solution.bound, 1e-9);
  }
}

TEST(CellProgram, OfSixFreedomsIsProvedByItsMultipliersAndReachedByItsPoint) {
  Random random(cases::seed(), 72);
  for (int k = 0; k < 300; ++k) {
    SCOPED_TRACE(k);
    std::vector<LinearBound<6>> rows(1 + random.below(80));
    for (auto& row : rows) {
      row.level = random.uniform(0, 2);
      for (double& s : row.slope) s = random.below(6) == 0 ? 0 : random.uniform(-1, 1);
    }
    std::array<double, 6> half{};
    for (double& h : half) h = random.below(8) == 0 ? 0 : random.uniform(0.05, 3);
    const LinearSolution<6> solution = solve_cell(rows, half);
    const auto lowest = [&](const std::array<double, 6>& z) {
      double least = 1e300;
      for (const auto& row : rows) {
        double top = row.level;
        for (std::size_t i = 0; i < 6; ++i) top += row.slope[i] * z[i];
        least = std::min(least, top);
      }
      return least;
    };
    double sum = 0, proved = 0;
    std::array<double, 6> slope{};
    for (std::size_t j = 0; j < solution.rows; ++j) {
      EXPECT_GE(solution.multiplier[j], 0);
      sum += solution.multiplier[j];
      proved += solution.multiplier[j] * rows[solution.row[j]].level;
      for (std::size_t i = 0; i < 6; ++i) slope[i] += solution.multiplier[j] * rows[solution.row[j]].slope[i];
    }
    for (std::size_t i = 0; i < 6; ++i) {
      proved += std::abs(slope[i]) * half[i];
      EXPECT_LE(std::abs(solution.z[i]), half[i]);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(proved, solution.bound, 1e-11);
    EXPECT_NEAR(lowest(solution.z), solution.bound, 1e-9);
  }
}

}  // namespace
}  // namespace lekalo::locate::locate_cell_program_test

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "cell_program.hpp"

namespace lekalo::locate {

template <std::size_t N>
[[nodiscard]] double inner(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = a[0] * b[0];
  for (std::size_t i = 1; i < N; ++i) sum += a[i] * b[i];
  return sum;
}

/// Solves a symmetric positive definite system.
template <std::size_t N>
[[nodiscard]] std::array<double, N> solve_definite(std::array<std::array<double, N>, N> a,
                                                   std::array<double, N> b) {
  for (std::size_t j = 0; j < N; ++j)
    for (std::size_t k = j + 1; k < N; ++k) {
      const double f = a[k][j] / a[j][j];
      for (std::size_t i = j; i < N; ++i) a[k][i] -= f * a[j][i];
      b[k] -= f * b[j];
    }
  for (std::size_t j = N; j-- > 0;) {
    for (std::size_t i = j + 1; i < N; ++i) b[j] -= a[j][i] * b[i];
    b[j] /= a[j][j];
  }
  return b;
}

/// Minimises z H z / 2 + g z subject to level + slope z >= 0 for every row, by Hildreth's dual coordinate
/// ascent (A quadratic programming procedure, Naval Research Logistics Quarterly 4, 1957). The result may
/// break a row a little. \pre H is positive definite. Cost: O(N^3 + N^2 rows) and O(N rows) a sweep, of which
/// there are 200 at most.
template <std::size_t N>
[[nodiscard]] std::array<double, N> constrained_step(const std::array<std::array<double, N>, N>& h,
                                                     const std::array<double, N>& g,
                                                     const std::vector<LinearBound<N>>& rows) {
  constexpr int kMostSweeps = 200;
  std::array<double, N> back{};
  for (std::size_t i = 0; i < N; ++i) back[i] = -g[i];
  std::array<double, N> z = solve_definite(h, back);
  std::vector<std::array<double, N>> reach;  // H^-1 slope
  reach.reserve(rows.size());
  for (const LinearBound<N>& row : rows) reach.push_back(solve_definite(h, row.slope));
  std::vector<double> multiplier(rows.size(), 0.0);
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double change = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double curvature = inner(rows[k].slope, reach[k]);
      if (!(curvature > 0)) continue;
      const double wanted = -(rows[k].level + inner(rows[k].slope, z)) / curvature;
      const double step = std::max(wanted, -multiplier[k]);
      multiplier[k] += step;
      for (std::size_t i = 0; i < N; ++i) z[i] += step * reach[k][i];
      change = std::max(change, std::abs(step) * std::sqrt(curvature));
    }
    if (change < 1e-12) break;
  }
  return z;
}

}  // namespace lekalo::locate

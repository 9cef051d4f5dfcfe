#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace lekalo::locate {

/// The normal equations of small motions with N freedoms, all in mm.
template <std::size_t N>
struct NormalEquations {
  std::array<std::array<double, N>, N> matrix{};
  std::array<double, N> right{};
  double squares = 0;

  void add(const std::array<double, N>& row, double residual) {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) matrix[i][j] += row[i] * row[j];
      right[i] += row[i] * residual;
    }
    squares += residual * residual;
  }

  /// Solves by Gaussian elimination. The matrix is positive semidefinite, so the largest diagonal entry is a
  /// good pivot. A motion that the points do not see (a disc turning in a disc) stays zero.
  [[nodiscard]] std::array<double, N> solve() const {
    // The points do not see a motion whose pivot is below this part of the largest one.
    constexpr double kUnseen = 1e-13;
    auto a = matrix;
    auto b = right;
    std::array<bool, N> done{};
    double largest = 0;
    for (std::size_t i = 0; i < N; ++i) largest = std::max(largest, a[i][i]);
    for (std::size_t step = 0; step < N; ++step) {
      std::size_t pivot = N;
      for (std::size_t i = 0; i < N; ++i) {
        if (!done[i] && (pivot == N || a[i][i] > a[pivot][pivot])) pivot = i;
      }
      if (!(a[pivot][pivot] > kUnseen * largest)) break;
      done[pivot] = true;
      for (std::size_t i = 0; i < N; ++i) {
        if (i == pivot) continue;
        const double factor = a[i][pivot] / a[pivot][pivot];
        for (std::size_t j = 0; j < N; ++j) a[i][j] -= factor * a[pivot][j];
        b[i] -= factor * b[pivot];
      }
    }
    std::array<double, N> motion{};
    for (std::size_t i = 0; i < N; ++i) motion[i] = done[i] ? b[i] / a[i][i] : 0;
    return motion;
  }
};

}  // namespace lekalo::locate

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "lekalo/base/parallel.hpp"

namespace lekalo::heat {

using Numbers = std::vector<double>;

/// Numbers at places in rows along x, with one place of zeros around them all, so that neighbours need no
/// question, and rows that are longer than they need be, so that kWide of them are read at once.
struct Lattice {
  static constexpr std::size_t kWide = 8;

  std::array<std::size_t, 3> count{};  ///< places along x, y, z
  std::size_t row = 0, layer = 0, size = 0;

  Lattice() = default;
  explicit Lattice(const std::array<std::size_t, 3>& places)
      : count(places),
        row((places[0] + kWide - 1) / kWide * kWide + 2),
        layer(row * (places[1] + 2)),
        size(layer * (places[2] + 2)) {}

  [[nodiscard]] std::size_t index(std::size_t i, std::size_t j, std::size_t k) const noexcept {
    return (k + 1) * layer + (j + 1) * row + i + 1;
  }
  [[nodiscard]] std::array<std::size_t, 3> steps() const noexcept { return {1, row, layer}; }
  [[nodiscard]] std::size_t rows() const noexcept { return count[1] * count[2]; }
  /// Returns the place at which the n-th row begins.
  [[nodiscard]] std::size_t begin_of_row(std::size_t n) const noexcept {
    return index(0, n % count[1], n / count[1]);
  }
};

/// Rows that one task takes. It is fixed, and sums are made of the tasks' in their order, so that the number
/// of threads changes no bit.
inline constexpr std::size_t kRowsOfTask = 16;
/// Nanoseconds below which starting threads costs more than it brings on a busy machine.
inline constexpr std::size_t kWorthThreads = 600'000;

/// Calls act(first, end) for runs of rows.
/// \param cost  about how many nanoseconds a place takes
template <class Act>
void each_rows(const Lattice& lattice, unsigned threads, std::size_t cost, const Act& act) {
  const std::size_t rows = lattice.rows(), tasks = (rows + kRowsOfTask - 1) / kRowsOfTask;
  const auto task = [&](std::size_t n) { act(n * kRowsOfTask, std::min((n + 1) * kRowsOfTask, rows)); };
  if (lattice.count[0] * rows * cost >= kWorthThreads) return share_out(tasks, threads, task);
  for (std::size_t n = 0; n < tasks; ++n) task(n);
}
/// Adds up act(first, end) of runs of rows, in one order.
template <class Act>
double sum_of_rows(const Lattice& lattice, unsigned threads, const Act& act) {
  std::vector<double> parts((lattice.rows() + kRowsOfTask - 1) / kRowsOfTask);
  each_rows(lattice, threads, 1,
            [&](std::size_t first, std::size_t end) { parts[first / kRowsOfTask] = act(first, end); });
  double sum = 0;
  for (const double part : parts) sum += part;
  return sum;
}

/// How many places, or voxels, a coarser lattice has along an axis; one stays one.
[[nodiscard]] constexpr std::size_t halved(std::size_t count) noexcept { return (count + 1) / 2; }

}  // namespace lekalo::heat

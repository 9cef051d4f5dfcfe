#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lekalo::locate {

/// An upper bound of the clearance that is linear over a cell of poses with N freedoms. With z counted from
/// the cell's middle, all in mm, clearance <= level + slope . z. In the plane z is (x, y, turn * reach).
template <std::size_t N>
struct LinearBound {
  std::array<double, N> slope{};
  double level = 0;
};

/// The solution of the linear program of one cell: maximise r over |z_i| <= half_i subject to r <= level_k +
/// slope_k . z for every row k. It has N unknowns and r, and is solved by the dual simplex method. Its
/// value bounds the clearance of every pose in the cell, and its z is the pose to look at next.
template <std::size_t N>
struct LinearSolution {
  std::array<double, N> z{};
  /// The bound that the multipliers below prove, whatever the simplex method did; not yet rounded up.
  double bound = 0;
  /// The rows that prove the bound, up to N + 1, with multipliers >= 0 that sum to 1 (to rounding).
  std::array<std::uint32_t, N + 1> row{};
  std::array<double, N + 1> multiplier{};
  std::size_t rows = 0;
};

using CellRow = LinearBound<3>;
using CellSolution = LinearSolution<3>;

/// \pre at least one row; N is 3 or 6. Cost: O(N^3 + rows) a pivot, usually 3 to 8 of them in the plane;
/// allocates nothing.
template <std::size_t N>
[[nodiscard]] LinearSolution<N> solve_cell(const std::vector<LinearBound<N>>& rows,
                                           const std::array<double, N>& half);

}  // namespace lekalo::locate

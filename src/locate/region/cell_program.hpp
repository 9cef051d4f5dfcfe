#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace lekalo::locate {

/// An upper bound of the clearance that is linear over a cell of poses. With z = (x, y, turn * reach) counted
/// from the cell's middle, all in mm, clearance <= level + slope . z.
struct CellRow {
  std::array<double, 3> slope{};
  double level = 0;
};

/// The solution of the linear program of one cell: maximise r over |z_i| <= half_i subject to r <= level_k +
/// slope_k . z for every row k. It has three unknowns and r, and is solved by the dual simplex method. Its
/// value bounds the clearance of every pose in the cell, and its z is the pose to look at next.
struct CellSolution {
  std::array<double, 3> z{};
  /// The bound that the multipliers below prove, whatever the simplex method did; not yet rounded up.
  double bound = 0;
  /// The rows that prove the bound, up to four, with multipliers >= 0 that sum to 1 (to rounding).
  std::array<std::uint32_t, 4> row{};
  std::array<double, 4> multiplier{};
  std::size_t rows = 0;
};

/// \pre at least one row. Cost: O(rows) a pivot, usually 3 to 8 of them; allocates nothing.
[[nodiscard]] CellSolution solve_cell(const std::vector<CellRow>& rows, const std::array<double, 3>& half);

}  // namespace lekalo::locate

#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/field/grid.hpp"

namespace lekalo::field {

/// Level lines of numbers at the nodes of a grid, by cells.
class LevelLines {
 public:
  /// A crossing of a level line with the way between two neighbouring nodes.
  struct Place {
    geom::Point at;
    /// True when both numbers are finite; otherwise `at` is in the middle.
    bool known = true;
  };

  /// \param values  of each node, +infinity where there is none; kept by reference
  /// \pre as many values as frame.size(), frame.columns and rows at least 2
  LevelLines(const GridFrame& frame, const std::vector<double>& values);

  /// The lines of a level, with what is below it on their left. Those that leave the grid are left out unless
  /// they come back to their first place: values at the grid's rim are to be above the level.
  /// Error: a place is where the value interpolated along the way between the nodes is the level, at least a
  /// thousandth of the way from either; with the second derivative along it at most M that is within
  /// h^2 M / (8 slope) of the line itself, h the pitch. Where a cell's corners are below and above crosswise,
  /// the mean of the four tells which are joined. Cost: O(nodes / 256 + places log places).
  [[nodiscard]] std::vector<std::vector<Place>> at(double level) const;

 private:
  /// Least and largest value in and around squares of nodes.
  struct Square {
    double low, high;
  };
  GridFrame frame_;
  const std::vector<double>& values_;
  std::vector<Square> squares_;
  std::size_t squares_across_ = 0;
};

}  // namespace lekalo::field

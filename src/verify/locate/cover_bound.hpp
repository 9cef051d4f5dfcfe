#pragma once

#include <vector>

#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// Poses (theta, x, y of the pivot): a box in doubles.
struct PoseCell {
  double low[3], high[3];
};

/// A pair of balls (cover_tree.hpp): the part's from the pivot, mirrored if the tree is.
struct BallTerm {
  Vec part;
  Vec blank;
  double part_radius = 0, blank_radius = 0;
  Span multiplier;      ///< as written: sums are divided by their sum
  bool capped = false;  ///< a cap's term: its ball lies in the blank's material
};

/// The bound that the terms prove over a cell, and the one at its middle: no division of the cell proves
/// less.
struct CellBound {
  double everywhere = 0, in_the_middle = 0;
};
[[nodiscard]] CellBound bound_over(const PoseCell& cell, const std::vector<BallTerm>& terms);

}  // namespace lekalo::verify

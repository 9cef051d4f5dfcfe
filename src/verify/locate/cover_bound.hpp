#pragma once

#include <array>
#include <vector>

#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// A box of poses (theta, and x, y of the pivot) in doubles.
struct PoseCell {
  std::array<double, 3> low, high;
};

/// A pair of balls (cover_tree.hpp). The part's ball is counted from the pivot, and mirrored if the tree is.
struct BallTerm {
  Vec part;
  Vec blank;
  double part_radius = 0, blank_radius = 0;
  /// The multiplier as written; a bound divides by the sum of all multipliers.
  Span multiplier;
  /// True for the term of a cap: its ball lies in the blank's material.
  bool capped = false;
};

/// The bound that the terms prove over a cell, and the one at its middle. No division of the cell proves a
/// bound below the latter.
struct CellBound {
  double everywhere, in_the_middle;
};
[[nodiscard]] CellBound bound_over(const PoseCell& cell, const std::vector<BallTerm>& terms);

}  // namespace lekalo::verify

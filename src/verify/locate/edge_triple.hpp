#pragma once

#include <array>
#include <vector>

#include "edge_lines.hpp"

namespace lekalo::verify {

/// Three blank edges that bound the allowance together, once they balance: for edges e1, e2, e3 the numbers
/// e2 x e3, e3 x e1, e1 x e2 make the sum of (number x edge) zero. When they agree in sign they weigh the
/// three distances so that a shift of the part cancels.
struct EdgeTriple {
  enum class Balance { holds, parallel, opposed };

  std::array<const EdgeLine*, 3> edges{};
  /// The weights of the edges. In a triple that balances none is negative and not all are zero.
  std::array<Integer, 3> weights;
  /// Each weight times its edge's length, as a share of the sum of all three: the multipliers in doubles.
  std::array<double, 3> shares{};
  Balance balance = Balance::parallel;

  explicit EdgeTriple(const std::array<const EdgeLine*, 3>& three);
  /// Returns the largest difference of a share from the multiplier written for it.
  [[nodiscard]] double disagreement(const std::array<double, 3>& multipliers) const;
  /// Returns about how wrong a share is when each coordinate of the edges' ends is off by `roundoff`.
  [[nodiscard]] double sensitivity(const Interval& roundoff) const;
};

/// Returns the triple that a certificate means by its edges and multipliers.
///
/// When a multiplier is next to nothing, the other two edges are opposite but for the last digits of the
/// file, and the third carries what those digits leave. The writer cannot know which edge is fit for that,
/// nor whether it does not itself run along the pair. Any three edges that balance make a true bound. So a
/// hull edge across the pair takes the third place when that fits the written multipliers better.
[[nodiscard]] EdgeTriple intended_triple(const std::array<const EdgeLine*, 3>& written,
                                         const std::array<double, 3>& multipliers, double tolerance,
                                         EdgeLines& edges);

}  // namespace lekalo::verify

#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "nest/separator/separator.hpp"

namespace lekalo::nest {

/// How good a valid state is. Less is better, and the first number that differs decides.
struct Merit {
  double missing = 0;   ///< value of the kits that are wanted and not complete; 0 on strips
  double unplaced = 0;  ///< area of the items that lie nowhere, times 1 + priority, mm^2
  double cost = 0;      ///< of the stock in use
  /// On a strip its length, mm. On sheets minus the leftover of the bin with most of it, mm^2.
  double reach = 0;
  friend auto operator<=>(const Merit&, const Merit&) = default;
};
/// The merit of a valid state. Cost: one pass over the items, and the search for complete kits.
[[nodiscard]] Merit merit_of(const Problem& problem, const Items& items, const State& state);

/// How far along a strip its items reach, border gaps included, mm.
[[nodiscard]] double strip_length(const Problem& problem, const Items& items, const State& state);
/// How far from the lower left corner the items on a bin reach, border gaps included, mm: along x for axis
/// 0, along y for axis 1.
[[nodiscard]] double reach_of(const Problem& problem, const Items& items, const State& state,
                              std::uint32_t bin, int axis);
/// The box at a bin's lower left corner that holds what lies on it and beyond which the rest is worth having,
/// mm: as high or as wide as the bin where one cut is to free the rest (Remnant).
struct BoxSize {
  double w = 0, h = 0;  ///< mm
  [[nodiscard]] double area() const noexcept { return w * h; }
};
[[nodiscard]] BoxSize box_in_use(const Problem& problem, const Items& items, const State& state,
                                 std::uint32_t bin);
/// Area of a bin outside that box, mm^2.
[[nodiscard]] double leftover_of(const Problem& problem, const Items& items, const State& state,
                                 std::uint32_t bin);
/// The open bin with the largest leftover. \pre a bin is open
[[nodiscard]] std::uint32_t emptiest(const Problem& problem, const Items& items, const State& state);
/// Area of the items that lie on a bin, mm^2.
[[nodiscard]] double used_area(const Problem& problem, const Items& items, const State& state,
                               std::uint32_t bin);
/// Pieces that lie somewhere, by part, with the locked ones.
[[nodiscard]] std::vector<layout::PieceCount> placed_pieces(const Problem& problem, const Items& items,
                                                            const State& state);

}  // namespace lekalo::nest

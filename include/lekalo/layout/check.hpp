#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lekalo/layout/document.hpp"

namespace lekalo::layout {

/// What can be wrong with a layout. Decided exactly on the grid (phi/outline_relation.hpp).
enum class ViolationKind : std::uint8_t {
  overlap,     ///< two parts have material in common
  gap,         ///< two parts are nearer than their gap
  outside,     ///< a part reaches beyond the stock or into a hole of it
  border_gap,  ///< a part is nearer to the border than its gap
  defect,      ///< a part covers a defect it does not tolerate
  defect_gap,  ///< a part is nearer to such a defect than its gap
  quality,     ///< an area of a part lies in a zone too bad for it
  rotation,    ///< an angle the part may not have
  mirror,      ///< mirrored, and may not be
  grain,       ///< the grain is off by more than the tolerance
  stock        ///< on a copy of the stock that is not there
};
/// "overlap", "gap", "outside", "border-gap", "defect", "defect-gap", "quality", "rotation", "mirror",
/// "grain", "stock".
[[nodiscard]] std::string_view name_of(ViolationKind kind) noexcept;

struct Violation {
  ViolationKind kind{};
  std::uint64_t a = 0;  ///< the placement's id
  std::uint64_t b = 0;  ///< the other placement's id, a < b; 0 where there is none
  std::uint32_t stock = 0;
  std::int64_t copy = 0;
  /// Index of the defect or zone in the stock; 0 for other kinds.
  std::uint32_t feature = 0;
  /// mm. overlap, outside, defect, quality: the length of a shift along `direction` that ends the violation
  /// between these two (short, not always the shortest). gap kinds: what is missing of the gap. rotation,
  /// grain: 0.
  double amount_mm = 0;
  geom::Point at;         ///< mm, a place where it can be seen
  geom::Point direction;  ///< unit vector in which to move `a`; (0, 0) where there is none
  friend bool operator==(const Violation&, const Violation&) = default;
};

/// The gap between two parts, in steps.
[[nodiscard]] std::int64_t gap_between(const Document& document, std::uint32_t part_a,
                                       std::uint32_t part_b) noexcept;

/// Every violation of a document, ordered by stock, copy, a, kind, b. Cost: O(n log n + pairs of parts whose
/// boxes come within their gap, times their edges).
[[nodiscard]] std::vector<Violation> check(const Document& document);

/// What check() would say of a document with these placements, only of those that one of `of` has a part in:
/// alone, with another of `of`, or with one of `with`. Both ascending by id; ids and the document's own
/// placements do not matter. What lies on different sheets does not meet. In the order of check().
[[nodiscard]] std::vector<Violation> check_some(const Document& document, std::span<const Placement> of,
                                                std::span<const Placement> with);

/// Whether a zone of its stock is too bad for some area of a placed part (rule 6 of docs/design/layout.md).
[[nodiscard]] bool spoils(const Document& document, const Placement& placement, std::uint32_t zone);

}  // namespace lekalo::layout

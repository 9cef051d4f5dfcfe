#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/layout/document.hpp"

namespace lekalo::layout {

/// The rules that a layout can break. They are decided exactly on the grid (phi/outline_relation.hpp).
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
/// Returns "overlap", "gap", "outside", "border-gap", "defect", "defect-gap", "quality", "rotation",
/// "mirror", "grain" or "stock".
[[nodiscard]] std::string_view name_of(ViolationKind kind) noexcept;

struct Violation {
  ViolationKind kind{};
  std::uint64_t a = 0;  ///< the placement's id
  /// The id of the other placement, a < b; 0 where there is none.
  std::uint64_t b = 0;
  std::uint32_t stock = 0;
  std::int64_t copy = 0;
  /// The index of the defect or zone in the stock; 0 for other kinds.
  std::uint32_t feature = 0;
  /// How much is wrong, mm; 0 for kinds not named here.
  ///
  /// For overlap, outside, defect and quality this is the length of a shift along `direction` that ends the
  /// violation between these two. The shift is proved and short, not always the shortest; that for quality
  /// leads out of the zone altogether. For outside without such a shift it is how far the part sticks out,
  /// with no direction. For the kinds of gaps it is what is missing of the gap, within 1e-12.
  double amount_mm = 0;
  /// A place where the violation can be seen, mm.
  geom::Point at;
  /// The unit vector in which to move `a`; (0, 0) where there is none.
  geom::Point direction;
  friend bool operator==(const Violation&, const Violation&) = default;
};

/// The id of the defect or zone that a violation is about; "" for kinds that have none.
[[nodiscard]] std::string feature_id(const Document& document, const Violation& violation);

/// Returns the gap between two parts in steps; the two functions below return a part's gap to the border and
/// to defects.
[[nodiscard]] std::int64_t gap_between(const Document& document, const Part& a, const Part& b) noexcept;
[[nodiscard]] std::int64_t border_gap_of(const Document& document, const Part& part) noexcept;
[[nodiscard]] std::int64_t defect_gap_of(const Document& document, const Part& part) noexcept;

/// Returns every violation of a document, ordered by stock, copy, a, kind, b, feature. Cost: O(n log n +
/// pairs of parts whose boxes come within their gap, times their edges), two sheets at a time.
/// \pre indices and ids are as Document says
[[nodiscard]] std::vector<Violation> check(const Document& document);

/// Says whether to find out too how to end an overlap, or a reach outside, into a defect or into a zone. That
/// costs a hundred times as much as finding these violations.
enum class Depths : std::uint8_t {
  measured,
  /// Amount and direction of these kinds are 0, and `at` is the placement's.
  left_out
};

/// Returns the violations that check() finds in a document with these placements, as far as one of `of` is in
/// them: alone, with another of `of`, or with one of `with`. Both lists are ascending by id, and ids and the
/// document's own placements do not matter. Placements on different sheets do not meet. The order is that of
/// check().
[[nodiscard]] std::vector<Violation> check_some(const Document& document, std::span<const Placement> of,
                                                std::span<const Placement> with,
                                                Depths depths = Depths::measured);

/// The checks below are those that check() is made of. Outlines are those of placed_outline().

/// Adds the violations of rotation, mirror, grain and stock.
void add_own_violations(const Document& document, const Placement& placement, std::vector<Violation>& to);
/// Returns outside, or else border_gap.
[[nodiscard]] std::optional<Violation> border_violation(const Document& document, const Placement& placement,
                                                        const geom::GridRegion& outline,
                                                        Depths depths = Depths::measured);
/// Returns defect, or else defect_gap.
/// \param defect  index in the placement's stock
[[nodiscard]] std::optional<Violation> defect_violation(const Document& document, const Placement& placement,
                                                        const geom::GridRegion& outline, std::uint32_t defect,
                                                        Depths depths = Depths::measured);
/// \param zone  index in the placement's stock
[[nodiscard]] std::optional<Violation> quality_violation(const Document& document, const Placement& placement,
                                                         const geom::GridRegion& outline, std::uint32_t zone,
                                                         Depths depths = Depths::measured);
/// Returns overlap, or else gap.
/// \pre both on one copy of one stock; a.id < b.id
[[nodiscard]] std::optional<Violation> pair_violation(const Document& document, const Placement& a,
                                                      const geom::GridRegion& outline_a, const Placement& b,
                                                      const geom::GridRegion& outline_b,
                                                      Depths depths = Depths::measured);

}  // namespace lekalo::layout

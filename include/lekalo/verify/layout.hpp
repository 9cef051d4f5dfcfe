#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/verify/verify.hpp"

namespace lekalo::verify {

/// The rules that a layout can break; their names are those of the words in docs/formats.md.
enum class LayoutRule : std::uint8_t {
  overlap,
  gap,
  outside,
  border_gap,
  defect,
  defect_gap,
  quality,
  rotation,
  mirror,
  grain,
  stock
};
/// Returns "overlap", "gap", "outside", "border-gap", "defect", "defect-gap", "quality", "rotation",
/// "mirror", "grain" or "stock".
[[nodiscard]] std::string_view name_of(LayoutRule rule) noexcept;

struct LayoutViolation {
  LayoutRule kind{};
  std::uint64_t a = 0;  ///< the placement's id
  /// The id of the other placement, above a; 0 where there is none.
  std::uint64_t b = 0;
  std::string stock;  ///< the stock's id
  std::int64_t copy = 0;
  /// The id of the defect or zone; empty for other kinds.
  std::string feature;
  friend bool operator==(const LayoutViolation&, const LayoutViolation&) = default;
};

struct LayoutVerdict {
  /// Ordered by stock (in the file's order), copy, a, kind, b and feature (in the file's order). Two things
  /// have one violation together: a gap only where nothing overlaps or sticks out.
  std::vector<LayoutViolation> violations;
  /// The number of placements that were looked at, which are all of the file.
  std::size_t placements = 0;
};

/// Decides which rules of docs/design/layout.md a layout ("lekalo-layout/1") breaks, from its bytes alone and
/// exactly. It shares nothing with what made the layout. docs/design/layout-verify.md says how.
///
/// Fails with bad_input, and with the place in the file, for bytes that are no layout, for a polygon that is
/// not simple or comes nearer to itself than the grid allows, and for a polygon that is missing or is not
/// what rule 2 makes of the drawing beside it. lekalo has to write such a file anew first. Cost: O(n log n +
/// pairs of placements with close boxes, times their edges): 1,000 parts take about a second.
[[nodiscard]] Result<LayoutVerdict> verify_layout(const Document& document);

}  // namespace lekalo::verify

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
/// "overlap", "gap", "outside", "border-gap", "defect", "defect-gap", "quality", "rotation", "mirror",
/// "grain", "stock".
[[nodiscard]] std::string_view name_of(LayoutRule rule) noexcept;

struct LayoutViolation {
  LayoutRule kind{};
  std::uint64_t a = 0;  ///< the placement's id
  std::uint64_t b = 0;  ///< the other placement's, above a; 0 where there is none
  std::string stock;    ///< its id
  std::int64_t copy = 0;
  std::string feature;  ///< id of the defect or zone; empty for other kinds
  friend bool operator==(const LayoutViolation&, const LayoutViolation&) = default;
};

struct LayoutVerdict {
  /// By stock (in the file's order), copy, a, kind, b and feature (in the file's order). Of two things there
  /// is one violation: a gap only where nothing overlaps or sticks out.
  std::vector<LayoutViolation> violations;
  std::size_t placements = 0;  ///< that were looked at: all of the file
};

/// Decides which rules of docs/design/layout.md a layout ("lekalo-layout/1") breaks, from its bytes alone and
/// exactly; nothing here is shared with what made it. How: docs/design/layout-verify.md.
///
/// bad_input, with the place in the file: what is no layout; a polygon that is not simple or comes nearer to
/// itself than the grid allows; a polygon that is missing, or is not what rule 2 makes of the drawing beside
/// it. Such files are to be written by lekalo first. Cost: O(n log n + pairs of placements with close boxes,
/// times their edges): 1,000 parts take about a second.
[[nodiscard]] Result<LayoutVerdict> verify_layout(const Document& document);

}  // namespace lekalo::verify

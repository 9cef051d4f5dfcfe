#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/layout/document.hpp"

namespace lekalo::layout {

/// The smallest rest of a sheet that goes back into the stock: it holds a rectangle of this size, lying or
/// standing, or it has this area. One of both is said, and the other is 0.
struct RemnantRule {
  std::int64_t width = 0, height = 0;  ///< grid steps
  std::int64_t area_mm2 = 0;
  friend bool operator==(const RemnantRule&, const RemnantRule&) = default;
};

/// Says whether such a remnant could lie in an outline, by the area and the box of both alone.
[[nodiscard]] bool fits_rule(const geom::GridRegion& outline, const RemnantRule& rule);

/// The rest of a sheet that is worth keeping.
struct Remnant {
  geom::GridRegion outline;  ///< in the frame of the sheet
  /// A rectangle in the outline, proved to lie in it; it has the size of the rule where that says one, or
  /// more.
  geom::GridBox rectangle;
};

/// How far a remnant stays from a part: the part's own gap, and no less than the width of the cut.
[[nodiscard]] std::int64_t remnant_gap(const Document& document, const Part& part) noexcept;

/// Returns what a sheet leaves when what lies on it was cut, largest first: the region beyond a stepped cut
/// around the box of every part, each grown by its remnant_gap. The cut begins at that corner of the sheet
/// from which it leaves most, and has at most four corners, each of which gains as much as the smallest
/// remnant of the rule is worth. Arms narrower than the shorter side of the rule are left out.
///
/// Proved of each one, exactly, on the grid: it lies in the sheet, is no nearer to a part than the part's
/// remnant_gap, overlaps no other one, and satisfies the rule. What cannot be proved is not returned.
/// docs/design/stock.md says how. Cost: O(n^2) for the n parts of the sheet
/// whose upper right corners no other part covers, and that of Booleans with a polygon of eleven corners.
/// \pre a part lies on the copy; the stock is no strip
[[nodiscard]] std::vector<Remnant> remnants_of(const Document& document, std::uint32_t stock,
                                               std::int64_t copy, const RemnantRule& rule);

/// Returns the remnant as stock, moved so that the lower left corner of its box is (0, 0). It has the
/// material and the grain of the sheet, its share of the cost by area, and the defects and zones that meet
/// it, as polygons. The id is left empty.
[[nodiscard]] Stock stock_of(const Stock& sheet, const Remnant& remnant);

}  // namespace lekalo::layout

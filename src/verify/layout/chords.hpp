#pragma once

#include <optional>
#include <string>
#include <vector>

#include "grid_outline.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::verify {

enum class ChordSide {
  outside,  ///< of the material: parts, defects, zones
  inside    ///< stock
};

/// The fault that keeps a polygon from being that of a drawing (rule 2 of docs/design/layout.md), for which
/// docs/design/layout-verify.md has the exact statement: its loops are the contours, in order and in either
/// direction; each vertex of the drawing has one of the polygon within 4 steps; lines are single edges; the
/// chords of an arc run around its centre with it, on their side of it. \pre loops are simple. Cost:
/// O(points).
[[nodiscard]] std::optional<std::string> fault_of_chords(const std::vector<GridLoop>& loops,
                                                         const Shape& drawn, ChordSide side,
                                                         double tolerance_mm);

}  // namespace lekalo::verify

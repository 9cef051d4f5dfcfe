#pragma once

#include <string>
#include <vector>

#include "sheet_shapes.hpp"

namespace lekalo::io::detail {

inline constexpr double kPlotterUnit = 0.025;  ///< mm

/// HPGL of one sheet: absolute moves in plotter units, a pen for each kind (docs/formats.md), no IP, SC or
/// RO, so that plotters keep their own scale. Chords lie within `chord_tolerance` of their arcs, and every
/// corner within kPlotterUnit / sqrt(2) of where it is. `only`: layers, empty for all.
///
/// Fails with ErrorCode::bad_input where a coordinate is beyond what plotters count to (2^23 - 1 units,
/// 209 m).
[[nodiscard]] Result<std::string> hpgl_text(const SheetShapes& sheet, const std::vector<std::string>& only,
                                            double chord_tolerance);

}  // namespace lekalo::io::detail

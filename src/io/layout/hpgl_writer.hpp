#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lekalo/nc/knife.hpp"
#include "sheet_shapes.hpp"

namespace lekalo::io::detail {

inline constexpr double kPlotterUnit = 0.025;  ///< mm

struct PlotText {
  std::string text;
  double tip_off_mm = 0;  ///< the tip of the knife is never farther from an outline
};

/// HPGL of one sheet: absolute moves in plotter units, a pen for each kind (docs/formats.md), no IP, SC or
/// RO, so that plotters keep their own scale. Chords lie within `chord_tolerance` of their arcs, and every
/// corner within kPlotterUnit / sqrt(2) of where it is. `only`: layers, empty for all. `knife`: pen 1 has a
/// knife, and the plot says what its axis follows.
///
/// Fails with ErrorCode::bad_input where a coordinate is beyond what plotters count to (2^23 - 1 units,
/// 209 m), and where the tip of the knife would leave an outline by more than its tolerance.
[[nodiscard]] Result<PlotText> hpgl_text(const SheetShapes& sheet, const std::vector<std::string>& only,
                                         double chord_tolerance,
                                         const std::optional<nc::KnifeOptions>& knife);

}  // namespace lekalo::io::detail

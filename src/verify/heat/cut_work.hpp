#pragma once

#include <optional>
#include <string>

#include "lekalo/verify/cut_history.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// The work of a program's cuts, by formulas of the checker's own (docs/design/heat-source.md, steps 2 to 5).

struct CheckedRange {
  double least = 0, greatest = 0;

  [[nodiscard]] double middle() const noexcept { return (least + greatest) / 2; }
};

/// A stock with upright sides and its upper face at the top of the stock, mm: a block, or an outline and the
/// box about it.
struct CheckedStock {
  double low_x = 0, low_y = 0, high_x = 0, high_y = 0, thickness = 0;
  std::optional<Shape> outline = std::nullopt;

  /// Distance of a place from the border, positive inside.
  [[nodiscard]] double inside(double x, double y) const;
};

struct CheckedCutting {
  double diameter = 0, teeth = 0, spindle_rpm = 0;
  CheckedRange force, exponent, wear, share;  ///< k_c1.1 in N/mm2, m_c
};

struct BookedWork {
  double seconds = 0, cutting_seconds = 0, volume_mm3 = 0;
  CheckedRange work_j, into_j, carried_off_j, power_w;
  std::string fault;  ///< one sentence where the program cuts beyond the stock; then nothing else counts
};

/// \param top  Z of the stock's upper face, mm
[[nodiscard]] BookedWork booked_work(const CutHistory& history, const CheckedStock& stock,
                                     const CheckedCutting& cutting, double top);

}  // namespace lekalo::verify

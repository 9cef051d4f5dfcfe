#pragma once

#include <string_view>

#include "scene.hpp"

namespace lekalo::draw {

inline constexpr Colour kInk{31, 36, 43}, kGrey{96, 105, 116}, kFaint{160, 168, 178}, kRule{214, 219, 225},
    kPaper{255, 255, 255}, kBlankFill{228, 233, 239}, kBlankLine{110, 122, 136}, kStartLine{70, 130, 180},
    kOutside{208, 0, 27}, kOutsideBase{20, 20, 20}, kGood{32, 122, 76}, kDoubt{150, 105, 10};

/// The scale has this many colours, so that a contour is drawn in few pieces.
inline constexpr int kColourSteps = 64;

/// Returns the colour of a step, from 0 (thin: bright orange) to kColourSteps - 1 (thick: dark blue).
/// Lightness falls evenly from thin to thick, so the order survives every kind of colour blindness and a grey
/// printer; the hue runs from warm to cold. The colours lie between nine colours of equal steps in OKLCh
/// (lightness 0.76 to 0.32, hue 62 to -88 degrees).
[[nodiscard]] Colour scale_colour(int step);

/// Returns the colour behind the status of a result.
[[nodiscard]] Colour colour_of_status(std::string_view status);

/// Returns the step for a value, clamped to the range.
[[nodiscard]] int scale_step(double value, double low, double high);

/// The range of values, in mm, for which the colours of a picture stand; low < high.
struct ColourRange {
  double low = 0, high = 1;
};
/// Returns the range for allowances from `least` to `greatest` in a blank of this size. An allowance below 0
/// has no colour of the scale.
[[nodiscard]] ColourRange colour_range(double least, double greatest, double rounding, double size);

}  // namespace lekalo::draw

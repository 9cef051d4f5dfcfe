#pragma once

#include <string>

namespace lekalo::draw {

/// Returns the decimals for lengths of a thing of this size, mm: 6 for the sizes of a workshop, more for
/// smaller things, fewer (at least 3) where the numbers would grow too long.
[[nodiscard]] int decimals_for(double size);
/// The rounding of a decimal. decimal() writes it fixed-point and never as "-0". Numbers from 1e15 on, and
/// numbers too small to show a digit or to count zeros in, are written d.ddde-x. A number that is not finite
/// becomes a dash.
enum class Rounding { nearest, down, up };
[[nodiscard]] std::string decimal(double value, int decimals, Rounding rounding = Rounding::nearest);
/// Returns two significant digits, rounded up, for small numbers that must not look smaller than they are.
[[nodiscard]] std::string short_number_up(double value);

/// The form of the lengths of a drawing's scale: in mm, or in a power of ten of mm where that needs fewer
/// digits.
struct LengthScale {
  double unit = 1;        ///< mm
  std::string unit_name;  ///< "mm", "10⁻⁵ mm"
  /// The decimals for multiples of `step` in that unit.
  int decimals = 0;
  [[nodiscard]] std::string text(double mm) const;
  [[nodiscard]] std::string text_with_unit(double mm) const;
};
/// Returns the form for multiples of `step` up to `largest`, both mm, > 0.
[[nodiscard]] LengthScale length_scale(double step, double largest);
/// Returns 1, 2 or 5 times a power of ten, the largest one that is at most `value` > 0.
[[nodiscard]] double round_length(double value);
/// Returns the step between the ticks of an axis from low to high, mm, that is `width` mm of paper long. The
/// step is round and makes three to seven ticks, or fewer where their numbers are long.
[[nodiscard]] double tick_step(double low, double high, double width, double font_size);

}  // namespace lekalo::draw

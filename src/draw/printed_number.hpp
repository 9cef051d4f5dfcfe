#pragma once

#include <string>

namespace lekalo::draw {

/// Decimals for lengths of a thing of this size, mm: 6 for the sizes of a workshop, more for smaller things,
/// fewer (at least 3) where the numbers would grow too long.
[[nodiscard]] int decimals_for(double size);
/// Fixed-point decimal, rounded to nearest, down or up; never "-0". Numbers from 1e15 on, and ones too small
/// to show a digit or to count zeros in, are written d.ddde-x. A dash for what is not finite.
enum class Rounding { nearest, down, up };
[[nodiscard]] std::string decimal(double value, int decimals, Rounding rounding = Rounding::nearest);
/// Two significant digits, rounded up, for small numbers that must not look smaller than they are.
[[nodiscard]] std::string short_number_up(double value);

/// How lengths of a drawing's scale are written: in mm, or in a power of ten of mm where that needs fewer
/// digits.
struct LengthScale {
  double unit = 1;        ///< mm
  std::string unit_name;  ///< "mm", "10⁻⁵ mm"
  int decimals = 0;       ///< for multiples of `step` in that unit
  [[nodiscard]] std::string text(double mm) const;
  [[nodiscard]] std::string text_with_unit(double mm) const;
};
/// For multiples of `step` up to `largest`, both mm, > 0.
[[nodiscard]] LengthScale length_scale(double step, double largest);
/// 1, 2 or 5 times a power of ten, the largest at most `value` > 0.
[[nodiscard]] double round_length(double value);
/// Between the ticks of an axis from low to high, mm, that is `width` mm of paper long: round, three to seven
/// ticks, fewer where their numbers are long.
[[nodiscard]] double tick_step(double low, double high, double width, double font_size);

}  // namespace lekalo::draw

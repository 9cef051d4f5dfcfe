#pragma once

namespace lekalo {

/// Inside, every length is in millimetres and every angle in radians.
enum class LengthUnit { millimetre, inch };

inline constexpr double kMillimetresPerInch = 25.4;

[[nodiscard]] constexpr double millimetres_per(LengthUnit unit) noexcept {
  return unit == LengthUnit::inch ? kMillimetresPerInch : 1.0;
}

}  // namespace lekalo

#pragma once

namespace lekalo::geom {

struct SinCos {
  double sine = 0, cosine = 1;
};

/// Largest |theta| for which sincos keeps its bound; about 10,000 turns.
inline constexpr double kMaxAngle = 65536.0;
/// sincos: largest error of either value. (One unit in the last place of 1.)
inline constexpr double kSinCosError = 2.220446049250313e-16;

/// Sine and cosine of an angle in radians, |theta| <= kMaxAngle, within kSinCosError of the true values.
/// Our own, so that every build gives the same bits: the C library's differ by processor and in a browser.
/// Only + - * and comparisons. Checked against MPFR in tests/differential/trig_test.cpp.
[[nodiscard]] SinCos sincos(double theta) noexcept;

/// Angle of the direction (x, y) in (-pi, pi], within 1e-15 of the true one; 0 for the zero vector.
[[nodiscard]] double direction_angle(double x, double y) noexcept;

}  // namespace lekalo::geom

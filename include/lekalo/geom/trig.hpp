#pragma once

namespace lekalo::geom {

struct SinCos {
  double sine = 0, cosine = 1;
};

/// The largest |theta| for which sincos keeps its bound; about 10,000 turns.
inline constexpr double kMaxAngle = 65536.0;
/// The largest error of either value of sincos: one unit in the last place of 1.
inline constexpr double kSinCosError = 2.220446049250313e-16;

/// Returns sine and cosine of an angle in radians, |theta| <= kMaxAngle, within kSinCosError of the true
/// values. The code is our own, so that every build gives the same bits: the C library's differ by processor
/// and in a browser. It uses only + - * and comparisons. Checked against MPFR in
/// tests/differential/trig_test.cpp.
[[nodiscard]] SinCos sincos(double theta) noexcept;

/// Returns the angle of the direction (x, y) in (-pi, pi], within 1e-15 of the true one; 0 for the zero
/// vector.
[[nodiscard]] double direction_angle(double x, double y) noexcept;

}  // namespace lekalo::geom

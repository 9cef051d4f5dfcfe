#pragma once

#include <cstdint>

#include "lekalo/geom/point.hpp"

namespace lekalo::geom {

/// The grid that placed outlines lie on, 2^-20 mm (0.95 nanometres), and the rule that puts them there; the
/// same rule in words, for whoever rechecks a file: docs/design/layout.md. Everything here is integers, so it
/// is the same in every build and in a browser.

__extension__ using Int128 = __int128;

inline constexpr double kGridStep = 0x1p-20;                       ///< mm
inline constexpr std::int64_t kGridPerMm = std::int64_t{1} << 20;  ///< grid steps in a millimetre
/// Largest coordinate of anything placed, in steps: 1,048,576 mm. Orientations then fit 128 bits.
inline constexpr std::int64_t kGridLimit = std::int64_t{1} << 40;

/// A point or a vector in grid steps.
struct GridPoint {
  std::int64_t x = 0, y = 0;
  friend constexpr bool operator==(const GridPoint&, const GridPoint&) = default;
};
[[nodiscard]] constexpr GridPoint operator+(GridPoint a, GridPoint b) noexcept {
  return {a.x + b.x, a.y + b.y};
}
[[nodiscard]] constexpr GridPoint operator-(GridPoint a, GridPoint b) noexcept {
  return {a.x - b.x, a.y - b.y};
}
[[nodiscard]] constexpr GridPoint operator-(GridPoint a) noexcept { return {-a.x, -a.y}; }
[[nodiscard]] constexpr Int128 cross(GridPoint a, GridPoint b) noexcept {
  return Int128{a.x} * b.y - Int128{a.y} * b.x;
}
[[nodiscard]] constexpr Int128 dot(GridPoint a, GridPoint b) noexcept {
  return Int128{a.x} * b.x + Int128{a.y} * b.y;
}
[[nodiscard]] constexpr int sign(Int128 value) noexcept { return (value > 0) - (value < 0); }

/// |value| in millimetres that still rounds to a step within kGridLimit; NaN does not.
[[nodiscard]] constexpr bool fits_grid(double mm) noexcept { return mm >= -0x1p20 && mm <= 0x1p20; }
/// The nearest step, ties to even. \pre fits_grid(mm)
[[nodiscard]] std::int64_t grid_from_mm(double mm) noexcept;
/// The least step not below `mm`: for gaps. \pre fits_grid(mm)
[[nodiscard]] std::int64_t grid_from_mm_up(double mm) noexcept;
/// Exact. \pre |steps| <= 2^53
[[nodiscard]] constexpr double mm_from_grid(std::int64_t steps) noexcept {
  return static_cast<double>(steps) * kGridStep;
}
[[nodiscard]] constexpr Point mm_from_grid(GridPoint p) noexcept {
  return {mm_from_grid(p.x), mm_from_grid(p.y)};
}

/// +1 where a, b, c turn left, -1 right, 0 on one line: exact. Coordinates up to 4 kGridLimit.
[[nodiscard]] inline int turn(GridPoint a, GridPoint b, GridPoint c) noexcept {
  // Differences are exact doubles; each product and their difference round once.
  const double left = static_cast<double>(b.x - a.x) * static_cast<double>(c.y - a.y);
  const double right = static_cast<double>(b.y - a.y) * static_cast<double>(c.x - a.x);
  const double determinant = left - right;
  const double bound = 0x1p-51 * ((left < 0 ? -left : left) + (right < 0 ? -right : right));
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  return sign(cross(b - a, c - a));
}

/// A rotation as its cosine and sine in steps of 2^-52. In files they are the doubles c * 2^-52 and s *
/// 2^-52, which lose nothing.
struct GridRotation {
  std::int64_t c = kOne, s = 0;
  static constexpr std::int64_t kOne = std::int64_t{1} << 52;
  friend constexpr bool operator==(const GridRotation&, const GridRotation&) = default;
};

/// The steps nearest to cosine and sine of `degrees` (taken exactly; multiples of 90 give 0 and +-1). The
/// error of either is at most half a step. \pre |degrees| <= 3.6e6 and finite.
[[nodiscard]] GridRotation rotation_from_degrees(double degrees) noexcept;
/// In (-180, 180]: the number with the fewest decimals, up to 9, whose rotation_from_degrees is `rotation`;
/// within 1e-12 of its angle where there is none.
[[nodiscard]] double degrees_of(GridRotation rotation) noexcept;
/// The nearest steps to a pair of doubles. \pre finite, within [-2, 2]
[[nodiscard]] GridRotation rotation_from_pair(double c, double s) noexcept;
/// c^2 + s^2 within 2^-50 of 1: what rotation_from_degrees gives, and nothing that scales a part by a step.
[[nodiscard]] bool is_rotation(GridRotation rotation) noexcept;
/// The direction of `rotation` lies in the counter-clockwise turn from `from` to `to`, ends included; decided
/// exactly. Equal ends: that direction alone.
[[nodiscard]] bool is_between(GridRotation rotation, GridRotation from, GridRotation to) noexcept;

/// The place to which a placement turns a part's vertex: x is negated first when mirrored, then (c x - s y, s
/// x + c y), each rounded to the nearest step, ties to even. Placing adds a translation to it, which is
/// exact.
/// \pre |p| <= kGridLimit
[[nodiscard]] GridPoint turned(GridPoint p, GridRotation rotation, bool mirrored) noexcept;

}  // namespace lekalo::geom

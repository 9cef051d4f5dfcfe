#pragma once

#include <cstdint>

#include "lekalo/geom/point.hpp"

namespace lekalo::geom {

/// The grid that placed outlines lie on, 2^-20 mm (0.95 nanometres), and the rule that puts them there.
/// docs/design/layout.md has the same rule in words, for whoever rechecks a file. Everything here is
/// integers, so it is the same in every build and in a browser.

__extension__ using Int128 = __int128;

inline constexpr double kGridStep = 0x1p-20;                       ///< mm
inline constexpr std::int64_t kGridPerMm = std::int64_t{1} << 20;  ///< grid steps in a millimetre
/// The largest coordinate of anything placed, in steps: 1,048,576 mm. Orientations then fit 128 bits.
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

/// Says whether a length in millimetres still rounds to a step within kGridLimit; NaN does not.
[[nodiscard]] constexpr bool fits_grid(double mm) noexcept { return mm >= -0x1p20 && mm <= 0x1p20; }
/// Returns the nearest step, ties to even.
/// \pre fits_grid(mm)
[[nodiscard]] std::int64_t grid_from_mm(double mm) noexcept;
/// Returns the least step that is not below `mm`, for gaps.
/// \pre fits_grid(mm)
[[nodiscard]] std::int64_t grid_from_mm_up(double mm) noexcept;
/// Returns the length exactly.
/// \pre |steps| <= 2^53
[[nodiscard]] constexpr double mm_from_grid(std::int64_t steps) noexcept {
  return static_cast<double>(steps) * kGridStep;
}
[[nodiscard]] constexpr Point mm_from_grid(GridPoint p) noexcept {
  return {mm_from_grid(p.x), mm_from_grid(p.y)};
}

/// Returns a place between the points of the grid, in steps, in mm.
[[nodiscard]] constexpr Point mm_from_steps(Point steps) noexcept { return kGridStep * steps; }

/// Returns +1 where a, b, c turn left, -1 right, 0 on one line: exact. Coordinates may be up to 4 kGridLimit.
[[nodiscard]] inline int turn(GridPoint a, GridPoint b, GridPoint c) noexcept {
  // The differences are exact doubles; each product rounds once, and so does their difference.
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

/// Returns the steps nearest to cosine and sine of `degrees` (taken exactly; multiples of 90 give 0 and +-1).
/// The error of either is at most half a step.
/// \pre |degrees| <= 3.6e6 and finite
[[nodiscard]] GridRotation rotation_from_degrees(double degrees) noexcept;
/// Returns an angle in (-180, 180]: the number with the fewest decimals, up to 9, whose rotation_from_degrees
/// is `rotation`. Where there is none, the angle is within 1e-12 of the rotation's.
[[nodiscard]] double degrees_of(GridRotation rotation) noexcept;
/// Returns the nearest steps to a pair of doubles.
/// \pre finite, within [-2, 2]
[[nodiscard]] GridRotation rotation_from_pair(double c, double s) noexcept;
/// Says whether c^2 + s^2 is within 2^-50 of 1. The results of rotation_from_degrees are, and nothing that
/// scales a part by a step is.
[[nodiscard]] bool is_rotation(GridRotation rotation) noexcept;
/// Says whether the direction of `rotation` lies in the counter-clockwise turn from `from` to `to`, ends
/// included; decided exactly. Equal ends are that direction alone.
[[nodiscard]] bool is_between(GridRotation rotation, GridRotation from, GridRotation to) noexcept;

/// Returns the place to which a placement turns a part's vertex. First x is negated when mirrored, then the
/// vertex goes to (c x - s y, s x + c y), each rounded to the nearest step, ties to even. Placing adds a
/// translation to it, which is exact.
/// \pre |p| <= kGridLimit
[[nodiscard]] GridPoint turned(GridPoint p, GridRotation rotation, bool mirrored) noexcept;

}  // namespace lekalo::geom

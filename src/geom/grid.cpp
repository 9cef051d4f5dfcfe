#include "lekalo/geom/grid.hpp"

#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/double_double.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::geom {

namespace {

/// Returns the integer nearest to value / 2^bits, ties to even.
std::int64_t rounded_shift(Int128 value, int bits) noexcept {
  // The shift is arithmetic, so it rounds towards minus infinity.
  const Int128 floor = value >> bits;
  const Int128 rest = value - (floor << bits), half = Int128{1} << (bits - 1);
  const bool up = rest > half || (rest == half && (floor & 1) != 0);
  return static_cast<std::int64_t>(floor + (up ? 1 : 0));
}

/// Returns the integer nearest to the sum of the pair, which is below 2^53.
std::int64_t nearest_integer(DoubleDouble value) noexcept {
  const double whole = std::nearbyint(value.hi);
  // The rest is at most half. The sum of its two parts could be rounded to a half that it is not, so they
  // stay apart.
  const DoubleDouble rest = two_sum(value.hi - whole, value.lo);
  double up = std::nearbyint(rest.hi);
  if (rest.hi == 0.5 && rest.lo > 0) up = 1;
  if (rest.hi == -0.5 && rest.lo < 0) up = -1;
  return static_cast<std::int64_t>(whole) + static_cast<std::int64_t>(up);
}

/// Returns a cosine or sine in the steps of a rotation.
DoubleDouble scaled(DoubleDouble value) noexcept { return {value.hi * 0x1p52, value.lo * 0x1p52}; }

GridPoint direction(GridRotation r) noexcept { return {r.c, r.s}; }

}  // namespace

std::int64_t grid_from_mm(double mm) noexcept {
  return static_cast<std::int64_t>(std::nearbyint(mm * 0x1p20));
}
std::int64_t grid_from_mm_up(double mm) noexcept { return static_cast<std::int64_t>(std::ceil(mm * 0x1p20)); }

GridRotation rotation_from_degrees(double degrees) noexcept {
  // The rest within 45 degrees is exact. It becomes a pair of radians, and sine and cosine of the pair are
  // computed to first order in its low part, which is below 2^-53.
  const double quarters = std::nearbyint(degrees / 90.0);
  const double rest = degrees - quarters * 90.0;
  constexpr DoubleDouble kRadians{0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};
  const DoubleDouble radians = DoubleDouble{rest} * kRadians;
  const SinCosPair at = sincos_double_double(radians.hi);
  const DoubleDouble low{radians.lo};
  const std::int64_t sine = nearest_integer(scaled(at.sine + low * at.cosine));
  const std::int64_t cosine = nearest_integer(scaled(at.cosine - low * at.sine));
  switch (((static_cast<std::int64_t>(quarters) % 4) + 4) % 4) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

double degrees_of(GridRotation rotation) noexcept {
  const double angle =
      direction_angle(static_cast<double>(rotation.c), static_cast<double>(rotation.s)) * kDegreesPerRadian;
  double scale = 1;
  for (int decimals = 0; decimals <= 9; ++decimals, scale *= 10) {
    const double rounded = std::nearbyint(angle * scale) / scale;
    if (rotation_from_degrees(rounded) == rotation) return rounded == -180.0 ? 180.0 : rounded + 0.0;
  }
  return angle <= -180.0 ? 180.0 : angle;
}

GridRotation rotation_from_pair(double c, double s) noexcept {
  return {static_cast<std::int64_t>(std::nearbyint(c * 0x1p52)),
          static_cast<std::int64_t>(std::nearbyint(s * 0x1p52))};
}

bool is_rotation(GridRotation r) noexcept {
  constexpr std::int64_t kMost = GridRotation::kOne + 4;
  if (r.c < -kMost || r.c > kMost || r.s < -kMost || r.s > kMost) return false;
  const Int128 excess = dot(direction(r), direction(r)) - (Int128{1} << 104);
  return excess >= -(Int128{1} << 54) && excess <= (Int128{1} << 54);
}

bool is_between(GridRotation rotation, GridRotation from, GridRotation to) noexcept {
  const GridPoint d = direction(rotation), a = direction(from), b = direction(to);
  const int from_a = sign(cross(a, d)), to_b = sign(cross(d, b)), turn_of = sign(cross(a, b));
  const bool at_a = from_a == 0 && dot(a, d) > 0, at_b = to_b == 0 && dot(b, d) > 0;
  if (at_a || at_b) return true;
  if (turn_of == 0 && dot(a, b) > 0) return false;
  if (turn_of > 0 || (turn_of == 0 && from_a > 0)) return from_a > 0 && to_b > 0;
  if (turn_of == 0) return false;
  // The range is more than half a turn, and the rotation is not in what is left of the turn.
  return from_a > 0 || to_b > 0;
}

GridPoint turned(GridPoint p, GridRotation r, bool mirrored) noexcept {
  const Int128 x = mirrored ? -p.x : p.x, y = p.y;
  return {rounded_shift(r.c * x - r.s * y, 52), rounded_shift(r.s * x + r.c * y, 52)};
}

}  // namespace lekalo::geom

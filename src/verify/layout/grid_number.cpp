#include "grid_number.hpp"

#include <cmath>

#include "verify/number/interval.hpp"

namespace lekalo::verify {
namespace {

constexpr int kStepBits = 20, kRotationBits = 52;

/// Returns the whole number nearest to value 2^bits, ties to even. Scaling by a power of two is exact.
/// \pre the result fits 62 bits
std::int64_t nearest_multiple(double value, int bits) {
  return static_cast<std::int64_t>(std::nearbyint(std::ldexp(value, bits)));
}

/// A direction seen from `from`: the vector turned back by the angle of `from`.
struct Turned {
  Integer along, across;
};
Turned seen_from(GridTurn from, GridTurn d) {
  const Integer c(from.c), s(from.s), x(d.c), y(d.s);
  return {c * x + s * y, c * y - s * x};
}
/// Orders directions within one turn from 0: first the axis itself, then the upper half, then the rest.
int part_of_turn(const Turned& v) {
  if (sgn(v.across) == 0) return sgn(v.along) > 0 ? 0 : 2;
  return sgn(v.across) > 0 ? 1 : 3;
}
bool not_after(const Turned& a, const Turned& b) {
  const int part_a = part_of_turn(a), part_b = part_of_turn(b);
  if (part_a != part_b) return part_a < part_b;
  return sgn(Integer(a.along * b.across - a.across * b.along)) >= 0;
}

/// Returns the whole number nearest to value / 2^52, ties to even.
std::int64_t without_rotation_bits(Wide value) {
  const Wide unit = Wide{1} << kRotationBits;
  Wide floor = value / unit, rest = value % unit;
  if (rest < 0) rest += unit, --floor;
  if (2 * rest > unit || (2 * rest == unit && floor % 2 != 0)) ++floor;
  return static_cast<std::int64_t>(floor);
}

}  // namespace

std::optional<std::int64_t> steps_of(double mm, ToStep how, double most) {
  if (!(std::abs(mm) <= most)) return std::nullopt;
  if (how == ToStep::nearest) return nearest_multiple(mm, kStepBits);
  return static_cast<std::int64_t>(std::ceil(std::ldexp(mm, kStepBits)));
}

std::optional<GridTurn> turn_of_pair(double c, double s) {
  if (!(std::abs(c) <= 2 && std::abs(s) <= 2)) return std::nullopt;
  const GridTurn turn{nearest_multiple(c, kRotationBits), nearest_multiple(s, kRotationBits)};
  const Wide off = Wide{turn.c} * turn.c + Wide{turn.s} * turn.s - (Wide{1} << 2 * kRotationBits);
  const Wide most = Wide{1} << (2 * kRotationBits - 50);
  if (off < -most || off > most) return std::nullopt;
  return turn;
}

GridTurn turn_of_degrees(double degrees) {
  // The loop ends: a rational number of degrees has no cosine half way between two multiples, because where
  // such a cosine is rational it is 0, 1/2 or 1 (Niven). So more digits decide.
  for (Precision precision = 192;; precision *= 2) {
    const Interval angle =
        Interval::exactly(degrees, precision) * Interval::pi(precision) / Interval::exactly(180, precision);
    const Turn turn = turn_by(angle);
    const auto c = nearest_multiple(turn.cosine, kRotationBits),
               s = nearest_multiple(turn.sine, kRotationBits);
    if (c && s) return {*c, *s};
  }
}

bool lies_between(GridTurn turn, GridTurn from, GridTurn to) {
  return not_after(seen_from(from, turn), seen_from(from, to));
}

GridPoint placed(GridPoint p, GridTurn turn, bool mirrored, GridPoint at) {
  const Wide x = mirrored ? -p.x : p.x, y = p.y;
  return {without_rotation_bits(turn.c * x - turn.s * y) + at.x,
          without_rotation_bits(turn.s * x + turn.c * y) + at.y};
}

}  // namespace lekalo::verify

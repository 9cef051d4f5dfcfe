#include "grid_number.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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
/// Says whether the direction is half a turn or more counter-clockwise from the axis.
bool second_half(const Turned& v) { return std::pair{sgn(v.across), sgn(v.along)} < std::pair<int, int>{}; }
bool not_after(const Turned& a, const Turned& b) {
  if (second_half(a) != second_half(b)) return second_half(b);
  return a.along * b.across >= a.across * b.along;
}

/// Returns the whole number nearest to value / 2^52, ties to even.
std::int64_t without_rotation_bits(Wide value) {
  constexpr Wide kBelowHalf = (Wide{1} << (kRotationBits - 1)) - 1;
  const Wide odd = value >> kRotationBits & 1;
  return static_cast<std::int64_t>((value + kBelowHalf + odd) >> kRotationBits);
}

}  // namespace

std::optional<std::int64_t> steps_of(double mm, ToStep how, double most) {
  if (!(std::abs(mm) <= most)) return std::nullopt;
  if (how == ToStep::nearest) return nearest_multiple(mm, kStepBits);
  return static_cast<std::int64_t>(std::ceil(std::ldexp(mm, kStepBits)));
}

std::optional<GridTurn> turn_of_pair(double c, double s) {
  const GridTurn turn{nearest_multiple(c, kRotationBits), nearest_multiple(s, kRotationBits)};
  const Wide off = Wide{turn.c} * turn.c + Wide{turn.s} * turn.s - (Wide{1} << 2 * kRotationBits);
  const Wide most = Wide{1} << (2 * kRotationBits - 50);
  if (std::max(off, -off) > most) return std::nullopt;
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

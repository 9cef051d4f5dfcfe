#include "grid_number.hpp"

#include <gmpxx.h>
#include <mpfr.h>

#include <cmath>
#include <string>

#include "verify/number/interval.hpp"

namespace lekalo::verify {
namespace {

constexpr int kRotationBits = 52;

/// An mpfr_t that frees itself.
class Real {
 public:
  explicit Real(mpfr_prec_t precision) { mpfr_init2(value_, precision); }
  ~Real() { mpfr_clear(value_); }
  Real(const Real&) = delete;
  Real& operator=(const Real&) = delete;
  [[nodiscard]] mpfr_ptr get() { return value_; }

 private:
  mpfr_t value_;
};

/// value 2^bits to a whole number. \pre the result fits 62 bits
std::int64_t scaled_to_whole(mpfr_srcptr value, int bits, mpfr_rnd_t how) {
  Real whole(std::max<mpfr_prec_t>(mpfr_get_prec(value), 64));
  mpfr_mul_2si(whole.get(), value, bits, MPFR_RNDN);  // exact
  mpfr_rint(whole.get(), whole.get(), how);           // RNDN: ties to even
  return mpfr_get_sj(whole.get(), MPFR_RNDN);
}

/// The whole number nearest to every number of the interval times 2^52, if there is one.
std::optional<std::int64_t> nearest_multiple(const Interval& value) {
  const std::int64_t low = scaled_to_whole(value.low(), kRotationBits, MPFR_RNDN);
  if (low != scaled_to_whole(value.high(), kRotationBits, MPFR_RNDN)) return std::nullopt;
  return low;
}

/// Counter-clockwise angle from `from`, as a vector turned back by it.
struct Turned {
  Integer along, across;
};
Turned seen_from(GridTurn from, GridTurn d) {
  const Integer c(from.c), s(from.s), x(d.c), y(d.s);
  return {c * x + s * y, c * y - s * x};
}
/// In [0, 360): 0 on the axis, then the upper half, then the rest.
int part_of_turn(const Turned& v) {
  if (sgn(v.across) == 0) return sgn(v.along) > 0 ? 0 : 2;
  return sgn(v.across) > 0 ? 1 : 3;
}
bool not_after(const Turned& a, const Turned& b) {
  const int part_a = part_of_turn(a), part_b = part_of_turn(b);
  if (part_a != part_b) return part_a < part_b;
  return sgn(Integer(a.along * b.across - a.across * b.along)) >= 0;
}

/// value / 2^52 to the nearest whole number, ties to even.
std::int64_t without_rotation_bits(Wide value) {
  const Wide unit = Wide{1} << kRotationBits;
  Wide floor = value / unit, rest = value % unit;
  if (rest < 0) rest += unit, --floor;
  if (2 * rest > unit || (2 * rest == unit && floor % 2 != 0)) ++floor;
  return static_cast<std::int64_t>(floor);
}

}  // namespace

double nearest_double(std::string_view decimal) {
  Real value(53);
  mpfr_set_str(value.get(), std::string(decimal).c_str(), 10, MPFR_RNDN);
  return mpfr_get_d(value.get(), MPFR_RNDN);
}

std::optional<std::int64_t> steps_of(double mm, ToStep how, double most) {
  if (!(std::abs(mm) <= most)) return std::nullopt;
  Real value(53);
  mpfr_set_d(value.get(), mm, MPFR_RNDN);
  return scaled_to_whole(value.get(), 20, how == ToStep::up ? MPFR_RNDU : MPFR_RNDN);
}

std::optional<GridTurn> turn_of_pair(double c, double s) {
  if (!(std::abs(c) <= 2 && std::abs(s) <= 2)) return std::nullopt;
  Real value(53);
  mpfr_set_d(value.get(), c, MPFR_RNDN);
  GridTurn turn;
  turn.c = scaled_to_whole(value.get(), kRotationBits, MPFR_RNDN);
  mpfr_set_d(value.get(), s, MPFR_RNDN);
  turn.s = scaled_to_whole(value.get(), kRotationBits, MPFR_RNDN);
  const Wide off = Wide{turn.c} * turn.c + Wide{turn.s} * turn.s - (Wide{1} << 2 * kRotationBits);
  const Wide most = Wide{1} << (2 * kRotationBits - 50);
  if (off < -most || off > most) return std::nullopt;
  return turn;
}

GridTurn turn_of_degrees(double degrees) {
  // Half way between two multiples there is no cosine of a rational number of degrees: where such a cosine is
  // rational it is 0, 1/2 or 1 (Niven), so more digits decide in the end.
  for (mpfr_prec_t precision = 192;; precision *= 2) {
    const Interval angle =
        Interval::exactly(degrees, precision) * Interval::pi(precision) / Interval::exactly(180, precision);
    const Turn turn = turn_by(angle);
    const auto c = nearest_multiple(turn.cosine), s = nearest_multiple(turn.sine);
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

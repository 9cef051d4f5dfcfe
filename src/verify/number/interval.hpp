#pragma once

// The header stands before mpfr.h, because mpfr.h declares mpfr_get_sj only then.
#include <cstdint>

#include <mpfr.h>

#include <optional>
#include <string>

#include "exact.hpp"

namespace lekalo::verify {

/// A number of bits of the mantissa.
using Precision = long;
/// This precision suffices for what is compared with a tolerance. Unlike a double it has room for squares of
/// any length.
inline constexpr Precision kRough = 64;

/// A set of reals [low, high] that certainly holds the true value: every operation rounds outwards. The
/// result of an operation has the larger precision of its operands (bits).
class Interval {
 public:
  /// Makes [0, 0].
  explicit Interval(Precision precision);
  Interval(const Integer& value, Precision precision);
  Interval(const Decimal& value, Precision precision);
  Interval(const Interval& other);
  Interval(Interval&& other) noexcept;
  Interval& operator=(Interval other) noexcept;
  ~Interval();

  static Interval pi(Precision precision);
  /// \pre precision is 53 or more
  static Interval exactly(double value, Precision precision);

  [[nodiscard]] Precision precision() const { return mpfr_get_prec(low_); }

  friend Interval operator+(const Interval& a, const Interval& b);
  friend Interval operator-(const Interval& a, const Interval& b);
  friend Interval operator*(const Interval& a, const Interval& b);
  /// \pre b is certainly positive
  friend Interval operator/(const Interval& a, const Interval& b);
  /// Returns the square roots of the part that is not negative; [0, 0] when there is none.
  friend Interval square_root(const Interval& a);
  friend Interval square(const Interval& a);
  friend struct Turn turn_by(const Interval& angle);
  /// Returns an interval that holds min(x, y) for every x in a, y in b.
  friend Interval minimum(const Interval& a, const Interval& b);
  friend Interval maximum(const Interval& a, const Interval& b);
  /// Returns an interval that holds both.
  friend Interval hull(const Interval& a, const Interval& b);

  /// Returns the least b >= 0 with |low| and |high| below 2^b. Where both ends are small and not both are 0,
  /// b may be below 0.
  friend long bits_of(const Interval& a);
  /// Returns the whole number that is nearest (ties to even) to every number of the interval times 2^bits, if
  /// there is one such number.
  /// \pre it fits 62 bits, and the precision is as large
  friend std::optional<std::int64_t> nearest_multiple(const Interval& a, int bits);

  friend bool certainly_zero(const Interval& a) {
    return mpfr_zero_p(a.low_) != 0 && mpfr_zero_p(a.high_) != 0;
  }
  friend bool certainly_positive(const Interval& a) { return mpfr_sgn(a.low_) > 0; }
  friend bool certainly_negative(const Interval& a) { return mpfr_sgn(a.high_) < 0; }
  friend bool certainly_not_above(const Interval& a, const Interval& b) {
    return mpfr_lessequal_p(a.high_, b.low_) != 0;
  }
  friend bool certainly_above(const Interval& a, const Interval& b) {
    return mpfr_greater_p(a.low_, b.high_) != 0;
  }

  /// Returns 30 significant decimal digits at or below low; high_text() gives those at or above high.
  [[nodiscard]] std::string low_text() const;
  [[nodiscard]] std::string high_text() const;
  /// Returns a double at or above high / 2^scale; low_double() gives one at or below low / 2^scale.
  [[nodiscard]] double high_double(long scale = 0) const;
  [[nodiscard]] double low_double(long scale = 0) const;
  /// Returns low / 2^scale, within 2^-52 of it relatively.
  [[nodiscard]] double nearly_low(long scale) const;

 private:
  mpfr_t low_, high_;
};

struct Turn {
  Interval cosine, sine;
};

/// Returns exactly (1, 0) for the angle 0, the only written angle at which either is rational.
[[nodiscard]] Turn turn_by(const Interval& angle);

/// The same for an angle in degrees: exact for multiples of 90.
[[nodiscard]] Turn turn_by_degrees(const Fraction& degrees);

/// The doubles nearest to cosine and sine of an angle.
struct RoundedTurn {
  double cosine, sine;
};
/// \pre finite
[[nodiscard]] RoundedTurn rounded_turn(double angle);

}  // namespace lekalo::verify

#pragma once

#include <cstdint>  // before mpfr.h, which declares mpfr_get_sj only then

#include <mpfr.h>

#include <optional>
#include <string>

#include "exact.hpp"

namespace lekalo::verify {

/// Bits of the mantissa.
using Precision = long;
/// Enough for what is compared with a tolerance; unlike a double it has room for squares of any length.
inline constexpr Precision kRough = 64;

/// A set of reals [low, high] that certainly holds the true value: every operation rounds outwards. The
/// result of an operation has the larger precision of its operands (bits).
class Interval {
 public:
  explicit Interval(Precision precision);  ///< [0, 0]
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
  /// The square roots of the part that is not negative; [0, 0] when there is none.
  friend Interval square_root(const Interval& a);
  friend Interval square(const Interval& a);
  friend struct Turn turn_by(const Interval& angle);
  /// Holds min(x, y) for every x in a, y in b.
  friend Interval minimum(const Interval& a, const Interval& b);
  friend Interval maximum(const Interval& a, const Interval& b);
  /// Holds both.
  friend Interval hull(const Interval& a, const Interval& b);

  /// The least b >= 0, or below 0 when both ends are that small and not 0, with |low| and |high| below 2^b.
  friend long bits_of(const Interval& a);
  /// The whole number nearest (ties to even) to every number of the interval times 2^bits, if it is one
  /// number. \pre it fits 62 bits
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

  /// 30 significant decimal digits, at or below low, at or above high.
  [[nodiscard]] std::string low_text() const;
  [[nodiscard]] std::string high_text() const;
  /// A double at or above high / 2^scale, at or below low / 2^scale.
  [[nodiscard]] double high_double(long scale = 0) const;
  [[nodiscard]] double low_double(long scale = 0) const;
  /// low / 2^scale, within 2^-52 of it relatively.
  [[nodiscard]] double nearly_low(long scale) const;

 private:
  mpfr_t low_, high_;
};

struct Turn {
  Interval cosine, sine;
};

/// Exactly (1, 0) for the angle 0, the only written angle where either is rational.
[[nodiscard]] Turn turn_by(const Interval& angle);

/// The doubles nearest to cosine and sine of an angle.
struct RoundedTurn {
  double cosine = 1, sine = 0;
};
/// \pre finite
[[nodiscard]] RoundedTurn rounded_turn(double angle);

}  // namespace lekalo::verify

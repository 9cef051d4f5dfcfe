#pragma once

#include <mpfr.h>

#include <string>

#include "exact.hpp"

namespace lekalo::verify {

/// A set of reals [low, high] that certainly holds the true value: every operation rounds outwards. The
/// result of an operation has the larger precision of its operands (bits).
class Interval {
 public:
  explicit Interval(mpfr_prec_t precision);  ///< [0, 0]
  Interval(const Integer& value, mpfr_prec_t precision);
  Interval(const Decimal& value, mpfr_prec_t precision);
  Interval(const Interval& other);
  Interval(Interval&& other) noexcept;
  Interval& operator=(Interval other) noexcept;
  ~Interval();

  static Interval pi(mpfr_prec_t precision);
  /// \pre precision is 53 or more
  static Interval exactly(double value, mpfr_prec_t precision);

  [[nodiscard]] mpfr_prec_t precision() const { return mpfr_get_prec(low_); }
  [[nodiscard]] mpfr_srcptr low() const { return low_; }
  [[nodiscard]] mpfr_srcptr high() const { return high_; }

  friend Interval operator+(const Interval& a, const Interval& b);
  friend Interval operator-(const Interval& a, const Interval& b);
  friend Interval operator*(const Interval& a, const Interval& b);
  /// \pre b is certainly positive
  friend Interval operator/(const Interval& a, const Interval& b);
  /// Of the part that is not negative; [0, 0] when there is none.
  friend Interval square_root(const Interval& a);
  friend Interval square(const Interval& a);
  friend struct Turn turn_by(const Interval& angle);
  /// Holds min(x, y) for every x in a, y in b.
  friend Interval minimum(const Interval& a, const Interval& b);
  friend Interval maximum(const Interval& a, const Interval& b);
  /// Holds both.
  friend Interval hull(const Interval& a, const Interval& b);

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

 private:
  mpfr_t low_, high_;
};

struct Turn {
  Interval cosine, sine;
};

/// Exactly (1, 0) for the angle 0, the only written angle where either is rational.
[[nodiscard]] Turn turn_by(const Interval& angle);

}  // namespace lekalo::verify

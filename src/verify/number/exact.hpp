#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/stop.hpp"

namespace lekalo::verify {

/// Exact numbers of the checker. A written decimal is digits * 10^exponent; all lengths of one verification
/// are brought to one exponent and are plain integers from there on, so cross products and signs are exact.
///
/// This header, interval.hpp and their two sources are the only files of the checker that know GMP and MPFR.
/// A target without them gives Integer and Fraction the same operators (arithmetic, shifts, comparisons, sgn,
/// abs, cmp, conversion from numbers) and implements the functions declared here anew. The types stand in the
/// open because a number behind a pointer of its own would cost an allocation more.
using Integer = mpz_class;
using Fraction = mpq_class;

struct Decimal {
  Integer digits;  ///< 0, or not a multiple of 10
  long exponent = 0;
};

/// Parses [+-] digits [. digits] [e [+-] digits] with at least one digit before the e. Returns nothing for
/// any other text, and for numbers of more than limits::kMostDigits or limits::kMostPlaces.
[[nodiscard]] std::optional<Decimal> parse_decimal(std::string_view text);

/// Error messages say with these words which numbers parse_decimal accepts.
[[nodiscard]] std::string decimal_rule();

/// Returns the text for a message, cut when it is long.
[[nodiscard]] std::string excerpt(std::string_view text);

[[nodiscard]] Integer power_of_ten(unsigned long exponent);

[[nodiscard]] inline bool is_even(const Integer& value) { return mpz_even_p(value.get_mpz_t()) != 0; }
/// \pre value fits a long
[[nodiscard]] inline long to_long(const Integer& value) { return value.get_si(); }

/// Returns the largest whole number whose square is not above the value. \pre value >= 0
[[nodiscard]] inline Integer whole_root(const Integer& value) { return sqrt(value); }

/// Returns the number of bits of |value|, which is 1 for 0.
[[nodiscard]] inline long bits_of(const Integer& value) {
  return static_cast<long>(mpz_sizeinbase(value.get_mpz_t(), 2));
}
/// Returns the number of decimal digits of |value|, or one more.
[[nodiscard]] inline long digits_of(const Integer& value) {
  return static_cast<long>(mpz_sizeinbase(value.get_mpz_t(), 10));
}

/// Returns value / 2^scale, cut towards zero by less than one step of a double.
[[nodiscard]] inline double scaled_down(const Integer& value, long scale) {
  long exponent{};
  const double digits = mpz_get_d_2exp(&exponent, value.get_mpz_t());
  return std::scalbln(digits, exponent - scale);
}
/// Returns the value, cut towards zero by less than one step of a double.
[[nodiscard]] inline double cut_to_double(const Fraction& value) { return value.get_d(); }

/// Returns value / 10^exponent.
/// \pre exponent <= value.exponent or value is 0.
[[nodiscard]] Integer in_units(const Decimal& value, long exponent);

[[nodiscard]] Fraction to_fraction(const Decimal& value);

/// Returns the sign of a - b.
[[nodiscard]] int compare(const Decimal& a, const Decimal& b);
[[nodiscard]] Decimal operator-(const Decimal& a, const Decimal& b);

/// Returns the bits that a number needs before its binary point, and a few more; 0 for small ones. An angle
/// costs these bits beyond the precision that is wanted.
[[nodiscard]] long angle_bits(const Decimal& value);

/// Returns the decimal that is exactly the double.
[[nodiscard]] Decimal exactly(double value);

/// The decimal digits / power, as most are written.
struct SmallDecimal {
  long digits = 0;   ///< less than 10^18
  double power = 1;  ///< 10^0 to 10^22, which doubles hold exactly
  /// Says whether a double holds the digits, too.
  [[nodiscard]] bool is_double() const { return std::abs(digits) <= 1L << 53; }
};
/// Returns nothing for a decimal that needs more digits or places than that.
[[nodiscard]] std::optional<SmallDecimal> small(const Decimal& value);

/// Returns the nearest double.
[[nodiscard]] double approximate(const Decimal& value);

struct Point {
  Integer x, y;
};
using Ring = std::vector<Point>;

[[nodiscard]] inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] inline bool operator==(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y; }
[[nodiscard]] inline Integer cross(const Point& a, const Point& b) {
  ask();  // whatever the checker is about, crosses are most of it
  return a.x * b.y - a.y * b.x;
}
[[nodiscard]] inline Integer dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }

}  // namespace lekalo::verify

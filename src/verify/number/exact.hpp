#pragma once

#include <gmpxx.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lekalo::verify {

/// Exact numbers of the checker. A written decimal is digits * 10^exponent; all lengths of one verification
/// are brought to one exponent and are plain integers from there on, so cross products and signs are exact.
using Integer = mpz_class;

struct Decimal {
  Integer digits;  ///< 0, or not a multiple of 10
  long exponent = 0;
};

/// A number may have this many digits, and its first digit may stand this many places from the decimal point.
/// Every double has a shortest form well inside; what lies outside would only cost memory.
inline constexpr std::size_t kMaxDigits = 800;
inline constexpr long kMaxMagnitude = 400;

/// [+-] digits [. digits] [e [+-] digits], at least one digit before the e; nothing for any other text, and
/// for numbers beyond the limits above.
[[nodiscard]] std::optional<Decimal> parse_decimal(std::string_view text);

/// What parse_decimal accepts, for error messages.
inline constexpr const char* kDecimalRule = "a decimal number of at most 800 digits between 1e-400 and 1e400";

/// For messages: the text, cut when it is long.
[[nodiscard]] std::string excerpt(std::string_view text);

[[nodiscard]] Integer power_of_ten(unsigned long exponent);

/// value / 10^exponent. \pre exponent <= value.exponent or value is 0.
[[nodiscard]] Integer in_units(const Decimal& value, long exponent);

/// Sign of a - b.
[[nodiscard]] int compare(const Decimal& a, const Decimal& b);
[[nodiscard]] Decimal operator-(const Decimal& a, const Decimal& b);

/// Bits that a number needs before its binary point, and a few more; 0 for small ones. What an angle costs
/// beyond the precision that is wanted.
[[nodiscard]] long angle_bits(const Decimal& value);

/// The nearest double; for messages and hints only.
[[nodiscard]] double approximate(const Decimal& value);

struct Point {
  Integer x, y;
};
using Ring = std::vector<Point>;

[[nodiscard]] inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] inline bool operator==(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y; }
[[nodiscard]] inline Integer cross(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline Integer dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }

}  // namespace lekalo::verify

#include "exact.hpp"

#include <cmath>

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "lekalo/base/assert.hpp"
#include "lekalo/base/limits.hpp"

namespace lekalo::verify {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes the digits at the front of `text`, appends them to `digits`, and returns how many there were.
std::size_t take_digits(std::string_view& text, std::string& digits) {
  std::size_t count = 0;
  while (count < text.size() && is_digit(text[count])) ++count;
  digits.append(text.substr(0, count));
  text.remove_prefix(count);
  return count;
}

bool take_sign(std::string_view& text) {
  const bool negative = !text.empty() && text.front() == '-';
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  return negative;
}

/// Parses e [+-] digits, which must be the whole of `text`. A value beyond 10^15 stays there: no text has so
/// many decimals that the number would be in range again.
std::optional<long> parse_exponent(std::string_view text) {
  if (text.empty()) return 0;
  if (text.front() != 'e' && text.front() != 'E') return std::nullopt;
  text.remove_prefix(1);
  const bool negative = take_sign(text);
  if (text.empty() || !std::all_of(text.begin(), text.end(), is_digit)) return std::nullopt;
  long value = 0;
  for (const char c : text) value = std::min(value * 10 + (c - '0'), 1'000'000'000'000'000L);
  return negative ? -value : value;
}

}  // namespace

std::optional<Decimal> parse_decimal(std::string_view text) {
  const bool negative = take_sign(text);
  std::string digits;
  std::size_t count = take_digits(text, digits);
  std::size_t decimals = 0;
  if (!text.empty() && text.front() == '.') {
    text.remove_prefix(1);
    decimals = take_digits(text, digits);
    count += decimals;
  }
  const std::optional<long> written = parse_exponent(text);
  if (count == 0 || !written) return std::nullopt;

  const std::size_t first = digits.find_first_not_of('0');
  if (first == std::string::npos) return Decimal{};
  const std::size_t last = digits.find_last_not_of('0');
  const long exponent = *written - static_cast<long>(decimals) + static_cast<long>(digits.size() - 1 - last);
  digits.erase(last + 1).erase(0, first);
  const long magnitude = exponent + static_cast<long>(digits.size());
  // The number lies in [10^(magnitude - 1), 10^magnitude).
  constexpr long kMost = limits::kMostPlaces;
  if (digits.size() > limits::kMostDigits || magnitude <= -kMost || magnitude > kMost) return std::nullopt;

  // A long is made without the text's way through numbers of any length.
  long few{};
  const bool fits = std::from_chars(digits.data(), digits.data() + digits.size(), few).ec == std::errc{};
  Decimal value{fits ? Integer(few) : Integer(digits, 10), exponent};
  if (negative) value.digits = -value.digits;
  return value;
}

std::string decimal_rule() {
  return fmt::format("a decimal number of at most {} digits, 0 or between 1e-{} and 1e{}",
                     limits::kMostDigits, limits::kMostPlaces, limits::kMostPlaces);
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string words(text.substr(0, kLongest));
  std::replace_if(
      words.begin(), words.end(), [](unsigned char c) { return c < 0x20 || c >= 0x7f; }, '?');
  return text.size() > kLongest ? words + "..." : words;
}

Integer power_of_ten(unsigned long exponent) {
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, exponent);
  return power;
}

Integer in_units(const Decimal& value, long exponent) {
  if (value.digits == 0) return 0;
  LEKALO_ASSERT(exponent <= value.exponent);
  const auto zeros = static_cast<unsigned long>(value.exponent - exponent);
  if (zeros > 18) return value.digits * power_of_ten(zeros);
  unsigned long power = 1;
  for (unsigned long k = 0; k < zeros; ++k) power *= 10;
  return value.digits * power;
}

Fraction to_fraction(const Decimal& value) {
  const auto tens = [](long zeros) { return power_of_ten(static_cast<unsigned long>(std::max(zeros, 0L))); };
  Fraction made(value.digits * tens(value.exponent), tens(-value.exponent));
  made.canonicalize();
  return made;
}

Decimal operator-(const Decimal& a, const Decimal& b) {
  if (b.digits == 0) return a;
  if (a.digits == 0) return {-b.digits, b.exponent};
  const long exponent = std::min(a.exponent, b.exponent);
  return {in_units(a, exponent) - in_units(b, exponent), exponent};
}

int compare(const Decimal& a, const Decimal& b) { return sgn((a - b).digits); }

long angle_bits(const Decimal& value) {
  return value.digits == 0 ? 0 : 4 * std::max(0L, digits_of(value.digits) + value.exponent);
}

Decimal exactly(double value) {
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(value, &exponent), 53);
  Decimal made{Integer(mantissa), 0};
  exponent -= 53;
  made.digits <<= static_cast<unsigned long>(std::max(exponent, 0));
  // Dividing m by 2 makes it 5 m / 10.
  for (; exponent < 0; ++exponent) {
    if (is_even(made.digits)) {
      made.digits /= 2;
    } else {
      made.digits *= 5, --made.exponent;
    }
  }
  return made;
}

std::optional<SmallDecimal> small(const Decimal& value) {
  constexpr long kMost = 1'000'000'000'000'000'000;
  if (value.digits >= kMost || value.digits <= -kMost || value.exponent < -22) return std::nullopt;
  long digits = to_long(value.digits), exponent = value.exponent;
  for (; exponent > 0; --exponent) {
    if (std::abs(digits) >= kMost / 10) return std::nullopt;
    digits *= 10;
  }
  double power = 1;
  for (; exponent < 0; ++exponent) power *= 10;
  return SmallDecimal{digits, power};
}

double approximate(const Decimal& value) {
  // The quotient of two doubles is rounded to the nearest.
  if (const auto few = small(value); few && few->is_double())
    return static_cast<double>(few->digits) / few->power;
  // Digits, e and an exponent, as from_chars reads them.
  std::string text =
      value.digits.fits_slong_p() ? std::to_string(to_long(value.digits)) : value.digits.get_str();
  text += 'e';
  text += std::to_string(value.exponent);
  double nearest = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), nearest).ec == std::errc{}) return nearest;
  // The library says on which side of the doubles a number beyond them is.
  return std::strtod(text.c_str(), nullptr);
}

}  // namespace lekalo::verify

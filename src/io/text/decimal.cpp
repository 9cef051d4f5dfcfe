#include "decimal.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "lekalo/base/assert.hpp"
#include "lekalo/base/double_of_text.hpp"
#include "lekalo/geom/double_double.hpp"

namespace lekalo::io {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// A decimal as digits times 10^exponent, without leading and trailing zeros; zero has no digits.
struct Decimal {
  bool negative = false;
  std::string digits;
  std::int64_t exponent = 0;
};

/// Reads the digits after "e"; the value saturates far outside of every range that matters.
std::optional<std::int64_t> read_exponent(std::string_view text) {
  const bool negative = !text.empty() && text.front() == '-';
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  if (text.empty()) return std::nullopt;
  std::int64_t value = 0;
  for (const char c : text) {
    if (!is_digit(c)) return std::nullopt;
    value = std::min<std::int64_t>(value * 10 + (c - '0'), std::int64_t{1} << 50);
  }
  return negative ? -value : value;
}

std::optional<Decimal> read_decimal(std::string_view text) {
  Decimal decimal;
  std::size_t at = 0;
  if (at < text.size() && (text[at] == '-' || text[at] == '+')) decimal.negative = text[at++] == '-';
  bool after_point = false, any_digit = false;
  for (; at < text.size() && (is_digit(text[at]) || (text[at] == '.' && !after_point)); ++at) {
    if (text[at] == '.') {
      after_point = true;
      continue;
    }
    any_digit = true;
    if (after_point) --decimal.exponent;
    if (!decimal.digits.empty() || text[at] != '0') decimal.digits += text[at];
  }
  if (!any_digit) return std::nullopt;
  if (at < text.size()) {
    if (lower(text[at]) != 'e') return std::nullopt;
    const auto exponent = read_exponent(text.substr(at + 1));
    if (!exponent) return std::nullopt;
    decimal.exponent += *exponent;
  }
  while (!decimal.digits.empty() && decimal.digits.back() == '0') {
    decimal.digits.pop_back();
    ++decimal.exponent;
  }
  return decimal;
}

/// A number in [10^(n - 1), 10^n) has n places before its point.
/// \pre not 0
std::int64_t places_of(const Decimal& decimal) {
  return static_cast<std::int64_t>(decimal.digits.size()) + decimal.exponent;
}

std::optional<NumberFault> fault_of(const Decimal& decimal) {
  if (decimal.digits.empty()) return std::nullopt;
  if (places_of(decimal) <= -limits::kMostPlaces) return NumberFault::too_small;
  if (decimal.digits.size() > limits::kMostDigits) return NumberFault::too_long;
  return std::nullopt;
}

/// Multiplies exactly, digit after digit as by hand, and moves the point.
void multiply(Decimal& decimal, DecimalFactor factor) {
  std::uint64_t carry = 0;
  for (auto digit = decimal.digits.rbegin(); digit != decimal.digits.rend(); ++digit) {
    carry += std::uint64_t{factor.multiplier} * static_cast<unsigned>(*digit - '0');
    *digit = static_cast<char>('0' + carry % 10);
    carry /= 10;
  }
  if (carry > 0) decimal.digits.insert(0, std::to_string(carry));
  decimal.exponent += factor.exponent;
  while (!decimal.digits.empty() && decimal.digits.back() == '0') {
    decimal.digits.pop_back();
    ++decimal.exponent;
  }
}

constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                   1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// Reads the form that nearly all numbers of drawings have: no exponent, and an integer below 2^53 over a
/// power of ten that is a double, so that one division rounds as wanted. Nothing for others and for numbers
/// out of range.
std::optional<Millimetres> read_short(std::string_view text, DecimalFactor factor) {
  const bool negative = !text.empty() && text.front() == '-';
  if (negative || (!text.empty() && text.front() == '+')) text.remove_prefix(1);
  if (text.empty() || text.size() > 19) return std::nullopt;
  std::uint64_t mantissa = 0;
  std::size_t places = 0, digits = 0;
  bool after_point = false;
  for (const char c : text) {
    if (is_digit(c)) {
      mantissa = mantissa * 10 + static_cast<std::uint64_t>(c - '0');
      ++digits;
      if (after_point) ++places;
    } else if (c == '.' && !after_point) {
      after_point = true;
    } else {
      return std::nullopt;
    }
  }
  constexpr std::uint64_t kLimit = std::uint64_t{1} << 53;
  if (digits == 0 || mantissa > kLimit / factor.multiplier) return std::nullopt;
  auto whole = static_cast<double>(mantissa * factor.multiplier);
  const int exponent = factor.exponent - static_cast<int>(places);
  if (exponent > 0) whole *= kPowersOfTen[exponent];  // exact, or too large
  const double power = exponent < 0 ? kPowersOfTen[std::min(-exponent, 22)] : 1;
  if (-exponent > 22 || whole > kLargestMillimetres * power || (exponent > 0 && whole >= 0x1p53))
    return std::nullopt;
  Millimetres result{whole / power, 0};
  const geom::DoubleDouble product = geom::two_product(result.value, power);
  if (product.hi != whole || product.lo != 0) result.error = std::ldexp(1.0, std::ilogb(result.value) - 53);
  if (negative && mantissa != 0) result.value = -result.value;
  return result;
}

/// True only when the decimal is a double: an odd number below 2^53 times a power of two.
/// \pre its magnitude is about kLargestMillimetres at most, so an exponent above 0 is small
bool is_exact_double(const Decimal& decimal) {
  if (decimal.digits.size() > 19)
    return false;  // may be one; the caller's bound then is merely not the smallest
  std::uint64_t odd = 0;
  for (const char c : decimal.digits) odd = odd * 10 + static_cast<std::uint64_t>(c - '0');
  for (std::int64_t e = decimal.exponent; e > 0; --e) odd *= 5;
  for (std::int64_t e = decimal.exponent; e < 0; ++e) {
    if (odd % 5 != 0) return false;
    odd /= 5;
  }
  while (odd % 2 == 0 && odd != 0) odd /= 2;
  return odd < (std::uint64_t{1} << 53);
}

/// The nearest double, for magnitudes far from overflow and underflow.
double nearest_double(const Decimal& decimal) {
  const auto value =
      double_of_text(fmt::format("{}{}e{}", decimal.negative ? "-" : "", decimal.digits, decimal.exponent));
  LEKALO_ASSERT(value);
  return *value;
}

}  // namespace

double value_of(DecimalFactor factor) noexcept {
  const double power = kPowersOfTen[std::abs(factor.exponent)];
  return factor.exponent < 0 ? factor.multiplier / power : factor.multiplier * power;
}

tl::expected<Millimetres, NumberFault> scaled_millimetres(double value, double scale) noexcept {
  const double scaled = value * scale;
  if (!(std::abs(scaled) <= kLargestMillimetres)) return tl::unexpected(NumberFault::too_large);
  if (value == 0) return Millimetres{};
  if (std::abs(scaled) < kSmallestMillimetres) return Millimetres{0, kSmallestMillimetres};
  // The scale is within 2^-53 of its size of the double, the product rounds once more.
  return Millimetres{scaled, scale == 1 ? 0 : std::abs(scaled) * 0x1p-51};
}

std::string beyond_millimetres(double value) {
  return fmt::format("{} is not a finite number up to {:g} mm", value, kLargestMillimetres);
}

bool is_number(std::string_view text) { return read_decimal(text).has_value(); }

std::optional<NumberFault> beyond_limits(std::string_view text) {
  // Nearly all numbers are so short that they cannot be.
  constexpr std::size_t kShort = 300, kShortExponent = 4;
  if (text.size() <= kShort &&
      text.size() - std::min(text.find_first_of("eE"), text.size()) <= kShortExponent)
    return std::nullopt;
  const auto decimal = read_decimal(text);
  return decimal ? fault_of(*decimal) : std::nullopt;
}

bool is_not_finite(std::string_view text) {
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  std::string name(text.substr(0, 9));
  std::transform(name.begin(), name.end(), name.begin(), lower);
  return name == "nan" || name == "inf" || name == "infinity";
}

tl::expected<Millimetres, NumberFault> read_millimetres(std::string_view text, DecimalFactor factor) {
  if (const auto result = read_short(text, factor)) return *result;
  auto decimal = read_decimal(text);
  if (!decimal) {
    return tl::unexpected(is_not_finite(text) ? NumberFault::not_finite : NumberFault::not_a_number);
  }
  if (decimal->digits.empty()) return Millimetres{};
  if (const auto fault = fault_of(*decimal)) return tl::unexpected(*fault);
  multiply(*decimal, factor);
  const std::int64_t places = places_of(*decimal);
  if (places > 10) return tl::unexpected(NumberFault::too_large);
  if (places <= -100) return Millimetres{0, kSmallestMillimetres};
  Millimetres result{nearest_double(*decimal), 0};
  if (std::abs(result.value) > kLargestMillimetres) return tl::unexpected(NumberFault::too_large);
  // Half a unit in the last place of 2^e .. 2^(e+1) is 2^(e - 53).
  if (!is_exact_double(*decimal)) result.error = std::ldexp(1.0, std::ilogb(result.value) - 53);
  return result;
}

std::string number_sentence(NumberFault fault, std::string_view text) {
  switch (fault) {
    case NumberFault::not_a_number:
      return fmt::format("{} is not a number", excerpt(text));
    case NumberFault::not_finite:
      return fmt::format("{} is not a finite number", excerpt(text));
    case NumberFault::too_large:
      return fmt::format("{} is out of range: coordinates go up to {:g} mm", excerpt(text),
                         kLargestMillimetres);
    case NumberFault::too_small:
      return fmt::format("{} is out of range: a number is 0 or at least 1e-{}", excerpt(text),
                         limits::kMostPlaces);
    case NumberFault::too_long:
      return fmt::format("{} is too long: a number has at most {} digits", excerpt(text),
                         limits::kMostDigits);
  }
  return {};
}

}  // namespace lekalo::io

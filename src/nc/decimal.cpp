#include "lekalo/nc/decimal.hpp"

#include <algorithm>
#include <cstddef>
#include "letters.hpp"

namespace lekalo::nc {
namespace {

constexpr Wide power_of_ten(int exponent) noexcept {
  Wide power = 1;
  for (int k = 0; k < exponent; ++k) power *= 10;
  return power;
}

}  // namespace

std::optional<std::int64_t> Decimal::whole() const noexcept {
  const auto scale = static_cast<std::int64_t>(power_of_ten(std::min(decimals, kMaxDigits)));
  if (digits % scale != 0) return std::nullopt;
  return digits / scale;
}

ParsedDecimal parse_decimal(std::string_view text) noexcept {
  std::size_t at = 0;
  const bool negative = !text.empty() && text[0] == '-';
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) ++at;

  Decimal value;
  bool any_digit = false, point = false, too_long = false;
  int significant = 0;
  for (; at < text.size(); ++at) {
    if (text[at] == '.' && !point) {
      point = true;
    } else if (is_digit(text[at])) {
      any_digit = true;
      if (significant > 0 || text[at] != '0') ++significant;
      if (point) ++value.decimals;
      too_long = too_long || significant > kMaxDigits || value.decimals > kMaxDigits;
      if (!too_long) value.digits = 10 * value.digits + (text[at] - '0');
    } else {
      return {std::nullopt, DecimalFault::malformed};
    }
  }
  if (!any_digit) return {std::nullopt, DecimalFault::malformed};
  if (too_long) return {std::nullopt, DecimalFault::too_long};
  if (negative) value.digits = -value.digits;
  return {value, DecimalFault::malformed};
}

Grains quantum(LengthUnit unit, int decimals) noexcept {
  // An inch is 254 tenths of a millimetre: one place fewer is left for it.
  return unit == LengthUnit::inch ? 254 * power_of_ten(kMaxDecimals - decimals)
                                  : power_of_ten(kMaxDecimals + 1 - decimals);
}

Grains to_grains(Decimal value, LengthUnit unit) noexcept {
  return value.digits * quantum(unit, value.decimals);
}

std::string format_decimal(Wide count, int decimals) {
  const bool negative = count < 0;
  if (negative) count = -count;
  std::string backwards;
  for (int place = 0; count != 0 || place <= decimals; ++place) {
    if (place == decimals && decimals > 0) backwards += '.';
    backwards += static_cast<char>('0' + static_cast<int>(count % 10));
    count /= 10;
  }
  if (negative) backwards += '-';
  return {backwards.rbegin(), backwards.rend()};
}

}  // namespace lekalo::nc

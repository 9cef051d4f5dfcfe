#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "lekalo/base/units.hpp"

namespace lekalo::nc {

/// Numbers of an NC program are kept as the exact decimals they are written as, so that "the same point" is a
/// question of equality and not of a tolerance.

/// GNU and Clang have this type. Its 128 bits hold every coordinate in grains.
__extension__ typedef __int128 Wide;

/// A coordinate in grains of 1e-18 mm: any decimal fraction of a millimetre or an inch with up to
/// kMaxDecimals digits is a whole number of grains.
using Grains = Wide;
inline constexpr double kGrainsPerMillimetre = 1e18;
inline constexpr int kMaxDecimals = 17;
inline constexpr int kMaxDigits = 18;

/// `digits * 10^-decimals`, with as many decimals as were written; |digits| < 10^kMaxDigits.
struct Decimal {
  std::int64_t digits = 0;
  int decimals = 0;

  /// The value where it is a whole number.
  [[nodiscard]] std::optional<std::int64_t> whole() const noexcept;
};

enum class DecimalFault { malformed, too_long };

struct ParsedDecimal {
  std::optional<Decimal> value;
  DecimalFault fault = DecimalFault::malformed;  ///< the reason why there is no value
};

/// Reads `[+-] digits [. digits]`, at least one digit; no blanks, no exponent.
[[nodiscard]] ParsedDecimal parse_decimal(std::string_view text) noexcept;

/// The length that the decimal means; \pre decimals <= kMaxDecimals.
[[nodiscard]] Grains to_grains(Decimal value, LengthUnit unit) noexcept;

/// Grains in one unit of the last of `decimals` places; \pre 0 <= decimals <= kMaxDecimals.
[[nodiscard]] Grains quantum(LengthUnit unit, int decimals) noexcept;

/// `count * 10^-decimals` with exactly that many decimals; zero has no sign.
[[nodiscard]] std::string format_decimal(Wide count, int decimals);

}  // namespace lekalo::nc

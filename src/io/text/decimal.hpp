#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "lekalo/base/limits.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/io/text/excerpt.hpp"

namespace lekalo::io {

/// The largest magnitude of a coordinate in a file, mm.
inline constexpr double kLargestMillimetres = limits::kLargestCoordinate;
/// A magnitude below this, mm, is read as 0 with the error of this, because the geometry predicates are not
/// exact below it (geom/predicates.hpp).
inline constexpr double kSmallestMillimetres = limits::kSmallestCoordinate;

/// A decimal number of a file in millimetres (inches times exactly 25.4), as the double nearest to it.
struct Millimetres {
  double value = 0;
  double error = 0;  ///< |value - decimal| is at most this; 0 only where the two are proved equal
};

enum class NumberFault {
  not_a_number,
  not_finite,
  too_large,  ///< beyond kLargestMillimetres
  too_small,  ///< nearer to 0 than limits::kMostPlaces allow, but not 0
  too_long,   ///< more than limits::kMostDigits
};

/// The number of millimetres in a unit of length: multiplier times 10^exponent. It is {1, 0} for numbers that
/// are no lengths.
struct DecimalFactor {
  unsigned multiplier = 1;  ///< at most 10^8
  int exponent = 0;         ///< from -15 to 15
};
[[nodiscard]] constexpr DecimalFactor decimal_factor(LengthUnit unit) noexcept {
  return unit == LengthUnit::inch ? DecimalFactor{254, -1} : DecimalFactor{};
}

/// The nearest double of a factor; \pre its exponent is at most 22 either way.
[[nodiscard]] double value_of(DecimalFactor factor) noexcept;

/// Scales a double of a binary file; one of more than kLargestMillimetres, an infinity and NaN are too large.
/// \param scale  value_of its unit
[[nodiscard]] tl::expected<Millimetres, NumberFault> scaled_millimetres(double value, double scale) noexcept;
/// Returns a sentence about what is wrong with a number that scaled_millimetres does not take.
[[nodiscard]] std::string beyond_millimetres(double value);

/// Reads a number of the grammar [+-] digits [. digits] [e|E [+-] digits], with at least one digit before the
/// exponent.
[[nodiscard]] tl::expected<Millimetres, NumberFault> read_millimetres(std::string_view text,
                                                                      DecimalFactor factor);
[[nodiscard]] inline tl::expected<Millimetres, NumberFault> read_millimetres(std::string_view text,
                                                                             LengthUnit unit) {
  return read_millimetres(text, decimal_factor(unit));
}

/// Says whether the text is a number of that grammar.
[[nodiscard]] bool is_number(std::string_view text);
/// The fault too_small or too_long of a number that nobody reads, whatever it stands for; nothing for others
/// and for texts that are no numbers.
[[nodiscard]] std::optional<NumberFault> beyond_limits(std::string_view text);
/// Says whether the text is nan, inf or infinity, with or without a sign, in upper or lower case.
[[nodiscard]] bool is_not_finite(std::string_view text);

/// Returns a sentence about what is wrong with a number: "'abc' is not a number".
[[nodiscard]] std::string number_sentence(NumberFault fault, std::string_view text);

}  // namespace lekalo::io

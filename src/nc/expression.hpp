#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace lekalo::nc {

/// The variables that a program has set so far, by number or by name. Nothing else is known: what the control
/// or another program has put into one cannot be read here.
using Variables = std::map<std::string, double, std::less<>>;

/// Reads numbers that are computed: `5.`, `#1`, `#<width>`, `-[#1 + 2 * SIN[30]]`. Angles are in degrees.
class ExpressionReader {
 public:
  /// \param globals_only  in a subprogram: controls differ whether others are the caller's
  ExpressionReader(std::string_view text, std::size_t at, const Variables& variables, bool globals_only)
      : text_(text), at_(at), variables_(variables), globals_only_(globals_only) {}

  /// The number that begins at the place; fault() tells whether there is one.
  [[nodiscard]] double value();
  /// The sum that begins at the place, `#2 + 1`.
  [[nodiscard]] double total();
  /// The key of the variable that begins at the place, behind its `#`.
  [[nodiscard]] std::string key();

  /// The place behind what was read.
  [[nodiscard]] std::size_t at() const { return at_; }
  /// Why it cannot be computed, as words that complete `name:line:`; empty: it can.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  [[nodiscard]] char peek();
  [[nodiscard]] bool takes(std::string_view word);
  double fail(std::string why);
  std::string any_key();
  double checked(double result);
  double sum();
  double product();
  double factor();
  double bracket();
  double function(std::string_view name);
  double plain();

  std::string_view text_;
  std::size_t at_;
  const Variables& variables_;
  bool globals_only_;
  std::string fault_;
  int depth_ = 0;
};

/// The value with up to twelve decimals; a whole number has a point behind it.
[[nodiscard]] std::string format_value(double value);

}  // namespace lekalo::nc

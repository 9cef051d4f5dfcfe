#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string_view>

#include "lekalo/base/error.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/number/exact.hpp"

namespace lekalo::verify {

/// Takes the lines off a document one by one and counts them.
class Lines {
 public:
  explicit Lines(std::string_view bytes);
  /// Returns the next line without the blanks around it.
  [[nodiscard]] std::optional<std::string_view> next();
  [[nodiscard]] std::size_t number() const { return number_; }
  /// Returns what has not been taken.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

/// Returns the text without the blanks around it.
[[nodiscard]] std::string_view trimmed(std::string_view text);

[[nodiscard]] tl::unexpected<Error> bad_line(const Document& document, std::size_t line,
                                             const std::string& sentence);

/// A line of a text of points: two numbers, or three; in space six, too, of which the last are a direction.
struct TextRow {
  std::array<Decimal, 3> numbers, direction;
  std::size_t count = 2;
  std::size_t line = 0;
  /// True if an empty line stands between the row before and this one.
  bool after_a_gap = false;
};

/// Calls `take` for each point of a text (docs/formats.md); bad_input names the line.
[[nodiscard]] Result<void> read_text_rows(const Document& document,
                                          const std::function<Result<void>(TextRow&&)>& take,
                                          bool in_space = false);

}  // namespace lekalo::verify

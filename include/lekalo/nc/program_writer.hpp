#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "lekalo/base/units.hpp"
#include "lekalo/nc/dialect.hpp"

namespace lekalo::nc {

/// A point as a program writes it: whole units of the last decimal.
struct WrittenPoint {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const WrittenPoint&, const WrittenPoint&) = default;
};

/// Text for the operator as a comment: capitals, digits, points and dashes between the marks of the dialect.
[[nodiscard]] std::string comment_of(const Dialect& dialect, std::string_view words);

/// A program in one dialect, line by line: what is alike in programs of every kind. Bytes are ASCII, and
/// every line ends with `\n`. Amortised O(1) per byte.
class ProgramWriter {
 public:
  /// A `{word}` of a dialect's text, and what stands in its place.
  using Places = std::initializer_list<std::pair<std::string_view, std::string>>;

  /// \param dialect   has to outlive the writer
  /// \param decimals  the decimals of coordinates
  ProgramWriter(const Dialect& dialect, LengthUnit unit, int decimals)
      : dialect_(&dialect), unit_(unit), decimals_(decimals) {}

  /// Writes tape mark and program number, where the dialect has them, and the title as a comment.
  void begin(std::optional<std::string_view> title = std::nullopt);
  void line(std::string_view words);
  /// Writes lines of the dialect with their places filled.
  void lines(std::string_view text, Places places = {});
  /// Writes text for the operator, or nothing where none of it may be written.
  void comment(std::string_view words);
  /// Writes the dialect's last lines, and returns the text of the program.
  /// \param end  the end of the frame of its kind
  [[nodiscard]] std::string finish(std::string_view end);

  /// Returns a coordinate of whole units of the last decimal.
  [[nodiscard]] std::string number(std::int64_t count) const;
  /// Returns two coordinates after these letters: " X1.0000 Y2.0000", " I0.5000 J0.0000".
  [[nodiscard]] std::string pair(char first, char second, WrittenPoint counts) const;
  /// Returns " F600.0": one decimal of a mm/min, this many of an inch/min, and more where a slow feed needs
  /// them (feed_decimals()).
  [[nodiscard]] std::string feed(double mm_per_min, int inch_decimals) const;

  /// The size of the text so far in bytes.
  [[nodiscard]] std::size_t size() const noexcept { return text_.size(); }
  [[nodiscard]] std::size_t line_count() const noexcept { return line_count_; }

 private:
  const Dialect* dialect_;
  LengthUnit unit_;
  int decimals_;
  std::string text_;
  std::size_t line_count_ = 0;
};

}  // namespace lekalo::nc

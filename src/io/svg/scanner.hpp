#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "io/drawing/bounded_number.hpp"
#include "lekalo/base/units.hpp"

namespace lekalo::io::detail {

/// A value, or a sentence that says why an attribute cannot be read. The caller knows the element and adds
/// the place.
template <class T>
using Read = tl::expected<T, std::string>;

/// Step 2 of docs/design/svg.md: goes through the numbers of an SVG attribute; "1.5.5-3" are three.
class SvgScanner {
 public:
  explicit SvgScanner(std::string_view text) : text_(text) {}

  void skip_blanks() noexcept;
  /// Skips blanks with at most one comma among them; true if there was a comma.
  bool skip_comma() noexcept;
  [[nodiscard]] bool at_end() const noexcept { return at_ == text_.size(); }
  /// Returns the next character, '\0' at the end.
  [[nodiscard]] char peek() const noexcept { return at_end() ? '\0' : text_[at_]; }
  [[nodiscard]] std::string_view rest() const noexcept { return text_.substr(at_); }
  void advance(std::size_t characters) noexcept { at_ += characters; }
  [[nodiscard]] bool number_ahead() const noexcept;
  /// Reads a number; blanks before it are skipped.
  [[nodiscard]] Read<Bounded> number();
  /// Reads '0' or '1', which may stand right before the next number.
  [[nodiscard]] Read<bool> flag();
  /// Reads the letters from here on.
  [[nodiscard]] std::string_view word() noexcept;
  /// Returns the place for messages: "at character 12: " and the text there.
  [[nodiscard]] std::string here() const;

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

/// The width and height that percentages refer to, in user units.
struct Viewport {
  Bounded width, height;
};
enum class Along { x, y, diagonal };

/// Reads a length with a unit and converts it to user units. A unit that CSS does not fix gives the sentence.
[[nodiscard]] Read<Bounded> read_svg_length(std::string_view text, const Viewport& viewport, Along along);

/// A length as the file writes it: number and unit.
struct SvgLength {
  Bounded number;
  std::string_view unit;  ///< "", "%", "mm", ...
};
[[nodiscard]] Read<SvgLength> split_svg_length(std::string_view text);
/// Returns millimetres for one of an absolute unit ("px" and "" too: 1/96 inch), or nullopt for other units.
[[nodiscard]] std::optional<Bounded> millimetres_per_unit(std::string_view unit);

/// Reads the attribute "transform".
[[nodiscard]] Read<Affine> read_svg_transform(std::string_view text);

}  // namespace lekalo::io::detail

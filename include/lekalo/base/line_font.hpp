#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace lekalo {

/// The letters of a font of single lines, as a tool engraves them, as data. The makers (layout) and the
/// checker (verify) share no code and set texts each for themselves; they read this one table.
///
/// Latin letters, figures and signs are those of Dr. A. V. Hershey's "Simplex Roman" (src/base/line_font.cpp
/// has its terms); Cyrillic letters, umlauts and a few signs were drawn for this table on the same grid.

/// Lengths are in units of which capitals have kLineFontCapital.
inline constexpr int kLineFontCapital = 21;

struct LineLetter {
  int width = 0;  ///< from the beginning of the letter to that of the next
  /// Each has two points or more: right of the letter's beginning, and up from the baseline.
  std::vector<std::vector<std::pair<int, int>>> strokes;
};

/// Returns the letter of a code point of Unicode; nothing where the font lacks it. Cost: O(log letters).
[[nodiscard]] std::optional<LineLetter> line_letter(char32_t code);

/// Takes the first code point off a text; a byte that begins none in UTF-8 is returned as U+FFFD.
/// \pre the text is not empty
[[nodiscard]] char32_t take_code_point(std::string_view& text) noexcept;

}  // namespace lekalo

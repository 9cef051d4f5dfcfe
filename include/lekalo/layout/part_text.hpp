#pragma once

#include <vector>

#include "lekalo/geom/polygon.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::layout {

/// Texts of parts set in the font of single lines (base/line_font.hpp).

/// Says whether the font has every letter of the text.
[[nodiscard]] bool has_all_letters(const PartText& text);

/// The strokes of the text in the part's frame, mm. A letter that the font lacks is a rectangle. Cost:
/// O(letters).
[[nodiscard]] std::vector<geom::Ring> text_strokes(const PartText& text);

/// The length of its line of letters, mm.
[[nodiscard]] double text_length(const PartText& text);

/// The middle of its line of letters at half their height, in the part's frame.
[[nodiscard]] geom::Point text_middle(const PartText& text);

}  // namespace lekalo::layout

#pragma once

#include <string_view>
#include <vector>

#include "blocks.hpp"
#include "io/drawing/drawn_shapes.hpp"
#include "lekalo/io/drawing/drawing.hpp"

namespace lekalo::io {

/// Moves a text as an insertion moves what its block holds.
void place_text(DxfText& text, const Affine& map);

/// The lines of a text, decoded and without markup (docs/formats.md, "DXF"); their layer is not filled in.
/// Lines that are blank, and texts that an insertion made flat or that are beyond the sizes of layouts, give
/// none.
[[nodiscard]] std::vector<ReadText> lines_of_text(const DxfText& text, std::string_view code_page);

}  // namespace lekalo::io

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/drawing/exact_arcs.hpp"

namespace lekalo::io::detail {

/// Attributes that our own files have besides those of SVG.

/// The attribute of a shape with its exact arcs, in its own user units and with "; " between them.
inline constexpr const char* kExactArcs = "data-lekalo-arcs";
/// The attribute of the root with the place of its page's lower left corner in the drawing, mm, y up.
inline constexpr const char* kPageCorner = "data-lekalo-corner";

[[nodiscard]] std::string exact_arcs_text(const std::vector<ExactArc>& arcs);
/// Calls restore_exact_arcs for the text of an attribute; arcs that cannot be read count as unfit.
[[nodiscard]] std::size_t restore_exact_arcs(std::vector<BoundedShape>& curves, std::string_view text);

/// Takes the drawing, whose user units become millimetres by `map`, where the text of kPageCorner says; false
/// where the map then is not the plain one from y down to y up, because the page was changed since.
[[nodiscard]] bool restore_page_corner(Affine& map, std::string_view text);

}  // namespace lekalo::io::detail

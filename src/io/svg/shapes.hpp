#pragma once

#include <vector>

#include "document.hpp"
#include "io/drawing/drawn_shapes.hpp"
#include "scanner.hpp"

namespace lekalo::io::detail {

/// True for the elements that draw: path, line, polyline, polygon, rect, circle and ellipse.
[[nodiscard]] bool is_svg_shape(std::string_view element) noexcept;

/// Returns the curves of such an element in its user units, with y down as they stand there. The result is
/// empty where the standard draws nothing (a circle without radius).
[[nodiscard]] Read<std::vector<BoundedShape>> read_svg_shape(const SvgElement& element,
                                                             const Viewport& viewport);

}  // namespace lekalo::io::detail

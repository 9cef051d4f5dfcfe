#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/io/drawing/drawing.hpp"
#include "lekalo/io/drawing/drawing_format.hpp"
#include "lekalo/io/drawing/written_drawing.hpp"

namespace lekalo::io {

/// Reads an SVG drawing (1.1, and what SVG 2 changed of the same words): path, line, polyline, polygon, rect,
/// circle, ellipse under g, a, svg, switch, use and symbol, with transform, viewBox and preserveAspectRatio.
/// Millimetres, y up, the origin at the lower left corner of the page (our own files say where that lies).
/// Arcs stay arcs under maps that keep circles, and become arcs of ellipses under others; Bezier curves are
/// splines.
///
/// The layer of a curve is the inkscape:label or id of the nearest group that says it is a layer, else of the
/// outermost group that has one. What display or visibility hides stands in a layer of the same name that is
/// hidden. Strokes (or fills where there is none) and dashes make several entries of a layer.
///
/// A page in mm, cm, in, pt, pc or Q says its unit. Otherwise one unit of the page is what the user said,
/// or 1/96 inch (CSS) if neither does, with a notice; a file that says another unit than the user is refused.
///
/// Fails with ErrorCode::bad_input and one sentence that names file, line, element and the way out: not XML,
/// no SVG, compressed SVG, a page whose size or view box is none, entities within entities, nesting or copies
/// beyond the limits of drawing.hpp. An element with path data or numbers that are none, or coordinates
/// beyond 1e9, is set aside with its sentence in `damaged`. No other file is opened. Text, images, gradients
/// and all else that is no outline is counted in `unread`. Clipping, markers and strokes change nothing.
/// Cost: O(bytes + curves).
[[nodiscard]] Result<Drawing> parse_svg(std::string_view bytes, const std::string& name,
                                        std::optional<LengthUnit> unit = std::nullopt);

/// How SVG files are told from others, with that reader.
[[nodiscard]] DrawingFormat drawing_svg();

/// SVG 1.1 in millimetres: a path or circle for every contour, in a group for every layer that follows
/// another. The page begins at the origin, or at the whole millimetre to the left of and below all that is
/// negative (by more than 2^-20 mm) and then says where; other programs see the drawing moved by that.
///
/// Fails with ErrorCode::usage for a layer name that is empty, not UTF-8 or holds a control character, and as
/// above. \pre regions made by make_region, not empty
[[nodiscard]] Result<std::string> svg_drawing(const std::vector<LayeredRegion>& regions,
                                              const DrawingExtras& extras = {});

}  // namespace lekalo::io

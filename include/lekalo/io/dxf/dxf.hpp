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

/// Reads a DXF drawing, R12 to current, text or binary: LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE, POLYLINE,
/// SPLINE, MLINE and INSERT of the model space, seen from above. `unit` is what the user said, and applies
/// where the file does not say ($INSUNITS; millimetres if neither does); a file that says otherwise is
/// refused.
///
/// Fails with ErrorCode::bad_input and one sentence that names file, line, what stands there and the way out:
/// DWG and other kinds of files, a file that is not complete, nesting or copies beyond the limits above. An
/// entity that is damaged is set aside with its sentence in `damaged`. Whatever else is not read is counted
/// in `unread`, never skipped in silence. Cost: O(bytes + curves).
[[nodiscard]] Result<Drawing> parse_dxf(std::string_view bytes, const std::string& name,
                                        std::optional<LengthUnit> unit = std::nullopt);

/// How DXF files are told from others, with that reader.
[[nodiscard]] DrawingFormat drawing_dxf();

/// DXF, AutoCAD 2000 (AC1015) in ASCII, millimetres: a closed LWPOLYLINE with bulges for every contour, a
/// CIRCLE for a full circle. Numbers are the shortest decimals that read back to the same double. Where a
/// layer's name is not ASCII, AutoCAD 2007 (AC1021), which is in UTF-8.
///
/// Fails with ErrorCode::usage for a coordinate, centre or radius beyond 5e8 mm (readers stop at 1e9), and
/// for a layer name that the format cannot hold: empty, longer than 255 characters, with one of < > / \ " : ;
/// ? * | , = ` or a control character, a space at either end, or not UTF-8; and for hole_layers of another
/// number than holes. Names that differ in case alone are one layer. \pre regions made by make_region
/// \param unit  what the file says its numbers are; they are written as they come,
/// unscaled. What stands beside curves of other units than millimetres is left out
[[nodiscard]] Result<std::string> dxf_drawing(const std::vector<LayeredRegion>& regions,
                                              const DrawingExtras& extras = {},
                                              LengthUnit unit = LengthUnit::millimetre);

}  // namespace lekalo::io

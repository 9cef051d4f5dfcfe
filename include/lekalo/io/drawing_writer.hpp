#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::io {

/// Regions as drawings that other programs read: lines stay lines, arcs stay arcs. docs/formats.md,
/// docs/design/drawing-regions.md.

/// A region and the layers that its contours are on.
struct LayeredRegion {
  geom::Region region;
  std::string layer = "0";
  std::vector<std::string> hole_layers;  ///< as many as holes; empty: all on `layer`
};

/// What parse_dxf or parse_svg and make_regions make of the written text (tests/property/
/// io_drawing_writer_test.cpp): the same regions, holes and layers in the same order;
///   - lines and the ends of arcs bit for bit;
///   - arcs as arcs, every point of either curve within kWrittenArcError times the largest coordinate, radius
///     or centre coordinate, plus twice the difference of the radii at the arc's ends, of the other; the
///     centre bit for bit where some number in the file gives it (DXF), so that what was read from such a
///     file and is written again comes back bit for bit;
///   - a full circle as one about the very centre, beginning on the right of it; bit for bit if it did before
///     and some radius, added to the centre, gives that point;
///   - an arc of more than 300 degrees in two halves, because its ends lie too close together to say where
///     its centre is; in SVG, which gives a radius instead of a centre, also one within half a degree of half
///     a turn that is not one within 2^-46 of its radius.
/// An arc flatter than its own rounding may come back as the line.
inline constexpr double kWrittenArcError = 0x1p-44;

/// DXF, AutoCAD 2000 (AC1015) in ASCII, millimetres: a closed LWPOLYLINE with bulges for every contour, a
/// CIRCLE for a full circle. Numbers are the shortest decimals that read back to the same double. Where a
/// layer's name is not ASCII, AutoCAD 2007 (AC1021), which is in UTF-8.
///
/// Fails with ErrorCode::usage for a layer name that the format cannot hold: empty, longer than 255
/// characters, with one of < > / \ " : ; ? * | , = ` or a control character, a space at either end, or not
/// UTF-8; and
/// for hole_layers of another number than holes. Names that differ in case alone are one layer.
/// \pre regions made by make_region
[[nodiscard]] Result<std::string> dxf_drawing(const std::vector<LayeredRegion>& regions);

/// SVG 1.1 in millimetres: a path or circle for every contour, in a group for every layer that follows
/// another. The page begins at the origin, or at the whole millimetre to the left of and below all that is
/// negative (by more than 2^-20 mm): what is read back is then moved by that, within rounding.
///
/// Fails with ErrorCode::usage for a layer name that is empty, not UTF-8 or holds a control character, and as
/// above. \pre regions made by make_region, not empty
[[nodiscard]] Result<std::string> svg_drawing(const std::vector<LayeredRegion>& regions);

}  // namespace lekalo::io

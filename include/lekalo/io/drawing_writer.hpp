#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
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

/// What else a drawing shows beside regions. Points and heights are in the drawing's unit.
struct DrawnLine {
  geom::Point from, to;
  std::string layer;
};
struct DrawnText {
  std::string text;    ///< one line; what is no UTF-8 and control characters are replaced
  geom::Point middle;  ///< of the text, both ways
  double height = 1;   ///< of capitals
  std::string layer;
};
/// How a layer is shown: AutoCAD's colour index in DXF, the colour itself in SVG. Others are black (7).
struct LayerColour {
  std::string layer;
  int index = 7;                 ///< 1 to 255
  std::uint32_t rgb = 0x000000;  ///< 0xrrggbb
};
struct DrawingExtras {
  std::vector<DrawnLine> lines;
  std::vector<DrawnText> texts;
  std::vector<LayerColour> colours;
};

/// What parse_dxf or parse_svg and make_regions make of the written text (tests/property/
/// io_drawing_writer_test.cpp): the same regions, bit for bit (-0 as 0, and what is nearer to 0 than 1e-100
/// as 0), holes and layers in the same order; written again, the same bytes. (With a join tolerance below
/// what the regions measure across, otherwise their two sides are copies of a line to make_regions.)
///
/// What bulges and radii do not say of an arc stands beside its curves, where other programs pass over it.
/// Those see, and so do our readers where the curves were changed since and the exact numbers do not fit any
/// more:
///   - lines and the ends of arcs bit for bit;
///   - arcs as arcs, every point of either curve within kWrittenArcError times the largest coordinate, radius
///     or centre coordinate, plus twice the difference of the radii at the arc's ends, of the other; an arc
///     flatter than that perhaps as the line;
///   - a full circle about the very centre, beginning on the right of it;
///   - an arc of more than 300 degrees in two halves, because its ends lie too close together to say where
///     its centre is; in SVG, which gives a radius instead of a centre, also one within half a degree of half
///     a turn, and each such half.
inline constexpr double kWrittenArcError = 0x1p-44;

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

/// SVG 1.1 in millimetres: a path or circle for every contour, in a group for every layer that follows
/// another. The page begins at the origin, or at the whole millimetre to the left of and below all that is
/// negative (by more than 2^-20 mm) and then says where; other programs see the drawing moved by that.
///
/// Fails with ErrorCode::usage for a layer name that is empty, not UTF-8 or holds a control character, and as
/// above. \pre regions made by make_region, not empty
[[nodiscard]] Result<std::string> svg_drawing(const std::vector<LayeredRegion>& regions,
                                              const DrawingExtras& extras = {});

}  // namespace lekalo::io

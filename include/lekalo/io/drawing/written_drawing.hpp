#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/io/drawing/drawing.hpp"

namespace lekalo::io {

/// Regions as drawings that other programs read: lines stay lines, arcs stay arcs. docs/formats.md,
/// docs/design/drawing-regions.md.

/// A region and the layers that its contours are on.
struct LayeredRegion {
  geom::Region region;
  std::string layer = "0";
  /// As many layers as holes; empty when all are on `layer`.
  std::vector<std::string> hole_layers;
};

/// A line that a drawing shows beside its regions. Points and heights are in the drawing's unit.
struct DrawnLine {
  geom::Point from, to;
  std::string layer;
};
struct DrawnText {
  /// One line. Bytes that are no UTF-8, and control characters, are replaced.
  std::string text;
  /// The middle of the text, both ways.
  geom::Point middle;
  double height = 1;  ///< of capitals
  std::string layer;
};
/// A chain of edges that bounds no region, closed where the last ends where the first begins. Of its layer
/// the name and the colour count.
struct DrawnChain {
  geom::Contour edges;  ///< made by make_chain
  Layer layer;
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
  std::vector<DrawnChain> chains{};
  /// Texts at their places, turned and perhaps backwards; of their layers the name and the colour count.
  std::vector<ReadText> set_texts{};
};

/// Laws of the written text (tests/property/io_drawing_writer_test.cpp): parse_dxf or parse_svg and
/// make_regions make the same regions of it, bit for bit (-0 and numbers nearer to 0 than 1e-100 become 0),
/// with holes and layers in the same order; written again they give the same bytes. The join tolerance must
/// be below the regions' width, otherwise make_regions takes their two sides for copies of one line.
///
/// The numbers of an arc that its bulge or radius loses stand beside its curves, where other programs pass
/// over them. Those programs see the following, and so do our readers where the curves were changed since and
/// the exact numbers do not fit any more:
///   - lines and the ends of arcs bit for bit;
///   - arcs as arcs, every point of either curve within kWrittenArcError times the largest coordinate, radius
///     or centre coordinate, plus twice the difference of the radii at the arc's ends, of the other; an arc
///     flatter than that perhaps as the line;
///   - a full circle about the very centre, beginning on the right of it;
///   - an arc of more than 300 degrees in two halves, because its ends lie too close together to say where
///     its centre is; in SVG, which gives a radius instead of a centre, also one within half a degree of half
///     a turn, and each such half.
inline constexpr double kWrittenArcError = 0x1p-44;

}  // namespace lekalo::io

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "lekalo/io/formats/layer_rules.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::io {

struct PartOptions {
  /// The unit of files that do not say theirs.
  std::optional<LengthUnit> unit;
  /// The chords of arcs lie outside the material by at most this, mm.
  double chord_tolerance = kUsualChordTolerance;
  DrawingOptions drawing;
  /// The roles of layers of drawings; where no row fits a layer, its closed lines are outlines.
  LayerRules layer_rules{};
};

struct PartsFile {
  std::vector<layout::Part> parts;
  /// The sheets; there are some only in drawings with the layers below.
  std::vector<layout::Stock> stocks;
  /// A sentence about every curve or shape of a drawing that is neither in a part nor a mark on one, with
  /// where and why; the first of them are among the notices.
  std::vector<std::string> set_aside{};
  std::vector<std::string> notices;
};

/// The parts in a DXF or SVG drawing, a region file or a tree of primitives, told apart by what is in them.
/// Each closed outline with its holes is a part that may be turned but not mirrored; outlines that are the
/// same but for their place are one part, wanted as often. Arcs are kept beside the chords that replace them.
/// Lines of a drawing that bound no area, what is engraved (docs/design/drawing.md), lines on layers that the
/// rules say are no outlines, and the texts of DXF are marks and texts of the part on which they lie.
///
/// Ids: of a tree the name of the outline's primitive, else the file's name without its ending; "-2", "-3"
/// after those that come again. The name is that of the layer, with what the element is called (its
/// inkscape:label, else its SVG id) behind it.
///
/// A drawing that has a layer CUT beside others of kExportLayers (layout_export.hpp), as lekalo's exports
/// have, holds its parts on CUT, its sheets on SHEET, and marks and texts of the parts on layers that are
/// none of those, unless layers are asked for; a notice says so.
///
/// Ellipses, splines and rounding make the outlines differ from the drawing; by how much a notice says where
/// it is more than a step. Fails as parse_dxf, parse_svg, make_regions, parse_regions and parse_shape_tree
/// do, and with a sentence that names the part where its polygon meets itself or has too many points.
[[nodiscard]] Result<PartsFile> read_parts(std::string_view bytes, const std::string& name,
                                           const PartOptions& options = {});

struct StocksFile {
  std::vector<layout::Stock> stocks;
  std::vector<std::string> notices;
};

/// The sheets in a file of the same forms: each closed outline with its holes is one. They are called after
/// the file, "-2", "-3" behind it; arcs are kept beside the chords that replace them, which lie in the
/// material. Fails as read_parts does.
[[nodiscard]] Result<StocksFile> read_stocks(std::string_view bytes, const std::string& name,
                                             const PartOptions& options = {});

}  // namespace lekalo::io

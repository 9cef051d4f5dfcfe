#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/geom/curve_faces.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::io {

/// Drawings as they stand in DXF and SVG files: every curve in file order, exact where the file is, nothing
/// joined yet. What is read, what is not, and why: docs/design/drawing.md. Regions come from make_regions
/// (drawing_regions.hpp).

/// Most curves of a drawing, blocks and arrays expanded; more are refused.
inline constexpr std::size_t kMostCurves = 2'000'000;
/// How deep blocks (or groups and uses of an SVG) may be nested.
inline constexpr std::size_t kDeepestNesting = 32;
/// Highest degree of a spline.
inline constexpr std::size_t kHighestDegree = 15;

/// centre + cos(t) u + sin(t) v for t from `begin` to `end`, begin < end <= begin + 2 pi: an arc of an
/// ellipse. u and v are conjugate half diameters, not always the axes; the arc is counter-clockwise when
/// cross(u, v) > 0.
struct EllipseArc {
  /// The ends as the file has them, equal for a whole ellipse.
  geom::Point from, to;
  geom::Point centre, u, v;
  double begin = 0, end = 0;
};

/// A rational B-spline over [knots[degree], knots[poles.size()]].
struct Spline {
  std::size_t degree = 0;  ///< 1 to kHighestDegree
  /// Numbers that do not descend, poles.size() + degree + 1 of them.
  std::vector<double> knots;
  std::vector<geom::Point> poles;  ///< more than `degree`
  /// Numbers above 0, as many as poles; empty when all are 1.
  std::vector<double> weights;
};

/// A line or a circle's arc (from == to: a full circle), an arc of an ellipse, or a spline (Bezier curves
/// too). Millimetres, y up.
using Shape = std::variant<geom::Edge, EllipseArc, Spline>;

struct DrawnCurve {
  Shape shape;
  std::uint32_t entity = 0, layer = 0;  ///< indices into Drawing
  /// mm: the curve and the one that the file's decimals mean lie within this of each other, both ways (where
  /// our own files state an arc's exact numbers beside it, both what they and what the curve means). Covers
  /// reading, scaling, blocks and transforms; 0 where all of that was exact.
  double error = 0;
};

/// The words by which a person finds an entity again in the drawing program.
struct DrawnEntity {
  std::string type;  ///< as in the file: "LWPOLYLINE", "path"
  /// The DXF handle or SVG id, "" if there is none.
  std::string handle;
  std::size_t line = 0;  ///< of the file, 1-based
  /// The rule by which the file fills the entity, even-odd where it is not filled.
  geom::FillRule fill = geom::FillRule::even_odd;
  /// The name that a person gave it (inkscape:label), "" if there is none.
  std::string label{};
  /// True where the file fills it and draws no line along it: a fill of SVG without a stroke, a solid HATCH.
  bool filled = false;
};

struct Layer {
  std::string name;  ///< UTF-8
  /// True for a layer that is switched off or frozen in the file.
  bool hidden = false;
  /// The colour of its curves as "#0000ff", or as the file's own word for it; empty where nothing is said.
  /// Curves of one layer in several colours or line types stand in as many entries of the same name.
  std::string colour{};
  /// The name of their line type ("DASHED"); empty for lines that are drawn through.
  std::string line_type{};
};

/// A line of a text as it stands in the file.
struct ReadText {
  enum class Anchor : std::uint8_t { left, middle, right };
  std::string text;   ///< UTF-8, not empty, without control characters
  geom::Point at;     ///< on the baseline, mm
  double height = 1;  ///< of capitals, mm
  double degrees = 0, width_factor = 1;
  bool mirrored = false;  ///< written backwards, before it is turned
  Anchor anchor = Anchor::left;
  Layer layer;
  std::size_t line = 0;  ///< of its entity in the file
};

/// Entities that are not curves or that are not read, by name: "TEXT", "SPLINE (fit points alone)".
struct Unread {
  std::string name;
  /// The number with the copies that blocks and arrays make.
  std::size_t count = 0;
  /// The line of the first.
  std::size_t line = 0;
};

struct Drawing {
  std::string name;  ///< as given, for messages
  std::string unit = "mm";
  double millimetres_per_unit = 1;
  /// The layers of the curves, in the order of their first curve.
  std::vector<Layer> layers;
  std::vector<DrawnEntity> entities;
  std::vector<DrawnCurve> curves;  ///< file order
  std::vector<ReadText> texts{};   ///< of DXF; those of blocks come after the others
  std::vector<Unread> unread;      ///< by name
  /// A sentence about every entity that is damaged and was set aside, with file, line and reason, in file
  /// order; the entity is counted in `unread` too.
  std::vector<std::string> damaged;
  std::vector<std::string> notices;
};

}  // namespace lekalo::io

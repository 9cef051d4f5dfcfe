#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/io/drawing/drawing.hpp"

namespace lekalo::io {

/// The way from the curves of a drawing to regions, marks and what was set aside.
/// docs/design/drawing-regions.md has the steps, the bounds and what failed.
struct DrawingOptions {
  /// Loose ends at most this far apart are joined, mm, >= 0.
  double join_tolerance = 0.01;
  /// Lines and arcs may be this far from an ellipse or spline that they replace, mm, > 0.
  double curve_tolerance = 0.001;
  /// Layer names; letters A to Z match in either case. Hidden layers count only where `take` names them.
  /// When it is empty, all layers that are not hidden count.
  std::vector<std::string> take;
  /// These layers never count.
  std::vector<std::string> leave;
  /// No mend moves an outline further than this, mm, >= 0: loops and spikes that are cut off, corners that
  /// touch and are pulled apart. What would take more is set aside.
  double repair = 0.2;
  /// True when nothing is mended or set aside: a chain that does not close, three ends in one place and
  /// outlines that cross or touch are refused, and so the whole drawing.
  bool strict = false;
};

/// Two ends of curves that were joined.
struct JoinedGap {
  geom::Point at;                    ///< mm, half way
  double size = 0;                   ///< mm, above 0
  std::uint32_t curves[2] = {0, 0};  ///< indices into Drawing::curves
};

/// A line that bounds no area: a hinge, a bend, an engraving, a cut inside waste.
struct Mark {
  /// In a row, each begins where the one before ends but for gaps that were joined.
  std::vector<geom::Edge> edges;
  /// For every edge the curve it came from, into Drawing::curves.
  std::vector<std::uint32_t> curve_of_edge;
  /// mm: the edges and the curves that the file means lie within this of each other, both ways.
  double tolerance = 0;
  /// The region within whose outer contour the middle of the first edge lies, the smallest of several.
  std::optional<std::uint32_t> region;
};

/// Why curves are neither in an outline nor a mark.
enum class AsideReason : std::uint8_t {
  crosses_itself,   ///< a contour that crosses itself by more than may be mended
  crosses_another,  ///< contours that overlap, of which none can be taken as it is drawn
  does_not_close,   ///< an outline with a gap that is too wide to mend
  lies_in_another,  ///< what lies in a contour that was set aside, its holes among it
  no_curve,         ///< numbers that make no curve
};
/// The reason in two or three words, as documents have it.
[[nodiscard]] const char* word_of(AsideReason reason) noexcept;

/// Curves that were set aside. Everything else of the drawing is taken nevertheless.
struct SetAside {
  AsideReason reason = AsideReason::crosses_itself;
  std::vector<std::uint32_t> curves;  ///< into Drawing::curves
  std::vector<geom::Edge> edges;      ///< what they draw
  double tolerance = 0;               ///< mm: how far the edges are from the curves, both ways
  geom::Point at;                     ///< mm: where the trouble is
  /// A sentence that says which curves, where, why, and what would take them in.
  std::string sentence;
};

struct DrawnRegions {
  /// Made by make_region, each by itself free of faults (fault_of of geom/region_check.hpp): outlines that
  /// hold material and their holes, by containment; in the order of their first curves in the file. Regions
  /// may share corners and edges, as parts do that are drawn side by side, and overlap by up to `repair`, or
  /// by more as they are drawn, which a notice says; whoever takes several of them as one shape asks fault_of
  /// of all (strict: they are apart).
  std::vector<geom::Region> regions;
  /// For every edge the curve it came from (into Drawing::curves); a line that closes a gap counts to the
  /// curve before it.
  std::vector<std::uint32_t> curve_of_edge;

  /// The outlines of `regions` and the curves that the file means lie within this of each other, mm, rounded
  /// up. It holds both ways: every point of one has a point of the other that near. Curves on layers left
  /// out, specks, marks and what was set aside are not counted among them. The tolerance is at most the sum
  /// of the four parts below, each of which is the largest of all curves.
  double tolerance = 0;
  /// Lines and arcs stand this far from ellipses and splines; proven, not sampled.
  double curve_tolerance = 0;
  /// Curves were moved this far by closing gaps and dropping duplicates.
  double moved = 0;
  /// Outlines were moved this far by mends, at most DrawingOptions::repair.
  double repaired = 0;
  /// Coordinates are off by this from reading and rounding.
  double coordinate_error = 0;

  /// The gaps along the outlines, without those that the two curves' errors and the 16 digits of a decimal
  /// explain.
  std::vector<JoinedGap> gaps;
  /// Curves that lie on others within join_tolerance and were dropped, and lines that were cut where they
  /// begin to lie on another; ascending.
  std::vector<std::uint32_t> duplicates;
  /// Points, and curves no longer than join_tolerance that no outline needs: dropped; ascending.
  std::vector<std::uint32_t> specks;
  /// Curves of loops and spikes that were cut off, and of nothing else: they lie within `repaired` of the
  /// outlines; ascending.
  std::vector<std::uint32_t> cut_off;
  std::vector<Mark> marks;
  std::vector<SetAside> set_aside;
  /// Sentences about closed lines that are marks, because they cross an outline that is far larger: what they
  /// enclose may be meant to be cut off.
  std::vector<std::string> doubtful;
  /// Sentences about layers left out, gaps, duplicates, mends, marks and what was not read; those about what
  /// was set aside are in `set_aside`.
  std::vector<std::string> notices;
};

/// A record of how a drawing became regions, for results, so that somebody else can follow.
struct DrawingRecord {
  std::vector<std::string> layers;  ///< that were taken; empty for all that are not hidden
  double join = 0;                  ///< the join tolerance, mm
  /// A point of every curve that was set aside because it is no longer than `join`, mm.
  std::vector<geom::Point> specks;
  std::vector<geom::Edge> marks;      ///< of all marks
  std::vector<geom::Edge> set_aside;  ///< of all that was set aside otherwise
  /// mm: the curves of marks and of what was set aside lie within this of those edges.
  double loose_error = 0;
};
[[nodiscard]] DrawingRecord record_of(const Drawing& drawing, const DrawingOptions& how,
                                      const DrawnRegions& drawn);

/// Adds a notice for each sentence about what was set aside, a thousand at most, and one with how many more
/// there are.
void tell_set_aside(const std::vector<std::string>& sentences, std::vector<std::string>& notices);

/// Joins, closes, mends, nests and checks. Fails with ErrorCode::bad_input where a layer is not there and
/// where nothing is enclosed, with one sentence that counts what there is by kind and layer; with `strict`
/// also, naming entity, line, layer and place, for a chain that does not close, three ends in one place,
/// outlines that cross or touch (exactly decided between lines; where arcs are involved, within rounding, for
/// crossing). Fails with ErrorCode::usage for a tolerance that is negative or not finite (curve_tolerance: or
/// 0). Cost: O((n + k) log n), k pairs of edges whose boxes meet.
[[nodiscard]] Result<DrawnRegions> make_regions(const Drawing& drawing, const DrawingOptions& options = {});

}  // namespace lekalo::io

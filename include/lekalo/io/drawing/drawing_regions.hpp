#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/io/drawing/drawing.hpp"

namespace lekalo::io {

/// The way from the curves of a drawing to regions. docs/design/drawing-regions.md has the steps, the bounds
/// and what failed.
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
  /// True when chains that do not close are left out and listed instead of refused.
  bool leave_open_chains = false;
};

/// Two ends of curves that were joined.
struct JoinedGap {
  geom::Point at;                    ///< mm, half way
  double size = 0;                   ///< mm, above 0
  std::uint32_t curves[2] = {0, 0};  ///< indices into Drawing::curves
};

/// Curves that hang together and do not close.
struct OpenChain {
  geom::Point from, to;               ///< mm
  std::vector<std::uint32_t> curves;  ///< indices into Drawing::curves
};

struct DrawnRegions {
  /// Made by make_region, free of faults (fault_of of geom/region_check.hpp): outlines that hold material and
  /// their holes, by containment; in the order of their first curves in the file.
  std::vector<geom::Region> regions;
  /// For every edge the curve it came from (into Drawing::curves); a line that closes a gap counts to the
  /// curve before it.
  std::vector<std::uint32_t> curve_of_edge;

  /// The outlines of `regions` and the curves that the file means lie within this of each other, mm, rounded
  /// up. It holds both ways: every point of one has a point of the other that near. Curves on layers left
  /// out, specks and open chains are not counted among them. The tolerance is at most the sum of the three
  /// parts below, each of which is the largest of all curves.
  double tolerance = 0;
  /// Lines and arcs stand this far from ellipses and splines; proven, not sampled.
  double curve_tolerance = 0;
  /// Curves were moved this far by closing gaps and dropping duplicates.
  double moved = 0;
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
  /// The chains that were left out; only with leave_open_chains.
  std::vector<OpenChain> open_chains;
  /// Sentences about layers left out, gaps, duplicates and entities not read.
  std::vector<std::string> notices;
};

/// A record of how a drawing became regions, for results, so that somebody else can follow.
struct DrawingRecord {
  std::vector<std::string> layers;  ///< that were taken; empty for all that are not hidden
  double join = 0;                  ///< the join tolerance, mm
  /// A point of every curve that was set aside because it is no longer than `join`, mm.
  std::vector<geom::Point> set_aside;
};
[[nodiscard]] DrawingRecord record_of(const Drawing& drawing, const DrawingOptions& how,
                                      const DrawnRegions& drawn);

/// Joins, closes, nests and checks. Fails with ErrorCode::bad_input, naming entity, line, layer and place: a
/// chain that does not close, three ends in one place, outlines that cross or touch (exactly decided between
/// lines; where arcs are involved, within rounding, for crossing), a layer that is not there, no closed
/// contour at all. Fails with ErrorCode::usage for a tolerance that is negative or not finite
/// (curve_tolerance: or 0). Cost: O((n + k) log n), k pairs of edges whose boxes meet.
[[nodiscard]] Result<DrawnRegions> make_regions(const Drawing& drawing, const DrawingOptions& options = {});

}  // namespace lekalo::io

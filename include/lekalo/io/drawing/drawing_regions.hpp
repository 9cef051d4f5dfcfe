#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/io/drawing/drawing.hpp"

namespace lekalo::io {

/// From the curves of a drawing to regions; steps, bounds and what failed: docs/design/drawing-regions.md.
struct DrawingOptions {
  double join_tolerance = 0.01;  ///< mm, >= 0: loose ends at most this far apart are joined
  double curve_tolerance =
      0.001;  ///< mm, > 0: how far lines and arcs may be from an ellipse or spline they replace
  /// Layer names; letters A to Z match in either case. Hidden layers count only where `take` names them.
  std::vector<std::string> take;   ///< empty: all that are not hidden
  std::vector<std::string> leave;  ///< these never
  bool leave_open_chains = false;  ///< chains that do not close are left out and listed, instead of refused
};

/// Two ends of curves that were joined.
struct JoinedGap {
  geom::Point at;                    ///< mm, half way
  double size = 0;                   ///< mm, above 0
  std::uint32_t curves[2] = {0, 0};  ///< into Drawing::curves
};

/// Curves that hang together and do not close.
struct OpenChain {
  geom::Point from, to;               ///< its ends, mm
  std::vector<std::uint32_t> curves;  ///< into Drawing::curves
};

struct DrawnRegions {
  /// Made by make_region, free of faults (fault_of of geom/region_check.hpp): outlines that hold material and
  /// their holes, by containment; in the order of their first curves in the file.
  std::vector<geom::Region> regions;
  /// For every edge the curve it came from (into Drawing::curves); a line that closes a gap counts to the
  /// curve before it.
  std::vector<std::uint32_t> curve_of_edge;

  /// mm, rounded up; the outlines of `regions` and the curves that the file means lie within `tolerance` of
  /// each other, both ways: every point of one has a point of the other that near. Curves on layers left out,
  /// specks and open chains are not counted among them. Its parts, each the largest of all curves:
  double tolerance = 0;         ///< at most the sum of the three
  double curve_tolerance = 0;   ///< lines and arcs instead of ellipses and splines; proven, not sampled
  double moved = 0;             ///< by closing gaps and dropping duplicates
  double coordinate_error = 0;  ///< reading and rounding

  /// Along the outlines; without those that the two curves' errors and the 16 digits of a decimal explain.
  std::vector<JoinedGap> gaps;
  /// Curves that lie on others within join_tolerance and were dropped, and lines that were cut where they
  /// begin to lie on another; ascending.
  std::vector<std::uint32_t> duplicates;
  /// Points, and curves no longer than join_tolerance that no outline needs: dropped; ascending.
  std::vector<std::uint32_t> specks;
  std::vector<OpenChain> open_chains;  ///< left out; only with leave_open_chains
  std::vector<std::string> notices;    ///< sentences: layers left out, gaps, duplicates, entities not read
};

/// Joins, closes, nests and checks. Fails with ErrorCode::bad_input, naming entity, line, layer and place: a
/// chain that does not close, three ends in one place, outlines that cross or touch (exactly decided between
/// lines; where arcs are involved, within rounding, for crossing), a layer that is not there, no closed
/// contour at all. Fails with ErrorCode::usage for a tolerance that is negative or not finite
/// (curve_tolerance: or 0). Cost: O((n + k) log n), k pairs of edges whose boxes meet.
[[nodiscard]] Result<DrawnRegions> make_regions(const Drawing& drawing, const DrawingOptions& options = {});

}  // namespace lekalo::io

#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/geom/region.hpp"

namespace lekalo::nc {

/// A profile program engraves marks on parts before it cuts any of them out: docs/design/marks.md.

/// A line, or all strokes of a text, on a placed part: in the sheet's frame, mm. The tool follows the very
/// lines, without compensation.
struct ProfileMark {
  std::vector<geom::Contour> lines;  ///< each made by make_chain
};

/// How marks are engraved. Not for torches and jets of water, which would cut through.
struct Engraving {
  double feed_mm_per_min = 0;  ///< 0.1 to 1e6
  /// The S word, 1 to 1e6; 0 for none, which leaves a router's spindle as it turns.
  double speed = 0;
  double depth_mm = 0;  ///< below Z 0, 0.01 to 1000; routers only
  int tool = 0;         ///< the number of its own tool, 1 to 9999; 0: that of the cuts; routers only
};

/// A mark that is not engraved, because it leaves its part or enters another one.
struct MarkLeftOut {
  std::size_t part = 0, mark = 0;  ///< into the parts, and into the marks of that part
};

/// Marks may stick out of their part, and reach into another one, by no more than this, mm.
inline constexpr double kMarkSlack = 0.01;

}  // namespace lekalo::nc

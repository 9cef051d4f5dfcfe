#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/geom/region.hpp"

namespace lekalo::io {

/// Edges in a row that make a contour but for gaps, and the curve that each comes from.
struct LooseContour {
  geom::Contour edges;
  std::vector<std::uint32_t> curves;
};

/// A gap between two neighbouring edges.
struct ClosedGap {
  geom::Point at;  ///< half way
  double size = 0;
  std::uint32_t before = 0, after = 0;  ///< curves
};

/// A curve, and how far what stands for it in the contour is from what it was, mm, both ways.
struct MovedCurve {
  std::uint32_t curve = 0;
  double moved = 0;
};

struct Closing {
  std::vector<ClosedGap> gaps;    ///< in order, none of size 0
  std::vector<MovedCurve> moved;  ///< a curve may come several times: the largest counts
};

/// Moves an end of an edge: of a line it alone, an arc is turned and stretched about its other end. Returns
/// how far any point of the edge moved at most; nothing, and the edge stays, where the arc's ends are too
/// near.
[[nodiscard]] std::optional<double> move_end(geom::Edge& edge, bool at_end, geom::Point to);

/// Makes each edge begin where the one before ends. Two lines meet half way; a line goes to the end of an
/// arc, which stays as it is; two arcs are turned and stretched a little, each about its other end, to meet
/// half way, arcs of far more than half a turn halved before. An arc whose ends are nearer than four times
/// the gap stays, with a line across the gap. A line that comes to nothing is left out.
[[nodiscard]] Closing close_gaps(LooseContour& contour);

}  // namespace lekalo::io

#pragma once

#include <cstdint>
#include <vector>

#include "contour_mending.hpp"

namespace lekalo::io {

/// Edges in a row that close no contour; between them there may be gaps up to the join tolerance.
struct OpenLine {
  std::vector<geom::Edge> edges;
  std::vector<std::uint32_t> curves;  ///< by edge
  std::vector<std::uint32_t> layers;  ///< by edge
};

/// Lines that hang together because ends of some lie on the inside of others, and what they enclose.
struct TouchingLines {
  std::vector<std::uint32_t> lines;    ///< ascending
  std::vector<LooseContour> contours;  ///< of all bounded faces: neighbours share edges
  std::vector<LooseEdge> left;         ///< what bounds no face
  std::vector<MovedCurve> moved;       ///< how far ends were taken over to the line that they lie on
};

/// Finds groups of lines that touch within `reach`, an end of one on the inside of an edge of its layer, and
/// that enclose a face larger than `smallest`, both mm. In the order of their first lines.
/// Cost: O((n + k) log n), k pairs of edges whose boxes meet.
[[nodiscard]] std::vector<TouchingLines> touching_lines(const std::vector<OpenLine>& lines, double reach,
                                                        double smallest);

}  // namespace lekalo::io

#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/geom/region.hpp"

namespace lekalo::io {

/// Edges in a row that make a contour but for gaps, and the curve that each comes from.
struct LooseContour {
  geom::Contour edges;
  std::vector<std::uint32_t> curves;
};

/// A gap between two neighbouring edges, and how far closing it moved something.
struct ClosedGap {
  geom::Point at;  ///< half way
  double size = 0;
  std::uint32_t before = 0, after = 0;       ///< curves
  double moved_before = 0, moved_after = 0;  ///< mm, bounds for either curve, both ways
};

/// Makes each edge begin where the one before ends. Two lines meet half way; a line goes to the end of an
/// arc, which stays as it is; two arcs meet half way where that changes them little, and have a line between
/// them otherwise. A line that came to nothing is left out. Returns the gaps in order, none of size 0.
[[nodiscard]] std::vector<ClosedGap> close_gaps(LooseContour& contour);

}  // namespace lekalo::io

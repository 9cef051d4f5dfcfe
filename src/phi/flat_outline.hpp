#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::phi {

/// An outline with its box's low corner in the origin, and what is quick to know about it.
struct FlatOutline {
  geom::GridRegion region;  ///< moved to the origin
  std::int64_t width = 0, height = 0;
  bool box = false;  ///< an axis-parallel rectangle without holes
  /// Points inside the material, the one deepest in it first, then others far from those before.
  std::vector<geom::GridPoint> inner;

  /// A span of material in a band as high as two rows: rows [j - 1, j + 1] of some height. Empty: low > high.
  struct Span {
    std::int64_t low = 1, high = 0;
  };
};

[[nodiscard]] FlatOutline flat_outline(geom::GridRegion region);

/// For every j from 0 on, the longest span wholly inside the material between (j - 1) row and (j + 1) row,
/// ends included, until the outline ends. Cost: O(rows x edges).
[[nodiscard]] std::vector<FlatOutline::Span> covered_spans(const FlatOutline& outline, double row);

}  // namespace lekalo::phi

#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::phi {

/// An outline with its box's low corner in the origin, and what is quick to know about it.
struct FlatOutline {
  geom::GridRegion region;  ///< moved to the origin
  std::int64_t width = 0, height = 0;
  struct Edge {
    double x0, y0, x1, y1;
  };
  std::vector<Edge> edges;
  bool box = false;                    ///< an axis-parallel rectangle without holes
  std::uint8_t asked = 0;              ///< questions about it, as far as somebody counts
  std::vector<geom::GridPoint> inner;  ///< inner_points(), once somebody wants them

  /// A span of material in a band as high as two rows: rows [j - 1, j + 1] of some height. Empty: low > high.
  struct Span {
    std::int64_t low = 1, high = 0;
  };
};

/// The answer of a quick look at two outlines.
enum class Overlap { no, yes, unsure };
/// The answer says whether interiors meet, `b` moved by `shift`; unsure where the outlines touch, nearly, or
/// are long. Never wrong. Cost: O(a + b + pairs of edges whose boxes meet), without memory.
[[nodiscard]] Overlap quick_overlap(const FlatOutline& a, const FlatOutline& b,
                                    geom::GridPoint shift) noexcept;

[[nodiscard]] FlatOutline flat_outline(geom::GridRegion region);

/// Points inside the material, the one deepest in it first, then others far from those before: 4, or fewer
/// where the outline is thin. Cost: O(edges).
[[nodiscard]] std::vector<geom::GridPoint> inner_points(const FlatOutline& outline);

/// For every j from 0 on, the longest span wholly inside the material between (j - 1) row and (j + 1) row,
/// ends included, until the outline ends. Cost: O(rows x edges).
[[nodiscard]] std::vector<FlatOutline::Span> covered_spans(const FlatOutline& outline, double row);

}  // namespace lekalo::phi

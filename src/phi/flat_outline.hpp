#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::phi {

/// An outline moved so that the low corner of its box is in the origin, and facts about it that are quick to
/// use.
struct FlatOutline {
  /// The outline, moved to the origin.
  geom::GridRegion region;
  std::int64_t width = 0, height = 0;
  struct Edge {
    double x0, y0, x1, y1;
  };
  std::vector<Edge> edges;
  /// True for an axis-parallel rectangle without holes.
  bool box = false;
  /// The number of questions about the outline, as far as somebody counts them.
  std::uint8_t asked = 0;
  /// The result of inner_points(), once somebody wants it.
  std::vector<geom::GridPoint> inner;

  /// A span of material in a band as high as two rows of some height: rows [j - 1, j + 1]. It is empty where
  /// low > high.
  struct Span {
    std::int64_t low = 1, high = 0;
  };
};

/// The answer of a quick look at two outlines.
enum class Overlap { no, yes, unsure };
/// Says whether interiors meet when `b` is moved by `shift`. The answer is unsure where the outlines touch,
/// nearly touch, or are long, and never wrong. Cost: O(a + b + pairs of edges whose boxes meet), without
/// memory.
[[nodiscard]] Overlap quick_overlap(const FlatOutline& a, const FlatOutline& b,
                                    geom::GridPoint shift) noexcept;

[[nodiscard]] FlatOutline flat_outline(geom::GridRegion region);

/// Returns points inside the material: the one deepest in it first, then others far from those before. There
/// are 4, or fewer where the outline is thin. Cost: O(edges).
[[nodiscard]] std::vector<geom::GridPoint> inner_points(const FlatOutline& outline);

/// Returns, for every j from 0 on until the outline ends, the longest span wholly inside the material between
/// (j - 1) row and (j + 1) row, ends included. Cost: O(rows x edges).
[[nodiscard]] std::vector<FlatOutline::Span> covered_spans(const FlatOutline& outline, double row);

}  // namespace lekalo::phi

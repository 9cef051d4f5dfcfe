#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "contour_mending.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"

namespace lekalo::io {

/// The entity that drew a curve, and by which rule it is filled.
struct CurveOrigin {
  std::uint32_t entity = 0;
  geom::FillRule fill = geom::FillRule::even_odd;
};

/// A contour that was set aside, and the one that it crosses.
struct AsideContour {
  LooseContour contour;
  AsideReason reason = AsideReason::crosses_itself;
  geom::Point at;
  std::optional<std::uint32_t> other;  ///< a curve of the contour that it crosses
};

/// A curve of each of two contours, and a place where they cross.
struct Neighbours {
  std::uint32_t first = 0, second = 0;
  geom::Point at;
};

struct Settled {
  std::vector<geom::Region> regions;
  std::vector<std::uint32_t> curve_of_edge;
  std::vector<LooseEdge> marks;
  std::vector<MovedCurve> moved;
  std::vector<AsideContour> aside;
  /// Outer contours that overlap, as parts do that were drawn too near to each other.
  std::vector<Neighbours> neighbours;
  /// Contours that cross a far larger one, the second, and are marks on it.
  std::vector<Neighbours> lines_on_others;
  /// Curves of contours that run along others and were dropped.
  std::vector<std::uint32_t> dropped;
  std::size_t mends = 0;  ///< how many groups of contours were mended
};

/// Makes regions of closed contours that may cross or touch themselves and each other: mends what `repair`
/// allows, and sets aside the contours that stay in the way. \param origins  by curve
/// Nothing where more edges lie near each other than limits let through.
[[nodiscard]] std::optional<Settled> settled_contours(std::vector<LooseContour> contours,
                                                      const std::vector<CurveOrigin>& origins,
                                                      const MendLimits& limits);

}  // namespace lekalo::io

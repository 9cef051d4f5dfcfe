#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "lekalo/geom/region.hpp"

namespace lekalo::geom {

inline constexpr std::size_t kNoContour = std::numeric_limits<std::size_t>::max();

/// How a contour lies among others.
struct Enclosed {
  std::size_t by = kNoContour;  ///< the innermost contour around it
  std::size_t depth = 0;        ///< how many contours are around it
};

/// Finds what is around each of many contours, by one sweep over the plane from below. Contours that meet may
/// seem to lie in each other in any way, though never in a circle. O(n log n) for n edges.
[[nodiscard]] std::vector<Enclosed> enclosed_contours(const std::vector<const Contour*>& contours);

}  // namespace lekalo::geom

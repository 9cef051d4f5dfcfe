#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::geom::detail {

/// Finds which of many contours hold a point. The index of a contour's edges is made when its box first holds
/// one.
class Containment {
 public:
  /// \pre the contours outlive this
  explicit Containment(std::vector<const Contour*> contours);

  /// Returns the numbers of the other contours around the first point of this one, ascending; for a point on
  /// a contour rounding decides. O(log n + boxes of contours around the point + their edges met by a ray).
  [[nodiscard]] std::vector<std::size_t> around(std::size_t contour);

 private:
  std::vector<const Contour*> contours_;
  /// A tree of the contours' boxes.
  BoxTree tree_;
  std::vector<std::optional<RegionIndex>> indices_;
};

}  // namespace lekalo::geom::detail

#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/region.hpp"
#include "piece.hpp"

namespace lekalo::geom::detail {

/// Which of many contours hold a point, by the parity of their edges on a ray to the right.
class Containment {
 public:
  explicit Containment(const std::vector<const Contour*>& contours);

  /// Numbers of the contours around p, ascending; rounding decides on a contour. O(log n + edges met by the
  /// ray).
  [[nodiscard]] std::vector<std::size_t> holding(Point p) const;

 private:
  std::vector<Piece> pieces_;
  BoxTree tree_;
};

}  // namespace lekalo::geom::detail

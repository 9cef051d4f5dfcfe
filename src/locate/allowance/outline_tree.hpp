#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/geom/point.hpp"
#include "lekalo/geom/polygon.hpp"

namespace lekalo::locate::detail {

/// Boxes over runs of consecutive edges of a closed outline, halved down to single edges. Consecutive edges
/// lie close together, so no sorting is needed. The tree answers exactly what the least
/// geom::distance_to_segment of all edges and geom::locate_point say, in O(log n) for outlines that are not
/// wild.
class OutlineTree {
 public:
  /// \pre ring has at least three points. Cost: O(n).
  explicit OutlineTree(geom::Ring ring);
  /// Returns the distance to the nearest point of the outline: positive inside, negative outside, 0 on it.
  [[nodiscard]] double signed_distance(geom::Point p) const;

 private:
  struct Node {
    geom::Box box;
    std::size_t first = 0, last = 0;  ///< edges first .. last - 1
    /// The node of the second half, or 0 for a single edge. The first half is the next node.
    std::size_t right = 0;
  };
  std::size_t build(std::size_t first, std::size_t last);
  [[nodiscard]] geom::Point end_of(std::size_t edge) const noexcept {
    return ring_[edge + 1 == ring_.size() ? 0 : edge + 1];
  }
  void nearest(std::size_t node, double box_distance, geom::Point p, double margin, double& least) const;
  /// Says whether a ray from p to the right crosses an odd number of edges of the run. Sets on_outline when p
  /// lies on one of the edges looked at.
  [[nodiscard]] bool crossed_odd(std::size_t node, geom::Point p, bool& on_outline) const;

  geom::Ring ring_;
  std::vector<Node> nodes_;
};

}  // namespace lekalo::locate::detail

#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/geom/point.hpp"
#include "lekalo/geom/polygon.hpp"

namespace lekalo::locate::detail {

/// Boxes over runs of consecutive edges of a closed outline, halved down to single edges. Consecutive edges
/// lie close together, so no sorting is needed. Answers exactly what the least
/// geom::distance_to_segment of all edges and geom::locate_point say, in O(log n) for outlines that are not
/// wild.
class OutlineTree {
 public:
  /// At least three points. Cost: O(n).
  explicit OutlineTree(geom::Ring ring);
  /// To the nearest point of the outline, positive inside, negative outside, 0 on it.
  [[nodiscard]] double signed_distance(geom::Point p) const;

 private:
  struct Node {
    geom::Box box;
    std::size_t first = 0, last = 0;  ///< edges first .. last - 1
    std::size_t right = 0;            ///< the second half; the first half is the next node. 0: one edge
  };
  std::size_t build(std::size_t first, std::size_t last);
  [[nodiscard]] geom::Point end_of(std::size_t edge) const noexcept {
    return ring_[edge + 1 == ring_.size() ? 0 : edge + 1];
  }
  void nearest(std::size_t node, double box_distance, geom::Point p, double margin, double& least) const;
  /// Edges of the run that a ray from p to the right crosses are odd in number. Sets on_outline when p lies
  /// on one of the edges looked at.
  [[nodiscard]] bool crossed_odd(std::size_t node, geom::Point p, bool& on_outline) const;

  geom::Ring ring_;
  std::vector<Node> nodes_;
};

}  // namespace lekalo::locate::detail

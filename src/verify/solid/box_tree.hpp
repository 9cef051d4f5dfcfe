#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "verify/number/vec3.hpp"

namespace lekalo::verify {

/// A box along the axes of space.
struct Box3 {
  Near3 low{}, high{};
  void hold(const Box3& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
  }
};
/// Returns the box of an enclosed point.
[[nodiscard]] inline Box3 box_of(const Vec3& p) {
  return {{p[0].low, p[1].low, p[2].low}, {p[0].high, p[1].high, p[2].high}};
}
/// Returns a number that the distance of two boxes is not below.
[[nodiscard]] double gap(const Box3& a, const Box3& b);

/// Says whether two boxes have a point in common.
[[nodiscard]] inline bool meet(const Box3& a, const Box3& b) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (a.low[axis] > b.high[axis] || b.low[axis] > a.high[axis]) return false;
  return true;
}

/// A tree over boxes in space. Each node has the box of all below it, and halves them by their middles.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Box3> boxes);

  [[nodiscard]] const Box3& box(std::uint32_t number) const { return boxes_[number]; }
  [[nodiscard]] const Box3& whole() const { return nodes_.front().box; }

  /// Calls visit(number) for every box that concerns(box), as do those of the nodes around it.
  template <class Concerns, class Visit>
  void visit(const Concerns& concerns, const Visit& visit) const {
    descend(0, concerns, visit);
  }

  /// Calls visit(number, other's number) for the pairs of two trees whose boxes come within `limit` of each
  /// other, the nearer ones first. The limit may shrink on the way.
  template <class Visit>
  void visit_pairs(const BoxTree& other, const double& limit, const Visit& visit) const {
    approach(0, other, 0, limit, visit);
  }

 private:
  struct Node {
    Box3 box;
    std::uint32_t begin, end;  ///< of order_
    std::uint32_t second;      ///< the second child, 0 for a leaf; the first one is the next node
  };

  std::uint32_t build(std::uint32_t begin, std::uint32_t end);

  template <class Concerns, class Visit>
  void descend(std::uint32_t at, const Concerns& concerns, const Visit& visit) const {
    ask();
    const Node& node = nodes_[at];
    if (!concerns(node.box)) return;
    if (node.second != 0) {
      descend(at + 1, concerns, visit);
      descend(node.second, concerns, visit);
      return;
    }
    for (std::uint32_t k = node.begin; k < node.end; ++k)
      if (concerns(boxes_[order_[k]])) visit(order_[k]);
  }

  template <class Visit>
  void approach(std::uint32_t at, const BoxTree& other, std::uint32_t there, const double& limit,
                const Visit& visit) const {
    ask();
    const Node &mine = nodes_[at], &its = other.nodes_[there];
    if (mine.second == 0 && its.second == 0) {
      for (std::uint32_t k = mine.begin; k < mine.end; ++k)
        for (std::uint32_t l = its.begin; l < its.end; ++l)
          if (!(gap(boxes_[order_[k]], other.boxes_[other.order_[l]]) > limit))
            visit(order_[k], other.order_[l]);
      return;
    }
    // The node of more boxes is opened; it is no leaf, because one of the two is none.
    const bool open_mine = mine.end - mine.begin >= its.end - its.begin;
    std::uint32_t near = (open_mine ? at : there) + 1, far = open_mine ? mine.second : its.second;
    const auto to = [&](std::uint32_t child) {
      return open_mine ? gap(nodes_[child].box, its.box) : gap(mine.box, other.nodes_[child].box);
    };
    double to_near = to(near), to_far = to(far);
    if (to_far < to_near) std::swap(near, far), std::swap(to_near, to_far);
    const auto go = [&](std::uint32_t child) {
      if (open_mine)
        approach(child, other, there, limit, visit);
      else
        approach(at, other, child, limit, visit);
    };
    if (!(to_near > limit)) go(near);
    if (!(to_far > limit)) go(far);
  }

  std::vector<Box3> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace lekalo::verify

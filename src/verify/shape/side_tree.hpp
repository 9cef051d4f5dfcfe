#pragma once

#include <cstdint>
#include <vector>

#include "verify/number/span.hpp"

namespace lekalo::verify {

struct Box {
  double low_x, low_y, high_x, high_y;
};
[[nodiscard]] inline bool meet(const Box& a, const Box& b) {
  return a.low_x <= b.high_x && b.low_x <= a.high_x && a.low_y <= b.high_y && b.low_y <= a.high_y;
}
/// Returns a number that the distance of two boxes is not below.
[[nodiscard]] double gap(const Box& a, const Box& b);

/// A tree over the boxes of sides: which ones does a question concern? Each node has the box of all below it,
/// and halves them by their middles.
class SideTree {
 public:
  explicit SideTree(std::vector<Box> boxes);

  [[nodiscard]] std::size_t size() const { return boxes_.size(); }
  [[nodiscard]] const Box& box(std::size_t side) const { return boxes_[side]; }

  /// Calls visit(side) for every side for whose box, and for the boxes of the nodes around it, concerns(box)
  /// is true.
  template <class Concerns, class Visit>
  void visit(const Concerns& concerns, const Visit& visit) const {
    if (!nodes_.empty()) descend(0, concerns, visit);
  }
  /// Calls visit(side) for the sides whose boxes come within `limit` of a box, the nearer half first. The
  /// limit may shrink on the way.
  template <class Visit>
  void visit_near(const Box& from, const double& limit, const Visit& visit) const {
    if (!nodes_.empty()) approach(0, from, limit, visit);
  }

 private:
  struct Node {
    Box box;
    std::uint32_t begin, end;  ///< of order_
    std::uint32_t second;      ///< the second child, 0 for a leaf; the first one is the next node
  };

  std::uint32_t build(std::uint32_t begin, std::uint32_t end);

  template <class Concerns, class Visit>
  void descend(std::uint32_t at, const Concerns& concerns, const Visit& visit) const {
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
  void approach(std::uint32_t at, const Box& from, const double& limit, const Visit& visit) const {
    const Node& node = nodes_[at];
    if (node.second == 0) {
      for (std::uint32_t k = node.begin; k < node.end; ++k)
        if (!(gap(from, boxes_[order_[k]]) > limit)) visit(order_[k]);
      return;
    }
    std::uint32_t near = at + 1, far = node.second;
    double to_near = gap(from, nodes_[near].box), to_far = gap(from, nodes_[far].box);
    if (to_far < to_near) std::swap(near, far), std::swap(to_near, to_far);
    if (!(to_near > limit)) approach(near, from, limit, visit);
    if (!(to_far > limit)) approach(far, from, limit, visit);
  }

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace lekalo::verify

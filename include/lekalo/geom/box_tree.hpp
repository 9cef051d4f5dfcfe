#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/polygon.hpp"

namespace lekalo::geom {

[[nodiscard]] inline bool boxes_meet(const Box& a, const Box& b) noexcept {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

/// A balanced tree of boxes in any order. It visits them in an order that depends on the boxes alone.
/// Building: O(n log n).
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Calls visit(i) for every box i that meets `box`, touching included.
  template <class Visit>
  void visit_meeting(const Box& box, Visit&& visit) const {
    visit_meeting_while(box, [&](std::uint32_t i) { return visit(i), true; });
  }
  /// Does the same until visit returns false. Returns whether it never did.
  template <class Visit>
  bool visit_meeting_while(const Box& box, Visit&& visit) const {
    return nodes_.empty() || descend(0, box, visit);
  }
  /// Calls visit(i, j), i < j, once for every two boxes that meet.
  template <class Visit>
  void visit_pairs(Visit&& visit) const {
    visit_pairs_while([&](std::uint32_t i, std::uint32_t j) { return visit(i, j), true; });
  }
  /// Does the same until visit returns false. Returns whether it never did.
  template <class Visit>
  bool visit_pairs_while(Visit&& visit) const {
    return nodes_.empty() || within(0, visit);
  }

 private:
  struct Node {
    Box box;
    /// The boxes order_[begin] to order_[end - 1].
    std::uint32_t begin = 0, end = 0;
    /// The node of the right child, or 0 in a leaf; the left child is the next node.
    std::uint32_t right = 0;
  };
  static constexpr std::uint32_t kLeaf = 8;

  void build(const std::vector<Box>& boxes, std::uint32_t begin, std::uint32_t end, const Box& box);

  template <class Visit>
  bool descend(std::uint32_t at, const Box& box, Visit& visit) const {
    const Node& node = nodes_[at];
    if (!boxes_meet(node.box, box)) return true;
    if (node.right != 0) return descend(at + 1, box, visit) && descend(node.right, box, visit);
    ask();
    for (std::uint32_t i = node.begin; i < node.end; ++i)
      if (boxes_meet(boxes_[i], box) && !visit(order_[i])) return false;
    return true;
  }

  template <class Visit>
  bool pair(std::uint32_t i, std::uint32_t j, Visit& visit) const {
    if (!boxes_meet(boxes_[i], boxes_[j])) return true;
    return visit(std::min(order_[i], order_[j]), std::max(order_[i], order_[j]));
  }

  template <class Visit>
  bool within(std::uint32_t at, Visit& visit) const {
    const Node& node = nodes_[at];
    if (node.right != 0)
      return within(at + 1, visit) && within(node.right, visit) && between(at + 1, node.right, visit);
    ask();
    for (std::uint32_t i = node.begin; i < node.end; ++i)
      for (std::uint32_t j = i + 1; j < node.end; ++j)
        if (!pair(i, j, visit)) return false;
    return true;
  }

  template <class Visit>
  bool between(std::uint32_t a, std::uint32_t b, Visit& visit) const {
    const Node &left = nodes_[a], &right = nodes_[b];
    if (!boxes_meet(left.box, right.box)) return true;
    const bool split_left = left.right != 0 && left.end - left.begin >= right.end - right.begin;
    if (split_left || (left.right != 0 && right.right == 0))
      return between(a + 1, b, visit) && between(left.right, b, visit);
    if (right.right != 0) return between(a, b + 1, visit) && between(a, right.right, visit);
    ask();
    for (std::uint32_t i = left.begin; i < left.end; ++i) {
      if (!boxes_meet(boxes_[i], right.box)) continue;
      for (std::uint32_t j = right.begin; j < right.end; ++j)
        if (!pair(i, j, visit)) return false;
    }
    return true;
  }

  std::vector<std::uint32_t> order_;
  std::vector<Box> boxes_;   ///< in this order
  std::vector<Node> nodes_;  ///< in preorder
};

}  // namespace lekalo::geom

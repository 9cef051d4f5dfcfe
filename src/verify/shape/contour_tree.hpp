#pragma once

#include <cstdint>
#include <vector>

#include "side_tree.hpp"

namespace lekalo::verify {

/// Says whether two boxes certainly have no point in common. What overflow has spoiled is everywhere.
[[nodiscard]] inline bool surely_apart(const Box& a, const Box& b) {
  return a.high_x < b.low_x || b.high_x < a.low_x || a.high_y < b.low_y || b.high_y < a.low_y;
}

/// Contours as chains of sides: which ones may wind about a point, and how a chain passes it.
///
/// A contour whose box does not hold a point does not wind about it. And a chain whose box does not hold the
/// point passes it as the line between the ends of the chain does, because a box without the point lets the
/// one be drawn into the other. So a row of holes costs a point nothing, and of a long outline only the
/// sides near the point are looked at.
class ContourTree {
 public:
  ContourTree() = default;
  /// \param sides  the boxes of all sides; \param starts  the first side of each contour, and their number
  ContourTree(const SideTree& sides, const std::vector<std::size_t>& starts);

  /// Calls visit(contour) for each whose box may hold something of the given one.
  template <class Visit>
  void visit_about(const Box& place, const Visit& visit) const {
    wholes_.visit([&](const Box& box) { return !surely_apart(box, place); }, visit);
  }
  /// Calls visit(first, last) for the fewest chains of sides that make up a contour, until it returns false.
  /// A chain of several sides has a box that holds nothing of the given one.
  template <class Visit>
  void visit_chains(std::size_t contour, const Box& place, const Visit& visit) const {
    (void)descend(roots_[contour], place, visit);
  }

 private:
  struct Node {
    Box box;
    std::uint32_t first, last;  ///< sides
    std::uint32_t second;       ///< the second child, 0 for a single side; the first one is the next node
  };

  std::uint32_t build(const SideTree& sides, std::uint32_t first, std::uint32_t last);

  template <class Visit>
  [[nodiscard]] bool descend(std::uint32_t at, const Box& place, const Visit& visit) const {
    const Node& node = nodes_[at];
    if (node.second == 0 || surely_apart(node.box, place)) return visit(node.first, node.last);
    return descend(at + 1, place, visit) && descend(node.second, place, visit);
  }

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> roots_;
  SideTree wholes_{std::vector<Box>()};
};

}  // namespace lekalo::verify

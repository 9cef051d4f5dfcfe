#include "contour_tree.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace lekalo::verify {

ContourTree::ContourTree(const SideTree& sides, const std::vector<std::size_t>& starts) {
  std::vector<Box> boxes;
  nodes_.reserve(2 * sides.size());
  for (std::size_t c = 0; c + 1 < starts.size(); ++c) {
    // A contour without sides is a file's mistake, of which the reader has complained.
    if (starts[c] == starts[c + 1]) return;
    const auto first = static_cast<std::uint32_t>(starts[c]),
               last = static_cast<std::uint32_t>(starts[c + 1] - 1);
    roots_.push_back(build(sides, first, last));
    boxes.push_back(nodes_[roots_.back()].box);
  }
  wholes_ = SideTree(std::move(boxes));
}

std::uint32_t ContourTree::build(const SideTree& sides, std::uint32_t first, std::uint32_t last) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({sides.box(first), first, last, 0});
  if (first == last) return at;
  const std::uint32_t middle = std::midpoint(first, last);
  const std::uint32_t one = build(sides, first, middle), two = build(sides, middle + 1, last);
  const Box &a = nodes_[one].box, &b = nodes_[two].box;
  nodes_[at].box = {std::min(a.low_x, b.low_x), std::min(a.low_y, b.low_y), std::max(a.high_x, b.high_x),
                    std::max(a.high_y, b.high_y)};
  nodes_[at].second = two;
  return at;
}

}  // namespace lekalo::verify

#include "lekalo/geom/box_tree.hpp"

#include <numeric>
#include <utility>

namespace lekalo::geom {

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(boxes_.size());
  if (!boxes_.empty()) build(0, static_cast<std::uint32_t>(boxes_.size()));
}

std::uint32_t BoxTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  Box box = boxes_[order_[begin]];
  for (std::uint32_t i = begin + 1; i < end; ++i) {
    const Box& b = boxes_[order_[i]];
    box.low = {std::min(box.low.x, b.low.x), std::min(box.low.y, b.low.y)};
    box.high = {std::max(box.high.x, b.high.x), std::max(box.high.y, b.high.y)};
  }
  nodes_.push_back({box, begin, end, 0});
  if (end - begin <= kLeaf) return at;
  const bool by_x = box.high.x - box.low.x >= box.high.y - box.low.y;
  const auto middle_of = [&](std::uint32_t i) {
    const Box& b = boxes_[i];
    return by_x ? b.low.x + b.high.x : b.low.y + b.high.y;
  };
  // The order is total, so that the halves do not depend on the library's nth_element.
  const auto before = [&](std::uint32_t i, std::uint32_t j) {
    const double a = middle_of(i), b = middle_of(j);
    return a != b ? a < b : i < j;
  };
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto first = order_.begin();
  std::nth_element(first + begin, first + middle, first + end, before);
  // The library's nth_element leaves each half in any order, and the order of visits must not depend on that
  // either.
  if (middle - begin <= kLeaf) std::sort(first + begin, first + middle);
  if (end - middle <= kLeaf) std::sort(first + middle, first + end);
  build(begin, middle);
  nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
  return at;
}

}  // namespace lekalo::geom

#include "side_tree.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <numeric>
#include <utility>
#include "verify/number/span.hpp"

namespace lekalo::verify {
double gap(const Box& a, const Box& b) {
  const double x =
      std::max({0.0, (just(a.low_x) - just(b.high_x)).low, (just(b.low_x) - just(a.high_x)).low});
  const double y =
      std::max({0.0, (just(a.low_y) - just(b.high_y)).low, (just(b.low_y) - just(a.high_y)).low});
  return square_root(squared(just(x)) + squared(just(y))).low;
}

SideTree::SideTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  // A box that overflow has spoiled is everywhere.
  for (Box& box : boxes_)
    if (!std::isfinite(box.low_x + box.low_y + box.high_x + box.high_y))
      box = {-kInfinity, -kInfinity, kInfinity, kInfinity};
  if (!boxes_.empty()) build(0, static_cast<std::uint32_t>(boxes_.size()));
}

std::uint32_t SideTree::build(std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t kLeaf = 4;
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  Box all = boxes_[order_[begin]];
  for (std::uint32_t k = begin; k < end; ++k) {
    const Box& box = boxes_[order_[k]];
    all = {std::min(all.low_x, box.low_x), std::min(all.low_y, box.low_y), std::max(all.high_x, box.high_x),
           std::max(all.high_y, box.high_y)};
  }
  nodes_.push_back({all, begin, end, 0});
  if (end - begin <= kLeaf) return at;
  const bool by_x = all.high_x - all.low_x >= all.high_y - all.low_y;
  // The order is total, so that the halves are the same whatever the library's nth_element does.
  struct Placed {
    double at;
    std::uint32_t side;
    auto operator<=>(const Placed&) const = default;
  };
  std::vector<Placed> placed;
  placed.reserve(end - begin);
  for (std::uint32_t k = begin; k < end; ++k) {
    const Box& box = boxes_[order_[k]];
    const double middles = by_x ? box.low_x + box.high_x : box.low_y + box.high_y;
    placed.push_back({std::isnan(middles) ? 0 : middles, order_[k]});  // of a box that is everywhere
  }
  const std::uint32_t middle = std::midpoint(begin, end);
  std::nth_element(placed.begin(), placed.begin() + (middle - begin), placed.end());
  for (std::uint32_t k = begin; k < end; ++k) order_[k] = placed[k - begin].side;
  for (const auto& [first, last] : {std::pair(begin, middle), std::pair(middle, end)})
    if (last - first <= kLeaf) std::sort(order_.begin() + first, order_.begin() + last);
  build(begin, middle);
  nodes_[at].second = build(middle, end);
  return at;
}

}  // namespace lekalo::verify

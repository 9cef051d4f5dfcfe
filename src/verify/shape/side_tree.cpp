#include "side_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace lekalo::verify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

double gap(const Box& a, const Box& b) {
  const double x =
      std::max({0.0, (just(a.low_x) - just(b.high_x)).low, (just(b.low_x) - just(a.high_x)).low});
  const double y =
      std::max({0.0, (just(a.low_y) - just(b.high_y)).low, (just(b.low_y) - just(a.high_y)).low});
  if (x == 0 || y == 0) return std::max(x, y);
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
  const auto place = [&](std::uint32_t side) {
    const Box& box = boxes_[side];
    return by_x ? box.low_x + box.high_x : box.low_y + box.high_y;
  };
  std::sort(order_.begin() + begin, order_.begin() + end, [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(place(a), a) < std::tuple(place(b), b);
  });
  const std::uint32_t middle = begin + (end - begin) / 2;
  build(begin, middle);
  nodes_[at].second = build(middle, end);
  return at;
}

}  // namespace lekalo::verify

#include "box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lekalo::verify {
namespace {

constexpr std::uint32_t kLeaf = 4;

}  // namespace

double gap(const Box3& a, const Box3& b) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double least = std::max({0.0, a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]});
    sum += least * least;
  }
  // Seven roundings make it longer by less than 2^-50 of it, and where squares are too small for all their
  // digits by less than 2^-500.
  return std::max(0.0, std::sqrt(sum) * (1 - 0x1p-50) - 0x1p-500);
}

BoxTree::BoxTree(std::vector<Box3> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(boxes_.size());
  build(0, static_cast<std::uint32_t>(boxes_.size()));
}

std::uint32_t BoxTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  Box3 box = boxes_[order_[begin]];
  for (std::uint32_t k = begin + 1; k < end; ++k) box.hold(boxes_[order_[k]]);
  nodes_.push_back({box, begin, end, 0});
  ask((end - begin) / 16 + 1);
  if (end - begin <= kLeaf) return at;
  const auto length = [&](std::size_t axis) { return box.high[axis] - box.low[axis]; };
  const std::size_t longest = std::max({0U, 1U, 2U}, [&](auto a, auto b) { return length(a) < length(b); });
  const std::uint32_t half = begin + (end - begin) / 2;
  const auto middle = [&](std::uint32_t number) {
    return std::pair(boxes_[number].low[longest] + boxes_[number].high[longest], number);
  };
  std::ranges::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end, {}, middle);
  build(begin, half);
  const std::uint32_t second = build(half, end);
  nodes_[at].second = second;
  return at;
}

}  // namespace lekalo::verify

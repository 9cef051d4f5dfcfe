#include "lekalo/geom/box_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace lekalo::geom {
namespace {

/// By what the boxes of a node are put in order before it is cut in halves.
enum class Split : std::uint8_t { middle_x, middle_y, width, height };

double measure(const Box& box, Split split) {
  switch (split) {
    case Split::middle_x:
      return box.low.x + box.high.x;
    case Split::middle_y:
      return box.low.y + box.high.y;
    case Split::width:
      return box.high.x - box.low.x;
    case Split::height:
      break;
  }
  return box.high.y - box.low.y;
}

double half_girth(const Box& box) { return (box.high.x - box.low.x) + (box.high.y - box.low.y); }

/// Says if halves with these boxes are hardly worse than those of a cut across the middle. Edges of a contour
/// are halved well as they stand, and that costs nothing.
bool are_good_halves(const Box& all, const Box& first, const Box& second) {
  constexpr double kHardlyWorse = 1.125;
  const double width = all.high.x - all.low.x, height = all.high.y - all.low.y;
  return half_girth(first) + half_girth(second) <= kHardlyWorse * (width + height + std::min(width, height));
}

Box around(const std::vector<Box>& boxes, std::span<const std::uint32_t> which) {
  Box box = boxes[which.front()];
  for (const std::uint32_t i : which) box = joined(box, boxes[i]);
  return box;
}

/// Puts the smaller half by a measure first; within the halves the boxes stay in their order. The order of
/// measures is total, so that the halves do not depend on the library's nth_element. The measures are taken
/// once, side by side: boxes far apart in memory cost more than comparing them.
void halve(const std::vector<Box>& boxes, std::span<std::uint32_t> which, Split split) {
  struct Measured {
    double size;
    std::uint32_t box;
    bool operator<(const Measured& other) const {
      return size != other.size ? size < other.size : box < other.box;
    }
  };
  std::vector<Measured> measured;
  measured.reserve(which.size());
  for (const std::uint32_t i : which) measured.push_back({measure(boxes[i], split), i});
  const std::vector<Measured> in_order = measured;
  const auto middle = measured.begin() + static_cast<std::ptrdiff_t>(measured.size() / 2);
  std::nth_element(measured.begin(), middle, measured.end());
  std::size_t first = 0, second = measured.size() / 2;
  for (const Measured& one : in_order) which[one < *middle ? first++ : second++] = one.box;
}

/// So many boxes are halved by more than their middles where they are, on average, longer than this share of
/// what is around them. The sides of nested squares are: halves by their middles hold sides of both
/// directions and overlap each other down to the leaves. The edges of ordinary outlines are not.
constexpr std::size_t kManyBoxes = 64;
constexpr double kLongShare = 1.0 / 8;

void halve_best(const std::vector<Box>& boxes, std::span<std::uint32_t> which, const Box& all) {
  const Split usual = all.high.x - all.low.x >= all.high.y - all.low.y ? Split::middle_x : Split::middle_y;
  Split best = usual;
  double girths = 0;
  if (which.size() >= kManyBoxes)
    for (const std::uint32_t i : which) girths += half_girth(boxes[i]);
  if (girths > kLongShare * half_girth(all) * static_cast<double>(which.size())) {
    double least = std::numeric_limits<double>::infinity();
    for (const Split split : {usual, Split::middle_x, Split::middle_y, Split::width, Split::height}) {
      halve(boxes, which, split);
      const std::size_t middle = which.size() / 2;
      const double girth =
          half_girth(around(boxes, which.first(middle))) + half_girth(around(boxes, which.subspan(middle)));
      if (girth < least) least = girth, best = split;
    }
  }
  halve(boxes, which, best);
}

}  // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes) : order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (boxes.empty()) return;
  nodes_.reserve(boxes.size());
  build(boxes, 0, static_cast<std::uint32_t>(boxes.size()), around(boxes, order_));
  boxes_.reserve(boxes.size());
  for (const std::uint32_t i : order_) boxes_.push_back(boxes[i]);
}

void BoxTree::build(const std::vector<Box>& boxes, std::uint32_t begin, std::uint32_t end, const Box& box) {
  const std::size_t at = nodes_.size();
  nodes_.push_back({box, begin, end, 0});
  if (end - begin <= kLeaf) return;
  const std::uint32_t middle = begin + (end - begin) / 2;
  const std::span<std::uint32_t> which(order_.data() + begin, end - begin);
  const std::span<const std::uint32_t> left(which.first(middle - begin)),
      right(which.subspan(middle - begin));
  Box first = around(boxes, left), second = around(boxes, right);
  if (!are_good_halves(box, first, second)) {
    halve_best(boxes, which, box);
    first = around(boxes, left), second = around(boxes, right);
  }
  build(boxes, begin, middle, first);
  nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
  build(boxes, middle, end, second);
}

}  // namespace lekalo::geom

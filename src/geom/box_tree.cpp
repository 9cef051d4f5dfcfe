#include "lekalo/geom/box_tree.hpp"

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

Box around(const std::vector<Box>& boxes, std::span<const std::uint32_t> which) {
  Box box = boxes[which.front()];
  for (const std::uint32_t i : which) box = joined(box, boxes[i]);
  return box;
}

/// Puts the smaller half by a measure first. The order is total, so that the halves do not depend on the
/// library's nth_element. The measures are taken once, side by side: boxes far apart in memory cost more than
/// comparing them.
void halve(const std::vector<Box>& boxes, std::span<std::uint32_t> which, Split split) {
  struct Measured {
    double size;
    std::uint32_t box;
  };
  std::vector<Measured> measured;
  measured.reserve(which.size());
  for (const std::uint32_t i : which) measured.push_back({measure(boxes[i], split), i});
  const auto middle = measured.begin() + static_cast<std::ptrdiff_t>(measured.size() / 2);
  std::nth_element(measured.begin(), middle, measured.end(), [](const Measured& a, const Measured& b) {
    return a.size != b.size ? a.size < b.size : a.box < b.box;
  });
  for (std::size_t k = 0; k < which.size(); ++k) which[k] = measured[k].box;
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

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(boxes_.size());
  if (!boxes_.empty()) build(0, static_cast<std::uint32_t>(boxes_.size()));
}

std::uint32_t BoxTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  const std::span<std::uint32_t> which(order_.data() + begin, end - begin);
  const Box box = around(boxes_, which);
  nodes_.push_back({box, begin, end, 0});
  if (end - begin <= kLeaf) return at;
  halve_best(boxes_, which, box);
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto first = order_.begin();
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

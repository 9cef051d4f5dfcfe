#include "cleared_grid.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/region_index.hpp"
#include "mill/path/edge_path.hpp"

namespace lekalo::mill {

using geom::Point;
using geom::Region;

ClearedGrid::ClearedGrid(const Growth& growth, double tool_radius) : done_(growth.fronts.size(), 0) {
  geom::Box box = geom::bounds(growth.cut.back().front().outer);
  for (const Region& region : growth.cut.back()) {
    const geom::Box more = geom::bounds(region.outer);
    box.low = {std::min(box.low.x, more.low.x), std::min(box.low.y, more.low.y)};
    box.high = {std::max(box.high.x, more.high.x), std::max(box.high.y, more.high.y)};
  }
  pitch_ = std::max(0.07 * tool_radius, std::max(box.high.x - box.low.x, box.high.y - box.low.y) / 600);
  low_ = box.low - Point{pitch_, pitch_};
  columns_ = static_cast<std::size_t>((box.high.x - box.low.x) / pitch_) + 4;
  rows_ = static_cast<std::size_t>((box.high.y - box.low.y) / pitch_) + 4;
  owner_.assign(columns_ * rows_, kNone);
  own_start(growth.cut.front());
  for (std::size_t first = 0; first < growth.fronts.size();) {
    std::size_t last = first;
    const std::size_t layer = growth.fronts[first].layer;
    while (last < growth.fronts.size() && growth.fronts[last].layer == layer) ++last;
    own_layer(growth, layer, first, last);
    first = last;
  }
}

void ClearedGrid::own_start(const std::vector<Region>& start) {
  const geom::RegionIndex index(start);
  const geom::Box box = index.bounds();
  for (std::size_t n = 0; n < owner_.size(); ++n) {
    const Point p = node(n);
    if (p.x < box.low.x || p.x > box.high.x || p.y < box.low.y || p.y > box.high.y || !index.contains(p))
      continue;
    owner_[n] = 0;
    rim_.push_back(n);
  }
}

/// Gives the nodes that the layer adds to the layer's nearest front each. The search starts at the rim of the
/// nodes owned so far, because what is new lies beside it.
void ClearedGrid::own_layer(const Growth& growth, std::size_t layer, std::size_t first, std::size_t last) {
  const geom::RegionIndex index(growth.cut[layer]);
  std::vector<std::vector<Point>> places;
  for (std::size_t i = first; i < last; ++i) places.push_back(places_on(growth.fronts[i].edges, 3 * pitch_));
  const auto claim = [&](std::size_t n) {
    double least = std::numeric_limits<double>::infinity();
    const Point p = node(n);
    for (std::size_t i = first; i < last; ++i)
      for (const Point q : places[i - first]) {
        ask();
        const double d = dot(q - p, q - p);
        if (d < least) least = d, owner_[n] = i + 1;
      }
  };
  std::vector<std::size_t> queue = std::move(rim_);
  rim_.clear();
  for (std::size_t i = 0; i < queue.size(); ++i) {
    ask();
    bool on_rim = false;
    around(queue[i], [&](std::size_t m) {
      if (owner_[m] != kNone) return;
      if (!index.contains(node(m))) {
        on_rim = true;
        return;
      }
      claim(m);
      queue.push_back(m);
    });
    if (on_rim) rim_.push_back(queue[i]);
  }
}

std::size_t ClearedGrid::nearest_open(Point p) const {
  std::size_t best = kNone;
  double least = std::numeric_limits<double>::infinity();
  const auto column = static_cast<long>((p.x - low_.x) / pitch_),
             row = static_cast<long>((p.y - low_.y) / pitch_);
  for (long reach = 2; best == kNone && reach < 2 * static_cast<long>(columns_ + rows_); reach *= 2)
    for (long y = std::max(0L, row - reach); y <= std::min(static_cast<long>(rows_) - 1, row + reach); ++y)
      for (long x = std::max(0L, column - reach);
           x <= std::min(static_cast<long>(columns_) - 1, column + reach); ++x) {
        const auto n = static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x);
        if (!is_open(n)) continue;
        const double d = norm(node(n) - p);
        if (d < least) least = d, best = n;
      }
  return best;
}

bool ClearedGrid::is_deep(std::size_t n) const {
  bool deep = true;
  around(n, [&](std::size_t m) { deep = deep && is_open(m); });
  return deep;
}

bool ClearedGrid::is_clear(Point a, Point b) const {
  const double steps = std::max(1.0, std::ceil(norm(b - a) / (0.5 * pitch_)));
  for (double i = 0; i <= steps; ++i) {
    const Point p = a + (i / steps) * (b - a);
    const double x = (p.x - low_.x) / pitch_ + 0.5, y = (p.y - low_.y) / pitch_ + 0.5;
    if (!(x >= 0 && x < static_cast<double>(columns_) && y >= 0 && y < static_cast<double>(rows_)))
      return false;
    if (!is_open(static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x))) return false;
  }
  return true;
}

std::vector<Point> ClearedGrid::way(Point from, Point to) const {
  if (is_clear(from, to)) return {to};
  const std::size_t begin = nearest_open(from), goal = nearest_open(to);
  if (begin == kNone || goal == kNone) return {};
  std::vector<double> cost(owner_.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> back(owner_.size(), kNone);
  using Item = std::pair<double, std::size_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  cost[begin] = 0;
  queue.emplace(norm(node(begin) - node(goal)), begin);
  while (!queue.empty()) {
    ask();
    const std::size_t n = queue.top().second;
    queue.pop();
    if (n == goal) break;
    around(n, [&](std::size_t m) {
      if (!is_open(m)) return;
      // A way that keeps away from what still stands costs less, because it can be pulled straight.
      const double there = cost[n] + (is_deep(m) ? 1 : 4) * norm(node(m) - node(n));
      if (there < cost[m]) {
        cost[m] = there, back[m] = n;
        queue.emplace(there + norm(node(m) - node(goal)), m);
      }
    });
  }
  if (goal != begin && back[goal] == kNone) return {};
  std::vector<Point> nodes{to};
  for (std::size_t n = goal; n != kNone; n = back[n]) nodes.push_back(node(n));
  nodes.push_back(from);
  std::reverse(nodes.begin(), nodes.end());
  std::vector<Point> corners;
  for (std::size_t i = 0; i + 1 < nodes.size();) {
    std::size_t k = nodes.size() - 1;
    while (k > i + 1 && !is_clear(nodes[i], nodes[k])) --k;
    corners.push_back(nodes[k]);
    i = k;
  }
  return corners;
}

}  // namespace lekalo::mill

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/predicates.hpp"
#include "point_hash.hpp"
#include "scan_order.hpp"

namespace lekalo::locate {
namespace {

using geom::Point;

/// Returns twice the median length of the edges, or more where all of them together would run through more
/// than a few cells an edge.
double cell_size(const geom::Ring& points, const std::vector<Loop>& loops) {
  std::vector<double> lengths;
  for (const Loop& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i)
      lengths.push_back(norm(points[loop[(i + 1) % loop.size()]] - points[loop[i]]));
  const double mean =
      std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return std::max(2 * *middle, mean / 8);
}

class EdgeCells {
 public:
  EdgeCells(const geom::Ring& points, const std::vector<Loop>& loops, double cell)
      : points_(points),
        loops_(loops),
        hash_(cell, 1024, geom::largest_coordinate(points)),
        cell_(hash_.cell()) {}

  /// Files the edge under the cells it runs through, and returns the first edge that it meets there, if any.
  std::optional<Crossing> add(std::uint32_t loop, std::uint32_t edge) {
    const std::pair<Point, Point> both = ends(loop, edge);
    const Point a = both.first, b = both.second;
    const std::uint32_t id = static_cast<std::uint32_t>(edges_.size());
    edges_.push_back({loop, edge});
    std::optional<Crossing> found;
    // Columns are gone through one by one, each with the rows between where the edge enters and leaves it,
    // and one row more on each side for rounding.
    const Point low = a.x <= b.x ? a : b, high = a.x <= b.x ? b : a;
    for (std::int64_t x = hash_.index(low.x), end = hash_.index(high.x); x <= end && !found; ++x) {
      ask();
      double y0 = low.y, y1 = high.y;
      if (high.x > low.x) {
        const double slope = (high.y - low.y) / (high.x - low.x);
        const double from = std::max(static_cast<double>(x) * cell_, low.x),
                     to = std::min(static_cast<double>(x + 1) * cell_, high.x);
        y0 = low.y + (from - low.x) * slope;
        y1 = low.y + (to - low.x) * slope;
      }
      const double slack = cell_ / 64;
      for (std::int64_t y = hash_.index(std::min(y0, y1) - slack),
                        top = hash_.index(std::max(y0, y1) + slack);
           y <= top && !found; ++y) {
        hash_.visit_cell(x, y, [&](std::uint32_t other) {
          if (!found && other != id && meet(other, loop, edge, a, b))
            found = Crossing{edges_[other].loop, edges_[other].edge, loop, edge};
        });
        hash_.insert_cell(id, x, y);
      }
    }
    return found;
  }

 private:
  struct LoopEdge {
    std::uint32_t loop = 0, edge = 0;
  };
  [[nodiscard]] std::pair<Point, Point> ends(std::uint32_t loop, std::uint32_t edge) const {
    const Loop& l = loops_[loop];
    return {points_[l[edge]], points_[l[(edge + 1) % l.size()]]};
  }
  [[nodiscard]] bool meet(std::uint32_t other, std::uint32_t loop, std::uint32_t edge, Point a,
                          Point b) const {
    const auto [c, d] = ends(edges_[other].loop, edges_[other].edge);
    const geom::SegmentRelation relation = geom::segment_relation(a, b, c, d);
    if (relation == geom::SegmentRelation::disjoint) return false;
    const std::size_t n = loops_[loop].size();
    const bool neighbours = edges_[other].loop == loop &&
                            ((edges_[other].edge + 1) % n == edge || (edge + 1) % n == edges_[other].edge);
    return !(neighbours && relation == geom::SegmentRelation::touch);
  }

  const geom::Ring& points_;
  const std::vector<Loop>& loops_;
  PointHash hash_;
  double cell_;
  std::vector<LoopEdge> edges_;
};

}  // namespace

std::optional<Crossing> first_crossing(const geom::Ring& points, const std::vector<Loop>& loops) {
  geom::Box box{{1e300, 1e300}, {-1e300, -1e300}};
  for (const Loop& loop : loops)
    for (const std::uint32_t i : loop) {
      const Point p = points[i];
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
    }
  const double extent = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  // An edge passes through at most 2^15 columns and as many rows, however short the others are.
  EdgeCells cells(points, loops, std::max(cell_size(points, loops), 0x1p-15 * extent));
  for (std::uint32_t l = 0; l < loops.size(); ++l)
    for (std::uint32_t e = 0; e < loops[l].size(); ++e)
      if (const auto found = cells.add(l, e)) return found;
  return std::nullopt;
}

}  // namespace lekalo::locate

#include "remnant.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "lekalo/base/stop.hpp"

namespace lekalo::layout {
namespace {

using geom::GridBox;
using geom::GridPoint;
using geom::GridRegion;
using geom::Int128;

using Axis = std::int64_t GridPoint::*;

/// Returns the quotient rounded down, and up. \pre below > 0
std::int64_t floor_of(Int128 above, Int128 below) {
  return static_cast<std::int64_t>(above / below - (above % below < 0 ? 1 : 0));
}
std::int64_t ceiling_of(Int128 above, Int128 below) { return -floor_of(-above, below); }

struct TakenEdge {
  GridPoint from, to;  ///< what is not free lies on the left
};

/// An interval of fractions low / whole to high / whole.
struct Reach {
  Int128 low, high, whole;
};

/// Returns how far along one axis the part of an edge reaches that lies between two values of the other axis,
/// or nothing where no point of it lies between them.
std::optional<Reach> reach_between(const TakenEdge& edge, Axis across, std::int64_t low, std::int64_t high,
                                   Axis along) {
  const bool falls = edge.to.*across < edge.from.*across;
  const GridPoint &a = falls ? edge.to : edge.from, &b = falls ? edge.from : edge.to;
  const std::int64_t rise = b.*across - a.*across, run = b.*along - a.*along;
  if (rise == 0) {
    if (!(low < a.*across && a.*across < high)) return std::nullopt;
    return Reach{std::min(a.*along, b.*along), std::max(a.*along, b.*along), 1};
  }
  const std::int64_t first = std::max(a.*across, low), last = std::min(b.*across, high);
  if (first >= last) return std::nullopt;
  const auto at = [&](std::int64_t value) {
    return Int128{a.*along} * rise + Int128{run} * (value - a.*across);
  };
  return Reach{std::min(at(first), at(last)), std::max(at(first), at(last)), rise};
}

/// Square cells. A cell is free where no edge passes through its inside and its middle is free.
class Cells {
 public:
  explicit Cells(const GridBox& within)
      : low_(within.low),
        cell_(std::max(within.high.x - within.low.x, within.high.y - within.low.y) / kMost + 1),
        columns_((within.high.x - within.low.x) / cell_),
        rows_((within.high.y - within.low.y) / cell_),
        met_(static_cast<std::size_t>(columns_ * rows_), 0),
        change_(static_cast<std::size_t>(columns_ * rows_), 0) {}

  void add(const TakenEdge& edge) {
    const std::int64_t bottom = std::min(edge.from.y, edge.to.y) - low_.y,
                       top = std::max(edge.from.y, edge.to.y) - low_.y;
    if (bottom > rows_ * cell_ || top < 0) return;
    mark(edge, bottom, top);
    if (bottom != top) count(edge, bottom, top);
  }

  /// Returns the largest rectangle of free cells.
  [[nodiscard]] GridBox largest_rectangle() const {
    GridBox best{low_, low_};
    Int128 most = 0;
    // Each row is the base of columns of free cells with some height. A stack of rising heights finds the
    // largest rectangle under them.
    std::vector<std::int64_t> height(static_cast<std::size_t>(columns_) + 1, 0);
    for (std::int64_t y = 0; y < rows_; ++y) {
      ask(1 + static_cast<std::uint64_t>(columns_));
      // Left of everything is no material.
      int taken_by = 1;
      for (std::int64_t x = 0; x < columns_; ++x) {
        taken_by += change_[index(x, y)];
        auto& h = height[static_cast<std::size_t>(x)];
        h = met_[index(x, y)] == 0 && taken_by == 0 ? h + 1 : 0;
      }
      std::vector<std::int64_t> rising;
      for (std::int64_t x = 0; x <= columns_; ++x) {
        while (!rising.empty() &&
               height[static_cast<std::size_t>(rising.back())] >= height[static_cast<std::size_t>(x)]) {
          const std::int64_t h = height[static_cast<std::size_t>(rising.back())];
          rising.pop_back();
          const std::int64_t left = rising.empty() ? 0 : rising.back() + 1;
          if (Int128{h} * (x - left) <= most) continue;
          most = Int128{h} * (x - left);
          best = {low_ + GridPoint{left * cell_, (y - h + 1) * cell_},
                  low_ + GridPoint{x * cell_, (y + 1) * cell_}};
        }
        rising.push_back(x);
      }
    }
    return best;
  }

 private:
  [[nodiscard]] std::size_t index(std::int64_t column, std::int64_t row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }

  /// Marks the cells through whose inside the edge passes.
  void mark(const TakenEdge& edge, std::int64_t bottom, std::int64_t top) {
    const std::int64_t last_row = std::min(rows_, ceiling_of(top, cell_));
    for (std::int64_t row = std::max<std::int64_t>(0, floor_of(bottom, cell_)); row < last_row; ++row) {
      const std::int64_t y = low_.y + row * cell_;
      const auto reach = reach_between(edge, &GridPoint::y, y, y + cell_, &GridPoint::x);
      if (!reach) continue;
      const Int128 left = low_.x * reach->whole, step = cell_ * reach->whole;
      const std::int64_t end = std::min(columns_, ceiling_of(reach->high - left, step));
      for (std::int64_t x = std::max<std::int64_t>(0, floor_of(reach->low - left, step)); x < end; ++x)
        met_[index(x, row)] = 1;
    }
  }

  /// Counts the edge for the middles of the cells to the right of it: what it bounds begins or ends there.
  void count(const TakenEdge& edge, std::int64_t bottom, std::int64_t top) {
    const int change = edge.to.y < edge.from.y ? 1 : -1;
    const std::int64_t rise = 2 * (edge.to.y - edge.from.y), run = edge.to.x - edge.from.x;
    const std::int64_t last_row = std::min(rows_, ceiling_of(2 * top - cell_, 2 * cell_));
    for (std::int64_t row = std::max<std::int64_t>(0, ceiling_of(2 * bottom - cell_, 2 * cell_));
         row < last_row; ++row) {
      const std::int64_t middle = 2 * (low_.y + row * cell_) + cell_;
      const Int128 at = Int128{edge.from.x - low_.x} * rise + Int128{run} * (middle - 2 * edge.from.y);
      // The cell through which the edge passes is marked, and it does not matter how that one counts.
      const std::int64_t x = std::max<std::int64_t>(
          0, ceiling_of(rise > 0 ? at : -at, Int128{cell_} * (rise > 0 ? rise : -rise)));
      if (x < columns_) change_[index(x, row)] += change;
    }
  }

  static constexpr std::int64_t kMost = 192;
  GridPoint low_;
  std::int64_t cell_, columns_, rows_;
  std::vector<char> met_;
  /// By how many outlines more than the cell to the left of it a cell is taken.
  std::vector<int> change_;
};

class FreeSpace {
 public:
  FreeSpace(const GridRegion& material, std::span<const GridRegion> outlines, const GridBox& within)
      : material_(material), outlines_(outlines), within_(within) {}

  [[nodiscard]] GridBox of_cells() const {
    Cells cells(within_);
    each_edge([&](const TakenEdge& edge) { cells.add(edge); });
    return cells.largest_rectangle();
  }

  /// Moves one side of a free rectangle out as far as it stays free.
  void stretch(GridBox& box, Axis along, bool high) const {
    const Axis across = along == &GridPoint::x ? &GridPoint::y : &GridPoint::x;
    const std::int64_t now = high ? box.high.*along : box.low.*along;
    std::int64_t most = high ? within_.high.*along : within_.low.*along;
    each_edge([&](const TakenEdge& edge) {
      const auto reach = reach_between(edge, across, box.low.*across, box.high.*across, along);
      if (!reach) return;
      // No edge passes through the rectangle, so what does not lie beyond this side lies beyond the other.
      if (high && reach->low >= now * reach->whole) most = std::min(most, floor_of(reach->low, reach->whole));
      if (!high && reach->high <= now * reach->whole)
        most = std::max(most, ceiling_of(reach->high, reach->whole));
    });
    // A bare ?: would do, but g++ 12 would assign to a copy of it.
    GridPoint& corner = high ? box.high : box.low;
    corner.*along = most;
  }

 private:
  template <class Visit>
  void each_edge(const Visit& visit) const {
    for (const GridRegion& outline : outlines_)
      each_edge_of(outline, [&](GridPoint from, GridPoint to) { visit({from, to}); });
    each_edge_of(material_, [&](GridPoint from, GridPoint to) { visit({to, from}); });
  }
  template <class Visit>
  static void each_edge_of(const GridRegion& region, const Visit& visit) {
    ask(1 + region.points.size());
    for (std::size_t l = 0; l < region.loops(); ++l) {
      GridPoint from = region.points[region.loop_starts[l + 1] - 1];
      for (std::uint32_t i = region.loop_starts[l]; i < region.loop_starts[l + 1]; ++i) {
        visit(from, region.points[i]);
        from = region.points[i];
      }
    }
  }

  const GridRegion& material_;
  std::span<const GridRegion> outlines_;
  GridBox within_;
};

}  // namespace

GridBox free_rectangle(const GridRegion& material, std::span<const GridRegion> outlines,
                       const GridBox& within) {
  const FreeSpace space(material, outlines, within);
  GridBox box = space.of_cells();
  if (box.low == box.high) return box;
  space.stretch(box, &GridPoint::x, true);
  space.stretch(box, &GridPoint::x, false);
  space.stretch(box, &GridPoint::y, true);
  space.stretch(box, &GridPoint::y, false);
  return box;
}

}  // namespace lekalo::layout

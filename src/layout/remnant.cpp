#include "remnant.hpp"

#include <algorithm>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "lekalo/phi/outline_relation.hpp"

namespace lekalo::layout {
namespace {

using geom::GridBox;
using geom::GridPoint;
using geom::GridRegion;
using geom::Int128;

class FreeSpace {
 public:
  FreeSpace(const Workspace& workspace, Sheet sheet, const GridBox& within)
      : scene_(workspace.scene(sheet)), within_(within) {}

  [[nodiscard]] bool is_free(const GridBox& box) const {
    const GridRegion region = rectangle(box);
    for (const phi::BodyIndex index : scene_.near(box, 0, kPartLayer | kDefectLayer | kBorderLayer)) {
      const phi::Body& body = scene_.body(index);
      const GridRegion& outline = scene_.outline(body.shape);
      if (body.container ? !phi::lies_within(outline, region, -body.at)
                         : phi::interiors_meet(outline, region, -body.at))
        return false;
    }
    return true;
  }

  /// Says whether no cell of a box is free: a body holds all of it, or it is outside.
  [[nodiscard]] bool is_taken(const GridBox& box) const {
    const GridRegion region = rectangle(box);
    for (const phi::BodyIndex index : scene_.near(box, 0, kPartLayer | kDefectLayer | kBorderLayer)) {
      const phi::Body& body = scene_.body(index);
      const GridRegion& outline = scene_.outline(body.shape);
      if (body.container ? !phi::interiors_meet(outline, region, -body.at)
                         : phi::lies_within(outline, region, -body.at))
        return true;
    }
    return false;
  }

  /// Returns the largest rectangle of free cells.
  [[nodiscard]] GridBox of_cells() const {
    const Cells cells = free_cells();
    GridBox best{within_.low, within_.low};
    Int128 most = 0;
    // Each row is the base of columns of free cells with some height. A stack of rising heights finds the
    // largest rectangle under them.
    std::vector<std::int64_t> height(static_cast<std::size_t>(cells.columns) + 1, 0);
    for (std::int64_t y = 0; y < cells.rows; ++y) {
      for (std::int64_t x = 0; x < cells.columns; ++x) {
        auto& h = height[static_cast<std::size_t>(x)];
        h = cells.free[cells.index(x, y)] ? h + 1 : 0;
      }
      std::vector<std::int64_t> rising;
      for (std::int64_t x = 0; x <= cells.columns; ++x) {
        while (!rising.empty() &&
               height[static_cast<std::size_t>(rising.back())] >= height[static_cast<std::size_t>(x)]) {
          const std::int64_t h = height[static_cast<std::size_t>(rising.back())];
          rising.pop_back();
          const std::int64_t left = rising.empty() ? 0 : rising.back() + 1;
          if (Int128{h} * (x - left) <= most) continue;
          most = Int128{h} * (x - left);
          best = box_of(cells, left, y - h + 1, x, y + 1);
        }
        rising.push_back(x);
      }
    }
    return best;
  }

  /// Moves one side out as far as the rectangle stays free.
  void stretch(GridBox& box, std::int64_t GridPoint::*axis, bool high) const {
    std::int64_t good = high ? box.high.*axis : box.low.*axis;
    std::int64_t bad = high ? within_.high.*axis : within_.low.*axis;
    const auto with = [&](std::int64_t value) {
      GridBox tried = box;
      // A bare ?: would do, but g++ 12 would assign to a copy of it.
      GridPoint& corner = high ? tried.high : tried.low;
      corner.*axis = value;
      return tried;
    };
    if (good == bad) return;
    if (is_free(with(bad))) {
      box = with(bad);
      return;
    }
    while (bad - good > 1 || good - bad > 1) {
      const std::int64_t middle = good + (bad - good) / 2;
      (is_free(with(middle)) ? good : bad) = middle;
    }
    box = with(good);
  }

 private:
  static constexpr std::int64_t kCells = 192;
  /// Smaller blocks of cells are not asked whether they are taken as a whole: their cells are as soon asked.
  static constexpr std::int64_t kLeastTaken = 16;

  struct Cells {
    std::int64_t size, columns, rows;
    std::vector<bool> free;
    [[nodiscard]] std::size_t index(std::int64_t x, std::int64_t y) const {
      return static_cast<std::size_t>(y * columns + x);
    }
  };
  /// The box of the cells from (x0, y0) to before (x1, y1).
  [[nodiscard]] GridBox box_of(const Cells& cells, std::int64_t x0, std::int64_t y0, std::int64_t x1,
                               std::int64_t y1) const {
    return {within_.low + GridPoint{x0 * cells.size, y0 * cells.size},
            within_.low + GridPoint{x1 * cells.size, y1 * cells.size}};
  }

  [[nodiscard]] Cells free_cells() const {
    const GridPoint size = within_.high - within_.low;
    Cells cells{std::max(size.x, size.y) / kCells + 1, 0, 0, {}};
    cells.columns = size.x / cells.size, cells.rows = size.y / cells.size;
    cells.free.resize(static_cast<std::size_t>(cells.columns * cells.rows));
    if (!cells.free.empty()) mark_free(cells, 0, 0, cells.columns, cells.rows);
    return cells;
  }

  /// Marks the free cells of a block: all at once, none, or those of its halves. Each cell counts as it would
  /// alone, for what is free as a whole is free in each part, and what is taken is taken.
  void mark_free(Cells& cells, std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) const {
    ask(1);
    const GridBox box = box_of(cells, x0, y0, x1, y1);
    if (is_free(box)) {
      for (std::int64_t y = y0; y < y1; ++y)
        for (std::int64_t x = x0; x < x1; ++x) cells.free[cells.index(x, y)] = true;
      return;
    }
    const std::int64_t width = x1 - x0, height = y1 - y0;
    if (width * height == 1) return;
    if (width * height >= kLeastTaken && is_taken(box)) return;
    if (width >= height) {
      mark_free(cells, x0, y0, x0 + width / 2, y1);
      mark_free(cells, x0 + width / 2, y0, x1, y1);
    } else {
      mark_free(cells, x0, y0, x1, y0 + height / 2);
      mark_free(cells, x0, y0 + height / 2, x1, y1);
    }
  }

  const phi::Scene& scene_;
  GridBox within_;
};

}  // namespace

GridBox free_rectangle(const Workspace& workspace, Sheet sheet, const GridBox& within) {
  const FreeSpace space(workspace, sheet, within);
  GridBox box = space.of_cells();
  if (box.low == box.high) return box;
  space.stretch(box, &GridPoint::x, true);
  space.stretch(box, &GridPoint::x, false);
  space.stretch(box, &GridPoint::y, true);
  space.stretch(box, &GridPoint::y, false);
  return box;
}

}  // namespace lekalo::layout

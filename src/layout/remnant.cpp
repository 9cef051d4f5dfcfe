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

  /// Returns the largest rectangle of free cells.
  [[nodiscard]] GridBox of_cells() const {
    const GridPoint size = within_.high - within_.low;
    const std::int64_t cell = std::max(size.x, size.y) / kCells + 1;
    const std::int64_t columns = size.x / cell, rows = size.y / cell;
    GridBox best{within_.low, within_.low};
    Int128 most = 0;
    // Each row is the base of columns of free cells with some height. A stack of rising heights finds the
    // largest rectangle under them.
    std::vector<std::int64_t> height(static_cast<std::size_t>(columns) + 1, 0);
    for (std::int64_t y = 0; y < rows; ++y) {
      ask(1 + static_cast<std::uint64_t>(columns));
      for (std::int64_t x = 0; x < columns; ++x) {
        const GridPoint low = within_.low + GridPoint{x * cell, y * cell};
        auto& h = height[static_cast<std::size_t>(x)];
        h = is_free({low, low + GridPoint{cell, cell}}) ? h + 1 : 0;
      }
      std::vector<std::int64_t> rising;
      for (std::int64_t x = 0; x <= columns; ++x) {
        while (!rising.empty() &&
               height[static_cast<std::size_t>(rising.back())] >= height[static_cast<std::size_t>(x)]) {
          const std::int64_t h = height[static_cast<std::size_t>(rising.back())];
          rising.pop_back();
          const std::int64_t left = rising.empty() ? 0 : rising.back() + 1;
          if (Int128{h} * (x - left) <= most) continue;
          most = Int128{h} * (x - left);
          best = {within_.low + GridPoint{left * cell, (y - h + 1) * cell},
                  within_.low + GridPoint{x * cell, (y + 1) * cell}};
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

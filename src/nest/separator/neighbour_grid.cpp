#include "neighbour_grid.hpp"

#include <algorithm>
#include <cmath>

#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {

NeighbourGrid::NeighbourGrid(std::size_t items, std::vector<Box> bins, double cell)
    : per_mm_(1 / cell), items_(items) {
  for (const Box& box : bins) {
    Grid grid;
    grid.box = box;
    const auto count = [&](double length, double most) {
      return static_cast<std::uint32_t>(std::clamp(std::ceil(length * per_mm_), 1.0, most));
    };
    grid.rows = count(box.y1 - box.y0, std::sqrt(tuning::kMostCells));
    grid.columns = count(box.x1 - box.x0, tuning::kMostCells / grid.rows);
    grid.cells.resize(std::size_t{grid.columns} * grid.rows);
    grids_.push_back(std::move(grid));
  }
}

NeighbourGrid::Cells NeighbourGrid::cells_of(const Grid& grid, const Box& box) const noexcept {
  const auto index = [&](double at, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(at * per_mm_, 0.0, static_cast<double>(count - 1)));
  };
  return {index(box.x0 - grid.box.x0, grid.columns), index(box.y0 - grid.box.y0, grid.rows),
          index(box.x1 - grid.box.x0, grid.columns), index(box.y1 - grid.box.y0, grid.rows)};
}

void NeighbourGrid::set(std::uint32_t item, std::uint32_t bin, const Box& box) {
  Listed& known = items_[item];
  const Cells cells = bin < grids_.size() ? cells_of(grids_[bin], box) : Cells{};
  if (known.bin == bin && known.cells == cells) return;
  for (std::uint32_t y = known.cells.y0; y <= known.cells.y1; ++y)
    for (std::uint32_t x = known.cells.x0; x <= known.cells.x1; ++x) {
      std::vector<std::uint32_t>& list =
          grids_[known.bin].cells[std::size_t{y} * grids_[known.bin].columns + x];
      list.erase(std::find(list.begin(), list.end(), item));
    }
  known = {bin, cells};
  for (std::uint32_t y = cells.y0; y <= cells.y1; ++y)
    for (std::uint32_t x = cells.x0; x <= cells.x1; ++x)
      grids_[bin].cells[std::size_t{y} * grids_[bin].columns + x].push_back(item);
}

void NeighbourGrid::find(std::uint32_t bin, const Box& box, std::vector<std::uint32_t>& into) const {
  into.clear();
  if (bin >= grids_.size()) return;
  const Cells cells = cells_of(grids_[bin], box);
  for (std::uint32_t y = cells.y0; y <= cells.y1; ++y)
    for (std::uint32_t x = cells.x0; x <= cells.x1; ++x)
      for (const std::uint32_t item : grids_[bin].cells[std::size_t{y} * grids_[bin].columns + x]) {
        // An item is listed once, in the first of the cells that both boxes meet.
        const Cells& own = items_[item].cells;
        if (std::max(own.x0, cells.x0) == x && std::max(own.y0, cells.y0) == y) into.push_back(item);
      }
}

}  // namespace lekalo::nest

#include "neighbour_grid.hpp"

#include <algorithm>
#include <cmath>

#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {

NeighbourGrid::NeighbourGrid(std::size_t items, std::vector<Box> bins, double cell)
    : per_mm_(1 / cell), items_(items) {
  for (const Box& box : bins) {
    Bin bin;
    bin.box = box;
    const auto count = [&](double length, double most) {
      return static_cast<std::uint32_t>(std::clamp(std::ceil(length * per_mm_), 1.0, most));
    };
    bin.rows = count(box.y1 - box.y0, std::sqrt(tuning::kMostCells));
    bin.columns = count(box.x1 - box.x0, tuning::kMostCells / bin.rows);
    bin.cells.resize(std::size_t{bin.columns} * bin.rows);
    bins_.push_back(std::move(bin));
  }
}

NeighbourGrid::Cells NeighbourGrid::cells_of(const Bin& bin, const Box& box) const noexcept {
  const auto index = [&](double at, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(at * per_mm_, 0.0, static_cast<double>(count - 1)));
  };
  return {index(box.x0 - bin.box.x0, bin.columns), index(box.y0 - bin.box.y0, bin.rows),
          index(box.x1 - bin.box.x0, bin.columns), index(box.y1 - bin.box.y0, bin.rows)};
}

void NeighbourGrid::set(std::uint32_t item, std::uint32_t bin, const Box& box) {
  Item& known = items_[item];
  const Cells cells = bin < bins_.size() ? cells_of(bins_[bin], box) : Cells{};
  if (known.bin == bin && known.cells == cells) return;
  for (std::uint32_t y = known.cells.y0; y <= known.cells.y1; ++y)
    for (std::uint32_t x = known.cells.x0; x <= known.cells.x1; ++x) {
      std::vector<std::uint32_t>& list =
          bins_[known.bin].cells[std::size_t{y} * bins_[known.bin].columns + x];
      list.erase(std::find(list.begin(), list.end(), item));
    }
  known = {bin, cells};
  for (std::uint32_t y = cells.y0; y <= cells.y1; ++y)
    for (std::uint32_t x = cells.x0; x <= cells.x1; ++x)
      bins_[bin].cells[std::size_t{y} * bins_[bin].columns + x].push_back(item);
}

void NeighbourGrid::find(std::uint32_t bin, const Box& box, std::vector<std::uint32_t>& into) const {
  into.clear();
  if (bin >= bins_.size()) return;
  const Cells cells = cells_of(bins_[bin], box);
  for (std::uint32_t y = cells.y0; y <= cells.y1; ++y)
    for (std::uint32_t x = cells.x0; x <= cells.x1; ++x)
      for (const std::uint32_t item : bins_[bin].cells[std::size_t{y} * bins_[bin].columns + x]) {
        // An item is listed once, in the first of the cells that both boxes meet.
        const Cells& own = items_[item].cells;
        if (std::max(own.x0, cells.x0) == x && std::max(own.y0, cells.y0) == y) into.push_back(item);
      }
}

}  // namespace lekalo::nest

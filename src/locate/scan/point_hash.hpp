#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "lekalo/geom/point.hpp"

namespace lekalo::locate {

/// Points (or what lies at them) by the square cell they fall in. Cells that hold nothing cost nothing, so
/// one point far away does no harm. Items are visited in an order that depends only on what was inserted.
class PointHash {
 public:
  /// Cells are at least 2^-40 of `largest` wide, the largest coordinate of all that is inserted or asked for,
  /// so that a cell's number is exact.
  /// \pre cell > 0
  PointHash(double cell, std::size_t capacity, double largest)
      : cell_(std::max(cell, 0x1p-40 * largest)), per_cell_(1 / cell_) {
    std::size_t size = 16;
    while (size < 2 * capacity) size *= 2;
    cells_.resize(size);
    next_.reserve(capacity);
    item_.reserve(capacity);
  }

  void insert(std::uint32_t item, geom::Point p) {
    if (2 * (used_ + 1) > cells_.size()) grow();
    Cell& cell = at(index(p.x), index(p.y));
    if (cell.head == kNone) ++used_;
    next_.push_back(cell.head);
    item_.push_back(item);
    cell.head = static_cast<std::uint32_t>(item_.size() - 1);
  }

  /// Calls visit(item) for everything in cells that meet the square of half width `radius` about p.
  template <class Visit>
  void visit_near(geom::Point p, double radius, Visit&& visit) const {
    const std::int64_t x_end = index(p.x + radius), y_end = index(p.y + radius),
                       y_begin = index(p.y - radius);
    for (std::int64_t x = index(p.x - radius); x <= x_end; ++x)
      for (std::int64_t y = y_begin; y <= y_end; ++y)
        for (std::uint32_t at = head(x, y); at != kNone; at = next_[at]) visit(item_[at]);
  }

  /// Calls visit(item) for everything in the cell (x, y), counted in cells.
  template <class Visit>
  void visit_cell(std::int64_t x, std::int64_t y, Visit&& visit) const {
    for (std::uint32_t at = head(x, y); at != kNone; at = next_[at]) visit(item_[at]);
  }
  void insert_cell(std::uint32_t item, std::int64_t x, std::int64_t y) {
    if (2 * (used_ + 1) > cells_.size()) grow();
    Cell& cell = at(x, y);
    if (cell.head == kNone) ++used_;
    next_.push_back(cell.head);
    item_.push_back(item);
    cell.head = static_cast<std::uint32_t>(item_.size() - 1);
  }
  [[nodiscard]] double cell() const noexcept { return cell_; }
  [[nodiscard]] std::int64_t index(double v) const noexcept {
    return static_cast<std::int64_t>(std::floor(v * per_cell_));
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct Cell {
    std::int64_t x = 0, y = 0;
    std::uint32_t head = kNone;
  };

  [[nodiscard]] std::size_t slot(std::int64_t x, std::int64_t y) const noexcept {
    std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15 +
                      static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4f;
    h ^= h >> 29;
    h *= 0xbf58476d1ce4e5b9;
    h ^= h >> 32;
    return static_cast<std::size_t>(h) & (cells_.size() - 1);
  }
  [[nodiscard]] std::uint32_t head(std::int64_t x, std::int64_t y) const noexcept {
    for (std::size_t i = slot(x, y);; i = (i + 1) & (cells_.size() - 1)) {
      const Cell& cell = cells_[i];
      if (cell.head == kNone || (cell.x == x && cell.y == y)) return cell.head;
    }
  }
  Cell& at(std::int64_t x, std::int64_t y) noexcept {
    for (std::size_t i = slot(x, y);; i = (i + 1) & (cells_.size() - 1)) {
      Cell& cell = cells_[i];
      if (cell.head == kNone) {
        cell.x = x;
        cell.y = y;
        return cell;
      }
      if (cell.x == x && cell.y == y) return cell;
    }
  }
  void grow() {
    std::vector<Cell> old(2 * cells_.size());
    old.swap(cells_);
    for (const Cell& cell : old)
      if (cell.head != kNone) at(cell.x, cell.y) = cell;
  }

  double cell_, per_cell_;
  std::vector<Cell> cells_;
  std::size_t used_ = 0;
  std::vector<std::uint32_t> next_, item_;
};

}  // namespace lekalo::locate

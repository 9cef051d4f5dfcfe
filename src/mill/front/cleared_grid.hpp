#pragma once

#include <cstddef>
#include <vector>

#include "fronts.hpp"

namespace lekalo::mill {

/// Finds ways at depth that cut nothing: a grid of places of the tool's middle, each with the front that has
/// to be cut before the tool may pass there.
class ClearedGrid {
 public:
  ClearedGrid(const Growth& growth, double tool_radius);

  void set_done(std::size_t front) { done_[front] = 1; }
  [[nodiscard]] bool is_done(std::size_t front) const { return done_[front] != 0; }
  /// True when a straight way keeps to what is cut.
  [[nodiscard]] bool is_clear(geom::Point a, geom::Point b) const;
  /// Corners of a short way through what is cut, the last of them `to`; none where there is no way.
  [[nodiscard]] std::vector<geom::Point> way(geom::Point from, geom::Point to) const;

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  void own_start(const std::vector<geom::Region>& start);
  void own_layer(const Growth& growth, std::size_t layer, std::size_t first, std::size_t last);
  [[nodiscard]] geom::Point node(std::size_t n) const {
    return low_ + pitch_ * geom::Point{static_cast<double>(n % columns_), static_cast<double>(n / columns_)};
  }
  [[nodiscard]] bool is_open(std::size_t n) const {
    return owner_[n] != kNone && (owner_[n] == 0 || done_[owner_[n] - 1] != 0);
  }
  [[nodiscard]] bool is_deep(std::size_t n) const;
  [[nodiscard]] std::size_t nearest_open(geom::Point p) const;
  template <class Visit>
  void around(std::size_t n, Visit&& visit) const {
    const std::size_t column = n % columns_, row = n / columns_;
    for (std::size_t y = row == 0 ? 0 : row - 1; y <= row + 1 && y < rows_; ++y)
      for (std::size_t x = column == 0 ? 0 : column - 1; x <= column + 1 && x < columns_; ++x)
        if (x != column || y != row) visit(y * columns_ + x);
  }

  geom::Point low_;
  double pitch_ = 1;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::size_t> owner_;  ///< front + 1; 0: the start
  std::vector<std::size_t> rim_;    ///< owned nodes that have a neighbour nobody owns
  std::vector<char> done_;
};

}  // namespace lekalo::mill

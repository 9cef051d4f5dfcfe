#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "nest/table/problem.hpp"

namespace lekalo::nest {

/// Places in rows, a pitch apart, and a sum at each.
struct NodeGrid {
  double x0 = 0, y0 = 0;  ///< the first
  std::uint32_t columns = 0, rows = 0, stride = 0;
  std::vector<float> sums;

  /// Makes it so large, zero everywhere.
  void begin(double from_x, double from_y, std::uint32_t column_count, std::uint32_t row_count);
  /// Readable up to the next multiple of CostGrid::kBlock beyond the columns.
  const float* row(std::uint32_t r) const noexcept { return &sums[std::size_t{r} * stride]; }
  /// Adds those of a grid of the same pitch that begins so many columns and rows before this one and reaches
  /// at least as far, times a weight.
  void add(const NodeGrid& from, std::uint32_t column, std::uint32_t row, float weight);
  /// The first block of a row, from this one on, with a sum below a limit; the number of blocks if none.
  std::uint32_t block_below(std::uint32_t r, std::uint32_t block, float limit) const noexcept;
};

/// What an item would cost at every node of a grid of places: the sum of one raster for each item that lies
/// there, shifted to the node nearest to it. Everywhere at once for the price of some tens of single places;
/// exact to half a pitch, and exactly where everything lies on multiples of the pitch. docs/design/nest.md
class CostGrid {
 public:
  static constexpr std::uint32_t kBlock = 8;  ///< floats added at a time
  /// Of a place, less than which nothing is: depth > 0.
  using PairCost = std::function<float(const Form& fixed, const Form& moved, double dx, double dy)>;

  /// Whether rasters of all pairs of forms take little enough memory. \param parts_only  what belongs to the
  /// stock needs none
  static bool pays(const Problem& problem, double pitch, bool parts_only);
  CostGrid(const Problem& problem, double pitch, PairCost cost);

  double pitch() const noexcept { return pitch_; }
  /// Nodes from 0 to a length.
  std::uint32_t nodes(double length) const noexcept {
    return static_cast<std::uint32_t>(length / pitch_ + 1e-6) + 1;
  }

  /// Adds what an item at (x, y) costs times a weight. Costs are multiples of 2^-14, so that sums of whole
  /// weights are exact up to 1,000: what is added can be taken away without a trace.
  void add(NodeGrid& to, std::uint32_t fixed, std::uint32_t moved, double x, double y, float weight);
  /// What a form costs at every node from the lowest place on a bin that it may have, with the obstacles
  /// there.
  void add_obstacles(NodeGrid& to, const std::vector<Obstacle>& obstacles, std::uint32_t moved);
  /// Nodes added up so far.
  std::uint64_t added() const noexcept { return added_; }

 private:
  /// Costs at shifts (column + c, row + r) x pitch of the moved one from the fixed one.
  struct Raster {
    std::int32_t column = 0, row = 0;
    std::uint32_t columns = 0, rows = 0, stride = 0;
    std::vector<float> values;
  };
  const Raster& raster(std::uint32_t fixed, std::uint32_t moved);
  Box shifts(const Form& fixed, const Form& moved) const;

  const Problem& problem_;
  double pitch_;
  PairCost cost_;
  std::vector<Raster> rasters_;  ///< by fixed and moved form; without rows: not made yet
  std::uint64_t added_ = 0;
};

}  // namespace lekalo::nest

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "nest/table/problem.hpp"

namespace lekalo::nest {

/// Nodes in rows, a pitch apart, and a sum of costs at each.
struct NodeGrid {
  double x0 = 0, y0 = 0;  ///< of the first node, mm
  std::uint32_t columns = 0, rows = 0, stride = 0;
  std::vector<float> sums;

  /// Sets place and size, and all sums to zero.
  void begin(double from_x, double from_y, std::uint32_t column_count, std::uint32_t row_count);
  /// The sums of a row, readable up to the next multiple of CostGrid::kBlock beyond the columns.
  const float* row(std::uint32_t r) const noexcept { return &sums[std::size_t{r} * stride]; }
  /// Adds the sums of another grid times a weight. \pre it has the same pitch, begins so many columns and
  /// rows before this one and reaches at least as far
  void add(const NodeGrid& from, std::uint32_t column, std::uint32_t row, float weight);
  /// The first block of a row, from this one on, with a sum below a limit; the number of blocks if none.
  std::uint32_t block_below(std::uint32_t r, std::uint32_t block, float limit) const noexcept;
};

/// Adds up what an item would cost at every node of a grid: one raster for each item that lies there,
/// shifted to the node nearest to it. That costs as much as some tens of single places. It is exact to half
/// a pitch, and to the bit where everything lies on multiples of the pitch. docs/design/nest.md, step 3.
class CostGrid {
 public:
  static constexpr std::uint32_t kBlock = 8;  ///< floats added at a time
  /// The cost of two forms at this shift of the moved one; 0 where they do not overlap.
  using PairCost = std::function<float(const Form& fixed, const Form& moved, double dx, double dy)>;

  /// True if rasters of all pairs of forms take little enough memory. \param parts_only  shapes of the
  /// stock need none
  static bool pays(const Problem& problem, double pitch, bool parts_only);
  CostGrid(const Problem& problem, double pitch, PairCost cost);

  double pitch() const noexcept { return pitch_; }
  /// The number of nodes from 0 to a length, mm.
  std::uint32_t nodes(double length) const noexcept {
    return static_cast<std::uint32_t>(length / pitch_ + 1e-6) + 1;
  }

  /// Adds what an item at (x, y) costs, times a weight. Costs are multiples of 2^-14, so sums with whole
  /// weights are exact up to 1,000, and what was added can be taken away without a trace.
  void add(NodeGrid& to, std::uint32_t fixed, std::uint32_t moved, double x, double y, float weight);
  /// Adds what a form costs with these obstacles at every node.
  void add_obstacles(NodeGrid& to, const std::vector<Obstacle>& obstacles, std::uint32_t moved);
  /// The nodes added up so far, which is what work is counted by.
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
  std::vector<Raster> rasters_;  ///< by fixed and moved form; one without rows is not made yet
  std::uint64_t added_ = 0;
};

}  // namespace lekalo::nest

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "problem.hpp"

namespace lekalo::nest {

/// What an item would cost at every node of a grid of places: the sum of one raster for each item that lies
/// there, shifted to the node nearest to it. Everywhere at once for the price of some tens of single places;
/// exact to half a pitch, and exactly where everything lies on multiples of the pitch. docs/design/nest.md
class CostGrid {
 public:
  static constexpr std::uint32_t kBlock = 8;  ///< floats added at a time
  /// Of a place, less than which nothing is: depth > 0.
  using PairCost = std::function<float(const Form& fixed, const Form& moved, double dx, double dy)>;

  /// Whether rasters of all pairs of forms take little enough memory.
  static bool pays(const Problem& problem, double pitch);
  CostGrid(const Problem& problem, double pitch, PairCost cost);

  double pitch() const noexcept { return pitch_; }

  /// Begins a grid of columns x rows nodes, zero everywhere; (x0, y0) is the first.
  void begin(double x0, double y0, std::uint32_t columns, std::uint32_t rows);
  /// Adds what an item at (x, y) costs times a weight.
  void add(std::uint32_t fixed, std::uint32_t moved, double x, double y, float weight);
  /// Nodes added up so far.
  std::uint64_t added() const noexcept { return added_; }

  std::uint32_t columns() const noexcept { return columns_; }
  std::uint32_t rows() const noexcept { return rows_; }
  double x0() const noexcept { return x0_; }
  double y0() const noexcept { return y0_; }
  /// Readable up to the next multiple of kBlock beyond columns().
  const float* row(std::uint32_t r) const noexcept { return &sums_[std::size_t{r} * stride_]; }

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
  double x0_ = 0, y0_ = 0;
  std::uint32_t columns_ = 0, rows_ = 0, stride_ = 0;
  std::vector<float> sums_;
  std::uint64_t added_ = 0;
};

}  // namespace lekalo::nest

#pragma once

#include <span>

#include "cost_grid.hpp"
#include "spot.hpp"

namespace lekalo::nest {

/// Keeps, for each form and bin, what the form would cost everywhere there (CostGrid) from one move to the
/// next. Only items that have moved since are taken away and added. The sums are the same to the bit as
/// added up anew.
class CostSums {
 public:
  CostSums(std::size_t bins, std::size_t forms) : forms_(forms), sums_(bins * forms) {}

  /// The cost of everything that lies on a bin at these nodes, each item with weight 1. \param spots  of the
  /// items that move \param fixed  what the rest costs, from the same node on; null where there is no rest
  const NodeGrid& now(CostGrid& grid, std::uint32_t form, std::uint32_t bin, double x0, double y0,
                      std::uint32_t columns, std::uint32_t rows, std::span<const Spot> spots,
                      const NodeGrid* fixed);

 private:
  struct Sums {
    NodeGrid nodes;
    std::vector<Spot> spots;  ///< where everything lay when it was added up
  };
  std::size_t forms_;
  std::vector<Sums> sums_;  ///< by bin and form
};

}  // namespace lekalo::nest

#pragma once

#include <span>

#include "cost_grid.hpp"
#include "spot.hpp"

namespace lekalo::nest {

/// For each form and bin what it would cost there, everywhere at once (CostGrid), kept from one move to the
/// next: only what has moved since is taken away and added. The same to the bit as added up anew.
class CostSums {
 public:
  CostSums(std::size_t bins, std::size_t forms) : forms_(forms), sums_(bins * forms) {}

  /// What everything that lies on a bin costs at these nodes, once each. \param spots  of items that move
  /// \param fixed  what the rest costs, from the same node on; null: nothing
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

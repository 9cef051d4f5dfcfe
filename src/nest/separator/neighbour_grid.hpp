#pragma once

#include <cstdint>
#include <vector>

#include "nest/table/nofit.hpp"

namespace lekalo::nest {

/// Boxes in square cells, so that those near a place are found without a look at all others. Items on
/// another bin are never near.
class NeighbourGrid {
 public:
  /// \param cell  side of a cell, mm
  NeighbourGrid(std::size_t items, std::vector<Box> bins, double cell);

  /// Puts an item there, or nowhere (a bin that is none), in place of where it was.
  void set(std::uint32_t item, std::uint32_t bin, const Box& box);
  /// Finds the items whose cells the box meets, each once. Their order follows from what was set before.
  void find(std::uint32_t bin, const Box& box, std::vector<std::uint32_t>& into) const;

 private:
  struct Cells {
    std::uint32_t x0 = 1, y0 = 1, x1 = 0,
                  y1 = 0;  ///< the last ones are included; x1 < x0 where there are none
    friend bool operator==(const Cells&, const Cells&) = default;
  };
  struct Grid {
    Box box;
    std::uint32_t columns = 0, rows = 0;
    std::vector<std::vector<std::uint32_t>> cells;
  };
  struct Listed {
    std::uint32_t bin = 0;
    Cells cells;
  };
  Cells cells_of(const Grid& grid, const Box& box) const noexcept;

  double per_mm_;            ///< cells a millimetre
  std::vector<Grid> grids_;  ///< by bin
  std::vector<Listed> items_;
};

}  // namespace lekalo::nest

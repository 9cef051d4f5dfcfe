#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/geom/region_index.hpp"

namespace lekalo::locate {

/// Signed distances (positive in material) of the points of a square grid from an outline, each computed when
/// it is first asked for. A distance changes by no more than its point moves, so the value of a grid point
/// bounds that of every point near it.
class DistanceGrid {
 public:
  /// The grid covers the square of half width `half` about `middle`.
  DistanceGrid(const geom::RegionIndex& outline, geom::Point middle, double half);

  struct Value {
    geom::Point at;  ///< the grid point
    /// The signed distance of the grid point.
    double signed_distance = 0;
    geom::Point nearest;     ///< on the outline
    std::uint32_t edge = 0;  ///< of the nearest point
    /// The distance of the point asked about from the grid point.
    double off = 0;
  };
  /// Returns the grid point nearest to q. O(1) but for the first time.
  [[nodiscard]] Value near(geom::Point q);

 private:
  struct Known {
    double signed_distance = 0;
    geom::Point nearest;
    std::uint32_t edge = 0;
    bool known = false;
  };
  const geom::RegionIndex& outline_;
  geom::Point origin_;
  double step_ = 1, per_step_ = 1;
  std::vector<Known> points_;
};

}  // namespace lekalo::locate

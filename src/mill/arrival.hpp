#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::mill {

/// When a front that starts at a region's boundary arrives at each place of a region, on a grid: |grad T| = 1
/// / speed, the speed given by the distance from the region's boundary. Where the speed falls towards the
/// boundary, its level lines come to it almost tangent.
class ArrivalField {
 public:
  /// Speed at distance d from the walls: that of the next step of a pass of convex radius bend * d, not
  /// below `least`.
  struct Law {
    double tool_radius = 0, step = 0;
    double beyond = 0;  ///< mm from the region's boundary to the walls
    double bend = 2;
    double least = 0.1;  ///< of the step
  };

  /// \pre pitch > 0
  ArrivalField(const geom::RegionIndex& allowed, const std::vector<geom::Region>& start, double pitch,
               const Law& law);

  [[nodiscard]] double speed(double distance) const;
  /// The latest arrival at a node inside.
  [[nodiscard]] double last() const { return last_; }
  /// Whether the front arrives at every node inside.
  [[nodiscard]] bool reaches_all() const { return reaches_all_; }
  /// The places that are reached before `time`, and some beyond the boundary of what is allowed: smooth
  /// stretches as lines and arcs within kFit of the level line of the interpolated field.
  [[nodiscard]] Result<std::vector<geom::Region>> before(double time) const;

 private:
  struct Place {
    geom::Point at;
    bool smooth = true;  ///< between two nodes of known arrival
  };
  void measure(const geom::RegionIndex& allowed);
  void march(const std::vector<geom::Region>& start);
  void extend();
  void update(std::size_t n, std::vector<std::pair<double, std::size_t>>& heap);
  [[nodiscard]] std::vector<std::vector<Place>> level_lines(double time) const;
  [[nodiscard]] geom::Point node(std::size_t n) const {
    return low_ + pitch_ * geom::Point{static_cast<double>(n % columns_), static_cast<double>(n / columns_)};
  }

  Law law_;
  double pitch_;
  geom::Point low_;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<double> depth_;    ///< distance from the boundary, negative outside
  std::vector<double> arrival_;  ///< infinite where nothing arrives
  std::vector<char> accepted_;
  /// Least and largest arrival in and around squares of nodes, where all are known.
  struct Square {
    double first, last;
  };
  void find_squares();
  std::vector<Square> squares_;
  std::size_t squares_across_ = 0;
  double last_ = 0;
  bool reaches_all_ = true;
};

}  // namespace lekalo::mill

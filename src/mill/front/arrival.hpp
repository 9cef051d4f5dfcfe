#pragma once

#include <optional>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/field/arrival.hpp"
#include "lekalo/field/level_lines.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::mill {

/// When a front that starts at a region's boundary arrives at each place of a region, on a grid
/// (field::arrival_times), the speed given by the distance from the region's boundary. Where the speed falls
/// towards the boundary, its level lines come to it almost tangent.
class ArrivalField {
 public:
  /// Speed at distance d from the walls: that of the next step of a pass of convex radius bend * d, not
  /// below `least`.
  struct Law {
    double tool_radius = 0, step = 0;
    double cosine = 0;  ///< of the angle that the next step is to hold
    double beyond = 0;  ///< mm from the region's boundary to the walls
    double bend = 2;
    double least = 0.1;  ///< of the step
  };

  /// \pre pitch > 0
  ArrivalField(const geom::RegionIndex& allowed, const std::vector<geom::Region>& start, double pitch,
               const Law& law);
  ArrivalField(const ArrivalField&) = delete;
  ArrivalField& operator=(const ArrivalField&) = delete;

  [[nodiscard]] double speed(double distance) const;
  /// The latest arrival at a node inside.
  [[nodiscard]] double last() const { return arrival_.last; }
  /// Whether the front arrives at every node inside.
  [[nodiscard]] bool reaches_all() const { return arrival_.reaches_all; }
  /// The places that are reached before `time`, and some beyond the boundary of what is allowed: smooth
  /// stretches as lines and arcs within kFit of the level line of the interpolated field.
  [[nodiscard]] Result<std::vector<geom::Region>> before(double time) const;

 private:
  Law law_;
  field::ArrivalTimes arrival_;
  std::optional<field::LevelLines> lines_;  ///< of arrival_
};

}  // namespace lekalo::mill

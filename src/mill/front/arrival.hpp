#pragma once

#include <optional>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/field/arrival.hpp"
#include "lekalo/field/level_lines.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::mill {

/// Step 3 of docs/design/pocket.md: the time at which a front that starts at one region's boundary arrives at
/// each place of another region, on a grid (field::arrival_times). Its speed depends on the distance from the
/// boundary; where the speed falls towards it, level lines come to the boundary almost tangent.
class ArrivalField {
 public:
  /// The speed at distance d from the walls is the step that a pass of convex radius bend * d may be followed
  /// by, but not below `least`.
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
  /// True when the front arrives at every node inside.
  [[nodiscard]] bool reaches_all() const { return arrival_.reaches_all; }
  /// The places that are reached before `time`, and some beyond the boundary of what is allowed. Smooth
  /// stretches are lines and arcs within kFit of the level line of the interpolated field.
  [[nodiscard]] Result<std::vector<geom::Region>> before(double time) const;

 private:
  Law law_;
  field::ArrivalTimes arrival_;
  std::optional<field::LevelLines> lines_;  ///< of arrival_
};

}  // namespace lekalo::mill

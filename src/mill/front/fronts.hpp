#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::mill {

/// A curve that is cut as one pass: from wall to wall, tangent to both, or closed.
struct Front {
  std::vector<geom::Edge> edges;  ///< what is cut before lies on their left
  bool closed = false;
  std::vector<std::size_t> parents;  ///< fronts that are to be cut before
  std::size_t layer = 0;             ///< of Growth::cut after it
  bool loop = false;                 ///< half a circle of a trochoid, from its right wall to its left
  bool slot = false;                 ///< in full material, to be cut in its direction
  /// The ways to a loop from where the loop before begins, or ends, to where this one does; they are cut too.
  std::vector<geom::Point> right_lead, left_lead;
};

/// The fronts that grow from a start, layer by layer, until they fill what is allowed.
struct Growth {
  std::vector<Front> fronts;  ///< in layers
  std::vector<std::vector<geom::Region>>
      cut;  ///< places of the tool's middle after each layer; [0] the start
};

struct GrowthLaw {
  double tool_radius = 0;  ///< mm
  double step = 0;         ///< mm between straight passes, at most
  double wall_strip = 0;   ///< mm between the fields and the walls
  /// rad of the rim in material on a straight pass: what others hold but for a few per cent.
  double angle = 0;
};

/// The walls that bound the fronts: those of the fields, but for the mouths of corridors.
struct FieldWalls {
  const geom::RegionIndex &fields, &limit, &narrow;
  double strip = 0;  ///< mm from the fields to the limit
};

/// Hears now and then how much is planned to be cut, mm2 of the places of the tool's middle.
using AreaListener = std::function<void(double)>;

/// Grows fronts from `start`, which is cut, through `fields` and, by loops, through corridors (`narrow`) that
/// lead from one field to another or are large: steps 4 and 5 of docs/design/pocket.md. The tool's middle may
/// be in `limit`. Errors: as geom::combine.
[[nodiscard]] Result<Growth> grow(const geom::RegionIndex& limit, const std::vector<geom::Region>& fields,
                                  const std::vector<geom::Region>& narrow,
                                  const std::vector<geom::Region>& start, const GrowthLaw& law,
                                  const AreaListener& listener);

/// The pass that cuts a front, in its direction or back. It leaves the wall on an arc, and omits the way
/// along the wall at its end, because the pass along all walls cuts that.
[[nodiscard]] std::vector<geom::Edge> pass_along(const Front& front, bool back, const FieldWalls& walls,
                                                 const geom::RegionIndex& before, double step);

/// Stretches of the boundary of `cut` that are not nearly in `before`, as fronts without parents.
[[nodiscard]] std::vector<Front> fresh_stretches(const std::vector<geom::Region>& cut,
                                                 const geom::RegionIndex& before);

}  // namespace lekalo::mill

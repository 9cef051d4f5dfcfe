#pragma once

#include "lekalo/geom/region_index.hpp"

namespace lekalo::locate {

struct Ball {
  geom::Point centre;
  double radius = 0;
};

/// A part ball in the part's material (centre counted from the pivot) and a blank ball without material.
/// Whatever the pose, the clearance is at most |T(part.centre) - blank.centre| - part.radius - blank.radius,
/// as long as that is not below -blank.radius. Balls of radius 0 are points of the outlines.
struct BallPair {
  Ball part, blank;
};

/// Returns the largest ball, up to `most`, that touches the outline at `at` from the side of `direction` (a
/// unit vector along the outline's normal) and holds no point of the outline in its inside. It has radius 0
/// at `at` where none of a useful size fits (a corner). The caller knows which side the ball is on. `doubt`
/// is what rounding may have moved the outline and what it will move the centre, and the radius is that much
/// smaller.
///
/// Source: the shrinking ball of Ma, Bae and Choi 2012 (3D medial axis point approximation), here on exact
/// nearest points of lines and arcs. Cost: a few nearest-point queries.
[[nodiscard]] Ball tangent_ball(const geom::RegionIndex& outline, geom::Point at, geom::Point direction,
                                double most, double least, double doubt);

}  // namespace lekalo::locate

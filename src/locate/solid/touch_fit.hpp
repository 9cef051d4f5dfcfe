#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/solid/triangle_tree.hpp"
#include "solid_frame.hpp"

namespace lekalo::locate {

/// The place of the nominal surface that is nearest to a touch.
struct TouchedPlace {
  solid::Vector place, normal;  ///< the normal leads out of the material; coordinates of the nominal mesh
  double height = 0;            ///< of the touch over the surface, negative inside, mm
};
[[nodiscard]] TouchedPlace touched_place(const solid::TriangleTree& nominal, solid::Vector touch);

/// Goes from a pose to one at which the nominal surface fits the touches well, in the squares of what they
/// lie off it. Those that are far off, as seen from the others, hardly count, so that an outlier does not
/// draw the mesh to itself. It proves nothing. \param radius  how high touches have to be over the surface,
/// mm
[[nodiscard]] FramedPose fitted(const solid::TriangleTree& nominal, const SolidFrame& frame,
                                const std::vector<solid::Vector>& touches, double radius);

}  // namespace lekalo::locate

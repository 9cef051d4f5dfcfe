#pragma once

#include <array>
#include <cstdint>

#include "lekalo/solid/principal_axes.hpp"
#include "solid_meter.hpp"

namespace lekalo::locate {

/// The pose that turns the axes of the part onto three others, which are across each other and right-handed,
/// and has its centre of volume at `centre`.
[[nodiscard]] FramedPose aligned(const SolidFrame& frame, const solid::PrincipalAxes& part,
                                 const std::array<solid::Vector, 3>& axes, solid::Vector centre);

/// The first climb of every method. It begins at the middle of the window; where that has every rotation, or
/// every turn about z, also from some of the rotations all over it that have the part stick out least, those
/// among them that bring the axes of inertia of part and blank together, and the best place counts. Arguments
/// and stops as for climb().
[[nodiscard]] MeasuredSolid first_climb(const SolidMeter& meter, double trust, double enough,
                                        const RunControl& run, std::uint64_t& work);

}  // namespace lekalo::locate

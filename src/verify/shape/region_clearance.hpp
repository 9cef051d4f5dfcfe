#pragma once

#include <limits>
#include <optional>

#include "shape.hpp"
#include "touching.hpp"
#include "verify/number/interval.hpp"

namespace lekalo::verify {

/// Returns rotation and shift of a placement, enclosed.
[[nodiscard]] Motion motion_of(const Interval& theta, Span x, Span y, bool mirrored);

/// Encloses the clearance of a placed part in a blank: the least signed distance of a point of the part from
/// the blank's boundary, positive inside. The enclosure is within a few last places of the coordinates where
/// the part lies in the blank, and within 1e-9 mm where it sticks out and that takes little work. Where the
/// part touches and `shift` says how it was placed without rotation, the result is exactly 0 if
/// touches_from_inside shows it.
/// Where it is surely below `claimed` nothing more is looked for, and the low end is a rough one.
/// \pre shapes without a fault
[[nodiscard]] Span clearance(const Shape& part, const Shape& placed_part, const Shape& blank,
                             const std::optional<ExactShift>& shift,
                             double claimed = -std::numeric_limits<double>::infinity());

}  // namespace lekalo::verify

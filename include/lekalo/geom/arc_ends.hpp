#pragma once

#include <algorithm>

#include "lekalo/geom/region.hpp"

namespace lekalo::geom {

/// Returns how far the ends of an arc may differ in their distance from its centre, mm: kArcConsistency, and
/// kArcConsistencyRelative of the radius, the latter up to an eighth of the chord. A millionth of a radius of a
/// thousand kilometres is a metre, and an arc of a few millimetres would then mean no curve at all.
[[nodiscard]] inline double allowed_radius_difference(const Edge& arc) noexcept {
  const double radius = std::max(norm(arc.from - arc.centre), norm(arc.to - arc.centre));
  return kArcConsistency + std::min(kArcConsistencyRelative * radius, norm(arc.to - arc.from) / 8);
}

}  // namespace lekalo::geom

#pragma once

#include "lekalo/geom/edge_distance.hpp"

namespace lekalo::io {

/// The unit direction from the centre to the middle of an arc, within rounding.
/// \pre an arc, not a full circle
[[nodiscard]] inline geom::Point towards_middle(const geom::Curve& arc) noexcept {
  const geom::Point first = (1 / norm(arc.first)) * arc.first, last = (1 / norm(arc.last)) * arc.last;
  const geom::Point sum = first + last;
  const double length = norm(sum);
  if (!(length > 0x1p-20)) return perpendicular(first);  // half a turn, counter-clockwise from first
  return (arc.wide ? -1 / length : 1 / length) * sum;
}

/// The point of an arc half way along it.
[[nodiscard]] inline geom::Point middle_of(const geom::Curve& arc) noexcept {
  return arc.edge.centre + arc.radius * towards_middle(arc);
}

}  // namespace lekalo::io

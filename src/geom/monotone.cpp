#include "monotone.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::geom::detail {

/// An end may miss the circle by half the difference of the radii. Where the circle is nearly level, the
/// circle at the end's height is much further off along the ray. So the x goes no further than this quarter
/// of the stretch reaches, and the jump from the end to the circle stays as near to the arc as its end is.
double arc_x_at(const Monotone& stretch, double y) noexcept {
  const double radius = stretch.curve->radius;
  const Point centre = stretch.curve->edge.centre;
  const Point begin = stretch.begin, end = stretch.end;
  const double h = y - centre.y, side = stretch.right ? 1 : -1;
  const double half = std::sqrt(std::max(0.0, (radius - h) * (radius + h)));
  const Point low = begin.y <= end.y ? begin : end, high = begin.y <= end.y ? end : begin;
  const Point outer = h >= 0 ? high : low, inner = h >= 0 ? low : high;
  const bool beyond_axis = h >= 0 ? inner.y < centre.y : inner.y >= centre.y;
  const auto [least, most] = std::minmax({outer.x, beyond_axis ? centre.x + side * radius : inner.x});
  return std::clamp(centre.x + side * half, least, most);
}

}  // namespace lekalo::geom::detail

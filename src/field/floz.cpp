#include "lekalo/field/floz.hpp"

#include <algorithm>

namespace lekalo::field {

FlozSegment floz_segment(geom::Point a, geom::Point b) noexcept {
  if (b.x < a.x || (b.x == a.x && b.y < a.y)) std::swap(a, b);
  const double length = norm(b - a);
  return {0.5 * (a + b), (1 / length) * (b - a), length};
}

Jet floz(const FlozSegment& s, geom::Point x, FlozForm form) noexcept {
  const geom::Point from_middle = x - s.middle, normal = perpendicular(s.along);
  const double f = dot(normal, from_middle);
  const double t = s.length / 4 - dot(from_middle, from_middle) / s.length;
  const geom::Point dt = (-2 / s.length) * from_middle;
  const double u = f * f / s.length, root = std::sqrt(u * u + t * t);
  // root - t without cancellation.
  const double over = t > 0 ? u * u / (root + t) : root - t;
  if (!(root > 0)) return {0, {}};  // an end of the segment
  const geom::Point du = (2 * f / s.length) * normal;
  const geom::Point d_over = (1 / root) * (u * du + t * dt) - dt;
  if (form == FlozForm::algebraic) return {u + over, du + d_over};
  const double g = over / 2, value = std::sqrt(f * f + g * g);
  if (!(value > 0)) return {0, {}};
  return {value, (1 / value) * (f * normal + (g / 2) * d_over)};
}

/// max(0, -t) <= (sqrt(t^2 + u^2) - t) / 2 <= max(0, -t) + u / 2 with u = f^2 / L, and both f and |x - c|
/// change by at most the radius.
FlozBounds floz_bounds(const FlozSegment& s, geom::Point x, double radius, FlozForm form) noexcept {
  const geom::Point from_middle = x - s.middle;
  const double f = std::abs(cross(s.along, from_middle)), off = norm(from_middle);
  const double f_low = std::max(0.0, f - radius), f_high = f + radius;
  const double off_low = std::max(0.0, off - radius), off_high = off + radius;
  const double past_low = std::max(0.0, off_low * off_low / s.length - s.length / 4);
  const double past_high = std::max(0.0, off_high * off_high / s.length - s.length / 4);
  const double u_low = f_low * f_low / s.length, u_high = f_high * f_high / s.length;
  constexpr double kRounding = 1e-14;  // relative, of either end
  FlozBounds bounds;
  if (form == FlozForm::algebraic)
    bounds = {u_low + 2 * past_low, 2 * u_high + 2 * past_high};
  else
    bounds = {std::sqrt(f_low * f_low + past_low * past_low),
              std::sqrt(f_high * f_high + (past_high + u_high / 2) * (past_high + u_high / 2))};
  const double slack = kRounding * (bounds.high + off_high + s.length);
  return {std::max(0.0, bounds.low - slack), bounds.high + slack};
}

}  // namespace lekalo::field

#include "start.hpp"

#include <fmt/core.h>

#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/phi/convex.hpp"

namespace lekalo::locate {
namespace {

using geom::Point;

double triangle_area(Point a, Point b, Point c) noexcept { return 0.5 * cross(b - a, c - a); }

}  // namespace

OutlineMoments outline_moments(const geom::ConvexPolygon& polygon) noexcept {
  // Everything is computed relative to one vertex, so that a small part far from the origin keeps its digits.
  const Point anchor = polygon[0];
  double length = 0;
  Point first;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i] - anchor, b = polygon[polygon.next(i)] - anchor;
    const double edge = norm(b - a);
    length += edge;
    first = first + (0.5 * edge) * (a + b);
  }
  const Point centre = (1 / length) * first;
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i] - anchor - centre, b = polygon[polygon.next(i)] - anchor - centre;
    const double third = norm(b - a) / 3;
    xx += third * (a.x * a.x + a.x * b.x + b.x * b.x);
    yy += third * (a.y * a.y + a.y * b.y + b.y * b.y);
    xy += third * (a.x * a.y + 0.5 * (a.x * b.y + a.y * b.x) + b.x * b.y);
  }
  return {anchor + centre, 0.5 * geom::direction_angle(xx - yy, 2 * xy)};
}

Point random_point(const geom::ConvexPolygon& polygon, Random& random) noexcept {
  const Point apex = polygon[0];
  double area = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    area += triangle_area(apex, polygon[i], polygon[i + 1]);
  double remaining = random.uniform() * area;
  std::size_t i = 1;
  for (; i + 2 < polygon.size(); ++i) {
    const double triangle = triangle_area(apex, polygon[i], polygon[i + 1]);
    if (remaining < triangle) break;
    remaining -= triangle;
  }
  double u = random.uniform(), v = random.uniform();
  // The point lies in the other half of the parallelogram and is turned back.
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return apex + u * (polygon[i] - apex) + v * (polygon[i + 1] - apex);
}

Result<void> check_window(const AngleWindow& window) {
  const auto usable = [](double angle) { return std::abs(angle) <= geom::kMaxAngle; };
  if (!usable(window.from) || !usable(window.to) || !(window.from <= window.to)) {
    return failure(ErrorCode::usage,
                   fmt::format("The angle window from {} to {} radians must run upwards between -{} and {}.",
                               window.from, window.to, geom::kMaxAngle, geom::kMaxAngle));
  }
  return {};
}

std::optional<double> fold_into(const AngleWindow& window, double angle) noexcept {
  const double turns = std::ceil((window.from - angle) / kTurn);
  // Rounding may put the angle just below the window or leave it a turn too high, so the neighbours are tried
  // too.
  for (const double extra : {-1.0, 0.0, 1.0}) {
    const double folded = angle + (turns + extra) * kTurn;
    if (folded >= window.from && folded <= window.to) return folded;
  }
  // The angle is within rounding of the seam.
  if (window.full_circle()) return window.from;
  return std::nullopt;
}

double nearest_in(const AngleWindow& window, double angle) noexcept {
  if (const auto inside = fold_into(window, angle)) return *inside;
  const auto distance = [](double a, double b) { return std::abs(std::remainder(a - b, kTurn)); };
  return distance(angle, window.from) <= distance(angle, window.to) ? window.from : window.to;
}

Point translation_onto(Point from, Point to, double theta) noexcept {
  return to - geom::BlankFromPart::from_angle(theta, {}).rotate(from);
}

std::array<double, 2> aligned_axes(const OutlineMoments& part, const OutlineMoments& blank) noexcept {
  const double angle = blank.axis - part.axis;
  return {angle, angle + kPi};
}

Placement measured_placement(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank, double x,
                             double y, double theta) noexcept {
  return {x, y, theta, phi::clearance_enclosure(part, blank, x, y, theta).low};
}

}  // namespace lekalo::locate

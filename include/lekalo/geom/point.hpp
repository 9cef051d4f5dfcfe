#pragma once

#include <cmath>

namespace lekalo::geom {

/// A point or a vector of the plane, millimetres, y up.
struct Point {
  double x = 0, y = 0;
  friend constexpr bool operator==(const Point&, const Point&) = default;
};

[[nodiscard]] constexpr Point operator+(Point a, Point b) noexcept { return {a.x + b.x, a.y + b.y}; }
[[nodiscard]] constexpr Point operator-(Point a, Point b) noexcept { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] constexpr Point operator-(Point a) noexcept { return {-a.x, -a.y}; }
[[nodiscard]] constexpr Point operator*(double k, Point a) noexcept { return {k * a.x, k * a.y}; }
[[nodiscard]] constexpr double dot(Point a, Point b) noexcept { return a.x * b.x + a.y * b.y; }
/// Returns the z component of a x b, which is positive when b lies counter-clockwise of a.
[[nodiscard]] constexpr double cross(Point a, Point b) noexcept { return a.x * b.y - a.y * b.x; }
/// Returns a turned by +90 degrees.
[[nodiscard]] constexpr Point perpendicular(Point a) noexcept { return {-a.y, a.x}; }
[[nodiscard]] inline double norm(Point a) noexcept { return std::sqrt(dot(a, a)); }

}  // namespace lekalo::geom

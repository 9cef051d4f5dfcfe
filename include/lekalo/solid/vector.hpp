#pragma once

#include <cmath>

namespace lekalo::solid {

/// A point or a vector of space, millimetres, right-handed, z up.
struct Vector {
  double x = 0, y = 0, z = 0;
  friend constexpr bool operator==(const Vector&, const Vector&) = default;
};

[[nodiscard]] constexpr Vector operator+(Vector a, Vector b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] constexpr Vector operator-(Vector a, Vector b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] constexpr Vector operator-(Vector a) noexcept { return {-a.x, -a.y, -a.z}; }
[[nodiscard]] constexpr Vector operator*(double k, Vector a) noexcept { return {k * a.x, k * a.y, k * a.z}; }
[[nodiscard]] constexpr double dot(Vector a, Vector b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] constexpr Vector cross(Vector a, Vector b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline double norm(Vector a) noexcept { return std::sqrt(dot(a, a)); }

}  // namespace lekalo::solid

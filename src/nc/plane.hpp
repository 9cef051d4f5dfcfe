#pragma once

#include "interpreter.hpp"
#include "lekalo/geom/double_double.hpp"

namespace lekalo::nc {

/// Vectors in grains with 32 digits. The rotation is as good as exact, so that a difference from it is the
/// rounding of the written numbers and nothing else.
struct Vector {
  geom::DoubleDouble x, y;
};

[[nodiscard]] inline Vector operator+(const Vector& a, const Vector& b) noexcept {
  return {a.x + b.x, a.y + b.y};
}
[[nodiscard]] inline Vector operator-(const Vector& a, const Vector& b) noexcept {
  return {a.x - b.x, a.y - b.y};
}
[[nodiscard]] inline Vector operator*(const geom::DoubleDouble& k, const Vector& a) noexcept {
  return {k * a.x, k * a.y};
}

/// \pre |value| < 2^106, which every coordinate keeps: then the two parts hold it exactly.
[[nodiscard]] inline geom::DoubleDouble to_double_double(Grains value) noexcept {
  const auto high = static_cast<double>(value);
  return {high, static_cast<double>(value - static_cast<Grains>(high))};
}
[[nodiscard]] inline Vector to_vector(const GridPoint& p) noexcept {
  return {to_double_double(p.x), to_double_double(p.y)};
}

/// Length in double-double; exactly zero for the zero vector.
[[nodiscard]] inline geom::DoubleDouble length(const Vector& v) noexcept {
  const geom::DoubleDouble square = v.x * v.x + v.y * v.y;
  return square.hi > 0 ? geom::sqrt(square) : geom::DoubleDouble{};
}

/// Length in millimetres.
[[nodiscard]] inline double millimetres(const Vector& grains) noexcept {
  return length(grains).hi / kGrainsPerMillimetre;
}

/// The nearest whole number of `step`s.
[[nodiscard]] Wide steps_nearest(const geom::DoubleDouble& grains, Grains step) noexcept;

/// `p -> R p + t` from program to machine, in grains.
class RigidMotion {
 public:
  RigidMotion(double x_mm, double y_mm, double theta) noexcept;

  [[nodiscard]] Vector rotate(const Vector& v) const noexcept {
    return {turn_.cosine * v.x - turn_.sine * v.y, turn_.sine * v.x + turn_.cosine * v.y};
  }
  [[nodiscard]] Vector operator()(const Vector& p) const noexcept { return rotate(p) + shift_; }
  [[nodiscard]] Vector operator()(const GridPoint& p) const noexcept { return (*this)(to_vector(p)); }
  [[nodiscard]] const Vector& shift() const noexcept { return shift_; }
  /// A pure shift keeps directions: differences of points need no rewriting.
  [[nodiscard]] bool turns() const noexcept { return turns_; }

 private:
  geom::SinCosPair turn_;
  Vector shift_;
  bool turns_;
};

}  // namespace lekalo::nc

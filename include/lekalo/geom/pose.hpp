#pragma once

#include "lekalo/geom/point.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::geom {

/// Names of frames. A pose says in its type from which frame it maps into which, so that two poses compose
/// only where the inner frames agree; anything else does not compile (tests/compile_fail).
struct PartFrame;     ///< in which the part and its NC program are written
struct BlankFrame;    ///< in which the blank was measured
struct MachineFrame;  ///< of the machine tool

/// Rigid motion `p -> R p + t`, R the rotation with the stored cosine and sine. The pair is computed once
/// (sincos below) and carried, never recomputed from an angle.
template <class To, class From>
struct Pose {
  double cosine = 1, sine = 0;
  Point translation;

  [[nodiscard]] static Pose from_angle(double theta, Point t) noexcept {
    const SinCos sc = sincos(theta);
    return {sc.cosine, sc.sine, t};
  }
  [[nodiscard]] constexpr Point rotate(Point v) const noexcept {
    return {cosine * v.x - sine * v.y, sine * v.x + cosine * v.y};
  }
  [[nodiscard]] constexpr Point operator()(Point p) const noexcept { return rotate(p) + translation; }
  [[nodiscard]] constexpr Pose<From, To> inverse() const noexcept {
    const Pose<From, To> turned{cosine, -sine, {}};
    return {cosine, -sine, -turned.rotate(translation)};
  }
};

/// `a_from_b * b_from_c == a_from_c`.
template <class A, class B, class C>
[[nodiscard]] constexpr Pose<A, C> operator*(const Pose<A, B>& a_from_b, const Pose<B, C>& b_from_c) noexcept {
  return {a_from_b.cosine * b_from_c.cosine - a_from_b.sine * b_from_c.sine,
          a_from_b.sine * b_from_c.cosine + a_from_b.cosine * b_from_c.sine,
          a_from_b(b_from_c.translation)};
}

using BlankFromPart = Pose<BlankFrame, PartFrame>;

}  // namespace lekalo::geom

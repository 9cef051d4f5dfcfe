#pragma once

#include "lekalo/geom/point.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::geom {

/// Names of frames. A pose says in its type from which frame it maps into which, so that two poses compose
/// only where the inner frames agree; anything else does not compile (tests/compile_fail).
struct PartFrame;     ///< the frame in which the part and its NC program are written
struct BlankFrame;    ///< the frame in which the blank was measured
struct MachineFrame;  ///< the frame of the machine tool

/// Rigid motion `p -> R M p + t`: R the rotation with the stored cosine and sine, M the change of sign of x
/// where `mirrored`, else nothing. The pair is computed once (sincos) and carried, never recomputed from an
/// angle; its rounding makes the motion rigid only within kSinCosError, which every guarantee counts in.
///
/// Laws (tests/property/geom_pose_test.cpp), exact for quarter turns on a grid, within rounding elsewhere:
///   (1) pose.inverse()(pose(p)) == p
///   (2) (a * b)(p) == a(b(p))
///   (3) cross(pose.rotate(v), pose.rotate(w)) == cross(v, w), with the other sign where mirrored
template <class To, class From>
struct Pose {
  double cosine = 1, sine = 0;
  Point translation;
  bool mirrored = false;

  [[nodiscard]] static Pose from_angle(double theta, Point t, bool mirror = false) noexcept {
    const SinCos sc = sincos(theta);
    return {sc.cosine, sc.sine, t, mirror};
  }
  /// A direction is moved by the motion without its translation.
  [[nodiscard]] constexpr Point rotate(Point v) const noexcept {
    const double x = mirrored ? -v.x : v.x;
    return {cosine * x - sine * v.y, sine * x + cosine * v.y};
  }
  [[nodiscard]] constexpr Point operator()(Point p) const noexcept { return rotate(p) + translation; }
  [[nodiscard]] constexpr Pose<From, To> inverse() const noexcept {
    // M R^-1 == R M: a mirrored turn undoes itself.
    const Pose<From, To> back{cosine, mirrored ? sine : -sine, {}, mirrored};
    return {back.cosine, back.sine, -back.rotate(translation), mirrored};
  }
};

/// `a_from_b * b_from_c == a_from_c`.
template <class A, class B, class C>
[[nodiscard]] constexpr Pose<A, C> operator*(const Pose<A, B>& a_from_b,
                                             const Pose<B, C>& b_from_c) noexcept {
  // M R == R^-1 M: a mirror on the left turns the inner rotation round.
  const double inner_sine = a_from_b.mirrored ? -b_from_c.sine : b_from_c.sine;
  return {a_from_b.cosine * b_from_c.cosine - a_from_b.sine * inner_sine,
          a_from_b.sine * b_from_c.cosine + a_from_b.cosine * inner_sine, a_from_b(b_from_c.translation),
          a_from_b.mirrored != b_from_c.mirrored};
}

using BlankFromPart = Pose<BlankFrame, PartFrame>;

}  // namespace lekalo::geom

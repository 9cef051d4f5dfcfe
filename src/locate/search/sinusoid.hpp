#pragma once

#include <array>
#include <cmath>

#include "lekalo/geom/trig.hpp"

namespace lekalo::locate {

/// An angle with its sine and cosine, computed once.
struct Angle {
  double theta = 0;
  geom::SinCos direction;
  [[nodiscard]] static Angle of(double theta) noexcept { return {theta, geom::sincos(theta)}; }
};

/// The function theta -> mean + a cos(theta) + b sin(theta).
struct Sinusoid {
  double mean = 0, a = 0, b = 0;

  [[nodiscard]] double at(const Angle& angle) const noexcept {
    return mean + (a * angle.direction.cosine + b * angle.direction.sine);
  }
  [[nodiscard]] double slope_at(const Angle& angle) const noexcept {
    return b * angle.direction.cosine - a * angle.direction.sine;
  }
  /// Says whether the crest may lie inside [lo, hi], an interval shorter than pi.
  [[nodiscard]] bool may_crest_within(const Angle& lo, const Angle& hi) const noexcept {
    // A slope within rounding of zero counts as a crest, because the crest's value is then right to second
    // order.
    const double doubt = 1e-15 * (std::abs(a) + std::abs(b));
    return slope_at(lo) > -doubt && slope_at(hi) < doubt;
  }
  [[nodiscard]] double amplitude() const noexcept { return std::sqrt(a * a + b * b); }
  [[nodiscard]] double crest_angle() const noexcept { return geom::direction_angle(a, b); }
};

/// Returns the largest value over [lo, hi], an interval shorter than pi, within 8 u (|mean| + |a| + |b|) of
/// the true one.
[[nodiscard]] inline double max_over(const Sinusoid& f, const Angle& lo, const Angle& hi) noexcept {
  const double ends = std::fmax(f.at(lo), f.at(hi));
  return f.may_crest_within(lo, hi) ? std::fmax(ends, f.mean + f.amplitude()) : ends;
}

/// The angles strictly inside (lo, hi), an interval shorter than pi, where f and g are equal: none, one or
/// two, in no order. They are found by the half-angle substitution about the middle, which keeps its digits
/// on short intervals.
struct CrossingAngles {
  std::array<double, 2> theta{};
  int count = 0;
};

[[nodiscard]] inline CrossingAngles crossings(const Sinusoid& f, const Sinusoid& g, double lo,
                                              double hi) noexcept {
  const double middle = lo + 0.5 * (hi - lo);
  const geom::SinCos sc = geom::sincos(middle);
  const double mean = f.mean - g.mean, a0 = f.a - g.a, b0 = f.b - g.b;
  const double a = a0 * sc.cosine + b0 * sc.sine, b = b0 * sc.cosine - a0 * sc.sine;
  // The equation mean + a cos(phi) + b sin(phi) = 0 with z = tan(phi / 2) is (mean - a) z^2 + 2 b z + (mean +
  // a) = 0.
  const double discriminant = a * a + b * b - mean * mean;
  CrossingAngles found;
  if (!(discriminant >= 0)) return found;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  const auto add = [&](double numerator, double denominator) {
    if (denominator == 0 || !(std::abs(numerator) < std::abs(denominator))) return;  // |phi| < pi / 2
    const double z = numerator / denominator;
    const double theta = middle + geom::direction_angle(1 - z * z, 2 * z);
    if (theta > lo && theta < hi) found.theta[static_cast<std::size_t>(found.count++)] = theta;
  };
  add(q, mean - a);
  add(mean + a, q);
  return found;
}

}  // namespace lekalo::locate

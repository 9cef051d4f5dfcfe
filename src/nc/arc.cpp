#include "arc.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::nc {
namespace {

/// Half chord over radius from which LinuxCNC (its TINY) and others take an arc by radius for a half circle.
constexpr double kHalfCircle = 1 - 1e-12;

double sweep_between(const Vector& from, const Vector& to, bool clockwise) noexcept {
  const double first = geom::direction_angle(from.x.hi, from.y.hi);
  const double last = geom::direction_angle(to.x.hi, to.y.hi);
  const double sweep = clockwise ? first - last : last - first;
  return sweep > 0 ? sweep : sweep + kTurn;
}

double half_chord_over_radius(const Vector& start, const Vector& end,
                              const geom::DoubleDouble& radius) noexcept {
  return std::abs((length(end - start) / (geom::DoubleDouble{2.0} * radius)).hi);
}

/// asin(x) <= x / sqrt(1 - x^2), without the math library; \pre 0 <= x < 1
double arc_sine_bound(double x) noexcept { return x / std::sqrt(1 - x * x); }

}  // namespace

Arc arc_by_centre(const Vector& start, const Vector& end, const Vector& centre, bool clockwise,
                  bool end_is_start) noexcept {
  Arc arc{start, end, centre};
  arc.start_radius = millimetres(start - centre);
  arc.end_radius = millimetres(end - centre);
  arc.sweep = end_is_start ? kTurn : sweep_between(start - centre, end - centre, clockwise);
  return arc;
}

bool spans_diameter(const Vector& start, const Vector& end, const geom::DoubleDouble& radius) noexcept {
  return half_chord_over_radius(start, end, radius) > kHalfCircle;
}

Arc arc_by_radius(const Vector& start, const Vector& end, const geom::DoubleDouble& radius,
                  bool clockwise) noexcept {
  const geom::DoubleDouble half{0.5};
  const Vector chord = end - start;
  Vector centre = start + half * chord;
  if (!spans_diameter(start, end, radius)) {
    const geom::DoubleDouble chord_length = length(chord), half_chord = half * chord_length;
    const geom::DoubleDouble height = geom::sqrt((radius - half_chord) * (radius + half_chord));
    // Left of the chord for the short way counter-clockwise and the long way clockwise.
    const bool left = clockwise == (radius.hi < 0);
    const geom::DoubleDouble along = (left ? height : -height) / chord_length;
    centre = centre + along * Vector{-chord.y, chord.x};
  }
  return arc_by_centre(start, end, centre, clockwise, false);
}

bool radii_agree(const Arc& arc, LengthUnit unit) noexcept {
  const bool inch = unit == LengthUnit::inch;
  const double smallest = 0.00005 * kMillimetresPerInch;
  const double allowed = 2 * std::sqrt(2.0) * (inch ? 0.001 * kMillimetresPerInch : 0.01);
  const double low = std::min(arc.start_radius, arc.end_radius),
               high = std::max(arc.start_radius, arc.end_radius);
  if (!(low >= smallest)) return false;
  return high - low <= allowed || (high - low <= 0.001 * high && high - low <= 100 * allowed);
}

bool radii_nearly_agree(const Arc& arc) noexcept {
  const double low = std::min(arc.start_radius, arc.end_radius),
               high = std::max(arc.start_radius, arc.end_radius);
  return low >= 0.00005 * kMillimetresPerInch && high - low <= std::min(0.5, 0.02 * high);
}

bool radius_reaches(const Vector& start, const Vector& end, const geom::DoubleDouble& radius) noexcept {
  const double half_chord = millimetres(end - start) / 2;
  return half_chord - std::abs(radius.hi) / kGrainsPerMillimetre <= 0.00005 * kMillimetresPerInch;
}

Vector in_plane(const Vector& p, const geom::DoubleDouble& z, int plane) noexcept {
  if (plane == 170) return p;
  return plane == 180 ? Vector{z, p.x} : Vector{p.y, z};
}

bool same_point(const Vector& a, const Vector& b) noexcept {
  const Vector way = a - b;
  return way.x.hi == 0 && way.y.hi == 0;
}

ArcEnds arc_ends(const Motion& motion) noexcept {
  return {in_plane(to_vector(motion.start), to_double_double(motion.start_z), motion.plane),
          in_plane(to_vector(motion.end), to_double_double(motion.end_z), motion.plane)};
}

Arc motion_arc(const Motion& motion) noexcept {
  const auto [start, end] = arc_ends(motion);
  if (motion.kind == MotionKind::arc_by_radius)
    return arc_by_radius(start, end, to_double_double(motion.radius), motion.clockwise);
  const Vector centre = in_plane(to_vector(motion.centre), to_double_double(motion.centre_z), motion.plane);
  return arc_by_centre(start, end, centre, motion.clockwise, same_point(start, end));
}

std::optional<double> arc_deviation(const Arc& exact, const Arc& written) noexcept {
  const double at_centre = millimetres(written.centre - exact.centre);
  const double at_start = millimetres((written.start - written.centre) - (exact.start - exact.centre));
  const double at_end = millimetres((written.end - written.centre) - (exact.end - exact.centre));
  constexpr double kFar = 0.1;  // of the radius: beyond, nothing here needs to be said
  if (!(at_start < kFar * exact.start_radius && at_end < kFar * exact.end_radius)) return std::nullopt;

  const double start_turn = arc_sine_bound(at_start / exact.start_radius);
  const double end_turn = arc_sine_bound(at_end / exact.end_radius);
  // The directions at the ends turned by no more than this, so a larger change is a full turn won or lost.
  if (!(std::abs(written.sweep - exact.sweep) <= start_turn + end_turn + 1e-12)) return std::nullopt;
  const double radial = std::max(at_start, at_end);
  const double tangential = std::max(exact.start_radius, exact.end_radius) * std::max(start_turn, end_turn);
  return at_centre + radial + tangential;
}

}  // namespace lekalo::nc

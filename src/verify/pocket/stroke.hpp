#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace lekalo::verify {

/// A place or direction of the plane in plain doubles, mm.
struct Place {
  double x = 0, y = 0;
};
[[nodiscard]] inline Place operator+(Place a, Place b) { return {a.x + b.x, a.y + b.y}; }
[[nodiscard]] inline Place operator-(Place a, Place b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] inline Place operator*(double k, Place a) { return {k * a.x, k * a.y}; }
[[nodiscard]] inline double dot(Place a, Place b) { return a.x * b.x + a.y * b.y; }
[[nodiscard]] inline double cross(Place a, Place b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline double length(Place a) { return std::sqrt(dot(a, a)); }
[[nodiscard]] inline Place unit(Place a) { return (1 / length(a)) * a; }
[[nodiscard]] inline Place left_of(Place a) { return {-a.y, a.x}; }

/// Returns the angle from a counter-clockwise to b in (-pi, pi], within 1e-15. It is computed by our own
/// series, so that every build gives the same.
[[nodiscard]] double angle_between(Place a, Place b);

/// A line, or an arc of at most a quarter turn (with rounding), short enough that all of it is near its ends.
struct Stroke {
  bool arc = false, ccw = true;
  Place from, to, centre;
  /// The radius of an arc: the mean of its ends'.
  double radius = 0;
};

[[nodiscard]] double length(const Stroke& stroke);
/// Returns the unit direction of travel at a place on the stroke.
/// \pre a stroke of positive length
[[nodiscard]] Place heading(const Stroke& stroke, Place at);
/// Says whether the direction lies in the cone of an arc, or is none.
[[nodiscard]] bool faces(const Stroke& arc, Place direction);
/// Returns the place on the stroke that is nearest.
[[nodiscard]] Place nearest_on(const Stroke& stroke, Place p);
[[nodiscard]] double distance(Place p, const Stroke& stroke);
/// Returns the least distance of two strokes that do not cross. Where they cross the result may be larger
/// than 0.
[[nodiscard]] double distance_apart(const Stroke& a, const Stroke& b);
/// Adds the points where two strokes cross. Tangent points that rounding leaves open are left out, and
/// strokes on one carrier have none.
void add_crossings(const Stroke& a, const Stroke& b, std::vector<Place>& places);
/// Says whether a ray from p to the right meets the stroke, which is half open in y.
/// \pre the stroke is monotone in y
[[nodiscard]] bool crosses_ray_to_the_right(const Stroke& stroke, Place p);
/// Returns the part up to a place on the stroke; beginning() returns the part from a place on.
[[nodiscard]] Stroke until(const Stroke& stroke, Place at);
[[nodiscard]] Stroke beginning(const Stroke& stroke, Place at);
/// Returns a place at a share t of the way, by halving angles for arcs, which is not exactly by length. t is
/// in [0, 1].
[[nodiscard]] Place at_share(const Stroke& stroke, double t);

/// Adds a line in pieces no longer than `longest`.
void add_line(Place from, Place to, double longest, std::vector<Stroke>& strokes);
/// Adds an arc of any sweep in pieces no longer than `longest`; from == to is a full turn.
void add_arc(Place from, Place to, Place centre, bool ccw, double longest, std::vector<Stroke>& strokes);

}  // namespace lekalo::verify

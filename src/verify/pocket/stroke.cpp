#include "stroke.hpp"

#include <algorithm>

#include "lekalo/base/angle.hpp"

namespace lekalo::verify {
namespace {

/// Returns the arctangent of t in [0, 1]: t is halved twice to at most tan(pi / 16), and the series does the
/// rest.
double small_arctangent(double t) {
  for (int i = 0; i < 2; ++i) t /= 1 + std::sqrt(1 + t * t);
  const double q = t * t;
  double sum = 0;
  for (int k = 23; k >= 1; k -= 2) sum = 1.0 / k - q * sum;
  return 4 * t * sum;
}

Place on_circle(const Stroke& arc, Place direction) {
  return arc.centre + (arc.radius / length(direction)) * direction;
}

void keep_if_on(const Stroke& a, const Stroke& b, Place p, std::vector<Place>& places) {
  const double slack = 1e-9;
  if (distance(p, a) <= slack && distance(p, b) <= slack) places.push_back(p);
}

void line_with_circle(const Stroke& line, const Stroke& arc, std::vector<Place>& places) {
  const Place way = unit(line.to - line.from);
  const double off = cross(way, arc.centre - line.from);
  const double root = arc.radius * arc.radius - off * off;
  if (!(root >= 0)) return;  // nor is it for a line of no length, whose way is no number
  const Place foot = line.from + dot(way, arc.centre - line.from) * way;
  const double half = std::sqrt(root);
  keep_if_on(line, arc, foot + half * way, places);
  keep_if_on(line, arc, foot - half * way, places);
}

void circle_with_circle(const Stroke& a, const Stroke& b, std::vector<Place>& places) {
  const Place between = b.centre - a.centre;
  const double apart = length(between);
  if (!(apart > 1e-12)) return;
  const double along = (apart * apart + a.radius * a.radius - b.radius * b.radius) / (2 * apart);
  const double root = a.radius * a.radius - along * along;
  if (!(root >= 0)) return;
  const Place way = (1 / apart) * between, foot = a.centre + along * way;
  const double half = std::sqrt(root);
  keep_if_on(a, b, foot + half * left_of(way), places);
  keep_if_on(a, b, foot - half * left_of(way), places);
}

/// Halves an arc of at most a quarter turn until the pieces are short enough.
void add_halved(const Stroke& arc, double longest, std::vector<Stroke>& strokes) {
  if (length(arc) <= longest) {
    strokes.push_back(arc);
    return;
  }
  const Place middle = at_share(arc, 0.5);
  add_halved(until(arc, middle), longest, strokes);
  add_halved(beginning(arc, middle), longest, strokes);
}

}  // namespace

double angle_between(Place a, Place b) {
  const double y = cross(a, b), x = dot(a, b);
  const double high = std::max(std::abs(x), std::abs(y)), low = std::min(std::abs(x), std::abs(y));
  if (!(high > 0)) return 0;
  double angle = small_arctangent(low / high);
  if (std::abs(y) > std::abs(x)) angle = kPi / 2 - angle;
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

double length(const Stroke& s) {
  if (!s.arc) return length(s.to - s.from);
  return s.radius * std::abs(angle_between(s.from - s.centre, s.to - s.centre));
}

Place heading(const Stroke& s, Place at) {
  if (!s.arc) return unit(s.to - s.from);
  const Place out = unit(at - s.centre);
  return s.ccw ? left_of(out) : -1.0 * left_of(out);
}

/// The third product tells the cone from the one opposite, which is within the first two where the end of an
/// arc is a rounding before its beginning.
bool faces(const Stroke& arc, Place direction) {
  const double hand = arc.ccw ? 1 : -1;
  return hand * cross(arc.from - arc.centre, direction) >= 0 &&
         hand * cross(direction, arc.to - arc.centre) >= 0 &&
         dot(direction, arc.from + arc.to - 2 * arc.centre) >= 0;
}

Place nearest_on(const Stroke& s, Place p) {
  if (!s.arc) {
    const Place way = s.to - s.from;
    const double square = dot(way, way);
    const double t = square > 0 ? std::clamp(dot(p - s.from, way) / square, 0.0, 1.0) : 0;
    return s.from + t * way;
  }
  const Place out = p - s.centre;
  if (dot(out, out) > 0 && faces(s, out)) return on_circle(s, out);
  return dot(p - s.from, p - s.from) <= dot(p - s.to, p - s.to) ? s.from : s.to;
}

double distance(Place p, const Stroke& stroke) { return length(p - nearest_on(stroke, p)); }

double distance_apart(const Stroke& a, const Stroke& b) {
  double least = std::min(std::min(distance(a.from, b), distance(a.to, b)),
                          std::min(distance(b.from, a), distance(b.to, a)));
  // Nearest places that are no ends lie on a line through the centres, on either side of the other's.
  const auto carrier_points = [&](const Stroke& arc, const Stroke& other) {
    for (const Place p : {arc.centre, other.centre + (other.centre - arc.centre)})
      least = std::min(least, distance(nearest_on(other, p), arc));
  };
  if (a.arc) carrier_points(a, b);
  if (b.arc) carrier_points(b, a);
  return least;
}

void add_crossings(const Stroke& a, const Stroke& b, std::vector<Place>& places) {
  if (a.arc && b.arc) return circle_with_circle(a, b, places);
  if (a.arc) return line_with_circle(b, a, places);
  if (b.arc) return line_with_circle(a, b, places);
  const Place u = a.to - a.from, v = b.to - b.from;
  const double turn = cross(u, v);
  if (!(std::abs(turn) > 1e-12 * length(u) * length(v))) return;
  keep_if_on(a, b, a.from + (cross(b.from - a.from, v) / turn) * u, places);
}

bool crosses_ray_to_the_right(const Stroke& s, Place p) {
  if ((s.from.y <= p.y) == (s.to.y <= p.y)) return false;
  if (!s.arc) return s.from.x + (p.y - s.from.y) / (s.to.y - s.from.y) * (s.to.x - s.from.x) > p.x;
  const double up = p.y - s.centre.y;
  const double half = std::sqrt(std::max(0.0, s.radius * s.radius - up * up));
  const double side = 0.5 * (s.from.x + s.to.x) >= s.centre.x ? 1 : -1;
  return s.centre.x + side * half > p.x;
}

Stroke until(const Stroke& stroke, Place at) {
  Stroke part = stroke;
  part.to = at;
  return part;
}

Stroke beginning(const Stroke& stroke, Place at) {
  Stroke part = stroke;
  part.from = at;
  return part;
}

Place at_share(const Stroke& s, double t) {
  if (t <= 0) return s.from;
  if (t >= 1) return s.to;
  const Place chord = s.from + t * (s.to - s.from);
  if (!s.arc) return chord;
  return on_circle(s, chord - s.centre);
}

void add_line(Place from, Place to, double longest, std::vector<Stroke>& strokes) {
  const auto pieces = static_cast<std::size_t>(std::max(1.0, std::ceil(length(to - from) / longest)));
  Place at = from;
  for (std::size_t i = 1; i <= pieces; ++i) {
    const Place next =
        i == pieces ? to : from + (static_cast<double>(i) / static_cast<double>(pieces)) * (to - from);
    strokes.push_back({false, true, at, next, {}, 0});
    at = next;
  }
}

void add_arc(Place from, Place to, Place centre, bool ccw, double longest, std::vector<Stroke>& strokes) {
  const double radius = 0.5 * (length(from - centre) + length(to - centre));
  Place at = from - centre;
  const Place end = to - centre;
  // A full turn begins with a quarter, though nothing is left to turn by.
  for (bool full = from.x == to.x && from.y == to.y;; full = false) {
    const double turn = angle_between(at, end) * (ccw ? 1 : -1);
    if (!full && turn >= 0 && turn <= kPi / 2 + 1e-9) break;
    const Place next = ccw ? left_of(at) : -1.0 * left_of(at);
    add_halved({true, ccw, centre + at, centre + next, centre, radius}, longest, strokes);
    at = next;
  }
  add_halved({true, ccw, centre + at, to, centre, radius}, longest, strokes);
}

}  // namespace lekalo::verify

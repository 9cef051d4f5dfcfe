#include "lekalo/geom/edge_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lekalo/geom/predicates.hpp"

namespace lekalo::geom {
namespace {

bool is_line(const Curve& curve) { return curve.edge.kind == EdgeKind::line; }

void keep_nearer(ClosestPoints& best, Point a, Point b) {
  const double distance = norm(b - a);
  if (distance < best.distance) best = {distance, a, b};
}

ClosestPoints swapped(const ClosestPoints& c) { return {c.distance, c.b, c.a}; }

/// Finds the closest of the pairs of an end of one edge with the whole of the other. Such pairs are
/// candidates for any two edges.
ClosestPoints closest_at_ends(const Curve& a, const Curve& b) {
  const std::array<ClosestPoints, 4> candidates{{{0, a.edge.from, nearest_on(b, a.edge.from)},
                                                 {0, a.edge.to, nearest_on(b, a.edge.to)},
                                                 {0, nearest_on(a, b.edge.from), b.edge.from},
                                                 {0, nearest_on(a, b.edge.to), b.edge.to}}};
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 4; ++k) {
    const Point apart = candidates[k].b - candidates[k].a;
    const double squared = dot(apart, apart);
    if (squared < least) least = squared, best = k;
  }
  return {std::sqrt(least), candidates[best].a, candidates[best].b};
}

/// Returns the point of an arc in a direction that it faces.
Point on_arc(const Curve& arc, Point unit) { return arc.edge.centre + arc.radius * unit; }

ClosestPoints closest_lines(const Curve& a, const Curve& b) {
  const ClosestPoints best = closest_at_ends(a, b);
  // Lines that cross are at their ends no further apart than half the length of the shorter one.
  if (2 * best.distance > std::min(a.length, b.length) * (1 + 1e-9)) return best;
  if (segment_relation(a.edge.from, a.edge.to, b.edge.from, b.edge.to) != SegmentRelation::cross) return best;
  const Point along = a.edge.to - a.edge.from, other = b.edge.to - b.edge.from;
  const double turn = cross(along, other);
  if (turn == 0) return best;
  const double t = std::clamp(cross(b.edge.from - a.edge.from, other) / turn, 0.0, 1.0);
  const Point at = a.edge.from + t * along;
  return {0, at, at};
}

ClosestPoints closest_line_arc(const Curve& line, const Curve& arc) {
  ClosestPoints best = closest_at_ends(line, arc);
  const Point centre = arc.edge.centre, unit = line.unit;
  const double length = line.length;
  const double foot = dot(centre - line.edge.from, unit);
  const Point to_foot = line.edge.from + foot * unit - centre;
  const double height = norm(to_foot);
  if (height >= arc.radius) {
    if (foot > 0 && foot < length && height > 0 && faces(arc, to_foot))
      keep_nearer(best, centre + to_foot, on_arc(arc, (1 / height) * to_foot));
    return best;
  }
  // The line passes through the circle, and between the two crossings no distance has a minimum of its own.
  const double half = std::sqrt((arc.radius - height) * (arc.radius + height));
  for (const double at : {foot - half, foot + half}) {
    if (!(at >= 0 && at <= length)) continue;
    const Point p = line.edge.from + at * unit;
    if (faces(arc, p - centre)) return {0, p, p};
  }
  return best;
}

ClosestPoints closest_arcs(const Curve& a, const Curve& b) {
  ClosestPoints best = closest_at_ends(a, b);
  const Point between = b.edge.centre - a.edge.centre;
  const double apart = norm(between);
  // Concentric arcs that face each other do so at an end of one, which was looked at already.
  if (!(apart > 0)) return best;
  const Point u = (1 / apart) * between;
  const auto pair = [&](Point of_a, Point of_b) {
    if (faces(a, of_a) && faces(b, of_b)) keep_nearer(best, on_arc(a, of_a), on_arc(b, of_b));
  };
  if (apart >= a.radius + b.radius) {
    pair(u, -u);
  } else if (apart + b.radius <= a.radius) {
    pair(u, u);
  } else if (apart + a.radius <= b.radius) {
    pair(-u, -u);
  } else {
    const double along = 0.5 * (apart + (a.radius - b.radius) * (a.radius + b.radius) / apart);
    const double across = std::sqrt(std::max(0.0, (a.radius - along) * (a.radius + along)));
    for (const double side : {across, -across}) {
      const Point p = a.edge.centre + along * u + side * perpendicular(u);
      if (faces(a, p - a.edge.centre) && faces(b, p - b.edge.centre)) return {0, p, p};
    }
  }
  return best;
}

}  // namespace

Curve make_curve(const Edge& edge) noexcept {
  Curve curve;
  curve.edge = edge;
  if (edge.kind == EdgeKind::line) {
    curve.length = norm(edge.to - edge.from);
    curve.unit = (1 / curve.length) * (edge.to - edge.from);
    return curve;
  }
  curve.radius = arc_radius(edge);
  curve.full = edge.from == edge.to;
  const bool forwards = edge.kind == EdgeKind::arc_ccw;
  curve.first = (forwards ? edge.from : edge.to) - edge.centre;
  curve.last = (forwards ? edge.to : edge.from) - edge.centre;
  const int turn = orientation({}, curve.first, curve.last);
  curve.beyond_half = turn < 0;
  curve.wide = turn < 0 || (turn == 0 && dot(curve.first, curve.last) < 0);
  return curve;
}

bool faces(const Curve& arc, Point direction) noexcept {
  if (arc.full) return true;
  const bool after_first = cross(arc.first, direction) >= 0, before_last = cross(direction, arc.last) >= 0;
  return arc.wide ? after_first || before_last : after_first && before_last;
}

Point nearest_on(const Curve& curve, Point p) noexcept {
  const Edge& edge = curve.edge;
  if (is_line(curve)) {
    const double along = dot(p - edge.from, curve.unit);
    if (!(along > 0)) return edge.from;
    return along < curve.length ? edge.from + along * curve.unit : edge.to;
  }
  const Point out = p - edge.centre;
  const double far = norm(out);
  if (far > 0 && faces(curve, out)) return on_arc(curve, (1 / far) * out);
  return norm(p - edge.from) <= norm(p - edge.to) ? edge.from : edge.to;
}

ClosestPoints closest_points(const Curve& a, const Curve& b) noexcept {
  if (is_line(a)) return is_line(b) ? closest_lines(a, b) : closest_line_arc(a, b);
  return is_line(b) ? swapped(closest_line_arc(b, a)) : closest_arcs(a, b);
}

Box curve_box(const Curve& curve) noexcept {
  const Edge& edge = curve.edge;
  Box box = box_of(edge.from, edge.to);
  if (!is_line(curve)) {
    if (faces(curve, {1, 0})) box.high.x = std::max(box.high.x, edge.centre.x + curve.radius);
    if (faces(curve, {-1, 0})) box.low.x = std::min(box.low.x, edge.centre.x - curve.radius);
    if (faces(curve, {0, 1})) box.high.y = std::max(box.high.y, edge.centre.y + curve.radius);
    if (faces(curve, {0, -1})) box.low.y = std::min(box.low.y, edge.centre.y - curve.radius);
  }
  const double far = std::max(
      {std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y), curve.radius});
  const double margin = kEdgeDistanceError * far;
  return grown(box, margin);
}

}  // namespace lekalo::geom

#pragma once

// Exact oracles for the tests, in GMP rationals: the definitions, written down without cleverness.

#include <gmpxx.h>

#include <algorithm>
#include <cstddef>

#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/predicates.hpp"

namespace lekalo::exact {

struct Point {
  mpq_class x, y;
  explicit Point(geom::Point p) : x(p.x), y(p.y) {}
  Point(mpq_class x_, mpq_class y_) : x(std::move(x_)), y(std::move(y_)) {}
  friend bool operator==(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y; }
};
inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
inline mpq_class cross(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }
inline mpq_class dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }

/// (b - a) x (d - c)
inline mpq_class turn(geom::Point a, geom::Point b, geom::Point c, geom::Point d) {
  return cross(Point(b) - Point(a), Point(d) - Point(c));
}

inline bool on_segment(const Point& p, const Point& a, const Point& b) {
  return cross(b - a, p - a) == 0 && dot(a - p, b - p) <= 0;
}

/// By the parameters of the common point, not by sides.
inline geom::SegmentRelation segment_relation(geom::Point ga, geom::Point gb, geom::Point gc,
                                              geom::Point gd) {
  using geom::SegmentRelation;
  const Point a(ga), b(gb), c(gc), d(gd);
  const Point r = b - a, s = d - c;
  const mpq_class parallel = cross(r, s);
  if (parallel != 0) {
    const mpq_class t = cross(c - a, s) / parallel, v = cross(c - a, r) / parallel;
    if (t < 0 || t > 1 || v < 0 || v > 1) return SegmentRelation::disjoint;
    const bool at_end = t == 0 || t == 1 || v == 0 || v == 1;
    return at_end ? SegmentRelation::touch : SegmentRelation::cross;
  }
  // Parallel, or one is a point: every common stretch has an end of one of them at each side.
  const bool ends[] = {on_segment(a, c, d), on_segment(b, c, d), on_segment(c, a, b), on_segment(d, a, b)};
  const Point* points[] = {&a, &b, &c, &d};
  const Point* first = nullptr;
  for (int i = 0; i < 4; ++i) {
    if (!ends[i]) continue;
    if (first != nullptr && !(*first == *points[i])) return SegmentRelation::overlap;
    first = points[i];
  }
  return first == nullptr ? SegmentRelation::disjoint : SegmentRelation::touch;
}

/// Even-odd rule, by where a ray upwards meets the edges.
inline geom::PointLocation locate_point(const geom::Ring& ring, geom::Point gp) {
  const Point p(gp);
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a(ring[i]), b(ring[i + 1 == ring.size() ? 0 : i + 1]);
    if (on_segment(p, a, b)) return geom::PointLocation::boundary;
    if ((a.x <= p.x) == (b.x <= p.x)) continue;
    const mpq_class height = a.y + (b.y - a.y) * (p.x - a.x) / (b.x - a.x);
    if (height > p.y) inside = !inside;
  }
  return inside ? geom::PointLocation::inside : geom::PointLocation::outside;
}

inline mpq_class signed_area(const geom::Ring& ring) {
  mpq_class doubled = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    doubled += cross(Point(ring[i]), Point(ring[i + 1 == ring.size() ? 0 : i + 1]));
  }
  return doubled / 2;
}

/// Square of the distance from p to segment ab.
inline mpq_class squared_distance(geom::Point gp, geom::Point ga, geom::Point gb) {
  const Point p(gp), a(ga), b(gb);
  const Point along = b - a, to_p = p - a;
  const mpq_class length = dot(along, along), foot = dot(along, to_p);
  if (foot <= 0) return dot(to_p, to_p);
  if (foot >= length) return dot(p - b, p - b);
  const mpq_class c = cross(along, to_p);
  return c * c / length;
}

}  // namespace lekalo::exact

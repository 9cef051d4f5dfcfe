#pragma once

// Random parts on a sheet for profile cuts, and a measure of kerf against part that shares nothing with the
// engine's: points along the cut, formulas of its own in long double.

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/nc/profile.hpp"
#include "support/layout_documents.hpp"
#include "support/rs274_reader.hpp"

namespace lekalo::cases {

using rs274::Real;

inline geom::Contour circle_contour(geom::Point centre, double radius, bool hole = false) {
  const geom::Point start{centre.x + radius, centre.y};
  return {{hole ? geom::EdgeKind::arc_cw : geom::EdgeKind::arc_ccw, start, start, centre}};
}
inline geom::Contour ring_contour(const std::vector<geom::Point>& points) {
  geom::Contour contour;
  for (std::size_t i = 0; i < points.size(); ++i)
    contour.push_back({geom::EdgeKind::line, points[i], points[(i + 1) % points.size()], {}});
  return contour;
}
inline geom::Contour box_contour(double x, double y, double width, double height) {
  return ring_contour({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}});
}
/// A bar with round ends, from a to b.
inline geom::Contour slot_contour(geom::Point a, geom::Point b, double radius) {
  const geom::Point along = b - a, side = (radius / geom::norm(along)) * geom::perpendicular(along);
  return {{geom::EdgeKind::line, a - side, b - side, {}},
          {geom::EdgeKind::arc_ccw, b - side, b + side, b},
          {geom::EdgeKind::line, b + side, a + side, {}},
          {geom::EdgeKind::arc_ccw, a + side, a - side, a}};
}
inline geom::Region region_of_contours(geom::Contour outer, std::vector<geom::Contour> holes = {}) {
  auto made = geom::make_region(std::move(outer), std::move(holes));
  if (!made) throw std::logic_error("test input: " + made.error().message);
  return *std::move(made);
}

/// A part in a cell of 60 mm about the point; washers have parts in their holes, with the ids that follow.
inline void add_random_parts(Random& random, geom::Point c, std::vector<nc::ProfilePart>& parts) {
  const auto id = [&] { return parts.size() + 1; };
  const double turn = random.uniform(0, 6.28);
  const auto [sine, cosine] = geom::sincos(turn);
  const geom::Point way{cosine, sine};
  switch (random.below(4)) {
    case 0: {  // washer, something in its hole
      const double inner = random.uniform(12, 20);
      parts.push_back({id(), region_of_contours(circle_contour(c, inner + random.uniform(3, 8)),
                                                {circle_contour(c, inner, true)})});
      const double nested = inner - random.uniform(2, 5);
      parts.push_back(
          {id(), region_of_contours(circle_contour(c, nested), {circle_contour(c, nested / 3, true)})});
      break;
    }
    case 1: {  // bar with slots
      const geom::Contour hole = slot_contour(c - 10.0 * way, c - 3.0 * way, random.uniform(1, 3));
      parts.push_back(
          {id(), region_of_contours(slot_contour(c - 18.0 * way, c + 18.0 * way, 8),
                                    {hole, circle_contour(c + 10.0 * way, random.uniform(1, 5))})});
      break;
    }
    default: {  // star: corners of every kind
      std::vector<geom::Point> points;
      const int corners = 3 + static_cast<int>(random.below(7));
      for (int k = 0; k < 2 * corners; ++k) {
        const auto [s, co] = geom::sincos(turn + 3.14159265 * k / corners);
        const double r = k % 2 == 0 ? random.uniform(20, 27) : random.uniform(9, 19);
        points.push_back(c + r * geom::Point{co, s});
      }
      parts.push_back(
          {id(), region_of_contours(ring_contour(points), {circle_contour(c, random.uniform(1, 6))})});
    }
  }
}

inline std::vector<nc::ProfilePart> random_parts(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, 77000 + index);
  std::vector<nc::ProfilePart> parts;
  const int columns = 1 + static_cast<int>(random.below(4)), rows = 1 + static_cast<int>(random.below(3));
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      add_random_parts(random, {40 + 60.0 * i + random.uniform(-2, 2), 35 + 60.0 * j + random.uniform(-2, 2)},
                       parts);
  return parts;
}

inline Real distance_to_edge(rs274::Point p, const geom::Edge& e) {
  const Real ax = e.from.x, ay = e.from.y, bx = e.to.x, by = e.to.y;
  if (e.kind == geom::EdgeKind::line) {
    const Real dx = bx - ax, dy = by - ay;
    Real t = ((p.x - ax) * dx + (p.y - ay) * dy) / (dx * dx + dy * dy);
    t = std::min<Real>(1, std::max<Real>(0, t));
    return std::hypot(p.x - ax - t * dx, p.y - ay - t * dy);
  }
  const Real cx = e.centre.x, cy = e.centre.y;
  const Real radius = (std::hypot(ax - cx, ay - cy) + std::hypot(bx - cx, by - cy)) / 2;
  const auto turned = [&](Real from, Real to) {
    Real angle = e.kind == geom::EdgeKind::arc_ccw ? to - from : from - to;
    while (angle < 0) angle += 2 * rs274::kPi;
    return angle;
  };
  const Real start = std::atan2(ay - cy, ax - cx);
  Real sweep = turned(start, std::atan2(by - cy, bx - cx));
  if (e.from == e.to) sweep = 2 * rs274::kPi;
  if (turned(start, std::atan2(p.y - cy, p.x - cx)) <= sweep)
    return std::abs(std::hypot(p.x - cx, p.y - cy) - radius);
  return std::min(std::hypot(p.x - ax, p.y - ay), std::hypot(p.x - bx, p.y - by));
}

template <class Visit>
void each_contour(const geom::Region& region, Visit&& visit) {
  visit(region.outer);
  for (const geom::Contour& hole : region.holes) visit(hole);
}

inline Real distance_to_step(rs274::Point p, const rs274::Step& step) {
  const auto point = [](rs274::Point q) { return geom::Point{double(q.x), double(q.y)}; };
  const geom::EdgeKind kind = !step.arc        ? geom::EdgeKind::line
                              : step.sweep > 0 ? geom::EdgeKind::arc_ccw
                                               : geom::EdgeKind::arc_cw;
  return distance_to_edge(p, {kind, point(step.from), point(step.to), point(step.centre)});
}

inline Real distance_to_boundary(rs274::Point p, const geom::Region& region) {
  Real least = std::numeric_limits<Real>::infinity();
  each_contour(region, [&](const geom::Contour& contour) {
    for (const geom::Edge& edge : contour) least = std::min(least, distance_to_edge(p, edge));
  });
  return least;
}

/// By turns about p, of chords that lie within `sagitta` of the contour: p must be further from it.
inline bool is_in(rs274::Point p, const geom::Contour& contour, Real sagitta) {
  Real turns = 0;
  for (const geom::Edge& edge : contour) {
    rs274::Point before{edge.from.x, edge.from.y};
    const bool arc = edge.kind != geom::EdgeKind::line;
    const Real sweep = arc ? geom::arc_sweep(edge) : 0;
    const Real dx = edge.from.x - edge.centre.x, dy = edge.from.y - edge.centre.y;
    const int pieces = arc ? static_cast<int>(std::ceil(
                                 sweep / std::min<Real>(0.7L, std::sqrt(8 * sagitta / std::hypot(dx, dy)))))
                           : 1;
    for (int k = 1; k <= pieces; ++k) {
      rs274::Point next{edge.to.x, edge.to.y};
      if (k < pieces) {
        const Real angle = sweep * k / pieces * (edge.kind == geom::EdgeKind::arc_ccw ? 1 : -1);
        next = {edge.centre.x + std::cos(angle) * dx - std::sin(angle) * dy,
                edge.centre.y + std::sin(angle) * dx + std::cos(angle) * dy};
      }
      turns += std::atan2((before.x - p.x) * (next.y - p.y) - (before.y - p.y) * (next.x - p.x),
                          (before.x - p.x) * (next.x - p.x) + (before.y - p.y) * (next.y - p.y));
      before = next;
    }
  }
  return std::abs(turns) > rs274::kPi;
}
/// \param apart  of p from the boundary
inline bool in_material(rs274::Point p, const geom::Region& region, Real apart) {
  const Real sagitta = std::max<Real>(apart / 2, 1e-9L);
  if (!is_in(p, region.outer, sagitta)) return false;
  for (const geom::Contour& hole : region.holes)
    if (is_in(p, hole, sagitta)) return false;
  return true;
}

/// How deep kerf about p lies in the part at most; 0 for none.
inline Real depth_of_kerf(rs274::Point p, const geom::Region& region, Real kerf) {
  const geom::Box box = geom::bounds(region.outer);
  const Real far = kerf + 1e-6L;
  if (p.x < box.low.x - far || p.x > box.high.x + far || p.y < box.low.y - far || p.y > box.high.y + far)
    return 0;
  const Real apart = distance_to_boundary(p, region);
  return std::max<Real>(0, in_material(p, region, apart) ? kerf / 2 + apart : kerf / 2 - apart);
}

}  // namespace lekalo::cases

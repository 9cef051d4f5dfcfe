#include "similarity.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drawn_shapes.hpp"
#include "lekalo/base/angle.hpp"

namespace lekalo::io::detail {

using geom::Box;
using geom::Contour;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;

namespace {

/// Reading a decimal in inches costs two roundings and that of 25.4.
constexpr double kReading = 4 * kUnitRoundoff;

double largest(Point p) { return std::max(std::abs(p.x), std::abs(p.y)); }

Box around(const std::vector<Point>& points) {
  Box box{points.front(), points.front()};
  for (const Point p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

std::vector<Point> corners(const Box& box) {
  return {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
}

Contour image(const Similarity& map, const Contour& contour) {
  Contour out;
  for (const Edge& edge : contour) {
    Edge mapped = image(map, edge);
    const bool is_short =
        edge.kind == EdgeKind::line || (!(edge.from == edge.to) && geom::arc_sweep(edge) < kPi);
    if (is_short && mapped.from == mapped.to) continue;
    const double size = std::max({largest(mapped.from), largest(mapped.to), largest(mapped.centre)});
    if (is_short && norm(mapped.to - mapped.from) <= kShortest * size)
      mapped = {EdgeKind::line, mapped.from, mapped.to, {}};
    out.push_back(mapped);
  }
  return out;
}

}  // namespace

Similarity move_by(Point shift) noexcept {
  Similarity map;
  map.after = shift;
  map.shift_error = 2 * kReading * largest(shift);
  return map;
}

Similarity turn_about(Point centre, double degrees) noexcept {
  const auto [unit, exact] = direction_of_degrees(degrees);
  Similarity map{unit.x, -unit.y, unit.y, unit.x, centre, centre};
  // The angle's own decimal is off by half a unit in its last place; whole degrees are not.
  const double reading = degrees == std::nearbyint(degrees) ? 0 : std::abs(degrees) * kUnitRoundoff * 0.02;
  map.linear_error = (exact ? 0 : kDegreesError) + reading;
  map.shift_error = 4 * kReading * largest(centre);
  return map;
}

Similarity scale_about(Point centre, double factor) noexcept {
  Similarity map{factor, 0, 0, factor, centre, centre};
  map.factor = factor;
  map.linear_error = kUnitRoundoff * factor;
  map.shift_error = 2 * (1 + factor) * kReading * largest(centre);
  return map;
}

Similarity flip(bool x) noexcept {
  Similarity map;
  (x ? map.xx : map.yy) = -1;
  map.mirrors = true;
  return map;
}

Similarity mirror_in_line(Point a, Point b) noexcept {
  const double size = largest(b - a);
  const Point d = (1 / size) * (b - a);
  const double square = dot(d, d);
  const double cosine = (d.x * d.x - d.y * d.y) / square, sine = 2 * d.x * d.y / square;
  Similarity map{cosine, sine, sine, -cosine, a, a};
  map.mirrors = true;
  // The line turns by what its points are off, its image by twice that.
  map.linear_error = 8 * kUnitRoundoff + 8 * kReading * std::max(largest(a), largest(b)) / size;
  map.shift_error = 4 * kReading * largest(a);
  return map;
}

double rounding_of(const Similarity& map, double size) noexcept {
  // Three roundings on the way to linear * (p - before), of numbers that are together twice the factor times
  // |p - before| in either coordinate; one more for the sum.
  const double reach = 2 * (size + largest(map.before));
  const double result = map.factor * reach + largest(map.after);
  return reach * (8 * kUnitRoundoff * map.factor + 2 * map.linear_error) + 2 * kUnitRoundoff * result +
         map.shift_error;
}

Edge image(const Similarity& map, const Edge& edge) noexcept {
  Edge out{edge.kind, map(edge.from), map(edge.to), {}};
  if (edge.kind == EdgeKind::line) return out;
  out.centre = map(edge.centre);
  if (map.mirrors) out.kind = edge.kind == EdgeKind::arc_ccw ? EdgeKind::arc_cw : EdgeKind::arc_ccw;
  return out;
}

Result<Region> image(const Similarity& map, const Region& region) {
  std::vector<Contour> holes;
  for (const Contour& hole : region.holes) holes.push_back(image(map, hole));
  return geom::make_region(image(map, region.outer), std::move(holes));
}

Box image(const Similarity& map, const Box& box) noexcept {
  std::vector<Point> points = corners(box);
  for (Point& p : points) p = map(p);
  return grown(around(points), rounding_of(map, largest_of(box)));
}

Box preimage(const Similarity& map, const Box& box) noexcept {
  std::vector<Point> points = corners(box);
  const double square = map.factor * map.factor;
  for (Point& p : points) {
    const Point q = p - map.after;  // the inverse of a similarity is its transpose, over the factor squared
    p = (1 / square) * Point{map.xx * q.x + map.yx * q.y, map.xy * q.x + map.yy * q.y} + map.before;
  }
  const Box back = around(points);
  return grown(back, 2 * rounding_of(map, largest_of(back)) / map.factor);
}

double largest_of(const Box& box) noexcept { return std::max(largest(box.low), largest(box.high)); }

double largest_of(const Region& region) noexcept {
  double size = 0;
  const auto look = [&size](const Contour& contour) {
    for (const Edge& e : contour) size = std::max({size, largest(e.from), largest(e.centre)});
  };
  look(region.outer);
  for (const Contour& hole : region.holes) look(hole);
  return size;
}

}  // namespace lekalo::io::detail

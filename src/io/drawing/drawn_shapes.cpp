#include "drawn_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "bounded_number.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/base/assert.hpp"
#include "lekalo/geom/double_double.hpp"
#include "lekalo/geom/predicates.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::io {
namespace {

using detail::Bounded;
using geom::DoubleDouble;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// Bounds are themselves computed in doubles; this covers their rounding, and the length of a vector whose
/// coordinates are below 1.
constexpr double kRoundingUp = 1 + 0x1p-40;
constexpr double kDiagonal = 1.41421356237309515 * kRoundingUp;

double largest(Point p) noexcept { return std::max(std::abs(p.x), std::abs(p.y)); }

bool is_in_range(Point p) noexcept { return largest(p) <= kLargestMillimetres; }

/// Numbers that the predicates cannot take are 0 (kSmallestMillimetres).
Bounded flushed(Bounded x) noexcept {
  if (x.value == 0 || std::abs(x.value) >= kSmallestMillimetres) return x;
  return {0, x.error + kSmallestMillimetres};
}

/// Computes a x + b y + shift; the error is that of rounding alone.
Bounded combination(double a, double x, double b, double y, double shift) noexcept {
  const DoubleDouble first = geom::two_product(a, x), second = geom::two_product(b, y);
  const DoubleDouble sum = geom::two_sum(first.hi, second.hi);
  const DoubleDouble moved = geom::two_sum(sum.hi, shift);
  return flushed(
      {moved.hi,
       (std::abs(first.lo) + std::abs(second.lo) + std::abs(sum.lo) + std::abs(moved.lo)) * kRoundingUp});
}

/// sigma_1 and, negative for maps that mirror, sigma_2 are the sum and the difference of the two.
struct Stretch {
  double kept = 0, skewed = 0;  ///< sizes of the map's parts that keep angles and that mirror them
};
Stretch stretch_of(const Affine& map) noexcept {
  return {geom::norm({map.xx + map.yy, map.yx - map.xy}) / 2,
          geom::norm({map.xx - map.yy, map.xy + map.yx}) / 2};
}

/// The factor by which distances grow at most, under the exact map too.
double largest_stretch(const Affine& map) noexcept {
  const Stretch stretch = stretch_of(map);
  return (stretch.kept + stretch.skewed + 2 * map.linear_error) * kRoundingUp;
}

struct BoundedVector {
  Point value;
  double error = 0;
};
BoundedVector bounded_image_of_vector(const Affine& map, Point v) noexcept {
  const Bounded x = combination(map.xx, v.x, map.xy, v.y, 0), y = combination(map.yx, v.x, map.yy, v.y, 0);
  const double entries = map.linear_error * (std::abs(v.x) + std::abs(v.y));
  return {{x.value, y.value}, (std::max(x.error, y.error) + entries) * kRoundingUp};
}

/// The angle from `begin` to `end` about the centre in the direction of the arc, in (0, 2 pi].
double sweep_between(const Edge& arc) noexcept {
  if (arc.from == arc.to) return kTurn;
  const Point a = arc.kind == EdgeKind::arc_ccw ? arc.from : arc.to;
  const Point b = arc.kind == EdgeKind::arc_ccw ? arc.to : arc.from;
  const Point p = a - arc.centre, q = b - arc.centre;
  const double turned = geom::direction_angle(geom::dot(p, q), geom::cross(p, q));
  if (std::abs(turned) > 1e-6) return turned > 0 ? turned : turned + kTurn;
  // Next to 0 and to a whole turn the sign is decided exactly.
  const bool is_short = geom::orientation(arc.centre, a, b) > 0;
  return is_short ? std::max(turned, 1e-300) : kTurn - std::max(-turned, 0.0);
}

/// An arc's parameters as of an ellipse. A clockwise arc runs through the angles from -a upwards.
EllipseArc ellipse_of(const Edge& arc) noexcept {
  const double radius = geom::arc_radius(arc);
  const bool ccw = arc.kind == EdgeKind::arc_ccw;
  EllipseArc ellipse{arc.from, arc.to, arc.centre, {radius, 0}, {0, ccw ? radius : -radius}};
  const Point start = arc.from - arc.centre;
  ellipse.begin = geom::direction_angle(start.x, ccw ? start.y : -start.y);
  ellipse.end = std::max(ellipse.begin + sweep_between(arc), std::nextafter(ellipse.begin, 10.0));
  ellipse.end = std::min(ellipse.end, ellipse.begin + kTurn);
  return ellipse;
}

std::optional<BoundedShape> image_of_arc(const Affine& map, const Edge& arc, double error) {
  const Stretch stretch = stretch_of(map);
  const bool mirrors = stretch.skewed > stretch.kept;
  const double off = mirrors ? stretch.kept : stretch.skewed;
  const double carried = error * largest_stretch(map);
  const double radius = geom::arc_radius(arc);
  if (off <= 8 * kUnitRoundoff * map.size() + 4 * map.linear_error) {
    const BoundedPoint from = image(map, {arc.from}), to = image(map, {arc.to}),
                       centre = image(map, {arc.centre});
    if (!is_in_range(from.at) || !is_in_range(to.at) || map.determinant() == 0) return std::nullopt;
    const bool ccw = (arc.kind == EdgeKind::arc_ccw) != mirrors;
    const Edge edge{ccw ? EdgeKind::arc_ccw : EdgeKind::arc_cw, from.at, to.at, centre.at};
    BoundedShape shape = circle_arc(edge, sweep_between(arc), std::max({from.error, to.error, centre.error}));
    // The image is not quite a circle: each of its points is within off * radius of the one that is, and
    // so are the two that give the mean radius and the directions of the ends.
    shape.error += carried + 4 * off * radius * kRoundingUp;
    return shape;
  }
  EllipseArc ellipse = ellipse_of(arc);
  // The curve meant runs along the mean radius and joins the ends; conic() sees how far they are off it.
  BoundedShape exact{ellipse, 0};
  auto shape = image(map, exact);
  if (shape) shape->error += carried + 4 * kUnitRoundoff * radius * largest_stretch(map);
  return shape;
}

std::optional<BoundedShape> image_of_ellipse(const Affine& map, const EllipseArc& arc, double error) {
  const BoundedPoint from = image(map, {arc.from}), to = image(map, {arc.to}),
                     centre = image(map, {arc.centre});
  const BoundedVector u = bounded_image_of_vector(map, arc.u), v = bounded_image_of_vector(map, arc.v);
  const EllipseArc mapped{from.at, to.at, centre.at, u.value, v.value, arc.begin, arc.end};
  if (!is_in_range(from.at) || !is_in_range(to.at) || !is_in_range(centre.at) || !is_in_range(u.value) ||
      !is_in_range(v.value) || geom::cross(u.value, v.value) == 0) {
    return std::nullopt;
  }
  BoundedShape shape =
      conic(mapped, std::max(centre.error + u.error + v.error, std::max(from.error, to.error)));
  shape.error += error * largest_stretch(map);
  return shape;
}

std::optional<BoundedShape> image_of_spline(const Affine& map, const Spline& spline, double error) {
  BoundedShape shape{spline, 0};
  double moved = 0;
  for (Point& pole : std::get<Spline>(shape.shape).poles) {
    const BoundedPoint mapped = image(map, {pole});
    if (!is_in_range(mapped.at)) return std::nullopt;
    pole = mapped.at;
    moved = std::max(moved, mapped.error);
  }
  // A point of the curve is a mean of poles with weights that are not negative.
  shape.error = (moved * kDiagonal + error * largest_stretch(map)) * kRoundingUp;
  return shape;
}

}  // namespace

Direction direction_of_degrees(double degrees) noexcept {
  const double within = std::fmod(degrees, 360);
  const double quarters = std::nearbyint(within / 90);
  const double rest = within - 90 * quarters;  // exact: the two are within a factor of 2 of each other
  const auto [sine, cosine] = geom::sincos(rest * kDegree);
  const bool exact = rest == 0;
  switch ((static_cast<int>(quarters) + 4) % 4) {
    case 0:
      return {{cosine, sine}, exact};
    case 1:
      return {{-sine, cosine}, exact};
    case 2:
      return {{-cosine, -sine}, exact};
    default:
      return {{sine, -cosine}, exact};
  }
}

bool Affine::is_identity() const noexcept {
  return xx == 1 && xy == 0 && yx == 0 && yy == 1 && shift == Point{} && linear_error == 0 &&
         shift_error == 0;
}

double Affine::size() const noexcept {
  return std::max(std::abs(xx) + std::abs(xy), std::abs(yx) + std::abs(yy));
}

BoundedPoint image(const Affine& map, const BoundedPoint& p) noexcept {
  const Bounded x = combination(map.xx, p.at.x, map.xy, p.at.y, map.shift.x);
  const Bounded y = combination(map.yx, p.at.x, map.yy, p.at.y, map.shift.y);
  const double entries = map.linear_error * (std::abs(p.at.x) + std::abs(p.at.y) + 2 * p.error);
  const double error = std::max(x.error, y.error) + map.size() * p.error + entries + map.shift_error;
  return {{x.value, y.value}, error * kRoundingUp};
}

Affine composed(const Affine& outer, const Affine& inner) noexcept {
  const Bounded xx = combination(outer.xx, inner.xx, outer.xy, inner.yx, 0);
  const Bounded xy = combination(outer.xx, inner.xy, outer.xy, inner.yy, 0);
  const Bounded yx = combination(outer.yx, inner.xx, outer.yy, inner.yx, 0);
  const Bounded yy = combination(outer.yx, inner.xy, outer.yy, inner.yy, 0);
  const BoundedPoint shift = image(outer, {inner.shift, inner.shift_error});
  const double inner_largest =
      std::max({std::abs(inner.xx), std::abs(inner.xy), std::abs(inner.yx), std::abs(inner.yy)});
  const double entries = std::max({xx.error, xy.error, yx.error, yy.error}) +
                         outer.size() * inner.linear_error +
                         2 * outer.linear_error * (inner_largest + inner.linear_error);
  return {xx.value, xy.value, yx.value, yy.value, shift.at, entries * kRoundingUp, shift.error};
}

std::optional<BoundedShape> image(const Affine& map, const BoundedShape& shape) {
  if (map.is_identity()) return shape;
  if (const auto* ellipse = std::get_if<EllipseArc>(&shape.shape)) {
    return image_of_ellipse(map, *ellipse, shape.error);
  }
  if (const auto* spline = std::get_if<Spline>(&shape.shape))
    return image_of_spline(map, *spline, shape.error);
  const Edge& edge = std::get<Edge>(shape.shape);
  if (edge.kind != EdgeKind::line) return image_of_arc(map, edge, shape.error);
  const BoundedPoint from = image(map, {edge.from}), to = image(map, {edge.to});
  if (!is_in_range(from.at) || !is_in_range(to.at)) return std::nullopt;
  BoundedShape line = line_between(from, to);
  line.error += shape.error * largest_stretch(map);
  return line;
}

BoundedShape line_between(const BoundedPoint& from, const BoundedPoint& to) noexcept {
  return {Edge{EdgeKind::line, from.at, to.at, {}}, kDiagonal * std::max(from.error, to.error)};
}

std::optional<BoundedShape> bulge_arc(const BoundedPoint& from, const BoundedPoint& to, double bulge,
                                      double bulge_error) {
  if (from.at == to.at) return std::nullopt;
  const DoubleDouble dx = geom::two_sum(to.at.x, -from.at.x), dy = geom::two_sum(to.at.y, -from.at.y);
  const double half_chord = geom::norm({dx.hi, dy.hi}) / 2;
  const double height = std::abs(bulge) * half_chord;
  BoundedShape line = line_between(from, to);
  line.error = (line.error * (1 + std::abs(bulge)) + height + bulge_error * half_chord) * kRoundingUp;
  if (bulge == 0) return line;
  // The centre lies beside the middle of the chord, (1 - bulge^2) / (4 bulge) of it to the left.
  const DoubleDouble b{bulge}, half{0.5};
  const DoubleDouble left = (DoubleDouble{1} - geom::two_product(bulge, bulge)) / (DoubleDouble{4} * b);
  const DoubleDouble x = half * geom::two_sum(from.at.x, to.at.x) - left * dy;
  const DoubleDouble y = half * geom::two_sum(from.at.y, to.at.y) + left * dx;
  const Point centre{flushed({x.hi}).value, flushed({y.hi}).value};
  // Double-double arithmetic errs here by less than 100 units of 2^-106 of the numbers in it; half turns need
  // only the mean of the ends.
  const double terms = std::abs(left.hi) * 2 * half_chord + std::max(largest(from.at), largest(to.at));
  const double rounding = std::max(std::abs(x.hi + x.lo - centre.x), std::abs(y.hi + y.lo - centre.y)) +
                          std::max(std::abs(x.lo), std::abs(y.lo)) + (left.hi == 0 ? 0 : terms * 0x1p-99);
  // docs/design/drawing.md, "Errors": ends move the arc as a similarity does; the bulge moves no point more
  // than the middle; the centre moves the circle, its radius and the directions of its ends.
  const double error = 3 * std::max(1.0, std::abs(bulge)) * std::max(from.error, to.error) +
                       bulge_error * half_chord + 4 * kDiagonal * rounding;
  if (height <= 16 * kUnitRoundoff * (largest(centre) + largest(from.at)) || height <= 8 * rounding)
    return line;
  const Edge arc{bulge > 0 ? EdgeKind::arc_ccw : EdgeKind::arc_cw, from.at, to.at, centre};
  return BoundedShape{arc, error * kRoundingUp};
}

BoundedShape circle(const BoundedPoint& centre, const Millimetres& radius) noexcept {
  const DoubleDouble x = geom::two_sum(centre.at.x, radius.value);
  const Point start{x.hi, centre.at.y};
  return {Edge{EdgeKind::arc_ccw, start, start, centre.at},
          (kDiagonal * centre.error + radius.error + std::abs(x.lo)) * kRoundingUp};
}

BoundedShape circle_arc(const Edge& arc, double sweep, double error) noexcept {
  const double apart = kDiagonal * error, radius = geom::arc_radius(arc);
  // Centre, mean radius and directions of the ends move the curve by 1, 2 and less than 3 `apart`; an arc
  // hardly larger than that is within two of its radii of anything near its centre.
  BoundedShape shape{arc, radius > 10 * apart ? 6 * apart : 2 * radius + 10 * apart};
  const double seen = sweep_between(arc);
  if (std::abs(seen - sweep) <= kPi) return shape;
  // Rounding took a short arc for a whole turn or the reverse.
  Edge& edge = std::get<Edge>(shape.shape);
  shape.error += geom::norm(arc.to - arc.from) * kRoundingUp;
  if (sweep > kPi) {
    edge.to = edge.from;
  } else {
    edge = {EdgeKind::line, arc.from, arc.to, {}};
  }
  return shape;
}

BoundedShape conic(const EllipseArc& arc, double error) {
  LEKALO_ASSERT(arc.begin < arc.end && std::abs(arc.begin) <= 1e4);
  const double length = std::max(geom::norm(arc.u), geom::norm(arc.v));
  const double rounding = 16 * kUnitRoundoff * (largest(arc.centre) + 2 * length);
  const double gap =
      std::max(geom::norm(arc.from - point_at(arc, arc.begin)), geom::norm(arc.to - point_at(arc, arc.end))) +
      rounding;
  const bool ccw = geom::cross(arc.u, arc.v) > 0;
  const Point square = ccw ? geom::perpendicular(arc.u) : -geom::perpendicular(arc.u);
  const double off = geom::norm(arc.v - square);
  const double sweep = arc.end - arc.begin;
  if (off <= 16 * kUnitRoundoff * length + 4 * error && gap < length / 16) {
    const Edge edge{ccw ? EdgeKind::arc_ccw : EdgeKind::arc_cw, arc.from, arc.to, arc.centre};
    BoundedShape shape = circle_arc(edge, sweep, 0);
    // The circle with half diameter u is within `off` of the ellipse; the ends move its radius and their
    // directions by the gap.
    shape.error += (kDiagonal * error + off + 4 * gap) * kRoundingUp;
    return shape;
  }
  const double joined = (kDiagonal * error + gap) * kRoundingUp;
  if (arc.from == arc.to && sweep < kPi) {
    return {Edge{EdgeKind::line, arc.from, arc.to, {}}, joined + sweep * length};
  }
  return {arc, joined};
}

Point point_at(const EllipseArc& arc, double t) noexcept {
  const auto [sine, cosine] = geom::sincos(t);
  return arc.centre + (cosine * arc.u + sine * arc.v);
}

}  // namespace lekalo::io

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "contour_points.hpp"
#include "hulled_contour.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/double_double.hpp"
#include "lekalo/geom/predicates.hpp"

// Step 3 of docs/design/io.md, and the reason why the result lies inside the contour. Let side i be the
// segment between two corners of the hull, and p_i the point deepest under it of the stretch of the contour
// between them. The line through p_i parallel to side i has that stretch, and the side, on one side of it or
// on it; the result lies on the other. So, seen from any point of the result, each stretch can be pulled
// straight onto its side without passing over the point, and the contour winds around the point as often as
// the hull does: once.

namespace lekalo::io {
namespace {

using geom::DoubleDouble;
using geom::Point;

constexpr double kHalfUlp = 0x1p-53;

/// A side of the hull and the deepest point of the contour under it.
struct Side {
  Point from, to;
  std::size_t deepest = 0;  ///< position
  Point deepest_point;
  double depth = 0;  ///< mm, rounded up
};

struct Sides {
  std::vector<Side> sides;
  double outside = 0;  ///< how far hull corners that were left out lie outside, mm
};

Sides measure_sides(const HulledContour& outline) {
  const std::vector<std::size_t>& corners = outline.corners;
  Sides all;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::size_t first = corners[k], last = corners[(k + 1) % corners.size()];
    const Point a = outline.point(first), b = outline.point(last);
    Side side{a, b, first, a, 0};
    for (std::size_t i = outline.after(first); i != last; i = outline.after(i)) {
      const Point p = outline.point(i);
      if (geom::turn(a, b, side.deepest_point, p) > 0) {
        side.deepest = i;
        side.deepest_point = p;
      } else if (geom::orientation(a, b, p) < 0) {
        all.outside = std::max(all.outside, distance_to_segment_up(p, a, b));
      }
    }
    side.depth = depth_left_of_line_up(side.deepest_point, a, b);
    all.sides.push_back(side);
  }
  return all;
}

struct ExactishPoint {
  DoubleDouble x, y;
};

/// The half plane of all (x, y) with nx x + ny y >= c, (nx, ny) of length 1.
struct HalfPlane {
  DoubleDouble nx, ny, c;

  /// The half plane left of the side, beyond its deepest point by `margin`.
  HalfPlane(const Side& side, double margin) {
    const DoubleDouble dx = geom::two_sum(side.to.x, -side.from.x),
                       dy = geom::two_sum(side.to.y, -side.from.y);
    const DoubleDouble length = geom::sqrt(dx * dx + dy * dy);
    nx = -dy / length;
    ny = dx / length;
    c = nx * DoubleDouble{side.deepest_point.x} + ny * DoubleDouble{side.deepest_point.y} +
        DoubleDouble{margin};
  }

  [[nodiscard]] DoubleDouble excess(const ExactishPoint& p) const { return nx * p.x + ny * p.y - c; }
  [[nodiscard]] bool holds(const ExactishPoint& p) const { return excess(p).hi >= 0; }
};

/// The point at which two borders meet; nothing unless the second turns left of the first by less than half a
/// turn.
std::optional<ExactishPoint> meet(const HalfPlane& a, const HalfPlane& b) {
  const DoubleDouble sine = a.nx * b.ny - a.ny * b.nx;
  if (!(sine.hi > 0)) return std::nullopt;
  return ExactishPoint{(a.c * b.ny - b.c * a.ny) / sine, (b.c * a.nx - a.c * b.nx) / sine};
}

/// Corners of the common part of half planes in the order of their direction, once around; empty when there
/// is none. A half plane that makes the corner before it useless takes it off the end (or the beginning) of
/// the chain.
std::vector<ExactishPoint> common_part(const std::vector<HalfPlane>& planes) {
  std::vector<const HalfPlane*> chain(planes.size());
  std::vector<ExactishPoint> corner(planes.size());  // corner[i]: chain[i - 1] with chain[i]
  std::size_t begin = 0, end = 0;
  for (const HalfPlane& plane : planes) {
    while (end - begin >= 2 && !plane.holds(corner[end - 1])) --end;
    while (end - begin >= 2 && !plane.holds(corner[begin + 1])) ++begin;
    if (end > begin) {
      const auto met = meet(*chain[end - 1], plane);
      if (!met) return {};
      corner[end] = *met;
    }
    chain[end++] = &plane;
  }
  while (end - begin > 2 && !chain[begin]->holds(corner[end - 1])) --end;
  while (end - begin > 2 && !chain[end - 1]->holds(corner[begin + 1])) ++begin;
  if (end - begin < 3) return {};
  const auto closing = meet(*chain[end - 1], *chain[begin]);
  if (!closing) return {};
  corner[begin] = *closing;
  return {corner.begin() + static_cast<std::ptrdiff_t>(begin),
          corner.begin() + static_cast<std::ptrdiff_t>(end)};
}

/// The corners rounded to doubles, without those that rounding made superfluous.
std::optional<geom::ConvexPolygon> rounded_polygon(const std::vector<ExactishPoint>& corners) {
  geom::Ring points, ring;
  for (const ExactishPoint& p : corners) points.push_back({p.x.hi, p.y.hi});
  for (const std::size_t index : geom::convex_hull(points)) ring.push_back(points[index]);
  auto polygon = geom::ConvexPolygon::make(std::move(ring));
  if (!polygon) return std::nullopt;
  return *std::move(polygon);
}

/// Every vertex lies beyond every side's deepest point, also when it comes `slack` short of the half planes.
/// The vertex nearest to a side moves on around the polygon as the sides do: O(sides + vertices).
bool is_beyond(const geom::ConvexPolygon& polygon, const std::vector<Side>& sides,
               const std::vector<HalfPlane>& planes, double slack) {
  const auto nearer = [&](const Side& side, std::size_t i, std::size_t j) {
    return geom::turn(side.from, side.to, polygon[j], polygon[i]) < 0;
  };
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) nearest = nearer(sides[0], i, nearest) ? i : nearest;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    ask();
    while (nearer(sides[k], polygon.next(nearest), nearest)) nearest = polygon.next(nearest);
    const Point v = polygon[nearest];
    if (geom::turn(sides[k].from, sides[k].to, sides[k].deepest_point, v) <= 0) return false;
    if (!(planes[k].excess({{v.x, 0}, {v.y, 0}}).hi >= -slack)) return false;
  }
  return true;
}

/// The largest distance of a coordinate from its shortest decimal.
double written_error(const geom::Ring& ring) {
  double error = 0;
  for (const Point p : ring) {
    for (const double v : {p.x, p.y}) {
      const auto read = read_millimetres(fmt::format("{}", v), LengthUnit::millimetre);
      error = std::max(error, read ? read->error : 0.0);
    }
  }
  return error;
}

double sum_rounded_up(std::initializer_list<double> terms) {
  double sum = 0;
  for (const double term : terms) sum = std::nextafter(sum + term, std::numeric_limits<double>::infinity());
  return sum;
}

}  // namespace

Result<TrimmedContour> trim_to_convex(const ContourFile& file, double tolerance) {
  if (!(tolerance >= 0) || std::isinf(tolerance)) {
    return failure(ErrorCode::usage,
                   fmt::format("--trim {}: a depth in mm, 0 or more, is wanted", tolerance));
  }
  // Sides between corners closer to straight than this meet nowhere in particular.
  const double rounding = kHalfUlp * geom::largest_coordinate(file.points);
  const double straight = std::max(kCollinearErrors * file.coordinate_error, 16 * rounding);
  LEKALO_TRY(const auto outline, find_hull(file, straight));

  const Sides measured = measure_sides(outline);
  const Side& worst = *std::max_element(measured.sides.begin(), measured.sides.end(),
                                        [](const Side& a, const Side& b) { return a.depth < b.depth; });
  if (!(worst.depth <= tolerance + straight)) {
    return refuse(file.name, fmt::format("--trim {} is not enough: {} lies {:.4g} mm inside the convex hull",
                                         tolerance, outline.name(worst.deepest), worst.depth));
  }

  // Decimals of the file differ from its points by up to sqrt(2) coordinate errors, those of the result by up
  // to sqrt(2) times half a unit in the last place; rounding the corners costs the same again.
  const double needed = 1.5 * (file.coordinate_error + rounding);
  constexpr int kTries = 8;
  double margin = 2 * needed;
  for (int attempt = 0; attempt < kTries; ++attempt, margin *= 2) {
    std::vector<HalfPlane> planes;
    for (const Side& side : measured.sides) planes.emplace_back(side, margin);
    auto polygon = rounded_polygon(common_part(planes));
    if (!polygon) break;
    if (!is_beyond(*polygon, measured.sides, planes, margin - needed)) continue;
    const double error = written_error(polygon->vertices());
    const double loss = sum_rounded_up({worst.depth, measured.outside, margin, 2 * rounding});
    std::string notice =
        fmt::format("{}: trimmed inwards, at most {:.4g} mm of allowance is lost; deepest at {}", file.name,
                    loss, outline.name(worst.deepest));
    return TrimmedContour{*std::move(polygon), loss, error, {std::move(notice)}};
  }
  return refuse(file.name, fmt::format("nothing convex is left inside dents up to {:.4g} mm deep ({})",
                                       worst.depth, outline.name(worst.deepest)));
}

}  // namespace lekalo::io

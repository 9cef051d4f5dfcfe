#include "near_edges.hpp"

#include <algorithm>

#include "arc_middle.hpp"

namespace lekalo::io {
namespace {

using geom::Box;
using geom::Curve;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// Parts of an edge are halved until they are this share of the limit long.
constexpr double kFinestOfLimit = 1.0 / 1024;

std::vector<Box> boxes_of(const std::vector<Curve>& curves) {
  std::vector<Box> boxes;
  for (const Curve& curve : curves) boxes.push_back(curve_box(curve));
  return boxes;
}

std::vector<Curve> curves_of(const std::vector<Edge>& edges) {
  std::vector<Curve> curves;
  for (const Edge& edge : edges) curves.push_back(geom::make_curve(edge));
  return curves;
}

/// Returns the points of a part between its ends where its distance from the line or circle that carries a
/// curve may have an extreme.
std::vector<Point> extremes(const Edge& part, const Curve& curve) {
  const Curve whole = geom::make_curve(part);
  if (part.kind == EdgeKind::line) {
    if (curve.edge.kind == EdgeKind::line) return {};
    const double foot = dot(curve.edge.centre - part.from, whole.unit);
    if (!(foot > 0 && foot < whole.length)) return {};
    return {part.from + foot * whole.unit};
  }
  const Point axis =
      curve.edge.kind == EdgeKind::line ? perpendicular(curve.unit) : part.centre - curve.edge.centre;
  std::vector<Point> found;
  const double length = norm(axis);
  if (!(length > 0)) return found;
  for (const double along : {whole.radius / length, -whole.radius / length})
    if (geom::faces(whole, along * axis)) found.push_back(part.centre + along * axis);
  return found;
}

/// Says whether every point of a part has its foot, on the line or circle that carries a curve, within the
/// curve. No may be said of a part of which that is true.
bool stands_on(const Edge& part, const Curve& curve) {
  if (curve.edge.kind == EdgeKind::line) {
    const auto within = [&](Point p) {
      const double along = dot(p - curve.edge.from, curve.unit);
      return along >= 0 && along <= curve.length;
    };
    if (!within(part.from) || !within(part.to)) return false;
    if (part.kind == EdgeKind::line) return true;
    const Curve whole = geom::make_curve(part);
    for (const double along : {whole.radius, -whole.radius})
      if (geom::faces(whole, along * curve.unit) && !within(part.centre + along * curve.unit)) return false;
    return true;
  }
  // Seen from well within its circle, an arc of less than a radian goes one way, and less than two radians.
  const Point centre = curve.edge.centre;
  if (part.kind != EdgeKind::line &&
      !(geom::arc_sweep(part) < 1 && 2 * norm(centre - part.centre) <= norm(part.from - part.centre)))
    return false;
  if (curve.full) return true;
  // So the part goes the short way from its one end to the other, and the gap is longer than that.
  return geom::arc_sweep(curve.edge) < 4.7 && dot(part.from - centre, part.to - centre) > 0 &&
         geom::faces(curve, part.from - centre) && geom::faces(curve, part.to - centre);
}

}  // namespace

double off_carrier(const Curve& curve, Point p) {
  if (curve.edge.kind == EdgeKind::line) return cross(curve.unit, p - curve.edge.from);
  return norm(p - curve.edge.centre) - curve.radius;
}

std::pair<double, double> range_off_carrier(const Edge& part, const Curve& curve) {
  const double from = off_carrier(curve, part.from), to = off_carrier(curve, part.to);
  std::pair<double, double> range = std::minmax({from, to});
  for (const Point p : extremes(part, curve)) {
    const double off = off_carrier(curve, p);
    range = {std::min(range.first, off), std::max(range.second, off)};
  }
  return range;
}

std::optional<double> farthest_along(const Edge& part, const Curve& curve) {
  // A line is nowhere farther from another than at its ends.
  if (part.kind == EdgeKind::line && curve.edge.kind == EdgeKind::line)
    return std::max(norm(nearest_on(curve, part.from) - part.from),
                    norm(nearest_on(curve, part.to) - part.to));
  if (!stands_on(part, curve)) return std::nullopt;
  const auto [low, high] = range_off_carrier(part, curve);
  return std::max(-low, high);
}

Bisected bisected(const Edge& edge) {
  Bisected halves{edge, edge, {}, 0};
  if (edge.kind == EdgeKind::line) {
    halves.middle = 0.5 * (edge.from + edge.to);
    halves.half_length = 0.5 * norm(edge.to - edge.from);
  } else {
    const Curve curve = geom::make_curve(edge);
    halves.middle = curve.full ? edge.centre - (edge.from - edge.centre) : middle_of(curve);
    // An arc of up to half a turn is at most pi / 2 times as long as its chord.
    halves.half_length = 1.6 * std::max(norm(halves.middle - edge.from), norm(halves.middle - edge.to));
  }
  halves.first.to = halves.second.from = halves.middle;
  return halves;
}

NearEdges::NearEdges(const std::vector<Edge>& edges) : curves_(curves_of(edges)), tree_(boxes_of(curves_)) {}

std::optional<double> NearEdges::distance(Point p, double limit) const {
  std::optional<double> least;
  tree_.visit_meeting(geom::grown({p, p}, limit), [&](std::uint32_t i) {
    const double far = norm(nearest_on(curves_[i], p) - p);
    if (far <= limit && (!least || far < *least)) least = far;
  });
  return least;
}

std::optional<double> NearEdges::farthest(const Edge& edge, double limit, std::size_t& work) const {
  double largest = 0;
  std::vector<Edge> open{edge};
  while (!open.empty()) {
    if (work == 0) return std::nullopt;
    --work;
    ask();
    const Edge part = open.back();
    open.pop_back();
    const Bisected halves = bisected(part);
    const auto middle = distance(halves.middle, limit);
    if (!middle) return std::nullopt;
    double bound = *middle + halves.half_length;
    tree_.visit_meeting(geom::grown({halves.middle, halves.middle}, limit), [&](std::uint32_t i) {
      if (const auto along = farthest_along(part, curves_[i])) bound = std::min(bound, *along);
    });
    if (bound <= largest) continue;
    const bool fine = halves.half_length <= limit * kFinestOfLimit || !(halves.half_length > 0);
    if (bound <= *middle + limit * kFinestOfLimit || fine) {
      if (!(bound <= limit)) return std::nullopt;
      largest = std::max(largest, bound);
      continue;
    }
    open.push_back(halves.first);
    open.push_back(halves.second);
  }
  return largest;
}

}  // namespace lekalo::io

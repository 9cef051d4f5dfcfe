#include "contour_relation.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/boolean.hpp"
#include "near_edges.hpp"

namespace lekalo::io {
namespace {

using geom::Contour;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// Parts of a contour are halved until they are this share of the reach long.
constexpr double kFinest = 1.0 / 64;
/// The reach is no less than this, mm, or halving would not end.
constexpr double kLeastReach = 1e-6;

/// Returns the points of a part between its ends where its distance from the line or circle that carries a
/// curve may have an extreme.
std::vector<Point> extremes(const Edge& part, const geom::Curve& curve) {
  const geom::Curve whole = geom::make_curve(part);
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

/// Returns the distance from the line or circle that carries a curve, with a sign for its two sides.
double off_carrier(const geom::Curve& curve, Point p) {
  if (curve.edge.kind == EdgeKind::line) return cross(curve.unit, p - curve.edge.from);
  return norm(p - curve.edge.centre) - curve.radius;
}

/// Says whether all of a part is farther than reach from what carries a curve, on one side of it.
bool is_beyond(const Edge& part, const geom::Curve& curve, double reach) {
  const double from = off_carrier(curve, part.from), to = off_carrier(curve, part.to);
  double low = std::min(from, to), high = std::max(from, to);
  for (const Point p : extremes(part, curve)) {
    low = std::min(low, off_carrier(curve, p)), high = std::max(high, off_carrier(curve, p));
  }
  return low > reach || high < -reach;
}

/// Says of a part with this middle that all of it is within reach of a curve, as can be told from a few of
/// its points. So a long arc beside another is not cut into parts as short as the reach.
bool runs_along(const Edge& part, Point middle, const geom::Curve& curve, double reach) {
  const auto is_near = [&](Point p) { return norm(nearest_on(curve, p) - p) <= reach; };
  if (!is_near(part.from) || !is_near(part.to)) return false;
  const bool line = part.kind == EdgeKind::line, other_line = curve.edge.kind == EdgeKind::line;
  if (line && other_line) return true;
  // A place near an arc's circle is near the arc, unless it lies in the arc's gap.
  if (!line && !(geom::arc_sweep(part) < 1)) return false;
  if (!other_line && !curve.full && !(geom::arc_sweep(curve.edge) < 5)) return false;
  if (!is_near(middle)) return false;
  const std::vector<Point> inner = extremes(part, curve);
  return std::all_of(inner.begin(), inner.end(),
                     [&](Point p) { return std::abs(off_carrier(curve, p)) <= reach; });
}

Contour anticlockwise(const Contour& contour) {
  return geom::signed_area(contour) > 0 ? contour : geom::reversed(contour);
}

}  // namespace

PlacedContour::PlacedContour(const Contour& contour)
    : contour_(anticlockwise(contour)),
      index_({geom::Region{contour_, {}}}),
      box_(geom::bounds(contour_)),
      area_(geom::signed_area(contour_)) {}

PlacedContour::Sides PlacedContour::sides_of(const PlacedContour& other, double reach,
                                             std::size_t& work) const {
  Sides sides;
  std::vector<Edge> open(contour_.begin(), contour_.end());
  while (!open.empty() && !(sides.outside && sides.inside)) {
    if (work == 0) return {true, true};
    --work;
    ask();
    const Edge part = open.back();
    open.pop_back();
    const Bisected halves = bisected(part);
    const auto near = other.index_.nearest(halves.middle);
    if (near.distance > reach) (other.contains(halves.middle) ? sides.inside : sides.outside) = true;
    // Nothing of the part is on the other side, or nothing of it is beyond reach.
    if (near.distance - halves.half_length > reach || near.distance + halves.half_length <= reach) continue;
    if (runs_along(part, halves.middle, other.index_.curves()[near.edge], reach)) continue;
    // Two edges may part so slowly that neither middle nor length tells that all is beyond reach.
    if (near.distance > reach) {
      bool beyond = true;
      other.index_.visit_within(halves.middle, halves.half_length, reach, [&](std::uint32_t edge) {
        beyond = beyond && is_beyond(part, other.index_.curves()[edge], reach);
      });
      if (beyond) continue;
    }
    if (halves.half_length <= kFinest * reach) continue;
    open.push_back(halves.first);
    open.push_back(halves.second);
  }
  return sides;
}

Relation relation_of(const PlacedContour& a, const PlacedContour& b, double repair, std::size_t& work) {
  const double reach = std::max(repair, kLeastReach);
  const auto of_a = a.sides_of(b, reach, work), of_b = b.sides_of(a, reach, work);
  const bool a_within = !of_a.outside && !of_b.inside, b_within = !of_b.outside && !of_a.inside;
  if (a_within && b_within) return Relation::same;
  if (a_within) return Relation::first_in;
  if (b_within) return Relation::second_in;
  return of_a.inside || of_b.inside ? Relation::crossing : Relation::beside;
}

double shared_part(const PlacedContour& a, const PlacedContour& b) {
  const auto both = geom::combine({geom::Region{a.contour_, {}}}, {geom::Region{b.contour_, {}}},
                                  geom::BooleanOperation::intersect);
  if (!both) return 1;
  double area = 0;
  for (const geom::Region& region : both->regions) area += geom::area(region);
  return area / std::min(a.area_, b.area_);
}

}  // namespace lekalo::io

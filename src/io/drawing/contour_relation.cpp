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

/// Parts of a contour are halved until they are this share of the reach long.
constexpr double kFinest = 1.0 / 64;
/// The reach is no less than this, mm, or halving would not end.
constexpr double kLeastReach = 1e-6;

/// Says of a part with a point within reach of a curve that all of it is, as can be told from its ends.
bool runs_along(const Edge& part, const geom::Curve& curve, double reach) {
  if ((part.kind == EdgeKind::line) != (curve.edge.kind == EdgeKind::line)) return false;
  if (norm(nearest_on(curve, part.from) - part.from) > reach ||
      norm(nearest_on(curve, part.to) - part.to) > reach)
    return false;
  if (part.kind == EdgeKind::line) return true;
  // Arcs of two circles that lie within reach of each other do so as well, unless one has its gap there.
  return geom::arc_sweep(part) < 1 && (curve.full || geom::arc_sweep(curve.edge) < 5) &&
         norm(part.centre - curve.edge.centre) +
                 std::abs(geom::arc_radius(part) - geom::arc_radius(curve.edge)) <=
             reach;
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
    if (runs_along(part, other.index_.curves()[near.edge], reach)) continue;
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

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
using geom::Point;

/// Parts of a contour are halved until they are this share of the reach long.
constexpr double kFinestOfReach = 1.0 / 64;
/// The reach is no less than this, mm, or halving would not end.
constexpr double kLeastReach = 1e-6;

/// Says whether all of a part is farther than reach from what carries a curve, on one side of it.
bool is_beyond(const Edge& part, const geom::Curve& curve, double reach) {
  const auto [low, high] = range_off_carrier(part, curve);
  return low > reach || high < -reach;
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
    const auto along = farthest_along(part, other.index_.curves()[near.edge]);
    if (along && *along <= reach) continue;
    // Two edges may part so slowly that neither middle nor length tells that all is beyond reach.
    if (near.distance > reach) {
      bool beyond = true;
      other.index_.visit_within(halves.middle, halves.half_length, reach, [&](std::uint32_t edge) {
        beyond = beyond && is_beyond(part, other.index_.curves()[edge], reach);
      });
      if (beyond) continue;
    }
    if (halves.half_length <= kFinestOfReach * reach) continue;
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

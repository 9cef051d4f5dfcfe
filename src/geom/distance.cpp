#include "lekalo/geom/distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lekalo/geom/predicates.hpp"

namespace lekalo::geom {

namespace {

/// The foot of the perpendicular from p, as dot products along ab, so that nothing is divided yet.
struct Projection {
  Point along, to_p;
  double dot_p, dot_along;

  Projection(Point p, Point a, Point b) noexcept
      : along(b - a), to_p(p - a), dot_p(dot(along, to_p)), dot_along(dot(along, along)) {}
  // The comparison is written so that a segment of one point, where both products are 0, counts as "before
  // a".
  [[nodiscard]] bool before_a() const noexcept { return !(dot_p > 0); }
  [[nodiscard]] bool beyond_b() const noexcept { return dot_p >= dot_along; }
};

}  // namespace

Point nearest_on_segment(Point p, Point a, Point b) noexcept {
  const Projection foot(p, a, b);
  if (foot.before_a()) return a;
  if (foot.beyond_b()) return b;
  return a + (foot.dot_p / foot.dot_along) * foot.along;
}

double distance_to_segment(Point p, Point a, Point b) noexcept {
  const Projection foot(p, a, b);
  if (foot.before_a()) return norm(foot.to_p);
  if (foot.beyond_b()) return norm(p - b);
  return std::abs(cross(foot.along, foot.to_p)) / std::sqrt(foot.dot_along);
}

double distance_between_segments(Point a, Point b, Point c, Point d) noexcept {
  if (segment_relation(a, b, c, d) != SegmentRelation::disjoint) return 0;
  return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                   distance_to_segment(d, a, b)});
}

double distance_to_boundary(Point p, const Ring& ring) noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i == 0 ? ring.size() - 1 : i - 1];
    least = std::min(least, distance_to_segment(p, a, ring[i]));
  }
  return least;
}

}  // namespace lekalo::geom

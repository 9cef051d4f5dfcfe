#include "lekalo/geom/distance.hpp"

#include <cmath>

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

}  // namespace lekalo::geom

#include "lekalo/geom/predicates.hpp"

#include "turn_tiers.hpp"

namespace lekalo::geom {

namespace {

/// Orders points along a line: by x, on a vertical line by y.
constexpr bool before(Point a, Point b) noexcept { return a.x != b.x ? a.x < b.x : a.y < b.y; }

SegmentRelation collinear_relation(Point a, Point b, Point c, Point d) noexcept {
  if (before(b, a)) return collinear_relation(b, a, c, d);
  if (before(d, c)) return collinear_relation(a, b, d, c);
  const Point from = before(a, c) ? c : a;
  const Point to = before(b, d) ? b : d;
  if (from == to) return SegmentRelation::touch;
  return before(from, to) ? SegmentRelation::overlap : SegmentRelation::disjoint;
}

constexpr bool intervals_apart(double a, double b, double c, double d) noexcept {
  return (a < c && a < d && b < c && b < d) || (a > c && a > d && b > c && b > d);
}

}  // namespace

int detail::turn_exact(Point a, Point b, Point c, Point d) noexcept {
  const TurnDifferences differences(a, b, c, d);
  const int sign = turn_of_exact_differences(differences);
  return sign != kUndecided ? sign : turn_by_expansion(differences);
}

PointLocation locate_point(const double* xy, std::size_t n, Point p) noexcept {
  if (n == 0) return PointLocation::outside;
  bool inside = false;
  Point a{xy[2 * n - 2], xy[2 * n - 1]};
  for (std::size_t i = 0; i < n; ++i) {
    const Point b{xy[2 * i], xy[2 * i + 1]};
    if (b == p) return PointLocation::boundary;
    if ((a.y > p.y) != (b.y > p.y)) {
      // The edge crosses the height of p, and the rest asks whether it does so to the right of p.
      if (a.x > p.x && b.x > p.x) {
        inside = !inside;
      } else if (!(a.x < p.x && b.x < p.x)) {
        const int side = orientation(a, b, p);
        if (side == 0) return PointLocation::boundary;
        if ((side > 0) == (b.y > a.y)) inside = !inside;
      }
    } else if (a.y == p.y && b.y == p.y && (a.x < p.x) != (b.x < p.x)) {
      return PointLocation::boundary;
    }
    a = b;
  }
  return inside ? PointLocation::inside : PointLocation::outside;
}

SegmentRelation segment_relation(Point a, Point b, Point c, Point d) noexcept {
  if (intervals_apart(a.x, b.x, c.x, d.x) || intervals_apart(a.y, b.y, c.y, d.y)) {
    return SegmentRelation::disjoint;
  }
  const int c_side = orientation(a, b, c), d_side = orientation(a, b, d);
  if (c_side * d_side > 0) return SegmentRelation::disjoint;
  const int a_side = orientation(c, d, a), b_side = orientation(c, d, b);
  if (a_side * b_side > 0) return SegmentRelation::disjoint;
  if (c_side == 0 && d_side == 0 && a_side == 0 && b_side == 0) return collinear_relation(a, b, c, d);
  // Each line parts the ends of the other or passes through one. So the segments meet, and they meet in an
  // end if a sign is 0.
  const bool in_an_end = c_side * d_side * a_side * b_side == 0;
  return in_an_end ? SegmentRelation::touch : SegmentRelation::cross;
}

}  // namespace lekalo::geom

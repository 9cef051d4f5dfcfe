#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/point.hpp"
#include "lekalo/geom/predicates.hpp"

namespace lekalo::geom {

/// A closed contour as its points in order; the last is joined to the first, no point is repeated.
using Ring = std::vector<Point>;

/// Signed area of a closed ring in square millimetres, positive when it runs counter-clockwise.
///
/// \param ring  finite; any number of points, fewer than three give 0.
/// \return      within (n^2 + 4n) u d^2 of the exact area, to first order: u = 2^-53, d the largest
///              coordinate difference from ring[0].
///
/// Laws (tests/property/geom_polygon_test.cpp), exact where no product rounds (multiples of 1/8 mm below 4
/// m):
///   (1) signed_area(reversed) == -signed_area
///   (2) signed_area(moved) == signed_area
///   (3) signed_area(begun at another vertex) == signed_area
///
/// Cost: O(n); allocates nothing.
/// Source: the shoelace formula (Meister 1769), centred on ring[0] so that a small ring far from the origin
/// keeps its digits.
[[nodiscard]] double signed_area(const Ring& ring) noexcept;

/// Corners of the axis-parallel box of a ring; both (0, 0) for an empty one.
struct Box {
  Point low, high;
  friend constexpr bool operator==(const Box&, const Box&) = default;
};
[[nodiscard]] Box bounds(const Ring& ring) noexcept;
/// The box with corners at a and b.
[[nodiscard]] inline Box box_of(Point a, Point b) noexcept {
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}
/// The least box around both.
[[nodiscard]] inline Box joined(const Box& a, const Box& b) noexcept {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}
/// The box with every side moved outwards by so many mm.
[[nodiscard]] inline Box grown(const Box& box, double by) noexcept {
  return {box.low - Point{by, by}, box.high + Point{by, by}};
}

/// Largest absolute coordinate of a ring, 0 for an empty one.
[[nodiscard]] double largest_coordinate(const Ring& ring) noexcept;

/// locate_point of predicates.hpp for a ring.
[[nodiscard]] PointLocation locate_point(const Ring& ring, Point p) noexcept;

/// Convex hull, counter-clockwise, strictly convex (no collinear points), from any points in any order that
/// satisfy is_exact. Returns indices into `points`, the leftmost first (the lowest of them); for duplicate
/// points the smallest index. Fewer than three indices when all points lie on one line: its two ends, one
/// point, or none.
///
/// Laws: decided by the exact predicate, so no point lies outside, the hull of the hull is itself, and the
/// hull's points do not depend on the order of the input.
/// Cost: O(n log n). Source: Andrew 1979 (monotone chain).
[[nodiscard]] std::vector<std::size_t> convex_hull(const Ring& points);

/// A strictly convex polygon: at least three vertices, counter-clockwise, every corner a left turn by the
/// exact predicate, once around. The type is the proof: it can only be made by `make`.
class ConvexPolygon {
 public:
  /// Fails with ErrorCode::bad_input, naming the first vertex (0-based, with its coordinates) that breaks the
  /// rule: not is_exact, repeated, on the line of its neighbours, a right turn, or where a second turn around
  /// begins. Does not reverse, hull or drop anything: that is the reader's work, with a notice. Cost: O(n).
  [[nodiscard]] static Result<ConvexPolygon> make(Ring vertices);

  [[nodiscard]] const Ring& vertices() const noexcept { return vertices_; }
  [[nodiscard]] std::size_t size() const noexcept { return vertices_.size(); }
  [[nodiscard]] const Point& operator[](std::size_t i) const noexcept { return vertices_[i]; }
  /// The vertex after i, cyclically; edge i runs from i to next(i).
  [[nodiscard]] std::size_t next(std::size_t i) const noexcept {
    return i + 1 == vertices_.size() ? 0 : i + 1;
  }

 private:
  explicit ConvexPolygon(Ring vertices) : vertices_(std::move(vertices)) {}
  Ring vertices_;
};

}  // namespace lekalo::geom

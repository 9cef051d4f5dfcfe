#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/point.hpp"

namespace lekalo::geom {

/// A closed contour as its points in order; the last is joined to the first, no point is repeated.
using Ring = std::vector<Point>;

/// Signed area of a closed ring in square millimetres, positive when it runs counter-clockwise.
///
/// \param ring  finite; any number of points, fewer than three give 0.
/// Cost: O(n); allocates nothing.
/// Source: the shoelace formula (Meister 1769), centred on ring[0] so that a small ring far from the origin
/// keeps its digits.
[[nodiscard]] double signed_area(const Ring& ring) noexcept;

/// Corners of the axis-parallel box of a ring; both (0, 0) for an empty one.
struct Box {
  Point low, high;
};
[[nodiscard]] Box bounds(const Ring& ring) noexcept;

/// Largest absolute coordinate of a ring, 0 for an empty one.
[[nodiscard]] double largest_coordinate(const Ring& ring) noexcept;

/// Convex hull, counter-clockwise, strictly convex (no collinear points), from any points in any order.
/// Decided by the exact predicate, so the hull of the hull is itself. Returns indices into `points`, the
/// lowest-leftmost first; for duplicate points the smallest index. Fewer than three indices when all points
/// lie on one line. Cost: O(n log n). Source: Andrew 1979 (monotone chain).
[[nodiscard]] std::vector<std::size_t> convex_hull(const Ring& points);

/// A strictly convex polygon: at least three vertices, counter-clockwise, every corner a left turn by the exact
/// predicate, once around. The type is the proof: it can only be made by `make`.
class ConvexPolygon {
 public:
  /// Fails with ErrorCode::bad_input, naming the first vertex (0-based) that breaks the rule. Does not
  /// reverse, hull or drop anything: that is the reader's work, with a notice.
  [[nodiscard]] static Result<ConvexPolygon> make(Ring vertices);

  [[nodiscard]] const Ring& vertices() const noexcept { return vertices_; }
  [[nodiscard]] std::size_t size() const noexcept { return vertices_.size(); }
  [[nodiscard]] const Point& operator[](std::size_t i) const noexcept { return vertices_[i]; }
  /// The vertex after i, cyclically; edge i runs from i to next(i).
  [[nodiscard]] std::size_t next(std::size_t i) const noexcept { return i + 1 == vertices_.size() ? 0 : i + 1; }

 private:
  explicit ConvexPolygon(Ring vertices) : vertices_(std::move(vertices)) {}
  Ring vertices_;
};

}  // namespace lekalo::geom

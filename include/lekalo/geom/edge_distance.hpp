#pragma once

#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::geom {

/// Distances between edges of regions (lines and arcs, region.hpp), millimetres, by short formulas.
///
/// Every distance is within kEdgeDistanceError * d of the exact one between the curves meant, d the largest
/// coordinate or radius, plus half the difference of an arc's radii at its ends; crossing edges give at most
/// that. For a radius that is large against its chord the centre's own digits are the limit: that is why d
/// counts radii. (64 u: five differences, a square root and a division, with reserve.)
inline constexpr double kEdgeDistanceError = 0x1p-47;

/// An edge with all that its distances need, computed once.
struct Curve {
  Edge edge;
  Point unit;         ///< direction of a line
  double length = 0;  ///< of a line
  double radius = 0;  ///< of an arc
  /// True when the arc turns through a half turn or more.
  bool wide = false;
  /// True when it turns through more than a half turn, but is not a full circle.
  bool beyond_half = false;
  bool full = false;  ///< a full circle
  /// The directions of an arc's ends from its centre, counter-clockwise from first to last.
  Point first, last;
};
[[nodiscard]] Curve make_curve(const Edge& edge) noexcept;

struct ClosestPoints {
  double distance = 0;
  Point a, b;  ///< on the first and the second edge
};

/// Says whether the arc has a point in this direction from its centre.
/// \pre an arc
[[nodiscard]] bool faces(const Curve& arc, Point direction) noexcept;

/// Returns the point of an edge nearest to p; of several any one.
[[nodiscard]] Point nearest_on(const Curve& curve, Point p) noexcept;

/// Returns the nearest points of two edges; of several pairs any one. The distance is 0 where the edges
/// cross.
[[nodiscard]] ClosestPoints closest_points(const Curve& a, const Curve& b) noexcept;

/// Returns the box of the curve, enlarged by its rounding.
[[nodiscard]] Box curve_box(const Curve& curve) noexcept;

}  // namespace lekalo::geom

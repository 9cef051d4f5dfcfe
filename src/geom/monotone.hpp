#pragma once

#include "lekalo/geom/edge_distance.hpp"

namespace lekalo::geom::detail {

/// A part of an edge along which y only grows or only falls: a line, or a stretch of an arc on the right or
/// the left half of its circle.
struct Monotone {
  const Curve* curve = nullptr;
  Point begin, end;
  bool right = false;  ///< of an arc

  [[nodiscard]] bool is_line() const noexcept { return curve->edge.kind == EdgeKind::line; }
};

/// Returns the x of an arc's stretch at height y, which lies between its ends.
[[nodiscard]] double arc_x_at(const Monotone& stretch, double y) noexcept;

/// Calls visit(part) for the parts of an edge in the order of a counter-clockwise arc, or of the line.
template <class Visit>
void visit_monotone(const Curve& curve, Visit&& visit) {
  const Edge& edge = curve.edge;
  if (edge.kind == EdgeKind::line) return visit(Monotone{&curve, edge.from, edge.to, false});
  // A counter-clockwise arc runs upwards on the circle's right half and downwards on its left, so it is split
  // where it is highest and lowest. A turning point exactly at an end does not split.
  const Point centre = edge.centre;
  const bool forwards = edge.kind == EdgeKind::arc_ccw;
  bool right = curve.first.x > 0 || (curve.first.x == 0 && curve.first.y < 0);
  const bool ends_right = curve.last.x > 0 || (curve.last.x == 0 && curve.last.y > 0);
  const int splits = right != ends_right ? 1 : (curve.beyond_half || curve.full ? 2 : 0);
  const Point last = forwards ? edge.to : edge.from;
  Point begin = forwards ? edge.from : edge.to;
  for (int i = 0; i <= splits; ++i) {
    const Point turning{centre.x, right ? centre.y + curve.radius : centre.y - curve.radius};
    const Point end = i == splits ? last : turning;
    visit(Monotone{&curve, begin, end, right});
    begin = end;
    right = !right;
  }
}

}  // namespace lekalo::geom::detail

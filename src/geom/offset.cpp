#include "lekalo/geom/offset.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/base/assert.hpp"
#include "overlay.hpp"

namespace lekalo::geom {
namespace {

using detail::Outlines;
using detail::Winding;

Edge line(Point from, Point to) { return {EdgeKind::line, from, to, {}}; }

Point unit(Point v) { return (1 / norm(v)) * v; }
Point right_of(Point direction) { return -perpendicular(direction); }

bool is_circle(const Edge& edge) { return edge.kind != EdgeKind::line && edge.from == edge.to; }

Point direction_at(const Edge& edge, Point at) {
  if (edge.kind == EdgeKind::line) return unit(edge.to - edge.from);
  const Point left = unit(perpendicular(at - edge.centre));
  return edge.kind == EdgeKind::arc_ccw ? left : -left;
}

/// A circle of smaller radius than this part of the arc's is its centre: not further off than points that are
/// snapped together.
constexpr double kNoRadius = kBooleanSnap;

/// What a disc's centre sweeps on the right of contours, as counter-clockwise contours that cover it.
class Brush {
 public:
  Brush(double radius, std::uint8_t operand, Outlines& outlines)
      : radius_(radius), operand_(operand), outlines_(outlines) {}

  void sweep(const Contour& contour) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Edge& edge = contour[i];
      sweep(edge);
      if (!is_circle(edge)) around_corner(edge, contour[i + 1 == contour.size() ? 0 : i + 1]);
    }
  }
  /// On the right of one edge.
  void sweep(const Edge& edge) {
    if (edge.kind == EdgeKind::line)
      along_line(edge);
    else if (is_circle(edge))
      along_circle(edge);
    else
      along_arc(edge);
  }
  void disc(Point centre) {
    const Point from = centre + Point{radius_, 0};
    add({{EdgeKind::arc_ccw, from, from, centre}});
  }

 private:
  void add(const Contour& contour) { outlines_.add(contour, operand_); }

  /// Back along the edge, out to its parallel, along that, and in again.
  void strip(const Edge& edge, const Edge& parallel) {
    Contour contour = reversed({edge});
    contour.push_back(line(edge.from, parallel.from));
    contour.push_back(parallel);
    contour.push_back(line(parallel.to, edge.to));
    add(contour);
  }

  void along_line(const Edge& edge) {
    const Point out = radius_ * right_of(unit(edge.to - edge.from));
    strip(edge, line(edge.from + out, edge.to + out));
  }

  /// Where the brush leads to the centre and the arc's radius is no larger, nothing remains but the sector.
  [[nodiscard]] bool reaches_centre(const Edge& arc) const {
    const double r = arc_radius(arc);
    return arc.kind == EdgeKind::arc_cw && !(r - radius_ > kNoRadius * r);
  }

  void along_arc(const Edge& arc) {
    if (reaches_centre(arc)) {
      Contour contour = reversed({arc});
      contour.push_back(line(arc.from, arc.centre));
      contour.push_back(line(arc.centre, arc.to));
      add(contour);
      return;
    }
    const double out = arc.kind == EdgeKind::arc_ccw ? radius_ : -radius_;
    const Edge parallel{arc.kind, arc.from + out * unit(arc.from - arc.centre),
                        arc.to + out * unit(arc.to - arc.centre), arc.centre};
    strip(arc, parallel);
  }

  void along_circle(const Edge& circle) {
    add(reversed({circle}));
    if (reaches_centre(circle)) return;
    const double out = circle.kind == EdgeKind::arc_ccw ? radius_ : -radius_;
    const Point from = circle.from + out * unit(circle.from - circle.centre);
    add({{circle.kind, from, from, circle.centre}});
  }

  /// The sector about a corner that turns left: no strip covers it.
  void around_corner(const Edge& in, const Edge& next) {
    const Point corner = in.to, arriving = direction_at(in, corner), leaving = direction_at(next, corner);
    const double turn = cross(arriving, leaving);
    constexpr double kNearlyBack = 1e-9;
    if (dot(arriving, leaving) < 0 && std::abs(turn) < kNearlyBack)  // a tip: rounding hides its side
      return disc(corner);
    if (!(turn > 0)) return;
    const Point from = corner + radius_ * right_of(arriving), to = corner + radius_ * right_of(leaving);
    if (!(from == to)) add({line(corner, from), {EdgeKind::arc_ccw, from, to, corner}, line(to, corner)});
  }

  double radius_;
  std::uint8_t operand_;
  Outlines& outlines_;
};

template <class Visit>
void for_each_contour(const std::vector<Region>& regions, Visit&& visit) {
  for (const Region& region : regions) {
    visit(region.outer);
    for (const Contour& hole : region.holes) visit(hole);
  }
}

Result<BooleanResult> grown(const std::vector<Region>& regions, double distance) {
  Outlines outlines;
  outlines.add(regions, 0);
  Brush brush(distance, 0, outlines);
  for_each_contour(regions, [&](const Contour& contour) { brush.sweep(contour); });
  return detail::overlay(outlines, [](const Winding& w) { return w[0] > 0; });
}

/// The outside grown into the material. Edges between two pieces are not outside, hence the union first.
Result<BooleanResult> shrunk(const std::vector<Region>& regions, double distance) {
  const auto whole = united(regions);
  if (!whole) return whole;
  Outlines outlines;
  outlines.add(whole->regions, 0);
  Brush brush(distance, 1, outlines);
  for_each_contour(whole->regions, [&](const Contour& contour) { brush.sweep(reversed(contour)); });
  return detail::overlay(
      outlines, [](const Winding& w) { return w[0] > 0 && w[1] <= 0; }, whole->edge_error);
}

/// Adds all points within `distance` of an edge, on the sides asked for.
void add_rim(const Edge& edge, double distance, std::uint8_t operand, bool both_sides, Outlines& outlines) {
  Brush brush(distance, operand, outlines);
  brush.sweep(edge);
  if (both_sides) brush.sweep(reversed({edge}).front());
  if (is_circle(edge)) return;
  brush.disc(edge.from);
  brush.disc(edge.to);
}

}  // namespace

Result<BooleanResult> offset_edges(const std::vector<Region>& regions, const std::vector<double>& distances) {
  std::vector<const Edge*> edges;
  for_each_contour(regions, [&](const Contour& contour) {
    for (const Edge& edge : contour) edges.push_back(&edge);
  });
  LEKALO_ASSERT(edges.size() == distances.size());
  Outlines cut;
  cut.add(regions, 0);
  for (std::size_t k = 0; k < edges.size(); ++k)
    if (distances[k] < 0) add_rim(*edges[k], -distances[k], 1, true, cut);
  const auto rest = detail::overlay(cut, [](const Winding& w) { return w[0] > 0 && w[1] <= 0; });
  if (!rest) return rest;
  Outlines all;
  all.add(rest->regions, 0);
  for (std::size_t k = 0; k < edges.size(); ++k)
    if (distances[k] > 0) add_rim(*edges[k], distances[k], 0, false, all);
  return detail::overlay(
      all, [](const Winding& w) { return w[0] > 0; }, rest->edge_error);
}

Result<BooleanResult> offset(const std::vector<Region>& regions, double distance) {
  if (distance == 0) return united(regions);
  return distance > 0 ? grown(regions, distance) : shrunk(regions, -distance);
}

}  // namespace lekalo::geom

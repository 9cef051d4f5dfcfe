#include "lekalo/geom/offset.hpp"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "lekalo/base/assert.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/predicates.hpp"
#include "lekalo/geom/region_check.hpp"
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

/// Adds the lines that join an arc's ends to its mean circle, which they may miss (region.hpp), so that discs
/// are swept along what is meant.
Contour with_joints(const Contour& contour) {
  Contour made;
  for (const Edge& edge : contour) {
    if (edge.kind == EdgeKind::line || edge.from == edge.to) {
      made.push_back(edge);
      continue;
    }
    const double r = arc_radius(edge), off = std::abs(norm(edge.from - edge.centre) - r);
    // The ends are off by rounding already by this share of the radius.
    constexpr double kRoundedAlready = 0.25 * kEdgeErrorInSnaps * kBooleanSnap;
    const Edge arc{edge.kind, edge.centre + r * unit(edge.from - edge.centre),
                   edge.centre + r * unit(edge.to - edge.centre), edge.centre};
    if (off <= kRoundedAlready * r || arc.from == edge.from || arc.to == edge.to || arc.from == arc.to) {
      made.push_back(edge);
      continue;
    }
    made.push_back(line(edge.from, arc.from));
    made.push_back(arc);
    made.push_back(line(arc.to, edge.to));
  }
  return made;
}

/// A circle whose radius is below this share of the arc's counts as its centre. The points of the circle are
/// no further apart than points that are snapped together.
constexpr double kNoRadius = kBooleanSnap;

/// "Offsets" in docs/design/boolean.md: the area that a disc's centre sweeps on the right of contours,
/// covered by counter-clockwise contours.
class Brush {
 public:
  Brush(double radius, std::uint8_t operand, Outlines& outlines)
      : radius_(radius), operand_(operand), outlines_(outlines) {}

  void sweep(const Contour& drawn) {
    const Contour contour = with_joints(drawn);
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Edge& edge = contour[i];
      sweep(edge);
      if (!is_circle(edge)) around_corner(edge, contour[i + 1 == contour.size() ? 0 : i + 1]);
    }
  }
  /// Sweeps the right of one edge.
  void sweep(const Edge& edge) {
    ask();
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

  /// Adds the strip between an edge and its parallel: back along the edge, out to the parallel, along that,
  /// and in again.
  void strip(const Edge& edge, const Edge& parallel) {
    Contour contour{reversed(edge)};
    contour.push_back(line(edge.from, parallel.from));
    if (!(parallel.from == parallel.to)) contour.push_back(parallel);
    contour.push_back(line(parallel.to, edge.to));
    add(contour);
  }

  void along_line(const Edge& edge) {
    const Point out = radius_ * right_of(unit(edge.to - edge.from));
    strip(edge, line(edge.from + out, edge.to + out));
  }

  /// Says whether the brush reaches the centre of an arc whose radius is no larger than its own, so that
  /// nothing remains but the sector.
  [[nodiscard]] bool reaches_centre(const Edge& arc) const {
    const double r = arc_radius(arc);
    return arc.kind == EdgeKind::arc_cw && !(r - radius_ > kNoRadius * r);
  }

  void along_arc(const Edge& arc) {
    if (reaches_centre(arc)) {
      Contour contour{reversed(arc)};
      contour.push_back(line(arc.from, arc.centre));
      contour.push_back(line(arc.centre, arc.to));
      add(contour);
      return;
    }
    const double out = arc.kind == EdgeKind::arc_ccw ? radius_ : -radius_;
    Edge parallel{arc.kind, arc.from + out * unit(arc.from - arc.centre),
                  arc.to + out * unit(arc.to - arc.centre), arc.centre};
    // An arc whose length is a few last places may come out turned round, and would then be nearly the whole
    // circle.
    if (dot(arc.from - arc.centre, arc.to - arc.centre) > 0 &&
        orientation(arc.centre, parallel.from, parallel.to) != orientation(arc.centre, arc.from, arc.to))
      parallel = line(parallel.from, parallel.to);
    strip(arc, parallel);
  }

  void along_circle(const Edge& circle) {
    add({reversed(circle)});
    if (reaches_centre(circle)) return;
    const double out = circle.kind == EdgeKind::arc_ccw ? radius_ : -radius_;
    const Point from = circle.from + out * unit(circle.from - circle.centre);
    add({{circle.kind, from, from, circle.centre}});
  }

  /// Sweeps the sector about a corner that turns left, which no strip covers.
  void around_corner(const Edge& in, const Edge& next) {
    const Point corner = in.to, arriving = direction_at(in, corner), leaving = direction_at(next, corner);
    const double turn = cross(arriving, leaving);
    constexpr double kNearlyBack = 1e-9;
    // At a tip rounding hides which way the corner turns.
    if (dot(arriving, leaving) < 0 && std::abs(turn) < kNearlyBack) return disc(corner);
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

/// Regions whose edges may be swept. What counts is their union, but taking it blunts the tips of needles,
/// which a large disc would show. So it is taken only where edges bound no material.
struct Material {
  std::vector<Region> regions;
  double error = 0;
};

Result<Material> material_of(const std::vector<Region>& regions, detail::KeepRule is_wrong, bool meeting) {
  Outlines outlines;
  outlines.add(regions, 0);
  LEKALO_TRY(const auto wrong, detail::overlay(outlines, is_wrong));
  if (wrong.regions.empty() && !(meeting && fault_of(regions))) return Material{regions, 0};
  LEKALO_TRY(auto whole, united(regions));
  return Material{std::move(whole.regions), whole.corner_error};
}

/// Grows regions. A loop that winds the other way is no material, and what its edges sweep is none either.
/// Edges inside material do no harm, because they sweep what belongs to the result.
Result<BooleanResult> grown(const std::vector<Region>& regions, double distance) {
  const auto is_wrong = [](const Winding& w) { return w[0] < 0; };
  LEKALO_TRY(const auto material, material_of(regions, is_wrong, false));
  Outlines outlines;
  outlines.add(material.regions, 0);
  Brush brush(distance, 1, outlines);
  for_each_contour(material.regions, [&](const Contour& contour) { brush.sweep(contour); });
  return detail::overlay(
      outlines, [](const Winding& w) { return w[0] > 0 || w[1] > 0; }, material.error);
}

/// Grows the outside into the material. Edges between two pieces, or inside one, have no outside.
Result<BooleanResult> shrunk(const std::vector<Region>& regions, double distance) {
  const auto is_wrong = [](const Winding& w) { return w[0] < 0 || w[0] > 1; };
  LEKALO_TRY(const auto material, material_of(regions, is_wrong, true));
  Outlines outlines;
  outlines.add(material.regions, 0);
  Brush brush(distance, 1, outlines);
  for_each_contour(material.regions, [&](const Contour& contour) { brush.sweep(reversed(contour)); });
  return detail::overlay(
      outlines, [](const Winding& w) { return w[0] > 0 && w[1] <= 0; }, material.error);
}

/// Adds all points within `distance` of an edge.
void add_rim(const Edge& edge, double distance, std::uint8_t operand, Outlines& outlines) {
  Brush brush(distance, operand, outlines);
  brush.sweep(edge);
  brush.sweep(reversed(edge));
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
    if (distances[k] < 0) add_rim(*edges[k], -distances[k], 1, cut);
  const auto rest = detail::overlay(cut, [](const Winding& w) { return w[0] > 0 && w[1] <= 0; });
  if (!rest) return rest;
  Outlines all;
  all.add(rest->regions, 0);
  for (std::size_t k = 0; k < edges.size(); ++k)
    if (distances[k] > 0) add_rim(*edges[k], distances[k], 1, all);
  return detail::overlay(
      all, [](const Winding& w) { return w[0] > 0 || w[1] > 0; }, rest->edge_error);
}

Result<BooleanResult> offset(const std::vector<Region>& regions, double distance) {
  if (!is_exact_coordinate(distance))
    return failure(ErrorCode::bad_input,
                   fmt::format("an offset by {} mm: it takes 0 or a number from {:.1g} to {:.1g}", distance,
                               kSmallestExactCoordinate, kLargestExactCoordinate));
  if (distance == 0) return united(regions);
  return distance > 0 ? grown(regions, distance) : shrunk(regions, -distance);
}

}  // namespace lekalo::geom

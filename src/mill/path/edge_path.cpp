#include "edge_path.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/geom/trig.hpp"

namespace lekalo::mill {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

double length_of(const Edge& edge) {
  return edge.kind == EdgeKind::line ? norm(edge.to - edge.from) : arc_sweep(edge) * arc_radius(edge);
}

double length_of(const std::vector<Edge>& edges) {
  double length = 0;
  for (const Edge& edge : edges) length += length_of(edge);
  return length;
}

Point place_at(const Edge& edge, double share) {
  if (share <= 0) return edge.from;
  if (share >= 1) return edge.to;
  if (edge.kind == EdgeKind::line) return edge.from + share * (edge.to - edge.from);
  const double angle = share * arc_sweep(edge);
  const auto [sine, cosine] = geom::sincos(edge.kind == EdgeKind::arc_ccw ? angle : -angle);
  const Point out = edge.from - edge.centre;
  return edge.centre + cosine * out + sine * perpendicular(out);
}

Edge part_of(const Edge& edge, double from, double to) {
  return {edge.kind, place_at(edge, from), place_at(edge, to), edge.centre};
}

Point heading_at(const Edge& edge, Point at) {
  const Point way = edge.kind == EdgeKind::line      ? edge.to - edge.from
                    : edge.kind == EdgeKind::arc_ccw ? perpendicular(at - edge.centre)
                                                     : -perpendicular(at - edge.centre);
  return (1 / norm(way)) * way;
}

std::vector<Point> places_on(const std::vector<Edge>& edges, double spacing) {
  std::vector<Point> places;
  for (const Edge& edge : edges) {
    const double pieces = std::max(1.0, std::ceil(length_of(edge) / spacing));
    for (double i = 0; i < pieces; ++i) places.push_back(place_at(edge, i / pieces));
  }
  if (!edges.empty()) places.push_back(edges.back().to);
  return places;
}

}  // namespace lekalo::mill

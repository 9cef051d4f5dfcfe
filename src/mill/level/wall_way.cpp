#include "wall_way.hpp"

#include <algorithm>

#include "mill/path/edge_path.hpp"

namespace lekalo::mill {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

namespace {

constexpr double kOnWall = 3e-4;  // mm: stretches that are new begin 2e-4 off the round before them

/// True when the goal, which lies on an edge, is ahead on the rest of it.
/// \param from_seam  the rest is one whole circle, from its seam on
bool is_ahead(const Edge& edge, const Edge& rest, const Edge& last, bool from_seam) {
  if (edge.kind == EdgeKind::line) return dot(last.to - last.from, edge.to - edge.from) > 0;
  return from_seam || (!(rest.from == rest.to) && arc_sweep(last) < arc_sweep(rest) + 1e-9);
}

}  // namespace

std::optional<std::vector<Edge>> way_along_wall(const geom::RegionIndex& walls, Point from, Point to,
                                                double most) {
  const auto begin = walls.nearest(from), goal = walls.nearest(to);
  if (begin.distance > kOnWall || goal.distance > kOnWall) return std::nullopt;
  const auto& starts = walls.contour_starts();
  const auto contour =
      static_cast<std::size_t>(std::upper_bound(starts.begin(), starts.end(), begin.edge) - starts.begin());
  if (goal.edge >= starts[contour] || goal.edge < starts[contour - 1]) return std::nullopt;
  const std::uint32_t first = starts[contour - 1], count = starts[contour] - first;
  for (const bool back : {false, true}) {
    std::vector<Edge> edges;
    double length = 0;
    std::uint32_t e = begin.edge;
    Point at = from;
    // The walk goes once round, and then over the edge where it began again, because a wall that is one whole
    // circle is walked from its seam on.
    for (std::uint32_t walked = 0; walked <= count && length < most; ++walked) {
      Edge edge = walls.curves()[e].edge;
      if (back) edge = geom::reversed(edge);
      const Edge rest{edge.kind, at, edge.to, edge.centre};
      if (e == goal.edge) {
        const Edge last{edge.kind, at, to, edge.centre};
        if (is_ahead(edge, rest, last, walked > 0 && edge.from == edge.to)) {
          if (length + length_of(last) > most) break;
          edges.push_back(last);
          return edges;
        }
      }
      if (!(rest.from == rest.to)) {
        length += length_of(rest);
        edges.push_back(rest);
      }
      at = edge.to;
      e = first + (back ? (e - first + count - 1) % count : (e - first + 1) % count);
    }
  }
  return std::nullopt;
}

}  // namespace lekalo::mill

#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/region_check.hpp"
#include "support/boolean_cases.hpp"
#include "support/cases.hpp"
#include "support/region_cases.hpp"

namespace lekalo::cases {

inline std::vector<geom::Contour> contours_of(const std::vector<geom::Region>& regions) {
  std::vector<geom::Contour> contours;
  for (const geom::Region& region : regions) {
    contours.push_back(region.outer);
    contours.insert(contours.end(), region.holes.begin(), region.holes.end());
  }
  return contours;
}

inline std::vector<geom::Edge> edges_of(const std::vector<geom::Region>& regions) {
  std::vector<geom::Edge> edges;
  for (const geom::Contour& contour : contours_of(regions))
    edges.insert(edges.end(), contour.begin(), contour.end());
  return edges;
}

/// The same set of regions begins the same way, wherever its contours began.
inline std::vector<geom::Contour> canonical(const std::vector<geom::Region>& regions) {
  const auto less = [](const geom::Edge& a, const geom::Edge& b) {
    return std::tie(a.from.x, a.from.y, a.to.x, a.to.y) < std::tie(b.from.x, b.from.y, b.to.x, b.to.y);
  };
  std::vector<geom::Contour> contours = contours_of(regions);
  for (geom::Contour& contour : contours)
    std::rotate(contour.begin(), std::min_element(contour.begin(), contour.end(), less), contour.end());
  std::sort(contours.begin(), contours.end(),
            [&](const geom::Contour& a, const geom::Contour& b) { return less(a.front(), b.front()); });
  return contours;
}

inline geom::Edge shifted(geom::Edge edge, geom::Point by) {
  edge.from = edge.from + by;
  edge.to = edge.to + by;
  if (edge.kind != geom::EdgeKind::line) edge.centre = edge.centre + by;
  return edge;
}

/// Points of an edge, its ends first; arcs at their mean radius, with the radial steps to the ends.
inline std::vector<geom::Point> points_of(const geom::Edge& edge, int count) {
  std::vector<geom::Point> points{edge.from, edge.to};
  if (edge.kind == geom::EdgeKind::line) {
    for (int i = 1; i < count; ++i)
      points.push_back(edge.from + (static_cast<double>(i) / count) * (edge.to - edge.from));
    return points;
  }
  const double radius = geom::arc_radius(edge);
  const double sweep = geom::arc_sweep(edge) * (edge.kind == geom::EdgeKind::arc_ccw ? 1 : -1);
  const geom::Point out = (radius / norm(edge.from - edge.centre)) * (edge.from - edge.centre);
  for (int i = 0; i <= count; ++i) {
    const auto [sine, cosine] = geom::sincos(sweep * i / count);
    points.push_back(edge.centre + geom::Point{cosine * out.x - sine * out.y, sine * out.x + cosine * out.y});
  }
  return points;
}

inline double distance_to_edges(geom::Point p, const std::vector<geom::Edge>& edges) {
  double least = 1e300;
  for (const geom::Edge& edge : edges)
    least = std::min(least, norm(p - nearest_on(geom::make_curve(edge), p)));
  return least;
}

/// Random regions apart from each other, with holes, of lines and arcs.
inline std::vector<geom::Region> random_regions(Random& random, std::uint64_t index) {
  std::vector<geom::Region> regions;
  const std::size_t count = 1 + random.below(3);
  for (std::size_t i = 0; i < count; ++i) {
    const geom::Point place{200 * static_cast<double>(i), 0};
    std::vector<geom::Region> pieces;
    if (random.below(2) == 0) {
      pieces = region_case(seed(), 10 * index + i, kRegionKinds[random.below(5)]).part;
    } else {
      const auto operand = boolean_operand(random, BooleanKind::turned);
      if (const auto joined = geom::united(operand)) pieces = joined->regions;
    }
    if (geom::fault_of(pieces)) continue;
    for (const geom::Region& piece : pieces) {
      geom::Region moved;
      for (const geom::Edge& edge : piece.outer) moved.outer.push_back(shifted(edge, place));
      for (const geom::Contour& hole : piece.holes) {
        moved.holes.emplace_back();
        for (const geom::Edge& edge : hole) moved.holes.back().push_back(shifted(edge, place));
      }
      // Moving rounds: ends that were equal still are, arcs remain within consistency.
      if (auto made = geom::make_region(moved.outer, moved.holes)) regions.push_back(*std::move(made));
    }
  }
  if (regions.empty() || geom::fault_of(regions))
    return {region_detail::region(boolean_rectangle(0, 0, 9, 7))};
  return regions;
}

}  // namespace lekalo::cases

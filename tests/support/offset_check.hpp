#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/offset.hpp"
#include "lekalo/geom/trig.hpp"
#include "support/boolean_cases.hpp"

namespace lekalo::cases {

inline geom::Point direction_of(double angle) {
  const auto [sine, cosine] = geom::sincos(angle);
  return {cosine, sine};
}

inline std::vector<geom::Edge> edges_of(const std::vector<geom::Region>& regions) {
  std::vector<geom::Edge> edges;
  for (const geom::Region& r : regions) {
    edges.insert(edges.end(), r.outer.begin(), r.outer.end());
    for (const geom::Contour& h : r.holes) edges.insert(edges.end(), h.begin(), h.end());
  }
  return edges;
}

/// The point a share of the way along an edge.
inline geom::Point point_on(const geom::Edge& edge, double share) {
  if (edge.kind == geom::EdgeKind::line) return edge.from + share * (edge.to - edge.from);
  const double turn = share * geom::arc_sweep(edge) * (edge.kind == geom::EdgeKind::arc_ccw ? 1 : -1);
  const geom::Point d = direction_of(turn), out = edge.from - edge.centre;
  return edge.centre + geom::Point{d.x * out.x - d.y * out.y, d.y * out.x + d.x * out.y};
}

/// Largest coordinate, arcs with their whole circles.
inline double extent_of(const std::vector<geom::Region>& regions) {
  double most = 0;
  for (const geom::Edge& e : edges_of(regions)) {
    most = std::max({most, std::abs(e.from.x), std::abs(e.from.y)});
    if (e.kind == geom::EdgeKind::line) continue;
    const double r = geom::arc_radius(e);
    most = std::max({most, std::abs(e.centre.x) + r, std::abs(e.centre.y) + r});
  }
  return most;
}

/// What is wrong with `result` as the offset of `regions`; empty if nothing is found. `regions` are simple
/// and disjoint: distances are those from their edges.
inline std::string offset_fault(const std::vector<geom::Region>& regions, double distance,
                                const geom::BooleanResult& result, Random& random, int points) {
  for (const geom::Region& r : result.regions) {
    const auto again = geom::make_region(r.outer, r.holes);
    if (!again || !(*again == r)) return "a region of the result is not in order";
  }
  if (regions.empty()) return result.regions.empty() ? "" : "something came of nothing";
  const geom::RegionIndex before(regions), after(result.regions);
  const double rounding = geom::kEdgeDistanceError * 4 * (extent_of(regions) + std::abs(distance));
  const double slack = result.edge_error + rounding;
  const auto signed_distance = [&](geom::Point p) {  // positive outside
    const double d = before.nearest(p).distance;
    return before.contains(p) ? -d : d;
  };
  const auto said = [](const char* what, geom::Point p, double d, double s) {
    return fmt::format("{} ({}, {}): its distance is {}, error {}", what, p.x, p.y, d, s);
  };
  const std::vector<geom::Edge> drawn = edges_of(regions), made = edges_of(result.regions);
  for (const geom::Edge& e : made) {
    for (const double share : {0.0, 0.5, random.uniform(0, 1)}) {
      const geom::Point p = point_on(e, share);
      const double d = signed_distance(p);
      if (!(std::abs(d - distance) <= slack + result.edge_error)) return said("boundary point", p, d, slack);
    }
  }
  for (int k = 0; k < points; ++k) {
    // Near the new outline, near the old one, and where the new one ought to be.
    const bool near_new = !made.empty() && random.below(3) == 0;
    const geom::Edge& e = near_new ? made[random.below(made.size())] : drawn[random.below(drawn.size())];
    const double far = random.below(2) == 0 ? std::abs(distance) : 0;
    const double more = slack * std::pow(10.0, random.uniform(0, 10));
    const geom::Point p =
        point_on(e, random.below(3) == 0 ? 0.0 : random.uniform(0, 1)) +
        (far + (random.below(2) == 0 ? more : -more)) * direction_of(random.uniform(0, 6.283185307179586));
    const double d = signed_distance(p);
    if (std::abs(d - distance) <= slack + result.edge_error) continue;
    if (after.contains(p) != (d < distance)) return said("membership of", p, d, slack);
  }
  return "";
}

}  // namespace lekalo::cases

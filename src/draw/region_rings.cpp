#include "region_rings.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/geom/trig.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;
using geom::Ring;

/// Appends the points along an edge without its end. The chords are no further than `sag` off and no longer
/// than `step`, mm.
void append_points(const geom::Edge& edge, double sag, double step, Ring& ring) {
  if (edge.kind == geom::EdgeKind::line) {
    const Point along = edge.to - edge.from;
    const auto pieces = std::max(1, static_cast<int>(std::ceil(std::min(1e4, norm(along) / step))));
    for (int k = 0; k < pieces; ++k) ring.push_back(edge.from + (static_cast<double>(k) / pieces) * along);
    return;
  }
  const double radius = arc_radius(edge), sweep = arc_sweep(edge);
  const double by_sag = std::sqrt(8 * std::min(sag, radius) / radius);
  const double turn = std::min({by_sag, step / radius, 1.0});
  const auto pieces = std::max(1, static_cast<int>(std::ceil(std::min(1e4, sweep / turn))));
  const double from = geom::direction_angle(edge.from.x - edge.centre.x, edge.from.y - edge.centre.y);
  const double sign = edge.kind == geom::EdgeKind::arc_ccw ? 1 : -1;
  for (int k = 0; k < pieces; ++k) {
    const auto [sine, cosine] = geom::sincos(from + sign * sweep * k / pieces);
    ring.push_back(edge.centre + radius * Point{cosine, sine});
  }
}

}  // namespace

std::vector<Ring> region_rings(const std::vector<geom::Region>& regions, double sag, double step) {
  std::vector<Ring> rings;
  const auto add = [&](const geom::Contour& contour) {
    Ring& ring = rings.emplace_back();
    for (const geom::Edge& edge : contour) append_points(edge, sag, step, ring);
  };
  for (const geom::Region& region : regions) {
    add(region.outer);
    for (const geom::Contour& hole : region.holes) add(hole);
  }
  return rings;
}

Ring chain_points(const geom::Contour& chain, double sag, double step) {
  Ring points;
  for (const geom::Edge& edge : chain) append_points(edge, sag, step, points);
  if (!chain.empty()) points.push_back(chain.back().to);
  return points;
}

}  // namespace lekalo::draw

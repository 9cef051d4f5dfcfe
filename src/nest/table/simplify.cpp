#include "simplify.hpp"

#include <cmath>
#include <limits>

#include "lekalo/geom/point.hpp"

namespace lekalo::nest {
namespace {

using geom::GridPoint;
using geom::Point;

Point between(GridPoint a, GridPoint b) {
  const GridPoint d = b - a;
  return {static_cast<double>(d.x), static_cast<double>(d.y)};
}

/// One change of a loop: corner k goes, or k and the one after become `to`.
struct Change {
  std::size_t k = 0;
  double cost = std::numeric_limits<double>::infinity();  ///< area that is added
  bool fills = false;
  GridPoint to;
};

Change cheapest(const std::vector<GridPoint>& loop, double reach) {
  const std::size_t n = loop.size();
  Change best;
  for (std::size_t k = 0; k < n; ++k) {
    const GridPoint a = loop[(k + n - 1) % n], b = loop[k], c = loop[(k + 1) % n], d = loop[(k + 2) % n];
    const Point along = between(a, c);
    const double length = norm(along);
    if (length > 0 && geom::turn(a, b, c) <= 0) {
      const double area = std::abs(cross(along, between(a, b)));
      if (area / length <= reach && area < best.cost) best = {k, area, true, {}};
    }
    if (geom::turn(a, b, c) > 0 && geom::turn(b, c, d) > 0) {
      // The tip is the point where the edges before and after this one meet.
      const Point before = between(a, b), after = between(d, c), edge = between(b, c);
      const double side = cross(before, after);
      if (!(side < 0)) continue;  // they run apart
      const double s = cross(edge, after) / side;
      if (!(s > 0)) continue;
      const Point tip = s * before;
      const double edge_length = norm(edge);
      const double height = std::abs(cross(edge, tip)) / edge_length;
      if (!(height <= reach)) continue;
      const double area = height * edge_length;
      if (area >= best.cost) continue;
      best = {k, area, false, {b.x + std::llround(tip.x), b.y + std::llround(tip.y)}};
    }
  }
  return best;
}

}  // namespace

geom::GridRegion simplified(const geom::GridRegion& region, double tolerance, std::size_t enough) {
  std::size_t count = region.points.size();
  if (count <= enough) return region;
  const double reach = tolerance * static_cast<double>(geom::kGridPerMm);
  std::vector<std::vector<GridPoint>> loops;
  for (std::size_t l = 0; l < region.loops(); ++l)
    loops.emplace_back(region.points.begin() + region.loop_starts[l],
                       region.points.begin() + region.loop_starts[l + 1]);
  while (count > enough) {
    Change best;
    std::size_t in = 0;
    for (std::size_t l = 0; l < loops.size(); ++l) {
      if (loops[l].size() <= 4) continue;
      const Change change = cheapest(loops[l], reach);
      if (change.cost < best.cost) {
        best = change;
        in = l;
      }
    }
    if (best.cost == std::numeric_limits<double>::infinity()) break;
    std::vector<GridPoint>& loop = loops[in];
    if (!best.fills) loop[(best.k + 1) % loop.size()] = best.to;
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(best.k));
    --count;
  }
  auto made = geom::make_grid_region(std::move(loops));
  return made ? std::move(*made) : region;
}

}  // namespace lekalo::nest

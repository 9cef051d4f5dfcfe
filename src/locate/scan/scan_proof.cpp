#include <algorithm>
#include <cmath>

#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/region_index.hpp"
#include "parity_index.hpp"
#include "scan_band.hpp"

namespace lekalo::locate {
namespace {

using geom::Point;

class Keeper {
 public:
  /// \param size  the largest coordinate of all
  Keeper(const std::vector<geom::Region>& regions, double size)
      : index_(regions), rounding_(4 * geom::kEdgeDistanceError * size) {}

  [[nodiscard]] bool point_out(Point p, double reach) {
    const geom::RegionIndex::Nearest near = index_.nearest(p, likely_);
    likely_ = near.edge;
    return near.distance >= reach + rounding_ && !index_.contains(p);
  }

  [[nodiscard]] bool edge_out(Point a, Point b, double reach) {
    const Point middle = 0.5 * (a + b);
    const double half = 0.5 * norm(b - a);
    const geom::RegionIndex::Nearest near = index_.nearest(middle, likely_);
    likely_ = near.edge;
    if (!(near.distance >= reach + rounding_) || index_.contains(middle)) return false;
    if (near.distance - half >= reach + rounding_) return true;
    const geom::Curve curve = geom::make_curve({geom::EdgeKind::line, a, b, {}});
    const double limit = reach + rounding_;
    bool out = true;
    index_.visit_within(middle, half, limit, [&](std::uint32_t e) {
      out = out && geom::closest_points(curve, index_.curves()[e]).distance >= limit;
    });
    return out;
  }

 private:
  geom::RegionIndex index_;
  double rounding_;
  std::uint32_t likely_ = 0;
};

}  // namespace

bool keeps_out(const geom::Ring& points, const std::vector<GuardedLoop>& loops, double guard,
               const std::vector<geom::Region>& regions) {
  std::vector<Loop> outlines;
  for (const GuardedLoop& loop : loops) outlines.push_back(loop.vertices);
  const ParityIndex parity(points, outlines);
  // One point of a piece tells for all of it, because no outline meets a piece, as is checked below.
  for (const geom::Region& region : regions)
    if (!parity.odd(region.outer.front().from)) return false;
  Keeper keeper(regions, geom::largest_coordinate(points));
  for (const GuardedLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.vertices.size(); ++i)
      if (!keeper.edge_out(points[loop.vertex(i)], points[loop.vertex(i + 1)], loop.reach[i])) return false;
    for (const std::uint32_t p : loop.beside)
      if (!keeper.point_out(points[p], guard)) return false;
  }
  return true;
}

}  // namespace lekalo::locate

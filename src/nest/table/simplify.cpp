#include "simplify.hpp"

#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/point.hpp"
#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {
namespace {

using geom::GridPoint;
using geom::Point;

constexpr double kNever = std::numeric_limits<double>::infinity();

Point between(GridPoint a, GridPoint b) {
  const GridPoint d = b - a;
  return {static_cast<double>(d.x), static_cast<double>(d.y)};
}

/// One change of a loop: a corner goes, or it and the one after become `to`.
struct Change {
  double cost = kNever;  ///< area that is added
  bool fills = false;
  GridPoint to;
};

/// The loops as rings of corners from which corners are taken.
class Rings {
 public:
  explicit Rings(const geom::GridRegion& region) : corners_(region.points.size()), sizes_(region.loops()) {
    for (std::uint32_t l = 0; l < region.loops(); ++l) {
      const std::uint32_t first = region.loop_starts[l], end = region.loop_starts[l + 1];
      sizes_[l] = end - first;
      for (std::uint32_t k = first; k < end; ++k)
        corners_[k] = {region.points[k], k == first ? end - 1 : k - 1, k + 1 == end ? first : k + 1, l};
    }
  }

  /// Takes the changes that add least area, of equal ones that of the first corner, until so many corners are
  /// left or nothing can be changed within this reach.
  void simplify(double reach, std::size_t enough) {
    for (std::uint32_t k = 0; k < corners_.size(); ++k) offer(k, reach);
    for (std::size_t count = corners_.size(); count > enough && !changes_.empty();) {
      ask();
      const Entry entry = changes_.top();
      changes_.pop();
      const std::uint32_t k = entry.corner;
      if (entry.version != corners_[k].version || sizes_[corners_[k].loop] <= 4) continue;
      const std::uint32_t before = corners_[k].before, after = corners_[k].after;
      if (!entry.change.fills) corners_[after].at = entry.change.to;
      ++corners_[k].version;
      corners_[before].after = after;
      corners_[after].before = before;
      --sizes_[corners_[k].loop];
      --count;
      for (const std::uint32_t near : {corners_[before].before, before, after, corners_[after].after})
        offer(near, reach);
    }
  }

  std::vector<std::vector<GridPoint>> loops(const geom::GridRegion& region) const {
    std::vector<std::vector<GridPoint>> loops;
    for (std::size_t l = 0; l < region.loops(); ++l) {
      std::uint32_t k = region.loop_starts[l];
      while (corners_[corners_[k].before].after != k) ++k;  // up to the first corner that is left
      std::vector<GridPoint> loop;
      const std::uint32_t first = k;
      do {
        loop.push_back(corners_[k].at);
        k = corners_[k].after;
      } while (k != first);
      loops.push_back(std::move(loop));
    }
    return loops;
  }

 private:
  struct Corner {
    GridPoint at;
    std::uint32_t before = 0, after = 0, loop = 0;
    std::uint32_t version = 0;  ///< changes with all that its change depends on, and as it goes
  };
  struct Entry {
    Change change;
    std::uint32_t corner = 0, version = 0;
    /// True if this comes after the other one in the queue.
    bool operator<(const Entry& other) const noexcept {
      return std::tie(change.cost, corner) > std::tie(other.change.cost, other.corner);
    }
  };

  void offer(std::uint32_t k, double reach) {
    const Change change = change_at(k, reach);
    ++corners_[k].version;
    if (change.cost < kNever) changes_.push({change, k, corners_[k].version});
  }

  Change change_at(std::uint32_t k, double reach) const {
    const Corner& corner = corners_[k];
    const GridPoint a = corners_[corner.before].at, b = corner.at, c = corners_[corner.after].at,
                    d = corners_[corners_[corner.after].after].at;
    Change best;
    const Point along = between(a, c);
    const double length = norm(along);
    if (length > 0 && geom::turn(a, b, c) <= 0) {
      const double area = std::abs(cross(along, between(a, b)));
      if (area / length <= reach) best = {area, true, {}};
    }
    if (!(geom::turn(a, b, c) > 0 && geom::turn(b, c, d) > 0)) return best;
    // The tip is the point where the edges before and after this one meet.
    const Point before = between(a, b), after = between(d, c), edge = between(b, c);
    const double side = cross(before, after);
    if (!(side < 0)) return best;  // they run apart
    const double s = cross(edge, after) / side;
    if (!(s > 0)) return best;
    const Point tip = s * before;
    const double edge_length = norm(edge);
    const double height = std::abs(cross(edge, tip)) / edge_length;
    if (!(height <= reach) || !(height * edge_length < best.cost)) return best;
    return {height * edge_length, false, {b.x + std::llround(tip.x), b.y + std::llround(tip.y)}};
  }

  std::vector<Corner> corners_;
  std::vector<std::uint32_t> sizes_;  ///< by loop
  std::priority_queue<Entry> changes_;
};

}  // namespace

geom::GridRegion simplified(const geom::GridRegion& region, double tolerance, std::size_t enough) {
  if (region.points.size() <= enough) return region;
  Rings rings(region);
  rings.simplify(tolerance * static_cast<double>(geom::kGridPerMm), enough);
  auto made = geom::make_grid_region(rings.loops(region));
  return made ? std::move(*made) : region;
}

geom::GridRegion outer_outline(const geom::GridRegion& region, double size) {
  double share = tuning::kSimplify;
  geom::GridRegion outer = simplified(region, share * size, tuning::kEnoughCorners);
  while (outer.points.size() > tuning::kMostCorners && 2 * share <= tuning::kSimplifyMost) {
    share *= 2;
    outer = simplified(region, share * size, tuning::kMostCorners);
  }
  return outer;
}

}  // namespace lekalo::nest

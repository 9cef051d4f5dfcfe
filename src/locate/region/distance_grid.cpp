#include "distance_grid.hpp"

#include <algorithm>

namespace lekalo::locate {
namespace {

using geom::Point;

/// The grid has this many points in either direction.
constexpr int kSize = 128;

}  // namespace

DistanceGrid::DistanceGrid(const geom::RegionIndex& outline, Point middle, double half)
    : outline_(outline),
      origin_(middle - Point{half, half}),
      step_(2 * half / (kSize - 1)),
      per_step_(1 / step_),
      points_(static_cast<std::size_t>(kSize) * kSize) {}

DistanceGrid::Value DistanceGrid::near(Point q) {
  const auto index = [&](double offset) {
    return static_cast<int>(std::clamp(offset * per_step_ + 0.5, 0.0, kSize - 1.0));
  };
  const int i = index(q.x - origin_.x), j = index(q.y - origin_.y);
  const Point at = origin_ + step_ * Point{static_cast<double>(i), static_cast<double>(j)};
  Known& known = points_[static_cast<std::size_t>(i) * kSize + static_cast<std::size_t>(j)];
  if (!known.known) {
    const auto nearest = outline_.nearest(at);
    known = {outline_.contains(at) ? nearest.distance : -nearest.distance, nearest.point, nearest.edge, true};
  }
  return {at, known.signed_distance, known.nearest, known.edge, norm(q - at)};
}

}  // namespace lekalo::locate

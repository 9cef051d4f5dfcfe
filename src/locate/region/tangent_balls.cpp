#include "tangent_balls.hpp"

#include <cmath>

namespace lekalo::locate {

using geom::Point;

Ball tangent_ball(const geom::RegionIndex& outline, Point at, Point direction, double most, double least,
                  double doubt) {
  constexpr int kMostSteps = 12;
  double radius = most;
  for (int step = 0; step < kMostSteps && radius >= least; ++step) {
    const Point centre = at + radius * direction;
    const geom::RegionIndex::Nearest nearest = outline.nearest(centre);
    const double hidden = doubt + 4 * geom::kEdgeDistanceError * (radius + std::abs(at.x) + std::abs(at.y));
    if (nearest.distance >= radius - hidden) {
      const double safe = radius - 2 * hidden;
      return safe > 0 ? Ball{centre, safe} : Ball{at, 0};
    }
    const Point chord = nearest.point - at;
    const double height = dot(direction, chord);
    if (!(height > 0)) break;
    const double smaller = dot(chord, chord) / (2 * height);
    // The next ball passes through the point found, which may be the touching point itself but for rounding.
    if (!(smaller < radius)) break;
    radius = smaller;
  }
  return {at, 0};
}

}  // namespace lekalo::locate

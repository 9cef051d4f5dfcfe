#include "space_view.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::draw {

using solid::Vector;

SpaceView seen_from(Vector towards) {
  SpaceView view;
  view.towards = 1 / norm(towards) * towards;
  const Vector upright{0, 0, 1};
  const Vector right = cross(upright, view.towards);
  view.right = norm(right) > 1e-3 ? 1 / norm(right) * right : Vector{1, 0, 0};
  view.up = cross(view.towards, view.right);
  return view;
}

void fit(SpaceView& view, const std::vector<Vector>& points, double width, double height, double margin) {
  if (points.empty()) return;
  Vector low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  view.centre = points.front();
  view.x = view.y = 0, view.scale = 1;
  for (const Vector p : points) {
    const ScreenPoint s = view(p);
    low = {std::min(low.x, s.x), std::min(low.y, s.y), std::min(low.z, s.z)};
    high = {std::max(high.x, s.x), std::max(high.y, s.y), std::max(high.z, s.z)};
  }
  const Vector middle = 0.5 * (low + high);
  view.centre = view.centre + (middle.x * view.right + (-middle.y * view.up + middle.z * view.towards));
  const double larger =
      std::max((high.x - low.x) / (width - 2 * margin), (high.y - low.y) / (height - 2 * margin));
  view.scale = larger > 0 ? 1 / larger : 1;
  view.x = width / 2, view.y = height / 2;
}

}  // namespace lekalo::draw

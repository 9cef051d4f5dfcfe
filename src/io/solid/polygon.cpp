#include "polygon.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/predicates.hpp"

namespace lekalo::io {
namespace {

using solid::Vector;

/// A point as somebody sees it who looks against one of the axes, 0 to 2.
geom::Point seen_along(int axis, Vector p) {
  return axis == 0 ? geom::Point{p.y, p.z} : axis == 1 ? geom::Point{p.z, p.x} : geom::Point{p.x, p.y};
}

double component(int axis, Vector v) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

bool PolygonCutter::is_convex() const {
  const std::size_t n = seen_.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (geom::orientation(seen_[k], seen_[(k + 1) % n], seen_[(k + 2) % n]) <= 0) return false;
    if (k > 0 && k + 1 < n && geom::orientation(seen_[0], seen_[k], seen_[k + 1]) <= 0) return false;
  }
  return true;
}

/// Says whether a corner and its neighbours are a triangle of the face that no other corner lies in. Corners
/// at the place of one of the three are none of its own: a face with a hole comes back to where it left the
/// rim.
bool PolygonCutter::is_ear(std::size_t k) const {
  const std::size_t b = before_[k], n = next_[k];
  const geom::Point &from = seen_[b], &tip = seen_[k], &to = seen_[n];
  if (geom::orientation(from, tip, to) <= 0) return false;
  const geom::Point low{std::min({from.x, tip.x, to.x}), std::min({from.y, tip.y, to.y})};
  const geom::Point high{std::max({from.x, tip.x, to.x}), std::max({from.y, tip.y, to.y})};
  for (std::size_t other = next_[n]; other != b; other = next_[other]) {
    const geom::Point& p = seen_[other];
    if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y) continue;
    if (p == from || p == tip || p == to) continue;
    if (geom::orientation(from, tip, p) >= 0 && geom::orientation(tip, to, p) >= 0 &&
        geom::orientation(to, from, p) >= 0)
      return false;
  }
  return true;
}

bool PolygonCutter::cut_ears(std::vector<solid::Triangle>& triangles) {
  const std::size_t n = corners_.size();
  next_.resize(n), before_.resize(n), ear_.resize(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    next_[k] = k + 1 == n ? 0 : k + 1;
    before_[k] = k == 0 ? static_cast<std::uint32_t>(n - 1) : k - 1;
  }
  for (std::size_t k = 0; k < n; ++k) ear_[k] = is_ear(k) ? 1 : 0;
  ask(n * n / 64);
  std::size_t k = 0;
  for (std::size_t left = n; left > 3; --left) {
    std::size_t looked = 0;
    for (; looked < left && ear_[k] == 0; ++looked) k = next_[k];
    if (looked == left) return false;
    const std::uint32_t b = before_[k], to = next_[k];
    triangles.push_back({corners_[b], corners_[k], corners_[to]});
    next_[b] = to;
    before_[to] = b;
    // Only at the neighbours of what was cut off can an ear begin or end.
    ear_[b] = is_ear(b) ? 1 : 0;
    ear_[to] = is_ear(to) ? 1 : 0;
    k = to;
  }
  triangles.push_back({corners_[before_[k]], corners_[k], corners_[next_[k]]});
  return geom::orientation(seen_[before_[k]], seen_[k], seen_[next_[k]]) > 0;
}

std::string PolygonCutter::cut(const std::vector<Vector>& vertices, std::span<const std::uint32_t> corners,
                               std::vector<solid::Triangle>& triangles) {
  corners_.clear();
  for (const std::uint32_t v : corners)
    if (corners_.empty() || v != corners_.back()) corners_.push_back(v);
  while (corners_.size() > 1 && corners_.back() == corners_.front()) corners_.pop_back();
  if (corners.size() == 3 || corners_.size() < 3) {
    triangles.push_back({corners[0], corners[1], corners[2]});
    return {};
  }
  const auto fan = [&] {
    for (std::size_t k = 1; k + 1 < corners_.size(); ++k)
      triangles.push_back({corners_[0], corners_[k], corners_[k + 1]});
  };
  if (corners_.size() == 3) {
    fan();
    return {};
  }

  ++faces_;
  const Vector first = vertices[corners_[0]];
  Vector normal, sum;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const Vector from = vertices[corners_[k]] - first,
                 to = vertices[corners_[k + 1 == corners_.size() ? 0 : k + 1]] - first;
    normal = normal + cross(from, to);
    sum = sum + from;
  }
  int axis = 2;
  for (const int other : {0, 1})
    if (std::abs(component(other, normal)) > std::abs(component(axis, normal))) axis = other;
  const bool from_behind = component(axis, normal) < 0;
  const auto look = [&](int along) {
    seen_.clear();
    for (const std::uint32_t v : corners_) {
      const geom::Point p = seen_along(along, vertices[v]);
      seen_.push_back(from_behind ? geom::Point{p.y, p.x} : p);
    }
  };
  if (const double length = norm(normal); length > 0) {
    const Vector middle = first + 1 / static_cast<double>(corners_.size()) * sum;
    for (const std::uint32_t v : corners_)
      unevenness_ = std::max(unevenness_, std::abs(dot(normal, vertices[v] - middle)) / length);
  }

  look(axis);
  if (is_convex()) {
    fan();
    return {};
  }
  if (corners_.size() > kMostCorners)
    return fmt::format(
        "a face of {} corners that is not convex; cut it into triangles, or into faces of at most {}",
        corners_.size(), kMostCorners);
  const std::size_t before = triangles.size();
  if (cut_ears(triangles)) return {};
  triangles.resize(before);
  // A face without area has none from any side, and gives triangles that are set aside later.
  bool straight = true;
  for (const int along : {0, 1, 2}) {
    look(along);
    std::size_t far = 1;
    while (far < seen_.size() && seen_[far] == seen_[0]) ++far;
    for (const geom::Point& p : seen_)
      straight = straight && (far == seen_.size() || geom::orientation(seen_[0], seen_[far], p) == 0);
  }
  if (!straight) return "a face that crosses or touches itself; cut it into triangles";
  fan();
  return {};
}

}  // namespace lekalo::io

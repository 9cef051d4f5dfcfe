#include "lekalo/geom/polygon.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace lekalo::geom {

double signed_area(const Ring& ring) noexcept {
  double doubled = 0;
  for (std::size_t i = 2; i < ring.size(); ++i) {
    doubled += cross(ring[i - 1] - ring[0], ring[i] - ring[0]);
  }
  return doubled / 2;
}

Box bounds(const Ring& ring) noexcept {
  if (ring.empty()) return {};
  Box box{ring[0], ring[0]};
  for (const Point p : ring) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

double largest_coordinate(const Ring& ring) noexcept {
  double largest = 0;
  for (const Point p : ring) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  return largest;
}

PointLocation locate_point(const Ring& ring, Point p) noexcept {
  static_assert(sizeof(Point) == 2 * sizeof(double), "the flat form of a ring is the ring itself");
  return locate_point(reinterpret_cast<const double*>(ring.data()), ring.size(), p);
}

std::vector<std::size_t> convex_hull(const Ring& points) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    const Point a = points[i], b = points[j];
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return i < j;
  });
  const auto same = [&](std::size_t i, std::size_t j) { return points[i] == points[j]; };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  if (order.size() < 3) return order;

  std::vector<std::size_t> hull;
  const auto extend = [&](std::size_t next, std::size_t chain_begin) {
    while (hull.size() >= chain_begin + 2 &&
           orientation(points[hull[hull.size() - 2]], points[hull.back()], points[next]) <= 0) {
      hull.pop_back();
    }
    hull.push_back(next);
  };
  for (const std::size_t i : order) extend(i, 0);
  const std::size_t upper_begin = hull.size() - 1;
  for (std::size_t k = order.size() - 1; k-- > 0;) extend(order[k], upper_begin);
  // The last index is the first point again.
  hull.pop_back();
  return hull;
}

namespace {

std::string vertex_name(const Ring& ring, std::size_t i) {
  return fmt::format("vertex {} ({}, {})", i, ring[i].x, ring[i].y);
}

std::optional<std::string> corner_fault(const Ring& ring, std::size_t i) {
  const std::size_t before = (i + ring.size() - 1) % ring.size(), after = (i + 1) % ring.size();
  if (ring[i] == ring[before]) return fmt::format("repeats vertex {}", before);
  const int side = orientation(ring[before], ring[i], ring[after]);
  if (side > 0) return std::nullopt;
  if (side == 0) return fmt::format("lies on the line of its neighbours {} and {}", before, after);
  return std::string("turns right");
}

/// Returns true for directions in [pi, 2 pi).
bool points_down(Point from, Point to) { return to.y < from.y || (to.y == from.y && to.x < from.x); }

/// Returns the vertex at which a ring of left turns begins its second turn, if it does. Each turn is less
/// than pi, so the direction of the edges cannot jump over a half plane, and one step from a downward to an
/// upward edge is one full turn.
std::optional<std::size_t> second_turn(const Ring& ring) {
  const std::size_t n = ring.size();
  std::size_t turns = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool was_down = points_down(ring[(i + n - 1) % n], ring[i]);
    if (was_down && !points_down(ring[i], ring[(i + 1) % n]) && ++turns == 2) return i;
  }
  return std::nullopt;
}

}  // namespace

Result<ConvexPolygon> ConvexPolygon::make(Ring vertices) {
  const auto refuse = [](std::string why) {
    return failure(ErrorCode::bad_input,
                   "not a strictly convex counter-clockwise polygon: " + std::move(why));
  };
  if (vertices.size() < 3) return refuse(fmt::format("{} vertices, at least 3 are needed", vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!is_exact(vertices[i])) {
      return refuse(fmt::format("{}: a coordinate is not 0 or a number of magnitude {:.3g} to {:.3g}",
                                vertex_name(vertices, i), kSmallestExactCoordinate, kLargestExactCoordinate));
    }
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (const auto fault = corner_fault(vertices, i)) return refuse(vertex_name(vertices, i) + " " + *fault);
  }
  if (const auto i = second_turn(vertices)) {
    return refuse(vertex_name(vertices, *i) + " begins a second turn around");
  }
  return ConvexPolygon(std::move(vertices));
}

}  // namespace lekalo::geom

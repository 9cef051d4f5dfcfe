#include "arc_through.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::mill {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

constexpr double kLargest = 1e4;  // mm: a flatter arc is a line

/// One line or arc through the first, a middle and the last of places [first, last], if it is near enough to
/// all.
bool piece(const std::vector<Point>& p, std::size_t first, std::size_t last, double tolerance, Edge& edge) {
  const Point a = p[first], b = p[last], way = b - a;
  const double length = norm(way);
  if (!(length > 1e-9)) return false;
  const Point middle = p[(first + last) / 2];
  const double twice_area = cross(middle - a, b - a);
  bool straight = true;
  for (std::size_t i = first + 1; i < last && straight; ++i) {
    const double along = dot(p[i] - a, way) / length;
    straight = std::abs(cross(way, p[i] - a)) <= tolerance * length && along > 0 && along < length;
  }
  edge = {EdgeKind::line, a, b, {}};
  if (last - first < 2) return true;
  if (std::abs(twice_area) > 1e-9 * length) {
    // The circle through three places.
    const Point u = middle - a, v = b - a;
    const double uu = dot(u, u), vv = dot(v, v), d = 2 * cross(u, v);
    const Point centre = a + (1 / d) * Point{v.y * uu - u.y * vv, u.x * vv - v.x * uu};
    const double radius = norm(centre - a);
    // An arc is at most about a third of a turn.
    if (radius < kLargest && length < 1.7 * radius) {
      bool round = true;
      double before = -1;
      for (std::size_t i = first + 1; i < last && round; ++i) {
        const double along = dot(p[i] - a, way);
        round = std::abs(norm(p[i] - centre) - radius) <= tolerance && along > before;
        before = along;
      }
      if (round) {
        edge = {twice_area > 0 ? EdgeKind::arc_ccw : EdgeKind::arc_cw, a, b, centre};
        return true;
      }
    }
  }
  return straight;
}

}  // namespace

void fit_arcs(const std::vector<Point>& places, double tolerance, std::vector<Edge>& edges) {
  for (std::size_t at = 0; at + 1 < places.size();) {
    Edge best{EdgeKind::line, places[at], places[at + 1], {}}, tried;
    std::size_t good = at + 1, reach = 2;
    while (at + reach < places.size() && piece(places, at, at + reach, tolerance, tried)) {
      good = at + reach, best = tried;
      reach *= 2;
    }
    std::size_t bad = std::min(at + reach, places.size());
    while (bad - good > 1) {
      const std::size_t middle = (good + bad) / 2;
      if (piece(places, at, middle, tolerance, tried))
        good = middle, best = tried;
      else
        bad = middle;
    }
    if (!(best.from == best.to)) edges.push_back(best);
    at = good;
  }
}

}  // namespace lekalo::mill

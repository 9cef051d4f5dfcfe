#include "triangle_pair.hpp"

#include <limits>

namespace lekalo::solid {
namespace {

/// Keeps the nearest of the pairs of points that it is shown.
struct Nearer {
  PairFound best{{}, {}, std::numeric_limits<double>::infinity(), 0};
  void look(Vector a, Vector b) {
    const Vector way = a - b;
    const double squared = dot(way, way);
    if (squared < best.squared) best.a = a, best.b = b, best.squared = squared;
  }
};

/// The nearest points of the segments p + s u and q + t v, s and t from 0 to 1. Source: Ericson 2005, section
/// 5.1.9, for the order in which s and t are held to their ends; the code is our own.
void look_at_edges(Nearer& nearer, Vector p, Vector u, Vector q, Vector v) {
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v);
  const Vector w = p - q;
  const double uw = dot(u, w), vw = dot(v, w), determinant = uu * vv - uv * uv;
  double s = determinant > 0 ? std::clamp((uv * vw - uw * vv) / determinant, 0.0, 1.0) : 0;
  double t = vv > 0 ? (uv * s + vw) / vv : 0;
  if (!(t > 0 && t < 1)) {
    t = t > 0 ? 1 : 0;
    s = uu > 0 ? std::clamp((uv * t - uw) / uu, 0.0, 1.0) : 0;
  }
  nearer.look(p + s * u, q + t * v);
}

/// If the edges of a go through the plane of b, the place where they do may lie in b.
void look_through(Nearer& nearer, const Corners& a, const Corners& b, bool swapped) {
  const Vector n = cross(b[1] - b[0], b[2] - b[0]);
  const std::array<double, 3> height{dot(n, a[0] - b[0]), dot(n, a[1] - b[0]), dot(n, a[2] - b[0])};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if ((height[k] > 0) == (height[next] > 0)) continue;
    const Vector through = a[k] + height[k] / (height[k] - height[next]) * (a[next] - a[k]);
    const Vector in_b = nearest_point(b, through);
    swapped ? nearer.look(in_b, through) : nearer.look(through, in_b);
  }
}

/// All of a lies beyond all of b along the way from b to a by this much, however good the two points are.
double separation(const Corners& a, const Corners& b, Vector at_a, Vector at_b) {
  const Vector way = at_a - at_b;
  const double length = norm(way);
  if (!(length > 0)) return 0;
  const double a_low = std::min({dot(way, a[0] - at_a), dot(way, a[1] - at_a), dot(way, a[2] - at_a)});
  const double b_high = std::max({dot(way, b[0] - at_b), dot(way, b[1] - at_b), dot(way, b[2] - at_b)});
  return length + (a_low - b_high) / length;
}

}  // namespace

PairFound nearest_points(const Corners& a, const Corners& b, double most, double enough) noexcept {
  Nearer nearer;
  PairFound& best = nearer.best;
  for (std::size_t i = 0; i < 3; ++i) {
    nearer.look(a[i], nearest_point(b, a[i]));
    nearer.look(nearest_point(a, b[i]), b[i]);
  }
  best.low = separation(a, b, best.a, best.b);
  // A vertex and a face, as a rule, and then no edge is nearer.
  if (best.low >= most || (best.low > 0 && best.low >= std::sqrt(best.squared) - enough)) return best;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      look_at_edges(nearer, a[i], a[(i + 1) % 3] - a[i], b[j], b[(j + 1) % 3] - b[j]);
  best.low = std::max(best.low, separation(a, b, best.a, best.b));
  if (best.low > 0) return best;
  look_through(nearer, a, b, false);
  look_through(nearer, b, a, true);
  best.low = std::max(best.low, separation(a, b, best.a, best.b));
  return best;
}

bool clearly_apart(const Corners& a, const Corners& b, double most) noexcept {
  const auto along = [&](Vector n) {
    const double a0 = dot(n, a[0] - b[0]), a1 = dot(n, a[1] - b[0]), a2 = dot(n, a[2] - b[0]),
                 b1 = dot(n, b[1] - b[0]), b2 = dot(n, b[2] - b[0]);
    const double gap = std::max(std::min({a0, a1, a2}) - std::max({0.0, b1, b2}),
                                std::min({0.0, b1, b2}) - std::max({a0, a1, a2}));
    return gap > 0 && gap * gap >= most * most * dot(n, n);
  };
  return along(cross(b[1] - b[0], b[2] - b[0])) || along(cross(a[1] - a[0], a[2] - a[0])) ||
         along((a[0] - b[0]) + (a[1] - b[1]) + (a[2] - b[2]));
}

}  // namespace lekalo::solid

#include "lekalo/phi/convex.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "lekalo/geom/double_double.hpp"
#include "lekalo/geom/pose.hpp"

namespace lekalo::phi {
namespace {

using geom::ConvexPolygon;
using geom::DoubleDouble;
using geom::Point;

constexpr double kUnit = 0x1p-53;

/// Returns the signed distance of p from the line a -> b, positive on the left.
double signed_distance(Point p, Point a, Point b) noexcept {
  const Point edge = b - a;
  return cross(edge, p - a) / norm(edge);
}

struct PointDD {
  DoubleDouble x, y;
};
PointDD operator-(const PointDD& a, const PointDD& b) { return {a.x - b.x, a.y - b.y}; }
DoubleDouble cross(const PointDD& a, const PointDD& b) { return a.x * b.y - a.y * b.x; }

/// The placed part in double-double. The input doubles are exact, and the rotation is within
/// kSinCosPairError.
class ExactPlacement {
 public:
  ExactPlacement(double x, double y, double theta)
      : rotation_(geom::sincos_double_double(theta)), x_(x), y_(y) {}
  [[nodiscard]] PointDD operator()(Point v) const {
    const DoubleDouble vx{v.x}, vy{v.y};
    return {rotation_.cosine * vx - rotation_.sine * vy + DoubleDouble{x_},
            rotation_.sine * vx + rotation_.cosine * vy + DoubleDouble{y_}};
  }

 private:
  geom::SinCosPair rotation_;
  double x_, y_;
};

DoubleDouble signed_distance(const PointDD& p, Point a, Point b) {
  const PointDD edge{geom::two_sum(b.x, -a.x), geom::two_sum(b.y, -a.y)};
  const DoubleDouble length = geom::sqrt(edge.x * edge.x + edge.y * edge.y);
  return cross(edge, p - PointDD{{a.x}, {a.y}}) / length;
}

}  // namespace

Enclosure clearance_enclosure(const ConvexPolygon& part, const ConvexPolygon& blank, double x, double y,
                              double theta) noexcept {
  const auto pose = geom::BlankFromPart::from_angle(theta, {x, y});
  const std::size_t m = part.size();
  std::vector<Point> placed(m);
  double scale = std::max(std::abs(x), std::abs(y));
  for (std::size_t i = 0; i < m; ++i) {
    placed[i] = pose(part[i]);
    scale = std::max(
        {scale, std::abs(part[i].x), std::abs(part[i].y), std::abs(placed[i].x), std::abs(placed[i].y)});
  }
  for (const Point& p : blank.vertices()) scale = std::max({scale, std::abs(p.x), std::abs(p.y)});
  // Doubles say which pairs can be the least. They are right within 32 u scale, so every pair
  // within twice that of the least double value is computed again with 32 digits.
  const double margin = 64 * kUnit * scale;

  // One turn around both polygons suffices, because as the edge's direction turns, so does the vertex that is
  // furthest out. The walk goes by the direction of the part's edges, which does not suffer from coordinates
  // far from the origin.
  const auto furthest_from = [&](std::size_t start, Point edge) {
    std::size_t i = start;
    for (std::size_t steps = 0; steps < m; ++steps) {
      const std::size_t next = part.next(i);
      if (!(cross(edge, pose.rotate(part[next] - part[i])) < 0)) break;
      i = next;
    }
    return i;
  };
  std::vector<std::size_t> outermost(blank.size());
  double least = std::numeric_limits<double>::infinity();
  std::size_t vertex = 0;
  {
    const Point edge = blank[1] - blank[0];
    for (std::size_t i = 1; i < m; ++i)
      if (cross(edge, pose.rotate(part[i] - part[vertex])) < 0) vertex = i;
  }
  for (std::size_t k = 0; k < blank.size(); ++k) {
    const Point a = blank[k], b = blank[blank.next(k)];
    vertex = furthest_from(vertex, b - a);
    outermost[k] = vertex;
    least = std::min(least, signed_distance(placed[vertex], a, b));
  }

  const ExactPlacement exact(x, y, theta);
  const double limit = least + margin;
  DoubleDouble best{std::numeric_limits<double>::infinity()};
  NearestPair nearest;
  for (std::size_t k = 0; k < blank.size(); ++k) {
    const Point a = blank[k], b = blank[blank.next(k)];
    if (signed_distance(placed[outermost[k]], a, b) > limit) continue;
    const auto consider = [&](std::size_t i) {
      const DoubleDouble value = signed_distance(exact(part[i]), a, b);
      if (value.hi < best.hi || (value.hi == best.hi && value.lo < best.lo)) {
        best = value;
        nearest = {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k)};
      }
    };
    consider(outermost[k]);
    // Distances rise on both sides of the outermost vertex, so the walk goes on only while doubles cannot
    // tell.
    for (std::size_t i = part.next(outermost[k]), n = 1; n < m; i = part.next(i), ++n) {
      if (signed_distance(placed[i], a, b) > limit) break;
      consider(i);
    }
    for (std::size_t i = outermost[k], n = 1; n < m; ++n) {
      i = i == 0 ? m - 1 : i - 1;
      if (signed_distance(placed[i], a, b) > limit) break;
      consider(i);
    }
  }

  // The rotation is off by 2 kSinCosPairError scale. Then come a dozen operations of 16 * 2^-106 each on
  // numbers below 4 scale, multiplied by edge / length <= 1. 1e-28 scale covers them with an order of
  // magnitude to spare.
  const double error = 1e-28 * scale;
  const DoubleDouble low = best - DoubleDouble{error}, high = best + DoubleDouble{error};
  const double inf = std::numeric_limits<double>::infinity();
  return {low.lo < 0 ? std::nextafter(low.hi, -inf) : low.hi,
          high.lo > 0 ? std::nextafter(high.hi, inf) : high.hi, nearest};
}

}  // namespace lekalo::phi

#pragma once

// Points that predicates find hard: on one line or a few units in the last place off it, of like and of very
// different sizes. Everything is a function of the generator's state.

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/point.hpp"

namespace lekalo::cases {

enum class PointKind { grid, uniform, ulps_about_a_line, kettner, far_from_origin, any_size, sparse };
inline constexpr std::array kPointKinds{
    PointKind::grid,    PointKind::uniform,         PointKind::ulps_about_a_line,
    PointKind::kettner, PointKind::far_from_origin, PointKind::any_size,
    PointKind::sparse};

/// v or one of its six nearest neighbours; 0 stays, for its neighbours are below every promise.
inline double few_ulps_off(Random& random, double v) {
  if (v == 0) return 0;
  const auto steps = static_cast<int>(random.below(7)) - 3;
  const double towards =
      steps < 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  for (int i = 0; i < std::abs(steps); ++i) v = std::nextafter(v, towards);
  return v;
}

/// Magnitudes 2^low to 2^high, either sign, all mantissas.
inline double any_size(Random& random, int low, int high) {
  const double mantissa = 1 + random.uniform();
  const int exponent = low + static_cast<int>(random.below(static_cast<std::uint64_t>(high - low)));
  return std::ldexp(random.below(2) == 0 ? mantissa : -mantissa, exponent);
}

/// Four points, the second pair nearly parallel to the first, and nearly on its line half of the time; for
/// three points take the first three.
inline std::array<geom::Point, 4> hard_points(Random& random, PointKind kind) {
  using geom::Point;
  const auto spread = [&](double reach) {
    return Point{random.uniform(-reach, reach), random.uniform(-reach, reach)};
  };
  const auto off = [&](Point p) { return Point{few_ulps_off(random, p.x), few_ulps_off(random, p.y)}; };
  switch (kind) {
    case PointKind::grid: {
      const auto node = [&] {
        return Point{static_cast<double>(random.below(5)) / 8, static_cast<double>(random.below(5)) / 8};
      };
      return {node(), node(), node(), node()};
    }
    case PointKind::uniform:
      return {spread(1000), spread(1000), spread(1000), spread(1000)};
    case PointKind::kettner: {
      // Kettner et al. 2008: the corner of a grid of single ulps against a diagonal, where plain arithmetic
      // gives a famous picture of wrong signs.
      const auto corner = [&] {
        return Point{0.5 + static_cast<double>(random.below(64)) * 0x1p-53,
                     0.5 + static_cast<double>(random.below(64)) * 0x1p-53};
      };
      return {corner(), {12, 12}, {24, 24}, corner()};
    }
    case PointKind::far_from_origin: {
      // Multiples of one small step, so that lines are met exactly, a single ulp apart.
      const auto steps = [&](double reach) {
        return Point{std::nearbyint(random.uniform(-reach, reach)),
                     std::nearbyint(random.uniform(-reach, reach))};
      };
      const double step = 0x1p-22;
      const Point far = step * steps(0x1p51), along = step * steps(100);
      const auto near_line = [&] { return off(far + static_cast<double>(random.below(9)) * along); };
      return {near_line(), near_line(), near_line(), near_line()};
    }
    case PointKind::any_size:
    case PointKind::sparse: {
      std::array<Point, 4> points;
      for (Point& p : points) p = {any_size(random, -480, 480), any_size(random, -480, 480)};
      if (kind == PointKind::sparse) {
        // Many equal and zero coordinates, of few sizes.
        for (Point& p : points) {
          if (random.below(3) == 0) p.x = 0;
          if (random.below(3) == 0) p.y = points[0].y;
          if (random.below(4) == 0) p = points[random.below(4)];
        }
      } else if (random.below(2) == 0) {
        // On a line through the origin, each point of its own size.
        const double size = any_size(random, -450, 450);
        points[0] = {size, size};
        for (Point& p : points) p = any_size(random, -20, 20) * Point{points[0].x, points[0].x / 3};
      }
      return points;
    }
    case PointKind::ulps_about_a_line:
      break;
  }
  const Point a = spread(1000), b = spread(1000);
  const Point c = random.below(2) == 0 ? off(a + random.uniform(-2, 3) * (b - a)) : spread(1000);
  return {a, b, c, off(c + random.uniform(-2, 3) * (b - a))};
}

}  // namespace lekalo::cases

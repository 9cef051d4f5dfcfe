#pragma once

// Random outlines on the grid and places where two of them touch or nearly do.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/grid_region.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::cases {

using geom::GridPoint;
using geom::GridRegion;

inline std::int64_t between(Random& random, std::int64_t low, std::int64_t high) {
  return low + static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(high - low + 1)));
}

inline GridPoint grid_direction(Random& random, double length) {
  const auto [sine, cosine] = geom::sincos(random.uniform(0, 6.283185307179586));
  return {std::llround(length * cosine), std::llround(length * sine)};
}

/// Star-shaped about the origin, within `size` steps, further out than `least` of it.
inline std::vector<GridPoint> star(Random& random, double size, double least, std::size_t n) {
  std::vector<GridPoint> loop;
  const double phase = random.uniform(0, 6.283185307179586);
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = phase + 6.283185307179586 * (static_cast<double>(i) + random.uniform(0, 0.8)) /
                                     static_cast<double>(n);
    const double r = size * random.uniform(least, 1);
    const auto [sine, cosine] = geom::sincos(angle);
    loop.push_back({std::llround(r * cosine), std::llround(r * sine)});
  }
  return loop;
}

/// A comb, an L, a U or a bar on a lattice of `unit` steps, with edges along (u, v) and (-v, u).
inline std::vector<GridPoint> lattice_shape(Random& random, GridPoint axis) {
  std::vector<GridPoint> loop;
  const std::int64_t teeth = between(random, 1, 3);
  std::int64_t x = 0;
  loop.push_back({0, 0});
  std::vector<GridPoint> top;
  for (std::int64_t i = 0; i < teeth; ++i) {
    const std::int64_t width = between(random, 1, 4), height = between(random, 2, 6);
    top.push_back({x, height});
    top.push_back({x + width, height});
    x += width;
    if (i + 1 < teeth) {
      const std::int64_t slot = between(random, 1, 3), floor = 1;
      top.push_back({x, floor});
      top.push_back({x + slot, floor});
      x += slot;
    }
  }
  loop.push_back({x, 0});
  std::reverse(top.begin(), top.end());
  loop.insert(loop.end(), top.begin(), top.end());
  for (GridPoint& p : loop) p = {p.x * axis.x - p.y * axis.y, p.x * axis.y + p.y * axis.x};
  return loop;
}

/// Rounded shapes: a slot, a disc, a washer, a quarter bitten out of a square.
inline geom::Region curved_region(Random& random, double size) {
  using geom::Edge;
  using geom::EdgeKind;
  const auto line = [](geom::Point a, geom::Point b) { return Edge{EdgeKind::line, a, b, {}}; };
  const double r = size * random.uniform(0.1, 0.5), length = size * random.uniform(0.2, 1);
  switch (random.below(4)) {
    case 0:
      return {{line({0, -r}, {length, -r}),
               {EdgeKind::arc_ccw, {length, -r}, {length, r}, {length, 0}},
               line({length, r}, {0, r}),
               {EdgeKind::arc_ccw, {0, r}, {0, -r}, {0, 0}}},
              {}};
    case 1:
      return {{{EdgeKind::arc_ccw, {r, 0}, {r, 0}, {0, 0}}}, {}};
    case 2: {
      const double hole = r * random.uniform(0.3, 0.9);
      return {{{EdgeKind::arc_ccw, {r, 0}, {r, 0}, {0, 0}}},
              {{{EdgeKind::arc_cw, {0, hole}, {0, hole}, {0, 0}}}}};
    }
    default: {
      const double bite = length * random.uniform(0.2, 0.8);
      return {{line({0, 0}, {length, 0}),
               line({length, 0}, {length, length - bite}),
               {EdgeKind::arc_cw, {length, length - bite}, {length - bite, length}, {length, length}},
               line({length - bite, length}, {0, length}),
               line({0, length}, {0, 0})},
              {}};
    }
  }
}

inline geom::GridRotation any_rotation(Random& random) {
  switch (random.below(3)) {
    case 0:
      return geom::rotation_from_degrees(90.0 * static_cast<double>(random.below(4)));
    case 1:
      return geom::rotation_from_degrees(15.0 * static_cast<double>(random.below(24)));
    default:
      return geom::rotation_from_degrees(random.uniform(-180, 180));
  }
}

/// 1 to 500 mm large, 3 to about 20 vertices, turned.
inline GridRegion any_outline(Random& random) {
  const double size = 0x1p20 * std::exp(random.uniform(0, 6.2));
  for (;;) {
    std::vector<std::vector<GridPoint>> loops;
    switch (random.below(5)) {
      case 0:
        loops.push_back(star(random, size, random.uniform(0.05, 0.9), 3 + random.below(8)));
        break;
      case 1: {
        const std::int64_t unit = between(random, 1, 1 << 20) * 5;
        const GridPoint axes[] = {{5, 0}, {3, 4}, {4, -3}, {0, 5}, {-4, 3}};
        const GridPoint axis = axes[random.below(5)];
        loops.push_back(lattice_shape(random, {axis.x * unit, axis.y * unit}));
        break;
      }
      case 2: {
        const double ring = random.uniform(0.3, 0.7);
        loops.push_back(star(random, size, ring + 0.1, 4 + random.below(6)));
        loops.push_back(star(random, size * ring * 0.5, 0.2, 3 + random.below(4)));
        break;
      }
      case 3: {  // a frame of right angles with one or two rooms
        const std::int64_t u = between(random, 8, 1 << 20);
        const auto box = [&](std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) {
          return std::vector<GridPoint>{
              {x0 * u, y0 * u}, {x1 * u, y0 * u}, {x1 * u, y1 * u}, {x0 * u, y1 * u}};
        };
        loops = {box(0, 0, 12, 9), box(1, 1, 5, 8)};
        if (random.below(2) == 0) loops.push_back(box(6, between(random, 1, 4), between(random, 8, 11), 8));
        break;
      }
      default: {
        const double mm = size * 0x1p-20;
        const auto made = geom::grid_region_of_curves(
            curved_region(random, mm), random.below(2) == 0 ? geom::ChordSide::grow : geom::ChordSide::shrink,
            mm * random.uniform(0.005, 0.05));
        if (made) return geom::turned(*made, any_rotation(random), random.below(2) == 0);
        continue;
      }
    }
    if (const auto made = geom::make_grid_region(std::move(loops)))
      return geom::turned(*made, any_rotation(random), random.below(2) == 0);
  }
}

/// One loop of a region alone, as a region.
inline GridRegion loop_region(const GridRegion& region, std::size_t loop) {
  std::vector<GridPoint> points(region.points.begin() + region.loop_starts[loop],
                                region.points.begin() + region.loop_starts[loop + 1]);
  if (loop > 0) std::reverse(points.begin(), points.end());
  const auto count = static_cast<std::uint32_t>(points.size());
  return {std::move(points), {0, count}};
}

struct GridEdge {
  GridPoint from, to;
};
inline GridEdge any_edge(Random& random, const GridRegion& region) {
  const std::size_t l = random.below(region.loops());
  const std::uint32_t begin = region.loop_starts[l], n = region.loop_starts[l + 1] - begin;
  const auto i = static_cast<std::uint32_t>(random.below(n));
  return {region.points[begin + i], region.points[begin + (i + 1) % n]};
}

/// A point of the edge, on the grid exactly where it can be, else rounded.
inline GridPoint point_on(Random& random, const GridEdge& edge) {
  const GridPoint d = edge.to - edge.from;
  const std::int64_t common = std::gcd(d.x, d.y);
  if (common > 1) {
    const std::int64_t k = between(random, 0, common);
    return {edge.from.x + d.x / common * k, edge.from.y + d.y / common * k};
  }
  const double share = random.uniform();
  return {edge.from.x + std::llround(share * static_cast<double>(d.x)),
          edge.from.y + std::llround(share * static_cast<double>(d.y))};
}

/// Where b must be moved so that it touches a: vertex on vertex, vertex on edge, edge along edge, or simply
/// on top.
inline GridPoint touching_shift(Random& random, const GridRegion& a, const GridRegion& b) {
  const GridEdge on_a = any_edge(random, a), on_b = any_edge(random, b);
  switch (random.below(5)) {
    case 0:
      return on_a.from - on_b.from;
    case 1:
      return point_on(random, on_a) - on_b.from;
    case 2:
      return on_a.from - point_on(random, on_b);
    case 3:
      return point_on(random, on_a) - point_on(random, on_b);
    default:
      return {};
  }
}

/// Nothing, some steps, 1e-7 to 10^-2.5 of the size anywhere, or multiples of a Pythagorean vector or of one
/// across an edge of `of`.
inline GridPoint small_offset(Random& random, double size, const GridRegion& of) {
  switch (random.below(6)) {
    case 5: {
      const GridEdge edge = any_edge(random, of);
      const GridPoint d = edge.to - edge.from;
      const std::int64_t common = std::gcd(d.x, d.y), k = between(random, 1, 1 << 16);
      if (std::max(std::abs(d.x), std::abs(d.y)) / common > 1000) return {};
      return {d.y / common * k, -d.x / common * k};
    }
    case 0:
    case 1:
      return {};
    case 2:
      return {between(random, -2, 2), between(random, -2, 2)};
    case 3:
      return grid_direction(random, size * std::exp(random.uniform(-16.12, -5.76)));
    default: {
      const std::int64_t k = between(random, 1, 1 << 16);
      const GridPoint vectors[] = {{3, 4}, {-4, 3}, {5, 0}, {0, -5}, {-3, -4}, {4, -3}, {5, 12}, {-8, 15}};
      const GridPoint v = vectors[random.below(8)];
      return {v.x * k, v.y * k};
    }
  }
}

}  // namespace lekalo::cases

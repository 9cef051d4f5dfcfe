#pragma once

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/point.hpp"
#include "lekalo/geom/trig.hpp"

/// Pocket files made up: their JSON.
namespace lekalo::pockets {

inline std::string line(geom::Point a, geom::Point b) {
  return fmt::format(R"({{"line":{{"from":[{},{}],"to":[{},{}]}}}})", a.x, a.y, b.x, b.y);
}
/// Bent by `sagitta` to the right of the way from a to b, or to the left where it is negative.
inline std::string bulge(geom::Point a, geom::Point b, double sagitta) {
  const geom::Point way = b - a;
  const double d = norm(way), h = std::abs(sagitta), r = (d * d / 4 + h * h) / (2 * h);
  const geom::Point centre = 0.5 * (a + b) + ((sagitta > 0 ? r - h : h - r) / d) * perpendicular(way);
  return fmt::format(R"({{"arc":{{"from":[{},{}],"to":[{},{}],"centre":[{},{}],"ccw":{}}}}})", a.x, a.y, b.x,
                     b.y, centre.x, centre.y, sagitta > 0);
}
inline std::string circle(geom::Point centre, double radius) {
  return fmt::format(R"({{"arc":{{"from":[{},{}],"to":[{},{}],"centre":[{},{}],"ccw":true}}}})",
                     centre.x + radius, centre.y, centre.x + radius, centre.y, centre.x, centre.y);
}
inline std::string outline(const std::vector<geom::Point>& at) {
  std::string text;
  for (std::size_t i = 0; i < at.size(); ++i)
    text += (i == 0 ? "" : ",") + line(at[i], at[(i + 1) % at.size()]);
  return text;
}
inline std::string document(const std::string& outer, const std::vector<std::string>& islands = {}) {
  std::string text = R"({"units":"mm","outer":[)" + outer + R"(],"islands":[)";
  for (const std::string& island : islands) text += (&island == &islands.front() ? "[" : ",[") + island + "]";
  return text + "]}";
}

inline geom::Point around(double share, double radius) {
  const auto [sine, cosine] = geom::sincos(6.283185307179586 * share);
  return {radius * cosine, radius * sine};
}

/// Islands, one to three: whole circles and pentagons that do not meet, all within `reach` of (0, 0).
inline std::vector<std::string> random_islands(Random& random, double reach) {
  struct Disc {
    geom::Point at;
    double radius;
  };
  std::vector<Disc> discs;
  std::vector<std::string> islands;
  const auto count = 1 + random.below(3);
  for (int trial = 0; trial < 60 && discs.size() < count; ++trial) {
    // The distance is drawn before the angle, in an order that no compiler may change.
    const double away = 0.8 * reach * random.uniform(), share = random.uniform();
    const Disc disc{around(share, away), 1 + 4 * random.uniform()};
    bool fits = norm(disc.at) + disc.radius < reach;
    for (const Disc& other : discs)
      fits = fits && norm(disc.at - other.at) > disc.radius + other.radius + 0.05;
    if (!fits) continue;
    discs.push_back(disc);
    std::vector<geom::Point> corners;
    for (int k = 0; k < 5; ++k) corners.push_back(disc.at + around((k + 0.25) / 5, disc.radius));
    islands.push_back(random.uniform() < 0.6 ? circle(disc.at, disc.radius) : outline(corners));
  }
  return islands;
}

/// In turn: lines through random places about (0, 0), a wavy outline, a whole circle, bent sides, two rooms
/// and a door, a whole circle with islands; every second of them with islands where there is room.
inline std::string random_pocket(Random& random, std::size_t number, double size) {
  const auto about = [&](std::size_t corners, double least, double turn) {
    std::vector<geom::Point> at;
    for (std::size_t i = 0; i < corners; ++i) {
      const double share = (static_cast<double>(i) + turn * random.uniform()) / static_cast<double>(corners);
      at.push_back(around(share, size * (least + (1 - least) * random.uniform())));
    }
    return at;
  };
  const bool islands = random.uniform() < 0.5;
  const auto with = [&](double reach) {
    return islands ? random_islands(random, reach) : std::vector<std::string>{};
  };
  switch (number % 6) {
    case 0: {
      const std::string outer = outline(about(3 + random.below(9), 0.4, 0.5));
      return document(outer, with(0.2 * size));
    }
    case 1: {
      const auto count = 60 + random.below(140);
      const double first = 2 + static_cast<double>(random.below(8)),
                   more = 7 + static_cast<double>(random.below(16));
      const double wave = 0.25 * random.uniform(), ripple = 0.08 * random.uniform();
      std::vector<geom::Point> at;
      for (std::size_t i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count);
        at.push_back(around(
            share, size * (1 + wave * around(first * share, 1).y + ripple * around(more * share, 1).y)));
      }
      return document(outline(at), with(0.5 * size));
    }
    case 2:
      return document(circle({}, size), with(0.95 * size));
    case 3: {
      const std::vector<geom::Point> at = about(4 + random.below(6), 0.6, 0.3);
      std::string outer;
      for (std::size_t i = 0; i < at.size(); ++i) {
        const geom::Point a = at[i], b = at[(i + 1) % at.size()];
        // One draw a statement: compilers may evaluate the operands of a product in any order.
        const double depth = 0.03 + 0.09 * random.uniform();
        const double sagitta = norm(b - a) * (random.uniform() < 0.5 ? depth : -depth);
        outer += (i == 0 ? "" : ",") + (random.uniform() < 0.4 ? line(a, b) : bulge(a, b, sagitta));
      }
      return document(outer, with(0.3 * size));
    }
    case 4: {
      const double door = 3 + 2.5 * random.uniform(), x1 = 9 + 13 * random.uniform(),
                   x2 = x1 + 2 + 13 * random.uniform(), x3 = x2 + 9 + 13 * random.uniform(),
                   y1 = door + 1 + 6 * random.uniform(), y2 = door + 1 + 6 * random.uniform();
      return document(outline({{0, -y1},
                               {x1, -y1},
                               {x1, -door},
                               {x2, -door},
                               {x2, -y2},
                               {x3, -y2},
                               {x3, y2},
                               {x2, y2},
                               {x2, door},
                               {x1, door},
                               {x1, y1},
                               {0, y1}}));
    }
    default:
      return document(circle({}, size), random_islands(random, 0.95 * size));
  }
}

}  // namespace lekalo::pockets

#pragma once

// Contours as decimals in integer steps, so that what is collinear in a file is known exactly, and their
// text.

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/polygon.hpp"

namespace lekalo::io_cases {

/// A coordinate counted in units of 10^-digits.
struct GridPoint {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};
using GridRing = std::vector<GridPoint>;

inline std::string decimal(std::int64_t steps, int digits) {
  std::string text = fmt::format("{:0{}}", steps < 0 ? -steps : steps, digits + 1);
  if (digits > 0) text.insert(text.size() - static_cast<std::size_t>(digits), ".");
  return (steps < 0 ? "-" : "") + text;
}

inline std::string csv(const GridRing& ring, int digits) {
  std::string text;
  for (const GridPoint p : ring) text += fmt::format("{},{}\n", decimal(p.x, digits), decimal(p.y, digits));
  return text;
}

inline std::string json(const GridRing& ring, int digits) {
  std::string text = "[";
  for (std::size_t i = 0; i < ring.size(); ++i) {
    text += fmt::format("{}[{}, {}]", i == 0 ? "" : ",\n ", decimal(ring[i].x, digits),
                        decimal(ring[i].y, digits));
  }
  return text + "]\n";
}

inline std::string region(const GridRing& ring, int digits) {
  std::string text = R"({"units": "mm", "outer": [)";
  const auto point = [&](std::size_t i) {
    const GridPoint p = ring[i % ring.size()];
    return fmt::format("[{}, {}]", decimal(p.x, digits), decimal(p.y, digits));
  };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    text +=
        fmt::format(R"({}{{"line": {{"from": {}, "to": {}}}}})", i == 0 ? "" : ", ", point(i), point(i + 1));
  }
  return text + R"(], "holes": []})";
}

inline std::string dxf_entities(const std::string& entities, const std::string& header = "") {
  return header + "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

inline std::string polyline(const GridRing& ring, int digits, int flags = 1,
                            const std::string& layer = "CUT") {
  std::string text = fmt::format("0\nLWPOLYLINE\n8\n{}\n90\n{}\n70\n{}\n", layer, ring.size(), flags);
  for (const GridPoint p : ring)
    text += fmt::format("10\n{}\n20\n{}\n", decimal(p.x, digits), decimal(p.y, digits));
  return text;
}

inline std::string line(GridPoint a, GridPoint b, int digits, const std::string& layer = "CUT") {
  return fmt::format("0\nLINE\n8\n{}\n10\n{}\n20\n{}\n30\n0.0\n11\n{}\n21\n{}\n31\n0.0\n", layer,
                     decimal(a.x, digits), decimal(a.y, digits), decimal(b.x, digits), decimal(b.y, digits));
}

/// The closed chain in a scrambled order, every third LINE backwards; the first stays first and forwards.
inline std::string lines(const GridRing& ring, int digits, Random& random) {
  std::vector<std::size_t> order(ring.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = ring.size() - 1; i > 1; --i) std::swap(order[i], order[1 + random.below(i)]);
  std::string text;
  for (const std::size_t k : order) {
    const GridPoint a = ring[k], b = ring[(k + 1) % ring.size()];
    text += k % 3 == 2 ? line(b, a, digits) : line(a, b, digits);
  }
  return text;
}

/// Corners of a convex polygon, counter-clockwise, every edge a multiple of `pieces` steps in x and y.
inline GridRing convex_corners(Random& random, std::size_t points, std::int64_t half_width,
                               std::int64_t pieces) {
  GridRing grid;
  geom::Ring ring;
  do {
    grid.clear();
    ring.clear();
    const auto side = static_cast<std::uint64_t>(2 * half_width / pieces);
    for (std::size_t i = 0; i < points; ++i) {
      const GridPoint p{pieces * static_cast<std::int64_t>(random.below(side)) - half_width,
                        pieces * static_cast<std::int64_t>(random.below(side)) - half_width};
      grid.push_back(p);
      ring.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
    }
  } while (geom::convex_hull(ring).size() < 3);
  GridRing corners;
  for (const std::size_t index : geom::convex_hull(ring)) corners.push_back(grid[index]);
  return corners;
}

/// The corners with pieces - 1 points on every edge.
inline GridRing subdivided(const GridRing& corners, std::int64_t pieces) {
  GridRing ring;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const GridPoint a = corners[i], b = corners[(i + 1) % corners.size()];
    for (std::int64_t k = 0; k < pieces; ++k) {
      ring.push_back({a.x + (b.x - a.x) / pieces * k, a.y + (b.y - a.y) / pieces * k});
    }
  }
  return ring;
}

inline GridRing moved(GridRing ring, GridPoint by) {
  for (GridPoint& p : ring) p = {p.x + by.x, p.y + by.y};
  return ring;
}

inline GridRing begun_at(GridRing ring, std::size_t start) {
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(start % ring.size()), ring.end());
  return ring;
}

inline GridRing reversed(GridRing ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

/// Vertices of a polygon beginning with the lowest in (x, y): equal for equal polygons wherever they begin.
inline geom::Ring canonical(const geom::ConvexPolygon& polygon) {
  geom::Ring ring = polygon.vertices();
  const auto lowest = std::min_element(ring.begin(), ring.end(), [](geom::Point a, geom::Point b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  });
  std::rotate(ring.begin(), lowest, ring.end());
  return ring;
}

}  // namespace lekalo::io_cases

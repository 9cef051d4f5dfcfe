#pragma once

// Inputs shared by tests and benchmarks: the published examples, and random pairs of a convex part and a
// convex blank with a known placement. Everything is a function of a seed and an index, the same on every
// machine.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::cases {

/// LEKALO_CASES when set, else `standard`. With LEKALO_TIMES it is at most so many times `standard`: the full
/// suite sets both, since ten thousand cases take a second of one test and days of another.
inline std::size_t case_count(std::size_t standard) {
  const auto number = [](const char* name, std::size_t otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr ? static_cast<std::size_t>(std::strtoull(text, nullptr, 10)) : otherwise;
  };
  return std::min(number("LEKALO_CASES", standard), standard * number("LEKALO_TIMES", 1'000'000'000));
}

/// LEKALO_SEED when set, else 1. Print it with every failure.
inline std::uint64_t seed() {
  const char* text = std::getenv("LEKALO_SEED");
  return text != nullptr ? std::strtoull(text, nullptr, 10) : 1;
}

/// The polygon of a ring that is convex by construction; a mistake here is the test's, hence the exception.
inline geom::ConvexPolygon convex(geom::Ring ring) {
  auto made = geom::ConvexPolygon::make(std::move(ring));
  if (!made) throw std::logic_error("test input: " + made.error().message);
  return *std::move(made);
}

inline geom::ConvexPolygon hull(const geom::Ring& points) {
  geom::Ring ring;
  for (const std::size_t index : geom::convex_hull(points)) ring.push_back(points[index]);
  return convex(std::move(ring));
}

// ----------------------------------------------------------------------------------------------------
// published

/// An example of the localisation article as printed there: file order, parts 2, 4 and 6 clockwise.
struct Example {
  std::string name;
  geom::Ring blank_points, part_points;
  double published;  ///< the article's phi*, not always reached by its own pose
  double optimum;    ///< global, to 9 digits

  [[nodiscard]] geom::ConvexPolygon part() const { return counter_clockwise(part_points); }
  [[nodiscard]] geom::ConvexPolygon blank() const { return counter_clockwise(blank_points); }

 private:
  static geom::ConvexPolygon counter_clockwise(geom::Ring ring) {
    if (geom::signed_area(ring) < 0) ring = geom::Ring(ring.rbegin(), ring.rend());
    return convex(std::move(ring));
  }
};

inline std::vector<Example> published_examples() {
  const geom::Ring ten{{48, 146}, {46, 155}, {44, 162}, {40, 164}, {33, 163},
                       {26, 160}, {24, 155}, {25, 150}, {32, 145}, {39, 144}};
  const geom::Ring seventeen{{87, 152}, {83, 153}, {78, 154},   {72, 154}, {68, 153}, {66, 152},
                             {63, 149}, {62, 147}, {61.5, 145}, {61, 137}, {63, 133}, {65, 130},
                             {70, 129}, {76, 130}, {80, 132},   {84, 139}, {86, 146}};
  const geom::Ring part1{{43.2, 131.4}, {41.4, 139.5}, {39.6, 145.8}, {36.0, 147.6}, {29.7, 146.7},
                         {23.4, 144.0}, {21.6, 139.5}, {22.5, 135.0}, {28.8, 130.5}, {35.1, 129.6}};
  const geom::Ring part2{{40.8, -124.1}, {39.1, -131.75}, {37.4, -137.7},  {34.0, -139.4},  {28.05, -138.55},
                         {22.1, -136.0}, {20.4, -131.75}, {21.25, -127.5}, {27.2, -123.25}, {33.15, -122.4}};
  const geom::Ring part5{{60.9, 106.4}, {58.1, 107.1}, {54.6, 107.8}, {50.4, 107.8},  {47.6, 107.1},
                         {46.2, 106.4}, {44.1, 104.3}, {43.4, 102.9}, {43.05, 101.5}, {42.7, 95.9},
                         {44.1, 93.1},  {45.5, 91.0},  {49.0, 90.3},  {53.2, 91.0},   {56.0, 92.4},
                         {58.8, 97.3},  {60.2, 102.2}};
  const auto mirrored = [](geom::Ring ring) {
    for (geom::Point& p : ring) p.y = -p.y;
    return ring;
  };
  return {
      {"example-1", ten, part1, 0.9469, 0.946928020},
      {"example-2", ten, part2, 0.429455, 0.429429599},
      {"example-3", seventeen, ten, 0.882078, 0.882092590},
      {"example-4", seventeen, mirrored(ten), 0.661594, 0.661610645},
      {"example-5", ten, part5, 1.081789, 1.081789926},
      {"example-6", ten, mirrored(part5), 0.671111, 0.671113798},
  };
}

// ---------------------------------------------------------------------------------------------------
// regular, smooth

inline geom::ConvexPolygon regular_ngon(std::size_t n, double radius, geom::Point centre = {},
                                        double phase = 0) {
  geom::Ring ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double turn = static_cast<double>(i) / static_cast<double>(n);
    const auto [sine, cosine] = geom::sincos(phase + 6.283185307179586 * turn);
    ring.push_back(centre + radius * geom::Point{cosine, sine});
  }
  return convex(std::move(ring));
}

/// n points of the superellipse (x/a)^4 + (y/b)^4 = 1: a smooth outline of n true edges.
inline geom::ConvexPolygon superellipse(std::size_t n, double a, double b, geom::Point centre = {}) {
  geom::Ring ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double turn = (static_cast<double>(i) + 0.25) / static_cast<double>(n);
    const auto [sine, cosine] = geom::sincos(6.283185307179586 * turn);
    const double u = cosine / a, v = sine / b;
    const double radius = 1 / std::sqrt(std::sqrt(u * u * u * u + v * v * v * v));
    ring.push_back(centre + radius * geom::Point{cosine, sine});
  }
  return convex(std::move(ring));
}

/// The corners' ring with points added on every edge, at least n in all: what a probe with a fixed step gives
/// on a blank of few sides. Rounded to doubles, so most added points are not exactly on their edge.
inline geom::Ring with_points_on_edges(const geom::ConvexPolygon& corners, std::size_t n) {
  const std::size_t pieces = (n + corners.size() - 1) / corners.size();
  geom::Ring ring;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const geom::Point a = corners[i], edge = corners[corners.next(i)] - a;
    for (std::size_t j = 0; j < pieces; ++j) {
      ring.push_back(a + (static_cast<double>(j) / static_cast<double>(pieces)) * edge);
    }
  }
  return ring;
}

// --------------------------------------------------------------------------------------------------------
// random

enum class Kind {
  plain,           ///< 3 to 60 vertices about an ellipse, allowance different on every side
  uniform_stock,   ///< the blank is the part's shape with nearly the same allowance all round
  moderate_stock,  ///< the same with 0.3 to 3 mm
  thin_stock,      ///< the same with 0.1 to 5 mm: locally thin
  sliver,          ///< part 1,000 to 100,000 times as long as wide
  near_parallel,   ///< edges broken into two whose directions differ by 1e-12 to 1e-6
  regular,         ///< a regular polygon in a regular polygon
  far,             ///< part and blank 1e5 to 1e7 from the origin
  tiny,            ///< in units where the part measures 1e-5
  huge             ///< in units where the part measures 1e8
};
inline constexpr std::array kKinds{Kind::plain,  Kind::uniform_stock, Kind::moderate_stock, Kind::thin_stock,
                                   Kind::sliver, Kind::near_parallel, Kind::regular,        Kind::far,
                                   Kind::tiny,   Kind::huge};

inline const char* name(Kind kind) {
  switch (kind) {
    case Kind::plain:
      return "plain";
    case Kind::uniform_stock:
      return "uniform_stock";
    case Kind::moderate_stock:
      return "moderate_stock";
    case Kind::thin_stock:
      return "thin_stock";
    case Kind::sliver:
      return "sliver";
    case Kind::near_parallel:
      return "near_parallel";
    case Kind::regular:
      return "regular";
    case Kind::far:
      return "far";
    case Kind::tiny:
      return "tiny";
    case Kind::huge:
      return "huge";
  }
  return "?";
}

struct LocateCase {
  std::string name;  ///< kind, seed and index: enough to make it again
  Kind kind{};
  geom::ConvexPolygon part, blank;
  /// A placement whose clearance is at least `allowance`, so that the optimum is too.
  double x = 0, y = 0, theta = 0;
  double allowance = 0;
  double largest_coordinate = 0;  ///< of part, blank and known placement
};

namespace detail {

inline constexpr double kTurn = 6.283185307179586;

/// Angles in ascending order, no two neighbours half a turn or more apart.
inline std::vector<double> spread_angles(Random& random, std::size_t n) {
  const double jitter = n < 6 ? 0.2 : 0.45;
  const double phase = random.uniform(0, kTurn);
  std::vector<double> angles;
  for (std::size_t i = 0; i < n; ++i) {
    const double place = static_cast<double>(i) + random.uniform(-jitter, jitter);
    angles.push_back(phase + kTurn * place / static_cast<double>(n));
  }
  return angles;
}

inline geom::Point direction(double angle) {
  const auto [sine, cosine] = geom::sincos(angle);
  return {cosine, sine};
}

/// Up to n vertices on an ellipse with the given half axes, turned.
inline geom::Ring ellipse_points(Random& random, std::size_t n, double a, double b) {
  const geom::Point axis = direction(random.uniform(0, kTurn));
  geom::Ring points;
  for (const double angle : spread_angles(random, n)) {
    const geom::Point d = direction(angle);
    points.push_back((a * d.x) * axis + (b * d.y) * perpendicular(axis));
  }
  return points;
}

/// Every edge of the ring gets a second point, pushed outwards from its middle by 1e-12 to 1e-6 of its
/// length.
inline geom::Ring broken_edges(Random& random, const geom::Ring& ring) {
  geom::Ring points;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const geom::Point a = ring[i], edge = ring[i + 1 == ring.size() ? 0 : i + 1] - a;
    const auto push = static_cast<double>(std::uint64_t{1} << random.below(21)) * 1e-12;
    points.push_back(a);
    points.push_back(a + random.uniform(0.1, 0.9) * edge - push * perpendicular(edge));
  }
  return points;
}

/// The part of a ring where normal . p >= offset (Sutherland and Hodgman).
inline geom::Ring clipped(const geom::Ring& ring, geom::Point normal, double offset) {
  geom::Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const geom::Point a = ring[i], b = ring[i + 1 == ring.size() ? 0 : i + 1];
    const double da = dot(normal, a) - offset, db = dot(normal, b) - offset;
    if (da >= 0) kept.push_back(a);
    if ((da < 0) != (db < 0)) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  return kept;
}

/// The polygon with the given inward normals whose sides lie allowances[k] outside the ring. Normals must
/// positively span the plane. Coordinates relative to the middle of the ring, to lose no digits.
inline geom::ConvexPolygon blank_around(const geom::Ring& ring, const std::vector<geom::Point>& normals,
                                        const std::vector<double>& allowances) {
  const geom::Box box = geom::bounds(ring);
  const geom::Point middle = 0.5 * (box.low + box.high), diagonal = box.high - box.low;
  const double reach = 100 * (diagonal.x + diagonal.y);
  geom::Ring blank{{-reach, -reach}, {reach, -reach}, {reach, reach}, {-reach, reach}};
  for (std::size_t k = 0; k < normals.size(); ++k) {
    double support = std::numeric_limits<double>::infinity();
    for (const geom::Point p : ring) support = std::min(support, dot(normals[k], p - middle));
    blank = clipped(blank, normals[k], support - allowances[k]);
  }
  for (geom::Point& p : blank) p = p + middle;
  return hull(blank);
}

inline geom::Ring part_shape(Random& random, Kind kind) {
  const std::size_t n = 3 + random.below(58);
  const double half = random.uniform(10, 100);
  switch (kind) {
    case Kind::sliver: {
      const double ratios[] = {1e3, 1e4, 1e5};
      return ellipse_points(random, n, half, half / ratios[random.below(3)]);
    }
    case Kind::near_parallel:
      return broken_edges(random, ellipse_points(random, 3 + random.below(28), half, half / 2));
    case Kind::regular:
      return regular_ngon(n, half).vertices();
    default:
      return ellipse_points(random, n, half, half * random.uniform(0.25, 1));
  }
}

struct Stock {
  double least, most;
};

inline Stock stock(Random& random, Kind kind) {
  if (kind == Kind::uniform_stock) {
    const double allowance = random.uniform(0.1, 5);
    return {allowance, 1.05 * allowance};
  }
  if (kind == Kind::moderate_stock) return {0.3, 3};
  if (kind == Kind::thin_stock) return {0.1, 5};
  const double least = random.uniform(0.1, 4);
  return {least, random.uniform(least, 5)};
}

/// Inward normals of the blank: those of the placed part where the stock follows its shape, else 3 to 60 of
/// any direction, sometimes in pairs that are nearly parallel.
inline std::vector<geom::Point> blank_normals(Random& random, Kind kind, const geom::Ring& placed) {
  std::vector<geom::Point> normals;
  if (kind == Kind::uniform_stock || kind == Kind::moderate_stock || kind == Kind::thin_stock) {
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const geom::Point edge = placed[i + 1 == placed.size() ? 0 : i + 1] - placed[i];
      normals.push_back((1 / norm(edge)) * perpendicular(edge));
    }
    return normals;
  }
  const std::size_t n = 3 + random.below(58);
  if (kind == Kind::regular) {
    const double phase = random.uniform(0, kTurn);
    for (std::size_t k = 0; k < n; ++k) {
      normals.push_back(direction(phase + kTurn * static_cast<double>(k) / static_cast<double>(n)));
    }
    return normals;
  }
  for (const double angle : spread_angles(random, n)) {
    normals.push_back(direction(angle));
    if (kind == Kind::near_parallel && random.below(2) == 0) {
      normals.push_back(direction(angle + static_cast<double>(std::uint64_t{1} << random.below(21)) * 1e-12));
    }
  }
  return normals;
}

inline geom::Ring scaled_and_moved(geom::Ring ring, double scale, geom::Point by) {
  for (geom::Point& p : ring) p = scale * p + by;
  return ring;
}

}  // namespace detail

/// Case `index` of the sequence with this seed: the kinds take turns. The part is placed at a random pose
/// first and the blank cut around it, so the pose is known to be good; part and blank have 3 to 60 vertices
/// (the blank fewer where a side falls away, near_parallel up to twice as many), the allowance is between 0.1
/// and 5 mm (in the units of tiny and huge: of a part of 20 to 200).
inline LocateCase random_case(std::uint64_t seed, std::uint64_t index, Kind kind) {
  Random random(seed, index + 1);
  const double scale = kind == Kind::tiny ? 1e-7 : kind == Kind::huge ? 1e6 : 1;
  const double reach = kind == Kind::far ? 1e5 * (1 + 99 * random.uniform()) : 100 * scale;
  const auto somewhere = [&] { return reach * geom::Point{random.uniform(-1, 1), random.uniform(-1, 1)}; };

  const geom::Ring shape = hull(detail::part_shape(random, kind)).vertices();
  const geom::Point part_at = somewhere(), blank_at = somewhere();
  geom::ConvexPolygon part = hull(detail::scaled_and_moved(shape, scale, part_at));
  const double theta = random.uniform(0, detail::kTurn);
  const geom::Point t = blank_at - geom::BlankFromPart::from_angle(theta, {}).rotate(part_at);
  const auto pose = geom::BlankFromPart::from_angle(theta, t);
  geom::Ring placed;
  for (const geom::Point p : part.vertices()) placed.push_back(pose(p));

  const detail::Stock stock = detail::stock(random, kind);
  const auto normals = detail::blank_normals(random, kind, placed);
  std::vector<double> allowances;
  for (std::size_t k = 0; k < normals.size(); ++k) {
    allowances.push_back(scale * random.uniform(stock.least, stock.most));
  }
  allowances[random.below(allowances.size())] = scale * stock.least;
  geom::ConvexPolygon blank = detail::blank_around(placed, normals, allowances);

  double largest =
      std::max(geom::largest_coordinate(part.vertices()), geom::largest_coordinate(blank.vertices()));
  largest = std::max({largest, std::abs(t.x), std::abs(t.y)});
  // Placing, cutting and rounding the blank move its sides by a few units in the last place of the
  // coordinates.
  const double allowance = scale * stock.least - 64 * std::numeric_limits<double>::epsilon() * largest;
  return {std::string(name(kind)) + " seed " + std::to_string(seed) + " index " + std::to_string(index),
          kind,
          std::move(part),
          std::move(blank),
          t.x,
          t.y,
          theta,
          allowance,
          largest};
}

inline LocateCase random_case(std::uint64_t seed, std::uint64_t index) {
  return random_case(seed, index, kKinds[index % kKinds.size()]);
}

}  // namespace lekalo::cases

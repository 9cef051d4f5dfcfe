#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "io/drawing/drawn_shapes.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/base/random.hpp"
#include "support/cases.hpp"

// The bounds of src/io/drawn_shapes.hpp: points of the exact curve, in numbers with 64 bits of mantissa, lie
// within the error of the curve in doubles, and its points within the error of the exact one.

namespace lekalo::io::io_drawn_shapes_test {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using Real = long double;

struct RealPoint {
  Real x = 0, y = 0;
};
RealPoint operator+(RealPoint a, RealPoint b) { return {a.x + b.x, a.y + b.y}; }
RealPoint operator-(RealPoint a, RealPoint b) { return {a.x - b.x, a.y - b.y}; }
RealPoint operator*(Real k, RealPoint a) { return {k * a.x, k * a.y}; }
Real size(RealPoint a) { return std::hypot(a.x, a.y); }
RealPoint real(Point p) { return {p.x, p.y}; }

constexpr Real kHalfTurn = 3.14159265358979323846264338327950288L;

Real distance_to_segment(RealPoint p, RealPoint a, RealPoint b) {
  const RealPoint d = b - a, e = p - a;
  const Real square = d.x * d.x + d.y * d.y;
  const Real t = square == 0 ? 0 : std::clamp((e.x * d.x + e.y * d.y) / square, Real{0}, Real{1});
  return size(e - t * d);
}

/// Distance from the curve that an arc edge stands for: the circle of the mean radius between the directions
/// of the ends, joined to them.
Real distance_to_arc(RealPoint p, const Edge& arc) {
  const RealPoint c = real(arc.centre), from = real(arc.from) - c, to = real(arc.to) - c;
  const Real r = (size(from) + size(to)) / 2;
  const RealPoint on_from = c + (r / size(from)) * from, on_to = c + (r / size(to)) * to;
  Real best =
      std::min(distance_to_segment(p, real(arc.from), on_from), distance_to_segment(p, real(arc.to), on_to));
  const Real s = arc.kind == EdgeKind::arc_ccw ? 1 : -1;
  const auto turn = [&](RealPoint v) {
    Real angle = s * std::atan2(from.x * v.y - from.y * v.x, from.x * v.x + from.y * v.y);
    if (angle < 0) angle += 2 * kHalfTurn;
    return angle;
  };
  const bool whole = arc.from == arc.to;
  const RealPoint d = p - c;
  if (whole || turn(d) <= turn(to)) best = std::min(best, std::abs(size(d) - r));
  return best;
}

Real distance_to_shape(RealPoint p, const Shape& shape) {
  if (const auto* edge = std::get_if<Edge>(&shape)) {
    return edge->kind == EdgeKind::line ? distance_to_segment(p, real(edge->from), real(edge->to))
                                        : distance_to_arc(p, *edge);
  }
  // Nearest of a dense walk, then a search around it.
  const auto& arc = std::get<EllipseArc>(shape);
  const auto away = [&](Real t) {
    return size(p - (real(arc.centre) + std::cos(t) * real(arc.u) + std::sin(t) * real(arc.v)));
  };
  Real best_t = arc.begin, best = std::min(size(p - real(arc.from)), size(p - real(arc.to)));
  const Real begin = arc.begin, end = arc.end;
  for (int k = 0; k <= 256; ++k) {
    const Real t = begin + (end - begin) * k / 256;
    if (away(t) < away(best_t)) best_t = t;
  }
  Real low = std::max(begin, best_t - (end - begin) / 256),
       high = std::min(end, best_t + (end - begin) / 256);
  for (int k = 0; k < 100; ++k) {
    const Real a = low + (high - low) / 3, b = high - (high - low) / 3;
    (away(a) < away(b) ? high : low) = away(a) < away(b) ? b : a;
  }
  return std::min(best, away((low + high) / 2));
}

Point somewhere(Random& random, double reach) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

double reach_of(Random& random) { return std::pow(10.0, random.uniform(-2, 6)); }

/// What 64 bits of mantissa leave unknown at these sizes.
Real blur(Real reach) { return reach * 0x1p-60L; }

/// A point of the exact arc with this bulge at a share of its sweep.
RealPoint on_bulge(RealPoint a, RealPoint b, Real bulge, Real share) {
  // The arc as the image of a circle's: w(t) = sin(t s / 2) / sin(s / 2) e^{-i (s - t s) / 2}, s the sweep.
  const Real sweep = 4 * std::atan(bulge), half = sweep / 2;
  if (half == 0) return a + share * (b - a);
  // sin(s / 2) = 2 bulge / (1 + bulge^2), without the digits that s / 2 loses next to a half turn.
  const Real length = std::sin(share * half) * (1 + bulge * bulge) / (2 * bulge), angle = -(1 - share) * half;
  const RealPoint w{length * std::cos(angle), length * std::sin(angle)}, d = b - a;
  return a + RealPoint{w.x * d.x - w.y * d.y, w.x * d.y + w.y * d.x};
}

TEST(IoDrawnShapes, AnArcOfABulgeIsWithinItsError) {
  const std::uint64_t seed = cases::seed();
  std::size_t arcs = 0;
  for (std::size_t c = 0; c < cases::case_count(5'000); ++c) {
    Random random(seed, c);
    const double reach = reach_of(random);
    const Point a = somewhere(random, reach),
                b = a + somewhere(random, reach * std::pow(10.0, random.uniform(-6, 0)));
    const double magnitude = std::pow(10.0, random.uniform(-12, 3));
    const double bulge = random.below(8) == 0   ? (random.below(2) == 0 ? 1 : -1)
                         : random.below(2) == 0 ? magnitude
                                                : -magnitude;
    const double error = random.below(2) == 0 ? 0 : reach * 1e-15;
    SCOPED_TRACE(fmt::format("seed {} case {} bulge {}", seed, c, bulge));
    const auto shape =
        bulge_arc({a, error}, {b, error}, bulge, random.below(2) == 0 ? 0 : std::abs(bulge) * 1e-16);
    if (!shape) continue;
    const Edge& edge = std::get<Edge>(shape->shape);
    EXPECT_EQ(edge.from, a);
    EXPECT_EQ(edge.to, b);
    arcs += edge.kind != EdgeKind::line ? 1 : 0;
    // Ends off by as much as they may be.
    const auto off = [&] {
      return RealPoint{random.below(2) == 0 ? error : -error, random.below(2) == 0 ? error : -error};
    };
    const RealPoint from = real(a) + off(), to = real(b) + off();
    const Real radius = size(to - from) * (1 + Real{bulge} * bulge) / (4 * std::abs(Real{bulge}));
    for (int k = 0; k <= 16; ++k) {
      const RealPoint p = on_bulge(from, to, bulge, Real(k) / 16);
      EXPECT_LE(distance_to_shape(p, shape->shape),
                shape->error + blur(reach + (edge.kind == EdgeKind::line ? 0 : radius)));
    }
  }
  EXPECT_GT(arcs, cases::case_count(5'000) / 4);
}

Affine random_map(Random& random, double reach) {
  const Direction d = direction_of_degrees(random.below(4) == 0 ? 90.0 * static_cast<double>(random.below(4))
                                                                : random.uniform(-720, 720));
  Affine turn{d.unit.x, -d.unit.y, d.unit.y, d.unit.x, somewhere(random, reach), d.exact ? 0 : kDegreesError,
              0};
  Affine scale;
  scale.xx = random.below(2) == 0 ? 1 : random.uniform(0.1, 10);
  const bool even = random.below(2) == 0;
  scale.yy = even ? scale.xx : random.uniform(0.1, 10);
  if (random.below(3) == 0) scale.xx = -scale.xx;
  scale.shift = somewhere(random, reach);
  return composed(turn, scale);
}

RealPoint mapped(const Affine& map, RealPoint p) {
  return {map.xx * p.x + map.xy * p.y + map.shift.x, map.yx * p.x + map.yy * p.y + map.shift.y};
}

TEST(IoDrawnShapes, ImagesOfCirclesArcsAndEllipsesAreWithinTheirErrors) {
  const std::uint64_t seed = cases::seed();
  std::size_t ellipses = 0, circles = 0;
  for (std::size_t c = 0; c < cases::case_count(400); ++c) {
    Random random(seed, c + 1'000'000);
    SCOPED_TRACE(fmt::format("seed {} case {}", seed, c));
    const double reach = std::pow(10.0, random.uniform(-1, 4));
    const Point centre = somewhere(random, reach);
    const double radius = reach * std::pow(10.0, random.uniform(-3, 0));
    const double begin = random.uniform(-180, 180),
                 sweep = random.below(4) == 0 ? 360 : random.uniform(0.01, 359.9);
    const Point u{radius, 0}, v{0, random.below(2) == 0 ? radius : -radius * random.uniform(0.1, 2)};
    EllipseArc arc{{}, {}, centre, u, v, begin * kPi / 180, 0};
    arc.end = sweep == 360 ? arc.begin + 2 * kPi : arc.begin + sweep * kPi / 180;
    arc.from = point_at(arc, arc.begin);
    arc.to = sweep == 360 ? arc.from : point_at(arc, arc.end);
    const BoundedShape drawn = conic(arc, 0);
    const Affine map = random_map(random, reach);
    const auto seen = image(map, drawn);
    ASSERT_TRUE(seen.has_value());
    (std::holds_alternative<Edge>(seen->shape) ? circles : ellipses) += 1;
    const Real sizes = 40 * Real{reach};
    for (int k = 0; k <= 12; ++k) {
      const Real t = arc.begin + (Real{arc.end} - arc.begin) * k / 12;
      const RealPoint p = real(centre) + std::cos(t) * real(u) + std::sin(t) * real(v);
      EXPECT_LE(distance_to_shape(p, drawn.shape), drawn.error + blur(sizes));
      // The map as it is stands for exact ones that differ by its own errors; they are in the bound.
      EXPECT_LE(distance_to_shape(mapped(map, p), seen->shape), seen->error + blur(sizes));
    }
    EXPECT_LE(seen->error, 1e-11 * sizes) << "and not much more than rounding";
  }
  EXPECT_GT(ellipses, cases::case_count(400) / 8);
  EXPECT_GT(circles, cases::case_count(400) / 8);
}

TEST(IoDrawnShapes, PointsAndComposedMapsAreWithinTheirErrors) {
  const std::uint64_t seed = cases::seed();
  for (std::size_t c = 0; c < cases::case_count(5'000); ++c) {
    Random random(seed, c + 2'000'000);
    const double reach = reach_of(random);
    const Affine a = random_map(random, reach), b = random_map(random, reach), both = composed(a, b);
    const Point p = somewhere(random, reach);
    const BoundedPoint seen = image(both, {p, 0});
    const RealPoint exact = mapped(a, mapped(b, real(p)));
    const Real off = std::max(std::abs(exact.x - seen.at.x), std::abs(exact.y - seen.at.y));
    EXPECT_LE(off, seen.error + blur(1000 * Real{reach})) << "seed " << seed << " case " << c;
  }
}

TEST(IoDrawnShapes, DirectionsAreWithinTheirErrorAndQuartersAreExact) {
  const std::uint64_t seed = cases::seed();
  for (std::size_t c = 0; c < cases::case_count(5'000); ++c) {
    Random random(seed, c + 3'000'000);
    const double degrees = random.uniform(-1000, 1000);
    const Direction d = direction_of_degrees(degrees);
    const Real angle = std::fmod(Real{degrees}, 360.0L) * kHalfTurn / 180;
    EXPECT_LE(std::abs(std::cos(angle) - d.unit.x), kDegreesError);
    EXPECT_LE(std::abs(std::sin(angle) - d.unit.y), kDegreesError);
  }
  for (int k = -8; k <= 8; ++k) {
    const Direction d = direction_of_degrees(90.0 * k);
    EXPECT_TRUE(d.exact);
    EXPECT_EQ(std::abs(d.unit.x) + std::abs(d.unit.y), 1);
  }
}

}  // namespace
}  // namespace lekalo::io::io_drawn_shapes_test

// Distances of lines and arcs by formula against a walk along both curves.

#include "lekalo/geom/edge_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/region_index.hpp"
#include "support/cases.hpp"

namespace lekalo::geom::geom_edge_distance_test {
namespace {

constexpr double kTurn = 6.283185307179586;

Edge random_edge(Random& random) {
  const auto point = [&] { return Point{random.uniform(-10, 10), random.uniform(-10, 10)}; };
  if (random.below(3) == 0) return {EdgeKind::line, point(), point(), {}};
  const Point centre = point();
  const double radius = random.uniform(0.5, 9), first = random.uniform(0, kTurn),
               sweep = random.uniform(0.05, 6.2);
  const auto at = [&](double angle) {
    const auto [sine, cosine] = sincos(angle);
    return centre + radius * Point{cosine, sine};
  };
  if (random.below(8) == 0) return {EdgeKind::arc_cw, at(first), at(first), centre};
  const bool ccw = random.below(2) == 0;
  return {ccw ? EdgeKind::arc_ccw : EdgeKind::arc_cw, at(first), at(ccw ? first + sweep : first - sweep),
          centre};
}

/// Points of an edge at n + 1 equal parameters: nothing of the formulas.
std::vector<Point> walked(const Edge& edge, int n) {
  std::vector<Point> points;
  for (int i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n;
    if (edge.kind == EdgeKind::line) {
      points.push_back(edge.from + t * (edge.to - edge.from));
      continue;
    }
    const double from = std::atan2(edge.from.y - edge.centre.y, edge.from.x - edge.centre.x);
    double sweep = std::atan2(edge.to.y - edge.centre.y, edge.to.x - edge.centre.x) - from;
    if (edge.kind == EdgeKind::arc_ccw && sweep <= 0) sweep += kTurn;
    if (edge.kind == EdgeKind::arc_cw && sweep >= 0) sweep -= kTurn;
    const double angle = from + t * sweep;
    points.push_back(edge.centre + norm(edge.from - edge.centre) * Point{std::cos(angle), std::sin(angle)});
  }
  return points;
}

TEST(EdgeDistance, NoWalkFindsLessAndTheClosestPointsLieOnTheEdges) {
  const std::size_t count = std::min<std::size_t>(cases::case_count(400), 4000);
  constexpr int kSteps = 120;
  Random random(cases::seed(), 60);
  int crossing = 0;
  for (std::size_t k = 0; k < count; ++k) {
    SCOPED_TRACE(k);
    const Edge a = random_edge(random), b = random_edge(random);
    const Curve ca = make_curve(a), cb = make_curve(b);
    const ClosestPoints close = closest_points(ca, cb), back = closest_points(cb, ca);
    EXPECT_NEAR(close.distance, back.distance, 1e-12);
    EXPECT_NEAR(norm(close.b - close.a), close.distance, 1e-12);
    EXPECT_NEAR(norm(nearest_on(ca, close.a) - close.a), 0, 1e-12);
    EXPECT_NEAR(norm(nearest_on(cb, close.b) - close.b), 0, 1e-12);
    double least = 1e300, step = 0;
    const auto pa = walked(a, kSteps), pb = walked(b, kSteps);
    for (const Point& p : pa)
      for (const Point& q : pb) least = std::min(least, norm(q - p));
    for (int i = 0; i < kSteps; ++i)
      step = std::max({step, norm(pa[i + 1] - pa[i]), norm(pb[i + 1] - pb[i])});
    EXPECT_LE(close.distance, least + 1e-12);
    EXPECT_GE(close.distance, least - step);
    if (close.distance == 0) ++crossing;
    const Box box = curve_box(ca);
    for (const Point& p : pa) {
      EXPECT_TRUE(p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y);
      EXPECT_LE(norm(nearest_on(cb, p) - p), norm(pb[0] - p) + 1e-12);
    }
  }
  if (count >= 1000) {  // fewer may have none
    EXPECT_GT(crossing, static_cast<int>(count / 20));
  }
}

/// The number of times the outline, walked in small steps, winds around p.
double winding(const Contour& contour, Point p) {
  double angle = 0;
  for (const Edge& edge : contour) {
    const auto points = walked(edge, 200);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Point u = points[i] - p, v = points[i + 1] - p;
      angle += std::atan2(cross(u, v), dot(u, v));
    }
  }
  return angle / kTurn;
}

TEST(RegionIndexDifferential, PointsAreInsideWhereTheOutlineWindsAround) {
  // A keyhole: a wide arc, lines through heights of its ends and centre, and a round hole.
  const Contour outer{{EdgeKind::arc_ccw, {3, -4}, {-3, -4}, {0, 0}},
                      {EdgeKind::line, {-3, -4}, {-3, -12}, {}},
                      {EdgeKind::arc_ccw, {-3, -12}, {3, -12}, {0, -12}},
                      {EdgeKind::line, {3, -12}, {3, -4}, {}}};
  const Contour hole{{EdgeKind::arc_ccw, {2, 0}, {2, 0}, {0, 0}}};
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (const bool mirror : {false, true}) {
      const auto place = [&](Point p) {
        if (mirror) p.x = -p.x;
        for (int k = 0; k < quarter; ++k) p = perpendicular(p);
        return p;
      };
      const auto moved = [&](const Contour& contour) {
        Contour out;
        for (const Edge& e : contour) {
          EdgeKind kind = e.kind;
          if (mirror && kind != EdgeKind::line)
            kind = kind == EdgeKind::arc_ccw ? EdgeKind::arc_cw : EdgeKind::arc_ccw;
          out.push_back({kind, place(e.from), place(e.to), place(e.centre)});
        }
        return out;
      };
      const auto region = make_region(moved(outer), {moved(hole)});
      ASSERT_TRUE(region.has_value()) << region.error().message;
      const RegionIndex index({*region});
      for (int i = -22; i <= 22; ++i) {
        for (int j = -34; j <= 14; ++j) {
          const Point p = place({i * 0.5, j * 0.5});
          const auto nearest = index.nearest(p);
          if (nearest.distance < 0.02) continue;
          const bool inside =
              std::abs(winding(region->outer, p)) > 0.5 && std::abs(winding(region->holes[0], p)) < 0.5;
          EXPECT_EQ(index.contains(p), inside) << quarter << mirror << ' ' << i << ' ' << j;
          double least = 1e300;
          for (const Curve& curve : index.curves()) least = std::min(least, norm(nearest_on(curve, p) - p));
          EXPECT_EQ(nearest.distance, least);
          EXPECT_EQ(index.nearest(p, 3).distance, least);
        }
      }
    }
  }
}

/// A piece of a cake about the origin, its arc's ends `off` nearer and further than 10.
Contour piece_of_cake(double first, double last, double off) {
  const auto at = [](double angle, double radius) {
    const auto [sine, cosine] = sincos(angle);
    return radius * Point{cosine, sine};
  };
  const Point from = at(first, 10 + off), to = at(last, 10 - off);
  return {{EdgeKind::line, {0, 0}, from, {}},
          {EdgeKind::arc_ccw, from, to, {0, 0}},
          {EdgeKind::line, to, {0, 0}, {}}};
}

TEST(RegionIndexDifferential, AnArcThatMissesItsEndsReachesNoFurther) {
  // Where an arc is level at its end, the circle is at the end's height 0.09 mm beside it.
  const auto tip = make_region({{EdgeKind::line, {3, -1}, {1e-9, 10}, {}},
                                {EdgeKind::arc_ccw, {1e-9, 10}, {-10.0009, 0}, {0, 0}},
                                {EdgeKind::line, {-10.0009, 0}, {3, -1}, {}}});
  ASSERT_TRUE(tip.has_value()) << tip.error().message;
  EXPECT_FALSE(RegionIndex({*tip}).contains({0.05, 10.0002}));
  EXPECT_TRUE(RegionIndex({*tip}).contains({-0.05, 9.9998}));

  const std::size_t count = cases::case_count(300);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed(), 60 + i);
    // Ends hardly beside the axes; radii that differ by as much as they may, and by next to nothing.
    const auto nearly = [&] {
      return kTurn / 4 * static_cast<double>(random.below(4)) +
             random.uniform(-1, 1) * std::pow(10.0, -random.uniform(1, 16));
    };
    const double off = random.uniform(-1, 1) * 4.9e-4 * std::pow(10.0, -random.uniform(0, 9));
    const double first = nearly(), turn = nearly() - first, whole = turn - kTurn * std::floor(turn / kTurn);
    if (!(whole > 0.01 && whole < kTurn - 0.01)) continue;
    const auto region = make_region(piece_of_cake(first, first + whole, off));
    ASSERT_TRUE(region.has_value()) << region.error().message;
    const RegionIndex index({*region});
    for (int k = 0; k < 60; ++k) {
      const Point end = region->outer[1 + random.below(2)].from;
      const double step = std::pow(10.0, -random.uniform(0, 12));
      const Point p = end + step * Point{random.uniform(-1, 1),
                                         random.uniform(-1, 1) * std::pow(10.0, -random.uniform(0, 6))};
      if (!(index.nearest(p).distance > std::abs(off) + 1e-12)) continue;
      const double angle = std::atan2(p.y, p.x) - first, beyond = angle - kTurn * std::floor(angle / kTurn);
      const bool inside = beyond < whole && norm(p) < 10;
      ASSERT_EQ(index.contains(p), inside)
          << "case " << i << " seed " << cases::seed() << " from " << first << " by " << whole << " off "
          << off << " at " << p.x << ", " << p.y;
    }
  }
}

}  // namespace
}  // namespace lekalo::geom::geom_edge_distance_test

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/drawing/near_edges.hpp"
#include "lekalo/base/random.hpp"
#include "lekalo/geom/region.hpp"
#include "support/cases.hpp"

// How far an edge is from others, against many points of it.

namespace lekalo::io::io_near_edges_test {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

Point around(Point centre, double radius, double angle) {
  return centre + radius * Point{std::cos(angle), std::sin(angle)};
}

/// An arc about a centre, or a line where the radius is 0.
struct Drawn {
  Edge edge;
  Point centre;
  double radius = 0, from = 0, sweep = 0;

  [[nodiscard]] Point at(double share) const {
    if (!(radius > 0)) return edge.from + share * (edge.to - edge.from);
    return around(centre, radius, from + share * sweep);
  }
};

Drawn random_edge(Random& random, Point near) {
  const auto spread = [&](double most) { return most * (2 * random.uniform() - 1); };
  if (random.below(3) == 0) {
    const Point from = near + Point{spread(1), spread(1)}, step{spread(3), spread(3)};
    return {{EdgeKind::line, from, from + step, {}}, {}, 0, 0, 0};
  }
  Drawn arc;
  arc.centre = near + Point{spread(0.5), spread(0.5)};
  arc.radius = 1 + random.uniform();
  arc.from = spread(3);
  arc.sweep = spread(random.below(2) == 0 ? 0.9 : 6);
  if (std::abs(arc.sweep) < 0.01) arc.sweep = 0.01;
  arc.edge = {arc.sweep > 0 ? EdgeKind::arc_ccw : EdgeKind::arc_cw, arc.at(0), arc.at(1), arc.centre};
  return arc;
}

TEST(NearEdges, NoPointOfAnEdgeIsFartherFromACurveThanIsSaidAndOneIsAsFar) {
  std::size_t told = 0;
  const std::size_t count = cases::case_count(3000);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed(), i);
    const Drawn part = random_edge(random, {0, 0});
    const Drawn other = random_edge(random, {0, 0});
    const geom::Curve curve = geom::make_curve(other.edge);
    const auto along = farthest_along(part.edge, curve);
    if (!along) continue;
    ++told;
    double most = 0;
    for (int k = 0; k <= 400; ++k) {
      const Point p = part.at(k / 400.0);
      most = std::max(most, norm(nearest_on(curve, p) - p));
    }
    EXPECT_LE(most, *along + 1e-9) << "case " << i;
    EXPECT_GE(most, *along - 1e-3) << "case " << i;
  }
  EXPECT_GT(told, count / 20);
}

TEST(NearEdges, AnEdgeBesideSeveralIsAsFarAsItsFarthestPoint) {
  for (std::size_t i = 0; i < cases::case_count(300); ++i) {
    Random random(cases::seed(), 100'000 + i);
    // A polyline of chords of an arc, and the arc itself a little off.
    Drawn arc = random_edge(random, {0, 0});
    if (!(arc.radius > 0)) continue;
    const double off = 0.01 * random.uniform();
    std::vector<Edge> chords;
    const std::size_t pieces = 1 + random.below(40);
    for (std::size_t k = 0; k < pieces; ++k) {
      const auto at = [&](std::size_t n) {
        return around(arc.centre, arc.radius + off,
                      arc.from + arc.sweep * static_cast<double>(n) / static_cast<double>(pieces));
      };
      chords.push_back({EdgeKind::line, at(k), at(k + 1), {}});
    }
    const double limit = 0.2;
    std::size_t work = kMostWork;
    const auto far = NearEdges(chords).farthest(arc.edge, limit, work);
    double most = 0;
    for (int k = 0; k <= 2000; ++k) {
      const Point p = arc.at(k / 2000.0);
      double least = INFINITY;
      for (const Edge& chord : chords)
        least = std::min(least, norm(nearest_on(geom::make_curve(chord), p) - p));
      most = std::max(most, least);
    }
    if (!far) {
      EXPECT_GT(most, limit * 0.99) << "case " << i;
      continue;
    }
    EXPECT_GE(*far, most - 1e-9) << "case " << i;
    EXPECT_LE(*far, most + limit / 512) << "case " << i;
  }
}

}  // namespace
}  // namespace lekalo::io::io_near_edges_test

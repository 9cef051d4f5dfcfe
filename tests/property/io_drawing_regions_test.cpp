#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/region_check.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "support/cases.hpp"
#include "support/drawn.hpp"
#include "support/drawn_region_cases.hpp"

namespace lekalo::io::io_drawing_regions_test {
namespace {

using cases::canonical;
using cases::case_count;
using cases::edges_of;
using cases::random_regions;
using cases::seed;
using cases::shifted;
using geom::Contour;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;
using geom::reversed;

TEST(DrawingRegionsLaws, LooseShuffledReversedCurvesComeBackAsTheSameRegions) {
  for (std::uint64_t index = 0; index < case_count(60); ++index) {
    Random random(seed(), 7000 + index);
    const auto regions = random_regions(random, index);
    auto edges = edges_of(regions);
    for (Edge& edge : edges)
      if (random.below(2) == 0) edge = reversed(edge);
    cases::shuffle(edges, random);
    cases::Sketch sketch;
    sketch.edges(edges);
    const auto found = make_regions(sketch.drawing());
    ASSERT_TRUE(found.has_value()) << found.error().message << " seed " << seed() << " case " << index;
    EXPECT_EQ(canonical(found->regions), canonical(regions)) << "seed " << seed() << " case " << index;
    EXPECT_EQ(found->tolerance, 0);
    const auto numbered = edges_of(found->regions);
    for (std::size_t i = 0; i < numbered.size(); ++i) {
      const Edge& drawn = edges[found->curve_of_edge[i]];
      EXPECT_TRUE(numbered[i] == drawn || numbered[i] == reversed(drawn));
    }
    const auto again = make_regions(sketch.drawing());
    EXPECT_EQ(again->regions, found->regions);
  }
}

/// The shortest edge, or the least distance of two edges that are no neighbours, or of an edge from the far
/// end of a neighbour: in a contour of three edges there are neighbours only, and a corner may lie on an arc.
double tightest(const std::vector<Region>& regions) {
  std::vector<geom::Curve> curves;
  double least = 1e300;
  for (const Edge& edge : edges_of(regions)) {
    curves.push_back(geom::make_curve(edge));
    if (edge.from != edge.to) least = std::min(least, norm(edge.to - edge.from));
  }
  const auto far_ends = [&](const geom::Curve& of, const geom::Curve& from) {
    for (const Point p : {of.edge.from, of.edge.to})
      if (p != from.edge.from && p != from.edge.to)
        least = std::min(least, norm(geom::nearest_on(from, p) - p));
  };
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (curves[i].edge.from != curves[j].edge.to && curves[j].edge.from != curves[i].edge.to) {
        least = std::min(least, closest_points(curves[i], curves[j]).distance);
      } else {
        far_ends(curves[i], curves[j]);
        far_ends(curves[j], curves[i]);
      }
    }
  return least;
}

TEST(DrawingRegionsLaws, OutlinesStayWithinTheirToleranceOfCurvesWithGaps) {
  std::size_t made = 0;
  for (std::uint64_t index = 0; index < case_count(40); ++index) {
    Random random(seed(), 8000 + index);
    const auto regions = random_regions(random, index);
    DrawingOptions options;
    options.join_tolerance = random.below(2) == 0 ? 0.01 : 1e-5;
    // Any two ends that belong together are nearer than the tolerance, and nearer than half of any others.
    const double off = options.join_tolerance / 3;
    if (tightest(regions) < 10 * options.join_tolerance) continue;
    std::vector<Edge> edges;
    for (const Edge& edge : edges_of(regions)) {
      const Edge moved = shifted(edge, {random.uniform(-off, off), random.uniform(-off, off)});
      edges.push_back(random.below(2) == 0 ? moved : reversed(moved));
    }
    ++made;
    cases::shuffle(edges, random);
    cases::Sketch sketch;
    sketch.edges(edges);
    const auto found = make_regions(sketch.drawing(), options);
    ASSERT_TRUE(found.has_value()) << found.error().message << " seed " << seed() << " case " << index;
    EXPECT_EQ(found->regions.size(), regions.size());
    EXPECT_LE(found->tolerance, 1.3 * options.join_tolerance);
    const double rounding = 1e-10;
    const geom::RegionIndex outlines(found->regions);
    for (const Edge& edge : edges)
      for (const Point p : cases::points_of(edge, 16))
        ASSERT_LE(outlines.nearest(p).distance, found->tolerance + rounding)
            << "seed " << seed() << " case " << index;
    for (const Edge& edge : edges_of(found->regions))
      for (const Point p : cases::points_of(edge, 8))
        ASSERT_LE(cases::distance_to_edges(p, edges), found->tolerance + rounding)
            << "seed " << seed() << " case " << index;
  }
  EXPECT_GT(made, case_count(40) / 2);
}

// ------------------------------------------------------------------------------------------------ splines

/// The spline's point by the basis functions (Cox and de Boor), nothing of which the library uses.
struct Reference {
  const Spline& spline;

  [[nodiscard]] long double basis(std::size_t i, std::size_t k, long double t, std::size_t span) const {
    if (k == 0) return i == span ? 1 : 0;
    const auto& u = spline.knots;
    long double sum = 0;
    if (u[i + k] > u[i])
      sum += (t - u[i]) / (static_cast<long double>(u[i + k]) - u[i]) * basis(i, k - 1, t, span);
    if (u[i + k + 1] > u[i + 1])
      sum += (u[i + k + 1] - t) / (static_cast<long double>(u[i + k + 1]) - u[i + 1]) *
             basis(i + 1, k - 1, t, span);
    return sum;
  }
  [[nodiscard]] Point at(long double t, std::size_t span) const {
    long double x = 0, y = 0, w = 0;
    for (std::size_t i = span - spline.degree; i <= span; ++i) {
      const long double b =
          basis(i, spline.degree, t, span) * (spline.weights.empty() ? 1 : spline.weights[i]);
      x += b * spline.poles[i].x, y += b * spline.poles[i].y, w += b;
    }
    return {static_cast<double>(x / w), static_cast<double>(y / w)};
  }
  [[nodiscard]] std::vector<Point> polyline(int per_span) const {
    std::vector<Point> points;
    for (std::size_t span = spline.degree; span < spline.poles.size(); ++span) {
      const long double a = spline.knots[span], b = spline.knots[span + 1];
      for (int i = 0; a < b && i <= per_span; ++i) points.push_back(at(a + (b - a) * i / per_span, span));
    }
    return points;
  }
};

/// Closed, star-shaped poles; clamped or periodic; sometimes rational, with double knots and of any degree.
Spline random_spline(Random& random) {
  Spline spline;
  spline.degree = random.below(4) == 0 ? 1 + random.below(8) : 3;
  const std::size_t n = spline.degree, count = 4 + random.below(9) + n;
  for (std::size_t i = 0; i < count; ++i) {
    const auto [sine, cosine] =
        geom::sincos(6.283185307179586 * static_cast<double>(i) / static_cast<double>(count));
    spline.poles.push_back(random.uniform(20, 40) * Point{cosine, sine});
    spline.weights.push_back(random.uniform(0.5, 3));
  }
  const bool periodic = random.below(3) == 0;
  if (periodic) {
    for (std::size_t i = 0; i < n; ++i) {
      spline.poles.push_back(spline.poles[i]);
      spline.weights.push_back(spline.weights[i]);
    }
    for (std::size_t i = 0; i < spline.poles.size() + n + 1; ++i)
      spline.knots.push_back(0.25 * static_cast<double>(i));
  } else {
    spline.poles.push_back(spline.poles.front());
    spline.weights.push_back(random.uniform(0.5, 3));
    double at = -1;
    bool doubled = true;  // no knot three times, none at the ends, and none of a polyline
    for (std::size_t i = 0; i < spline.poles.size() + n + 1; ++i) {
      const bool inside = i > n && i < spline.poles.size();
      doubled = inside && n > 1 && !doubled && random.below(4) == 0;
      if (i == n) doubled = true;
      if ((inside && !doubled) || i == spline.poles.size()) at += random.uniform(0.1, 1);
      spline.knots.push_back(at);
    }
  }
  if (random.below(2) == 0) spline.weights.clear();
  return spline;
}

void expect_near(const std::vector<Point>& curve, const DrawnRegions& found, double step_error,
                 const std::string& name) {
  const geom::RegionIndex outlines(found.regions);
  for (const Point p : curve) ASSERT_LE(outlines.nearest(p).distance, found.tolerance + 1e-10) << name;
  std::vector<Edge> chords;
  for (std::size_t i = 0; i + 1 < curve.size(); ++i)
    if (curve[i] != curve[i + 1]) chords.push_back({EdgeKind::line, curve[i], curve[i + 1], {}});
  chords.push_back({EdgeKind::line, curve.back(), curve.front() + Point{1e-9, 0}, {}});
  chords.push_back({EdgeKind::line, chords.back().to, curve.front(), {}});
  const geom::RegionIndex index({{chords, {}}});
  for (const Edge& edge : edges_of(found.regions))
    for (const Point p : cases::points_of(edge, 8))
      ASSERT_LE(index.nearest(p).distance, found.tolerance + step_error) << name;
}

TEST(DrawingRegionsLaws, SplinesAreReplacedWithinTheProvenTolerance) {
  std::size_t made = 0;
  for (std::uint64_t index = 0; index < std::min<std::size_t>(case_count(60), 2000); ++index) {
    Random random(seed(), 9000 + index);
    const Spline spline = random_spline(random);
    const double tolerances[] = {1, 0.1, 0.01, 0.001};
    DrawingOptions options;
    options.curve_tolerance = tolerances[random.below(4)];
    cases::Sketch sketch;
    sketch.add(spline, "SPLINE");
    const auto found = make_regions(sketch.drawing(), options);
    const std::string name = "seed " + std::to_string(seed()) + " case " + std::to_string(index);
    // Star-shaped poles do not prevent loops of high weights.
    if (!found) {
      EXPECT_NE(found.error().message.find("crosses or touches itself"), std::string::npos)
          << found.error().message << name;
      continue;
    }
    ++made;
    EXPECT_LE(found->curve_tolerance, options.curve_tolerance);
    const auto curve = Reference{spline}.polyline(400);
    double longest = 0, sharpest = 0;
    for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
      longest = std::max(longest, norm(curve[i + 1] - curve[i]));
      if (norm(curve[i] - curve[i - 1]) > 0 && norm(curve[i + 1] - curve[i]) > 0)
        sharpest = std::max(sharpest, norm(curve[i + 1] - 2 * curve[i] + curve[i - 1]));
    }
    expect_near(curve, *found, sharpest + 1e-9, name);
  }
  EXPECT_GT(made, std::min<std::size_t>(case_count(60), 2000) / 2);
}

TEST(DrawingRegionsLaws, EllipsesAreReplacedWithinTheProvenTolerance) {
  for (std::uint64_t index = 0; index < case_count(40); ++index) {
    Random random(seed(), 9500 + index);
    EllipseArc arc;
    arc.centre = {random.uniform(-50, 50), random.uniform(-50, 50)};
    const auto [sine, cosine] = geom::sincos(random.uniform(0, 6));
    arc.u = random.uniform(1, 60) * Point{cosine, sine};
    // Conjugate half diameters of any kind, either way round.
    arc.v = {random.uniform(-30, 30), random.uniform(-30, 30)};
    // One as thin as the tolerance has no area.
    if (!(std::abs(cross(arc.u, arc.v)) > 2 * (norm(arc.u) + norm(arc.v)))) continue;
    const bool whole = random.below(2) == 0;
    arc.begin = random.uniform(-4, 4);
    arc.end = arc.begin + (whole ? 6.283185307179586 : random.uniform(0.5, 5.5));
    const auto at = [&](double t) {
      const geom::SinCos a = geom::sincos(t);
      return arc.centre + a.cosine * arc.u + a.sine * arc.v;
    };
    arc.from = at(arc.begin);
    arc.to = whole ? arc.from : at(arc.end);
    const double tolerances[] = {0.1, 0.01, 0.001};
    DrawingOptions options;
    options.curve_tolerance = tolerances[index % 3];
    cases::Sketch sketch;
    sketch.add(arc, "ELLIPSE");
    if (!whole) sketch.line(arc.to, arc.from);
    const auto found = make_regions(sketch.drawing(), options);
    const std::string name = "seed " + std::to_string(seed()) + " case " + std::to_string(index);
    ASSERT_TRUE(found.has_value()) << found.error().message << name;
    EXPECT_LE(found->curve_tolerance, options.curve_tolerance);
    std::vector<Point> curve;
    for (int i = 0; i <= 4000; ++i) curve.push_back(at(arc.begin + (arc.end - arc.begin) * i / 4000));
    const double step = (arc.end - arc.begin) / 4000;
    if (!whole)
      for (int i = 0; i <= 100; ++i) curve.push_back(arc.to + (0.01 * i) * (arc.from - arc.to));
    expect_near(curve, *found, step * step * (norm(arc.u) + norm(arc.v)) + 1e-9, name);
  }
}

TEST(DrawingRegionsLaws, AnEllipseTakesFewArcs) {
  cases::Sketch sketch;
  sketch.add(EllipseArc{{50, 0}, {50, 0}, {0, 0}, {50, 0}, {0, 25}, 0, 6.283185307179586}, "ELLIPSE");
  const auto found = make_regions(sketch.drawing());
  ASSERT_TRUE(found.has_value());
  EXPECT_LE(found->regions[0].outer.size(), 64u);
  // All of them arcs, and the tolerance nearly used.
  for (const Edge& edge : found->regions[0].outer) EXPECT_NE(edge.kind, EdgeKind::line);
  EXPECT_GT(found->curve_tolerance, 0.0003);
}

}  // namespace
}  // namespace lekalo::io::io_drawing_regions_test

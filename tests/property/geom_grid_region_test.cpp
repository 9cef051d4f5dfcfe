// The laws of geom/grid_region.hpp.

#include "lekalo/geom/grid_region.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/cases.hpp"
#include "support/exact_geometry.hpp"
#include "support/grid_cases.hpp"
#include "support/grid_oracle.hpp"

namespace lekalo::geom::geom_grid_region_test {
namespace {

constexpr std::int64_t mm = kGridPerMm;
using Loop = std::vector<GridPoint>;

Loop box(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

void refused(std::vector<Loop> loops, const std::string& words) {
  const auto made = make_grid_region(std::move(loops));
  ASSERT_FALSE(made.has_value()) << words;
  EXPECT_EQ(made.error().code, ErrorCode::bad_input);
  EXPECT_NE(made.error().message.find(words), std::string::npos) << made.error().message;
}

TEST(GridRegion, RefusesWhatIsNoOutline) {
  refused({}, "no points");
  refused({{}}, "outline: it has 0 different points");
  refused({{{0, 0}, {mm, 0}}}, "outline: it has 2 different points");
  refused({{{0, 0}, {1, 1}, {2, 0}, {mm, 0}, {mm, 2}}}, "outline: it has 2 different points");
  refused({{{0, 0}, {mm, 0}, {2 * mm, 0}}}, "area is 0");
  refused({{{0, 0}, {mm, mm}, {mm, 0}, {0, mm}}}, "area is 0");
  refused({{{0, 0}, {4 * mm, mm}, {4 * mm, 0}, {0, 3 * mm}}}, "may not meet itself");
  refused({{{0, 0}, {4 * mm, 0}, {4 * mm, mm}, {2 * mm, 0}, {0, mm}}}, "may not meet itself");  // touches
  refused({{{0, 0}, {4 * mm, 0}, {4 * mm, mm}, {2 * mm, 2}, {0, mm}}}, "nearer than 3e-06");    // nearly
  EXPECT_TRUE(make_grid_region({{{0, 0}, {4 * mm, 0}, {4 * mm, mm}, {2 * mm, 3}, {0, mm}}}));   // just not
  refused({{{0, 0}, {4 * mm, 0}, {2 * mm, 0}, {2 * mm, mm}}}, "may not meet itself");           // folded back
  refused({{{0, 0}, {mm, 0}, {mm, mm}, {0, 0}, {-mm, mm}, {-mm, 0}}}, "may not meet itself");  // at one point
  refused({box(0, 0, 10, 10), box(2, 2, 10, 5)}, "hole 0");
  refused({box(0, 0, mm, mm), box(2 * mm, 0, 3 * mm, mm)}, "hole 0: it lies outside");
  refused({box(0, 0, 9 * mm, 9 * mm), box(mm, mm, 8 * mm, 8 * mm), box(2 * mm, 2 * mm, 3 * mm, 3 * mm)},
          "hole 1: it lies inside hole 0");
  refused({box(0, 0, 9 * mm, 9 * mm), box(2 * mm, 2 * mm, 3 * mm, 3 * mm), box(mm, mm, 8 * mm, 8 * mm)},
          "hole 0: it lies inside hole 1");
  refused({box(0, 0, kGridLimit / 4 + 1, mm)}, "further from the origin");
  EXPECT_TRUE(make_grid_region({box(-kGridLimit / 4, 0, kGridLimit / 4, mm)}));
}

TEST(GridRegion, TurnsLoopsIntoTheirDirectionAndThinsThem) {
  Loop clockwise = box(0, 0, 10 * mm, 10 * mm);
  std::reverse(clockwise.begin() + 1, clockwise.end());
  const auto made = make_grid_region({clockwise, box(mm, mm, 2 * mm, 3 * mm)});
  ASSERT_TRUE(made);
  EXPECT_EQ(made->points[0], (GridPoint{0, 0}));
  EXPECT_EQ(made->points[1], (GridPoint{10 * mm, 0}));
  EXPECT_EQ(made->points[4], (GridPoint{mm, mm}));
  EXPECT_EQ(area_mm2(*made), 98);
  EXPECT_EQ(sign(twice_area(*made) - Int128{196} * mm * mm), 0);
  const auto thinned = make_grid_region({{{0, 0}, {1, 1}, {2, 2}, {mm, 0}, {mm + 2, 0}, {0, mm}, {-2, 1}}});
  ASSERT_TRUE(thinned);
  EXPECT_EQ(thinned->points, (Loop{{0, 0}, {mm, 0}, {0, mm}}));
  EXPECT_EQ(bounds(*thinned), (GridBox{{0, 0}, {mm, mm}}));
  EXPECT_EQ(bounds(GridRegion{}), GridBox{});
}

TEST(GridRegion, ATurnedOutlineIsSimpleAndAsLarge) {
  for (std::size_t i = 0; i < cases::case_count(1500); ++i) {
    Random random(cases::seed(), 1 + i);
    const GridRegion region = cases::any_outline(random);
    const GridRotation rotation = cases::any_rotation(random);
    const bool mirrored = random.below(2) == 0;
    const GridRegion there = turned(region, rotation, mirrored);
    ASSERT_NO_THROW(oracle::Cut{there}) << i;  // proves triangles that fill it
    ASSERT_GT(twice_area(there), 0);
    ASSERT_NEAR(area_mm2(there) / area_mm2(region), 1, 1e-3) << i;
    if (rotation.s == 0 || rotation.c == 0) {
      ASSERT_EQ(area_mm2(there), area_mm2(region));
    }
  }
}

TEST(GridRegion, APointIsWhereTheDefinitionSays) {
  std::size_t counts[3] = {};
  for (std::size_t i = 0; i < cases::case_count(1500); ++i) {
    Random random(cases::seed() + 1, 1 + i);
    const GridRegion region = cases::any_outline(random);
    const GridBox all = bounds(region);
    for (int k = 0; k < 8; ++k) {
      GridPoint p = cases::point_on(random, cases::any_edge(random, region));
      if (k < 2) p = {p.x, cases::any_edge(random, region).from.y};
      if (k == 2) p = cases::any_edge(random, region).from;
      if (k == 3)
        p = {cases::between(random, all.low.x, all.high.x), cases::between(random, all.low.y, all.high.y)};
      if (k > 5) p = p + GridPoint{cases::between(random, -2, 2), cases::between(random, -2, 2)};
      PointLocation expected = PointLocation::outside;
      for (std::size_t l = 0; l < region.loops(); ++l) {
        Ring ring;
        for (std::size_t v = region.loop_starts[l]; v < region.loop_starts[l + 1]; ++v)
          ring.push_back({static_cast<double>(region.points[v].x), static_cast<double>(region.points[v].y)});
        const PointLocation in =
            exact::locate_point(ring, {static_cast<double>(p.x), static_cast<double>(p.y)});
        if (in == PointLocation::outside) continue;
        expected = in == PointLocation::boundary ? in
                   : l == 0                      ? PointLocation::inside
                                                 : PointLocation::outside;
        if (in == PointLocation::boundary) break;
      }
      ASSERT_EQ(locate_point(region, p), expected) << i << " " << k;
      ++counts[static_cast<int>(expected)];
    }
  }
  for (const std::size_t count : counts) EXPECT_GT(count, cases::case_count(1500));
}

struct LongPoint {
  long double x = 0, y = 0;
};

/// Distance from the outline's edges, positive inside, steps.
long double depth(const GridRegion& region, LongPoint p) {
  long double least = 1e30L;
  bool inside = false;
  for (std::size_t l = 0; l < region.loops(); ++l) {
    std::size_t j = region.loop_starts[l + 1] - 1;
    for (std::size_t i = region.loop_starts[l]; i < region.loop_starts[l + 1]; j = i++) {
      const LongPoint a{static_cast<long double>(region.points[j].x),
                        static_cast<long double>(region.points[j].y)};
      const LongPoint d{static_cast<long double>(region.points[i].x) - a.x,
                        static_cast<long double>(region.points[i].y) - a.y};
      const long double share =
          std::clamp(((p.x - a.x) * d.x + (p.y - a.y) * d.y) / (d.x * d.x + d.y * d.y), 0.0L, 1.0L);
      least = std::min(least, std::hypot(p.x - a.x - share * d.x, p.y - a.y - share * d.y));
      if ((a.y > p.y) != (a.y + d.y > p.y) && p.x < a.x + d.x * (p.y - a.y) / d.y) inside = !inside;
    }
  }
  return inside ? least : -least;
}

TEST(GridRegion, ChordsStayOnTheirSideOfArcsAndWithinTheTolerance) {
  std::size_t samples = 0;
  for (std::size_t i = 0; i < cases::case_count(60); ++i) {
    Random random(cases::seed() + 2, 1 + i);
    Region drawn = cases::curved_region(random, std::exp(random.uniform(-1, 6)));
    const Point by{random.uniform(-1000, 1000), random.uniform(-1000, 1000)};
    const auto move = [&](Contour& contour) {
      for (Edge& edge : contour)
        edge.from = edge.from + by, edge.to = edge.to + by, edge.centre = edge.centre + by;
    };
    move(drawn.outer);
    for (Contour& hole : drawn.holes) move(hole);
    const ChordSide side = random.below(2) == 0 ? ChordSide::grow : ChordSide::shrink;
    const double tolerance = std::exp(random.uniform(-9, 0));
    const auto made = grid_region_of_curves(drawn, side, tolerance);
    if (!made) continue;  // grown shut, or shrunk away
    const GridRotation rotation = cases::any_rotation(random);
    const GridRegion there = turned(*made, rotation, false);
    const long double c = static_cast<long double>(rotation.c) * 0x1p-52L,
                      s = static_cast<long double>(rotation.s) * 0x1p-52L;
    std::vector<const Contour*> contours{&drawn.outer};
    for (const Contour& hole : drawn.holes) contours.push_back(&hole);
    for (const Contour* contour : contours)
      for (const Edge& edge : *contour) {
        if (edge.kind == EdgeKind::line) continue;
        const long double from = std::atan2(static_cast<long double>(edge.from.y - edge.centre.y),
                                            static_cast<long double>(edge.from.x - edge.centre.x));
        const long double sweep =
            static_cast<long double>(arc_sweep(edge)) * (edge.kind == EdgeKind::arc_ccw ? 1 : -1);
        const long double radius = arc_radius(edge);
        for (int k = 1; k < 200; ++k) {
          const long double angle = from + sweep * (k + random.uniform(-0.4, 0.4)) / 200;
          const LongPoint at{(edge.centre.x + radius * std::cos(angle)) * 0x1p20L,
                             (edge.centre.y + radius * std::sin(angle)) * 0x1p20L};
          // Near the ends the curve runs into the rounded vertices.
          const long double to_ends =
              std::min(std::hypot(at.x - edge.from.x * 0x1p20L, at.y - edge.from.y * 0x1p20L),
                       std::hypot(at.x - edge.to.x * 0x1p20L, at.y - edge.to.y * 0x1p20L));
          const long double room = to_ends < 0.2L * radius * 0x1p20L ? -0.8L : 2.0L;
          const long double in = depth(*made, at) * (side == ChordSide::grow ? 1 : -1);
          ASSERT_GE(in, room) << "seed " << cases::seed() << " case " << i << " sample " << k;
          ASSERT_LE(in, tolerance * 0x1p20L) << i;
          const long double turned_in =
              depth(there, {c * at.x - s * at.y, s * at.x + c * at.y}) * (side == ChordSide::grow ? 1 : -1);
          ASSERT_GT(turned_in, room < 0 ? -1.6L : 0.0L) << i;
          ++samples;
        }
      }
  }
  EXPECT_GT(samples, cases::case_count(60) * 100);
}

TEST(GridRegion, CurvesThatCannotBeChordsAreRefused) {
  const Region disc{{{EdgeKind::arc_ccw, {1, 0}, {1, 0}, {0, 0}}}, {}};
  EXPECT_FALSE(grid_region_of_curves(disc, ChordSide::grow, 1e-5));
  EXPECT_FALSE(grid_region_of_curves(disc, ChordSide::grow, std::nan("")));
  EXPECT_TRUE(grid_region_of_curves(disc, ChordSide::grow, 0x1p-16));
  const Region far{{{EdgeKind::arc_ccw, {2e6, 0}, {2e6, 0}, {0, 0}}}, {}};
  EXPECT_FALSE(grid_region_of_curves(far, ChordSide::grow, 1));
  // The long way round a centre that is nowhere near: no more chords than can be counted.
  const Region vast{{{EdgeKind::arc_ccw, {0, 1}, {0, -1}, {1e100, 0}}, {EdgeKind::line, {0, -1}, {0, 1}, {}}},
                    {}};
  EXPECT_FALSE(grid_region_of_curves(vast, ChordSide::grow, 0.01));
}

TEST(GridRegion, PointsOfCurvesAreCountedBeforeTheyAreMade) {
  std::size_t regions = 0;
  for (std::uint64_t i = 0; i < cases::case_count(60); ++i) {
    Random random(cases::seed() + 3, 1 + i);
    const Region drawn = cases::curved_region(random, std::exp(random.uniform(1, 6)));
    const ChordSide side = random.below(2) == 0 ? ChordSide::grow : ChordSide::shrink;
    const double tolerance = std::exp(random.uniform(-9, 0));
    const auto made = grid_region_of_curves(drawn, side, tolerance);
    if (!made) continue;  // grown shut, or shrunk away
    ++regions;
    const std::size_t points = points_of_curves(drawn, side, tolerance);
    EXPECT_EQ(points, made->points.size()) << "seed " << cases::seed() << " case " << i;
    EXPECT_TRUE(grid_region_of_curves(drawn, side, tolerance, points));
    EXPECT_FALSE(grid_region_of_curves(drawn, side, tolerance, points - 1));
  }
  EXPECT_GT(regions, cases::case_count(60) / 2);
}

/// Circles that cross are refused for that once there are chords; none is made of too many.
TEST(GridRegion, CurvesOfTooManyPointsAreRefusedBeforeAnyIsMade) {
  const auto circle = [](double x) { return Contour{{EdgeKind::arc_cw, {x + 1, 0}, {x + 1, 0}, {x, 0}}}; };
  const Region crossing{{{EdgeKind::arc_ccw, {9, 0}, {9, 0}, {0, 0}}}, {circle(0), circle(1)}};
  const auto message = [&](std::size_t most) {
    const auto made = grid_region_of_curves(crossing, ChordSide::grow, 0.001, most);
    return made ? "made" : made.error().message;
  };
  EXPECT_NE(message(1000).find("an outline may not meet itself"), std::string::npos) << message(1000);
  EXPECT_NE(message(100).find("points with chords within 0.001 mm; at most 100 are taken"), std::string::npos)
      << message(100);
}

}  // namespace
}  // namespace lekalo::geom::geom_grid_region_test

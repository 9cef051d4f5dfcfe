// The laws of phi/separation.hpp.

#include "lekalo/phi/separation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "lekalo/phi/outline_relation.hpp"
#include "support/cases.hpp"
#include "support/grid_cases.hpp"
#include "support/grid_oracle.hpp"

namespace lekalo::phi_separation_test {
namespace {

using geom::GridPoint;
using geom::GridRegion;

constexpr std::int64_t mm = geom::kGridPerMm;

GridRegion rectangle(std::int64_t w, std::int64_t h) {
  return geom::make_grid_region({{{0, 0}, {w, 0}, {w, h}, {0, h}}}).value();
}

GridRegion convex_outline(Random& random) {
  const auto ring = cases::hull(cases::detail::ellipse_points(random, 3 + random.below(40),
                                                              random.uniform(20, 80), random.uniform(5, 80)));
  std::vector<GridPoint> loop;
  for (const geom::Point p : ring.vertices())
    loop.push_back({geom::grid_from_mm(p.x), geom::grid_from_mm(p.y)});
  return geom::make_grid_region({loop}).value();
}

/// Depth of two convex outlines: the least, over the edges' normals, that one reaches beyond the other.
double convex_depth(const GridRegion& a, const GridRegion& b, GridPoint shift) {
  long double least = std::numeric_limits<long double>::infinity();
  for (const GridRegion* of : {&a, &b})
    for (std::size_t i = 0; i < of->points.size(); ++i) {
      const GridPoint edge = of->points[(i + 1) % of->points.size()] - of->points[i];
      const long double length =
          std::hypot(static_cast<long double>(edge.x), static_cast<long double>(edge.y));
      const long double nx = static_cast<long double>(edge.y) / length,
                        ny = -static_cast<long double>(edge.x) / length;
      long double a_low = 1e30L, a_high = -1e30L, b_low = 1e30L, b_high = -1e30L;
      for (const GridPoint p : a.points) {
        const long double h = nx * static_cast<long double>(p.x) + ny * static_cast<long double>(p.y);
        a_low = std::min(a_low, h), a_high = std::max(a_high, h);
      }
      for (const GridPoint q : b.points) {
        const GridPoint p = q + shift;
        const long double h = nx * static_cast<long double>(p.x) + ny * static_cast<long double>(p.y);
        b_low = std::min(b_low, h), b_high = std::max(b_high, h);
      }
      least = std::min({least, a_high - b_low, b_high - a_low});
    }
  return static_cast<double>(least) * geom::kGridStep;
}

TEST(Separation, OfConvexOutlinesIsNearlyAlwaysTheDepthAndNeverLess) {
  const std::size_t count = std::min<std::size_t>(cases::case_count(2000), 200'000);
  std::size_t exact = 0, within_percent = 0, tried = 0;
  double worst = 1;
  for (std::size_t i = 0; tried < count; ++i) {
    Random random(cases::seed(), 1 + i);
    const GridRegion a = convex_outline(random), b = convex_outline(random);
    const GridPoint shift = cases::grid_direction(random, random.uniform(0, 140) * mm);
    if (!phi::interiors_meet(a, b, shift)) continue;
    ++tried;
    const double depth = convex_depth(a, b, shift);
    const phi::Separation found = phi::separate(a, b, shift);
    ASSERT_GE(found.distance_mm, depth - 1e-9) << i;
    ASSERT_FALSE(phi::interiors_meet(a, b, shift - found.shift)) << i;
    exact += found.distance_mm <= depth + 32 * geom::kGridStep ? 1 : 0;
    within_percent += found.distance_mm <= 1.01 * depth + 32 * geom::kGridStep ? 1 : 0;
    worst = std::max(worst, found.distance_mm / (depth + geom::kGridStep));
  }
  std::printf("%zu convex pairs: depth itself %zu, within 1 %% %zu, at worst %.4f times it\n", count, exact,
              within_percent, worst);
  EXPECT_GE(exact, count * 97 / 100);
  EXPECT_LT(worst, 1.1);
}

/// How far a place lies outside; 0 inside.
double beyond_mm(const GridRegion& region, geom::Point at) {
  const GridPoint nearest{geom::grid_from_mm(at.x), geom::grid_from_mm(at.y)};
  if (locate_point(region, nearest) != geom::PointLocation::outside) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t l = 0; l < region.loops(); ++l) {
    std::size_t before = region.loop_starts[l + 1] - 1;
    for (std::size_t i = region.loop_starts[l]; i < region.loop_starts[l + 1]; before = i++) {
      const geom::Point from = geom::mm_from_grid(region.points[before] - nearest);
      const geom::Point edge = geom::mm_from_grid(region.points[i] - region.points[before]);
      const double share = std::clamp(-dot(from, edge) / dot(edge, edge), 0.0, 1.0);
      least = std::min(least, norm(from + share * edge));
    }
  }
  return least;
}

TEST(Separation, FreesAnyOutlinesAsTheOracleSays) {
  const std::size_t count = std::min<std::size_t>(cases::case_count(500), 50'000);
  std::size_t tried = 0, freed_by_box = 0;
  for (std::size_t i = 0; tried < count; ++i) {
    Random random(cases::seed() + 5, 1 + i);
    const GridRegion a = cases::any_outline(random), b = cases::any_outline(random);
    const GridPoint shift = cases::touching_shift(random, a, b) + cases::small_offset(random, 1e8, a);
    if (!phi::interiors_meet(a, b, shift)) continue;
    ++tried;
    const phi::Separation found = phi::separate(a, b, shift);
    ASSERT_FALSE(oracle::Cut(a).interiors_meet(oracle::Cut(b), shift - found.shift)) << i;
    const geom::Point v = geom::mm_from_grid(found.shift);
    ASSERT_NEAR(geom::norm(v), found.distance_mm, 1e-9) << i;
    ASSERT_NEAR(geom::norm(found.direction), 1, 1e-12) << i;
    ASSERT_GT(dot(v, found.direction), 0) << i;
    const geom::GridBox p = bounds(a), q = bounds(b);
    const double box =
        geom::mm_from_grid(std::min({q.high.x + shift.x - p.low.x, p.high.x - q.low.x - shift.x,
                                     q.high.y + shift.y - p.low.y, p.high.y - q.low.y - shift.y}));
    ASSERT_LE(found.distance_mm, box + 1e-9) << i;
    freed_by_box += found.distance_mm > box - 1e-9 ? 1 : 0;
    // The place shown lies in both, or on the edge of a thin overlap.
    ASSERT_LT(beyond_mm(a, found.at), 2 * geom::kGridStep) << i;
    ASSERT_LT(beyond_mm(geom::moved(b, shift), found.at), 2 * geom::kGridStep) << i;
  }
  EXPECT_LT(freed_by_box, count / 2);
}

TEST(Separation, BringsPartsBackIntoARectangleByTheShortestWay) {
  const std::size_t count = std::min<std::size_t>(cases::case_count(300), 20'000);
  const GridRegion sheet = rectangle(1200 * mm, 900 * mm);
  std::size_t tried = 0;
  for (std::size_t i = 0; tried < count; ++i) {
    Random random(cases::seed() + 6, 1 + i);
    GridRegion a = cases::any_outline(random);
    const geom::GridBox raw = bounds(a);
    if (raw.high.x - raw.low.x > 600 * mm || raw.high.y - raw.low.y > 600 * mm) continue;
    a = geom::moved(a, {cases::between(random, -900, 1500) * mm, cases::between(random, -700, 1200) * mm});
    if (phi::lies_within(sheet, a)) continue;
    ++tried;
    const auto found = phi::bring_inside(sheet, a);
    ASSERT_TRUE(found.has_value()) << i;
    ASSERT_TRUE(phi::lies_within(sheet, a, found->shift)) << i;
    const geom::GridBox box = bounds(a);
    const auto axis = [](std::int64_t low, std::int64_t high, std::int64_t most) {
      return geom::mm_from_grid(low < 0 ? -low : std::max<std::int64_t>(0, high - most));
    };
    const double least =
        geom::norm({axis(box.low.x, box.high.x, 1200 * mm), axis(box.low.y, box.high.y, 900 * mm)});
    ASSERT_NEAR(found->distance_mm, least, 32 * geom::kGridStep) << i;
  }
}

TEST(Separation, BringsPartsBackIntoMaterialWithHoles) {
  const std::size_t count = std::min<std::size_t>(cases::case_count(300), 20'000);
  std::size_t tried = 0, back = 0;
  for (std::size_t i = 0; tried < count; ++i) {
    Random random(cases::seed() + 7, 1 + i);
    const auto stock = geom::make_grid_region(
        {cases::star(random, 900 * mm, 0.6, 12), {{0, 0}, {20 * mm, 0}, {20 * mm, 20 * mm}, {0, 20 * mm}}});
    GridRegion a =
        geom::turned(rectangle(cases::between(random, 20, 200) * mm, cases::between(random, 20, 200) * mm),
                     cases::any_rotation(random), false);
    a = geom::moved(a, cases::grid_direction(random, random.uniform(0, 900) * mm));
    if (!stock || phi::lies_within(*stock, a)) continue;
    ++tried;
    const auto found = phi::bring_inside(*stock, a);
    const phi::StickingOut out = phi::sticking_out(*stock, a);
    if (!found) continue;
    ++back;
    ASSERT_TRUE(oracle::Cut(*stock).holds(oracle::Cut(a), found->shift)) << i;
    ASSERT_GE(found->distance_mm, out.distance_mm * (1 - 1e-12)) << i;
  }
  EXPECT_GT(back, count * 9 / 10);
  EXPECT_FALSE(phi::bring_inside(rectangle(10 * mm, 10 * mm), rectangle(11 * mm, 2 * mm)).has_value());
}

}  // namespace
}  // namespace lekalo::phi_separation_test

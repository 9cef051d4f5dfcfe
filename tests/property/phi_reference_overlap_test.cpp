// The reference checks: right where they are right, and wrong where the source's method is known to be.

#include "support/reference_overlap.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "lekalo/phi/outline_relation.hpp"
#include "support/cases.hpp"
#include "support/grid_cases.hpp"

namespace lekalo::phi::phi_reference_overlap_test {
namespace {

using geom::GridPoint;
using geom::GridRegion;
using Loop = std::vector<GridPoint>;

constexpr std::int64_t mm = geom::kGridPerMm;

GridRegion made(Loop loop) { return geom::make_grid_region({std::move(loop)}).value(); }
Loop box(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) {
  return {{x0 * mm, y0 * mm}, {x1 * mm, y0 * mm}, {x1 * mm, y1 * mm}, {x0 * mm, y1 * mm}};
}

TEST(ReferenceOverlap, RaysAreRightAlsoThroughVerticesAndEdges) {
  std::size_t inside = 0;
  for (std::size_t i = 0; i < cases::case_count(2000); ++i) {
    Random random(cases::seed(), 1 + i);
    const GridRegion region = cases::loop_region(cases::any_outline(random), 0);
    for (int k = 0; k < 10; ++k) {
      const GridPoint p{
          cases::point_on(random, cases::any_edge(random, region)).x + cases::between(random, -2, 2),
          cases::any_edge(random, region).from.y};
      const bool holds = locate_point(region, p) == geom::PointLocation::inside;
      ASSERT_EQ(ray_holds(region.points, p), holds) << i;
      inside += holds ? 1 : 0;
    }
  }
  EXPECT_GT(inside, cases::case_count(2000) / 4);
}

TEST(ReferenceOverlap, TheRuleForEdgesOnTheRayIsPrintedTheWrongWayRound) {
  // A step: its tread is level with p, its ends go up and down, so the ray passes from outside to inside.
  const Loop step{{0, 0},      {30 * mm, 0}, {30 * mm, 20 * mm}, {10 * mm, 20 * mm}, {10 * mm, 10 * mm},
                  {0, 10 * mm}};
  const GridPoint p{20 * mm, 10 * mm};
  EXPECT_TRUE(ray_holds(step, p));
  EXPECT_FALSE(ray_holds(step, p, true));
}

TEST(ReferenceOverlap, VerticesMissThinArmsThatCross) {
  const GridRegion across = made(box(-50, -1, 50, 1)), upright = made(box(-1, -50, 1, 50));
  EXPECT_TRUE(interiors_meet(across, upright));
  EXPECT_TRUE(segments_overlap(across.points, upright.points, {}));
  EXPECT_FALSE(ray_overlap(across.points, upright.points, {}));
  // Split by their own width they are found; stored slanting, their boxes are wide and nothing splits them
  // enough.
  const std::int64_t width = smallest_box_side({&across, &upright});
  EXPECT_EQ(width, 2 * mm);
  EXPECT_TRUE(fragment_overlap(fragment_image(across, width), fragment_image(upright, width), {}));
  const geom::GridRotation slant = geom::rotation_from_degrees(45);
  const GridRegion a = geom::turned(across, slant, false), b = geom::turned(upright, slant, false);
  const std::int64_t wide = smallest_box_side({&a, &b});
  EXPECT_GT(wide, 70 * mm);
  EXPECT_TRUE(interiors_meet(a, b, {mm / 3, mm * 11}));
  EXPECT_FALSE(fragment_overlap(fragment_image(a, wide), fragment_image(b, wide), {mm / 3, mm * 11}));
}

TEST(ReferenceOverlap, SegmentsMissOnlyWhereOutlinesTouchAlongEdgesOrAtVertices) {
  const GridRegion square = made(box(0, 0, 10, 10));
  EXPECT_TRUE(interiors_meet(square, square));
  EXPECT_FALSE(segments_overlap(square.points, square.points, {}));  // no crossing, no vertex inside
  for (std::size_t i = 0; i < cases::case_count(2000); ++i) {
    Random random(cases::seed() + 1, 1 + i);
    const GridRegion a = cases::loop_region(cases::any_outline(random), 0),
                     b = cases::loop_region(cases::any_outline(random), 0);
    const GridPoint shift = cases::touching_shift(random, a, b) + cases::grid_direction(random, 1e6);
    ASSERT_EQ(segments_overlap(a.points, b.points, shift), interiors_meet(a, b, shift)) << i;
  }
}

/// How often `fragment` misses an overlap of two copies of a part, each turned anyhow, near each other.
double missed(const GridRegion& part, const char* name) {
  const std::int64_t smallest = smallest_box_side({&part});
  std::size_t overlaps = 0, misses = 0, false_alarms = 0;
  for (std::size_t i = 0; i < cases::case_count(4000); ++i) {
    Random random(cases::seed() + 2, 1 + i);
    const auto any = [&] {
      return geom::turned(part, geom::rotation_from_degrees(random.uniform(-180, 180)), false);
    };
    const GridRegion a = any(), b = any();
    const GridPoint shift = cases::grid_direction(random, random.uniform(0, 100) * mm);
    const bool overlap = interiors_meet(a, b, shift);
    const bool found = fragment_overlap(fragment_image(a, smallest), fragment_image(b, smallest), shift);
    overlaps += overlap ? 1 : 0;
    misses += overlap && !found ? 1 : 0;
    false_alarms += found && !overlap ? 1 : 0;
  }
  std::printf("%s: fragment missed %zu of %zu overlaps\n", name, misses, overlaps);
  // Split vertices are rounded to the grid, so that one may lie a step beyond its edge.
  EXPECT_LE(false_alarms, overlaps / 1000);
  return static_cast<double>(misses) / static_cast<double>(overlaps);
}

TEST(ReferenceOverlap, FragmentMissesOverlapsOfConvexParts) {
  const double triangle = missed(made({{0, 0}, {100 * mm, 0}, {50 * mm, 10 * mm}}), "triangle 100 x 10");
  EXPECT_GT(triangle, 0.03);
  EXPECT_LT(triangle, 0.2);
  const GridRegion strap = geom::turned(made(box(0, 0, 100, 10)), geom::rotation_from_degrees(45), false);
  const double slanting = missed(strap, "strap 100 x 10 stored at 45 degrees");
  EXPECT_GT(slanting, 0.08);
  EXPECT_LT(slanting, 0.6);
}

}  // namespace
}  // namespace lekalo::phi::phi_reference_overlap_test

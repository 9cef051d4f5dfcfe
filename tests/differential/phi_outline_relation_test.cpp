// The exact relations of outlines on the grid against triangles and fractions
// (tests/support/grid_oracle.hpp).

#include "lekalo/phi/outline_relation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "support/cases.hpp"
#include "support/grid_cases.hpp"
#include "support/grid_oracle.hpp"

namespace lekalo::phi_outline_relation_test {
namespace {

using geom::GridPoint;
using geom::GridRegion;

std::string text(const GridRegion& region) {
  std::string result;
  for (std::size_t l = 0; l < region.loops(); ++l) {
    result += "[";
    for (std::size_t i = region.loop_starts[l]; i < region.loop_starts[l + 1]; ++i)
      result += "(" + std::to_string(region.points[i].x) + "," + std::to_string(region.points[i].y) + ")";
    result += "]";
  }
  return result;
}

/// The second of two outlines: any, the same, one that just fills a hole, or the first without its holes.
GridRegion partner(Random& random, const GridRegion& a) {
  switch (random.below(4)) {
    case 0:
      return a;
    case 1:
      return cases::loop_region(a, a.loops() - 1);
    default:
      return cases::any_outline(random);
  }
}

/// Touching, and more often than not without overlapping.
GridPoint touching(Random& random, const GridRegion& a, const GridRegion& b) {
  const bool any = random.below(4) == 0;
  GridPoint shift = cases::touching_shift(random, a, b);
  for (int i = 0; i < 24 && !any && phi::interiors_meet(a, b, shift); ++i)
    shift = cases::touching_shift(random, a, b);
  return shift;
}

/// Gaps that decide: near the distance, exactly it when it is Pythagorean, or any.
std::int64_t some_gap(Random& random, const GridRegion& a, const GridRegion& b, GridPoint shift,
                      GridPoint offset) {
  const double length = std::sqrt(static_cast<double>(dot(offset, offset)));
  const auto about = [&](double steps) {
    return std::max<std::int64_t>(
        0, std::llround(steps) - (random.below(3) == 0 ? cases::between(random, -1, 1) : 0));
  };
  switch (random.below(4)) {
    case 0:
    case 1:
      return about(length);
    case 2:
      return about(phi::edge_distance(a, b, shift).distance_mm * 0x1p20);
    default:
      return about(length * random.uniform(0.2, 1.2));
  }
}

TEST(OutlineRelation, NearContactIsDecidedAsByTrianglesAndFractions) {
  const std::size_t count = cases::case_count(12'000);
  constexpr std::size_t kPlacesOfAPair = 24;
  std::size_t overlaps = 0, held = 0, nearer = 0, gaps = 0, exact_gaps = 0;
  for (std::size_t i = 0; i < count;) {
    Random random(cases::seed(), 1 + i / kPlacesOfAPair);
    const GridRegion a = cases::any_outline(random), b = partner(random, a);
    const oracle::Cut cut_a(a), cut_b(b);
    const geom::GridBox box = bounds(b);
    const double size = static_cast<double>(std::max(box.high.x - box.low.x, box.high.y - box.low.y));
    for (std::size_t k = 0; k < kPlacesOfAPair && i < count; ++k, ++i) {
      const GridPoint offset = cases::small_offset(random, size, a);
      const GridPoint shift = touching(random, a, b) + offset;
      const std::int64_t gap = some_gap(random, a, b, shift, offset);
      const bool held_by_b = cut_b.holds(cut_a, -shift);
      const bool meet = cut_a.interiors_meet(cut_b, shift), holds = cut_a.holds(cut_b, shift),
                 near = cut_a.edges_nearer_than(cut_b, gap, shift);
      const auto where = [&] {
        return "seed " + std::to_string(cases::seed()) + " case " + std::to_string(i) + " gap " +
               std::to_string(gap) + " shift (" + std::to_string(shift.x) + "," + std::to_string(shift.y) +
               ")\n" + text(a) + "\n" + text(b);
      };
      ASSERT_EQ(phi::interiors_meet(a, b, shift), meet) << where();
      ASSERT_EQ(phi::interiors_meet(b, a, -shift), meet) << where();
      ASSERT_EQ(phi::lies_within(a, b, shift), holds) << where();
      ASSERT_EQ(phi::lies_within(b, a, -shift), held_by_b) << where();
      ASSERT_EQ(phi::edges_nearer_than(a, b, gap, shift), near) << where();
      ASSERT_EQ(phi::edges_nearer_than(b, a, gap, -shift), near) << where();
      overlaps += meet ? 1 : 0;
      held += (holds ? 1 : 0) + (held_by_b ? 1 : 0);
      nearer += near ? 1 : 0;
      gaps += gap > 0 ? 1 : 0;
      if (gap > 0 && !near && phi::edges_nearer_than(a, b, gap + 1, shift)) {
        ASSERT_TRUE(cut_a.edges_nearer_than(cut_b, gap + 1, shift)) << where();
        exact_gaps +=
            cut_a.squared_edge_distance(cut_b, shift) == oracle::detail::wide(geom::Int128{gap} * gap) ? 1
                                                                                                       : 0;
      }
    }
  }
  std::printf(
      "%zu placed pairs, 6 questions each: %zu overlap, %zu within, %zu of %zu gaps broken, %zu gaps exactly "
      "kept\n",
      count, overlaps, held, nearer, gaps, exact_gaps);
  // Questions that all have one answer would prove little.
  EXPECT_GT(overlaps, count / 5);
  EXPECT_LT(overlaps, count * 9 / 10);
  EXPECT_GT(held, count / 100);
  EXPECT_GT(nearer, gaps / 5);
  EXPECT_LT(nearer, gaps * 9 / 10);
  EXPECT_GT(exact_gaps, count / 100);
}

TEST(OutlineRelation, EdgeDistanceIsTheExactOneRounded) {
  const std::size_t count = std::min<std::size_t>(cases::case_count(600), 20'000);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed() + 77, 1 + i);
    const GridRegion a = cases::any_outline(random), b = partner(random, a);
    const oracle::Cut cut_a(a), cut_b(b);
    const GridPoint shift = cases::touching_shift(random, a, b) + cases::small_offset(random, 1e9, a) +
                            cases::grid_direction(random, 1e8 * static_cast<double>(random.below(2)));
    const mpq_class squared = cut_a.squared_edge_distance(cut_b, shift);
    const auto found = phi::edge_distance(a, b, shift);
    const double exact = std::sqrt(squared.get_d()) * 0x1p-20;
    ASSERT_NEAR(found.distance_mm, exact, 1e-15 * exact + 1e-12) << i;
    ASSERT_EQ(found.distance_mm == 0, squared == 0) << i;
    // The two places are that far apart, and each on its outline.
    const double apart = geom::norm(found.on_a - found.on_b);
    ASSERT_NEAR(apart, exact, 1e-9) << i;
    const auto to_edges = [](geom::Point p, const GridRegion& region, GridPoint by) {
      double least = 1e300;
      for (std::size_t l = 0; l < region.loops(); ++l)
        for (std::uint32_t e = region.loop_starts[l]; e < region.loop_starts[l + 1]; ++e) {
          const std::uint32_t next = e + 1 == region.loop_starts[l + 1] ? region.loop_starts[l] : e + 1;
          const geom::Point from = geom::mm_from_grid(region.points[e] + by),
                            to = geom::mm_from_grid(region.points[next] + by);
          const double share = std::clamp(dot(p - from, to - from) / dot(to - from, to - from), 0.0, 1.0);
          least = std::min(least, geom::norm(p - from - share * (to - from)));
        }
      return least;
    };
    ASSERT_LT(to_edges(found.on_a, a, {}), 1e-8) << i;
    ASSERT_LT(to_edges(found.on_b, b, shift), 1e-8) << i;
  }
}

TEST(OutlineRelation, AGapOfThreeMillimetresIsThreeMillimetres) {
  constexpr std::int64_t mm = geom::kGridPerMm;
  const auto square = [](std::int64_t size) {
    return geom::make_grid_region({{{0, 0}, {size, 0}, {size, size}, {0, size}}}).value();
  };
  const GridRegion a = square(10 * mm), b = square(4 * mm);
  EXPECT_FALSE(phi::edges_nearer_than(a, b, 3 * mm, {13 * mm, 0}));
  EXPECT_TRUE(phi::edges_nearer_than(a, b, 3 * mm, {13 * mm - 1, 0}));
  EXPECT_TRUE(phi::edges_nearer_than(a, b, 3 * mm + 1, {13 * mm, 0}));
  // Corner to corner by 3-4-5, and from inside a hole.
  EXPECT_FALSE(phi::edges_nearer_than(a, b, 5 * mm, {13 * mm, 14 * mm}));
  EXPECT_TRUE(phi::edges_nearer_than(a, b, 5 * mm, {13 * mm, 14 * mm - 1}));
  const GridRegion frame =
      geom::make_grid_region(
          {{{0, 0}, {30 * mm, 0}, {30 * mm, 30 * mm}, {0, 30 * mm}},
           {{10 * mm, 10 * mm}, {20 * mm, 10 * mm}, {20 * mm, 20 * mm}, {10 * mm, 20 * mm}}})
          .value();
  EXPECT_FALSE(phi::interiors_meet(frame, b, {13 * mm, 13 * mm}));
  EXPECT_FALSE(phi::edges_nearer_than(frame, b, 3 * mm, {13 * mm, 13 * mm}));
  EXPECT_TRUE(phi::edges_nearer_than(frame, b, 3 * mm, {13 * mm, 13 * mm + 1}));
  EXPECT_FALSE(phi::interiors_meet(frame, a, {10 * mm, 10 * mm}));
  EXPECT_TRUE(phi::interiors_meet(frame, a, {10 * mm, 10 * mm + 1}));
  EXPECT_FALSE(phi::lies_within(frame, square(30 * mm)));
  EXPECT_TRUE(phi::lies_within(frame, square(10 * mm), {20 * mm, 20 * mm}));
  EXPECT_FALSE(phi::lies_within(frame, square(10 * mm), {20 * mm, 20 * mm + 1}));
}

TEST(OutlineRelation, GapsThatDoublesCannotTellFromTheDistance) {
  // Distances c / sqrt(m^2 + 1) of a vertex from an edge along (m, 1), where c^2 - g^2 (m^2 + 1) is 1 or -1
  // (Pell's equation): above or below the gap g by a share of 1 / 2c^2.
  const auto outline = [](std::vector<GridPoint> loop) {
    return geom::make_grid_region({std::move(loop)}).value();
  };
  for (std::int64_t m = 64; m <= 4096; m *= 2) {
    const std::int64_t k = (std::int64_t{1} << 34) / m;
    const GridRegion a = outline({{0, 0}, {k * m / 2, -k}, {k * m, k}});
    const GridRegion b = outline({{0, 0}, {1 << 20, 1 << 20}, {0, 1 << 20}});
    for (const std::int64_t along : {std::int64_t{7}, k / 3, k - 9 * m}) {
      const GridPoint by{along * m, along};
      const auto nearer = [&](GridPoint p, std::int64_t gap) {
        EXPECT_EQ(phi::edges_nearer_than(a, b, gap, p + by), phi::edges_nearer_than(b, a, gap, -p - by));
        return phi::edges_nearer_than(a, b, gap, p + by);
      };
      EXPECT_FALSE(nearer({-1, 2 * m}, 2 * m)) << m;
      EXPECT_TRUE(nearer({-1, 2 * m}, 2 * m + 1)) << m;
      EXPECT_TRUE(nearer({0, 4 * m * m + 3}, 4 * m * m + 1)) << m;
      EXPECT_FALSE(nearer({0, 4 * m * m + 3}, 4 * m * m)) << m;
    }
  }
}

}  // namespace
}  // namespace lekalo::phi_outline_relation_test

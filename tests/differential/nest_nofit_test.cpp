#include <gtest/gtest.h>

#include "lekalo/phi/outline_relation.hpp"
#include "nest/table/convex_pieces.hpp"
#include "nest/table/nofit.hpp"
#include "support/cases.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::nest::nest_nofit_test {
namespace {

using geom::GridPoint;
using geom::GridRegion;

SearchOutline shape_of(const GridRegion& region) {
  SearchOutline shape;
  for (std::size_t l = 0; l < region.loops(); ++l) {
    std::vector<geom::Point> loop;
    for (std::uint32_t k = region.loop_starts[l]; k < region.loop_starts[l + 1]; ++k)
      loop.push_back(geom::mm_from_grid(region.points[k]));
    shape.loops.push_back(std::move(loop));
  }
  shape.pieces = convex_pieces(region);
  return shape;
}

double area_of(const ConvexPiece& piece) {
  double twice = 0;
  for (std::size_t k = 0; k < piece.size(); ++k) twice += cross(piece[k], piece[(k + 1) % piece.size()]);
  return 0.5 * twice;
}

TEST(ConvexPieces, AreConvexAndMakeUpTheArea) {
  for (std::size_t i = 0; i < cases::case_count(300); ++i) {
    Random random(cases::seed(), 100 + i);
    const GridRegion region = cases::random_part(random, i).outline.polygon;
    double sum = 0;
    for (const ConvexPiece& piece : convex_pieces(region)) {
      sum += area_of(piece);
      for (std::size_t k = 0; k < piece.size(); ++k)
        EXPECT_GE(cross(piece[(k + 1) % piece.size()] - piece[k],
                        piece[(k + 2) % piece.size()] - piece[(k + 1) % piece.size()]),
                  0)
            << "case " << i << " of seed " << cases::seed();
    }
    EXPECT_NEAR(sum, geom::area_mm2(region), 1e-9 * geom::area_mm2(region))
        << "case " << i << " of seed " << cases::seed();
  }
}

/// Against the exact answer, at shifts anywhere and near the border; and the way out leads out.
TEST(NoFit, SaysTheSameAsTheExactRelation) {
  constexpr double kBand = 1e-5;  // mm: nearer to the border either answer is right
  std::size_t overlapping = 0, near = 0;
  for (std::size_t i = 0; i < cases::case_count(40); ++i) {
    Random random(cases::seed(), 500 + i);
    const GridRegion a = cases::random_part(random, i).outline.polygon,
                     b = cases::random_part(random, i + 1).outline.polygon;
    const NoFit table(shape_of(a), shape_of(b), 0, 1024);
    for (int k = 0; k < 200; ++k) {
      geom::Point shift{random.uniform(-70, 70), random.uniform(-70, 70)};
      const NoFit::Way way = table.way_out(shift.x, shift.y);
      if (k % 2 == 1 && way.depth > 0) {  // to the border and a little to one side
        shift = shift + (way.depth + random.uniform(-1, 1) * 1e-3) * way.direction;
        ++near;
      }
      const double depth = table.depth(shift.x, shift.y);
      const GridPoint at{geom::grid_from_mm(shift.x), geom::grid_from_mm(shift.y)};
      const bool meet = phi::interiors_meet(a, b, at);
      overlapping += meet;
      if (depth > kBand) {
        EXPECT_TRUE(meet) << "case " << i << " of seed " << cases::seed() << ", depth " << depth;
      }
      if (depth == 0 && meet) {  // only ever within rounding of contact
        const GridPoint wayside{at.x + geom::grid_from_mm(kBand), at.y + geom::grid_from_mm(kBand)};
        EXPECT_FALSE(phi::interiors_meet(a, b, wayside) && phi::interiors_meet(a, b, at - (wayside - at)))
            << "case " << i << " of seed " << cases::seed() << " at " << shift.x << ", " << shift.y;
      }
    }
  }
  EXPECT_GT(overlapping, std::size_t{100});
  EXPECT_GT(near, std::size_t{50});
}

TEST(NoFit, KeepsAGap) {
  const GridRegion square = cases::outline_of({cases::box_loop(0, 0, 10, 10)}).polygon;
  const NoFit table(shape_of(square), shape_of(square), 2, 1024);
  EXPECT_EQ(table.depth(12.001, 0), 0);
  EXPECT_NEAR(table.depth(11.5, 0), 0.5, 1e-9);
  // Round at the corner: 1.5 across and 1.5 up are 2.12 apart, 1.4 and 1.4 are 1.98.
  EXPECT_EQ(table.depth(11.5, 11.5), 0);
  EXPECT_NEAR(table.depth(11.4, 11.4), 2 - 1.4 * 1.4142135623730951, 1e-9);
}

TEST(NoFit, KnowsTheAreaInCommonRoughly) {
  const GridRegion frame =
      cases::outline_of({cases::box_loop(0, 0, 40, 40), cases::box_loop(10, 10, 30, 30)}).polygon;
  const GridRegion square = cases::outline_of({cases::box_loop(0, 0, 10, 10)}).polygon;
  const NoFit table(shape_of(frame), shape_of(square), 0, 2048, {}, {}, true);
  EXPECT_NEAR(table.common_area(0, 15), 100, 15);  // a ridge, cut off between nodes
  EXPECT_NEAR(table.common_area(5, 15), 50, 5);
  EXPECT_NEAR(table.common_area(15, 15), 0, 1);
  EXPECT_EQ(table.common_area(60, 0), 0);
}

/// A slot as wide as the tongue: only the exact answer can tell that it is free.
TEST(NoFit, FindsASlotJustWideEnough) {
  const GridRegion slot =
      cases::outline_of({{cases::grid_point(0, 0), cases::grid_point(30, 0), cases::grid_point(30, 20),
                          cases::grid_point(20, 20), cases::grid_point(20, 5), cases::grid_point(10, 5),
                          cases::grid_point(10, 20), cases::grid_point(0, 20)}})
          .polygon;
  const GridRegion tongue = cases::outline_of({cases::box_loop(0, 0, 10, 10)}).polygon;
  const auto is_free = [&](geom::Point shift) {
    return !phi::interiors_meet(slot, tongue, {geom::grid_from_mm(shift.x), geom::grid_from_mm(shift.y)});
  };
  const NoFit table(shape_of(slot), shape_of(tongue), 0, 1024, is_free);
  EXPECT_NEAR(table.depth(10, 8), 0, 1e-9);
  EXPECT_GT(table.depth(10.5, 8), 0.4);
  EXPECT_GT(table.depth(10, 4), 0.5);
}

/// Lists of four bytes an edge, as borders of very many edges have them, give the same to the bit.
TEST(NoFit, WideListsSayTheSame) {
  for (std::size_t i = 0; i < cases::case_count(20); ++i) {
    Random random(cases::seed(), 700 + i);
    const SearchOutline a = shape_of(cases::random_part(random, i).outline.polygon),
                        b = shape_of(cases::random_part(random, i + 1).outline.polygon);
    const NoFit narrow(a, b, 1, 1024), wide(a, b, 1, 1024, {}, {}, false, 0);
    for (int k = 0; k < 200; ++k) {
      const double x = random.uniform(-70, 70), y = random.uniform(-70, 70);
      const NoFit::Way one = narrow.way_out(x, y), two = wide.way_out(x, y);
      EXPECT_EQ(narrow.depth(x, y), wide.depth(x, y)) << "case " << i << " of seed " << cases::seed();
      EXPECT_TRUE(one.depth == two.depth && one.direction == two.direction)
          << "case " << i << " of seed " << cases::seed();
    }
  }
}

/// 8,200 small lozenges have 65,600 edges of contact with a square: none of them is left out.
TEST(NoFit, KeepsEveryEdgeOfABorderOfVeryMany) {
  constexpr int kAcross = 100, kUp = 82;
  const auto lozenge_at = [](double x, double y) {
    const std::vector<geom::Point> loop = {{x - 1, y}, {x, y - 1}, {x + 1, y}, {x, y + 1}};
    return SearchOutline{{loop}, {loop}};
  };
  SearchOutline all;
  for (int k = 0; k < kAcross * kUp; ++k) {
    const SearchOutline one = lozenge_at(10.0 * (k % kAcross), 10.0 * (k / kAcross));
    all.loops.push_back(one.loops[0]);
    all.pieces.push_back(one.pieces[0]);
  }
  const SearchOutline square = shape_of(cases::outline_of({cases::box_loop(0, 0, 2, 2)}).polygon);
  const NoFit table(all, square, 0, 16'384);
  EXPECT_GT(table.border().size(), NoFit::kMostNarrow);
  const NoFit alone(lozenge_at(0, 0), square, 0, 1024);
  Random random(cases::seed(), 900);
  for (int k = 0; k < 2000; ++k) {
    const double x = random.uniform(-4, 2), y = random.uniform(-4, 2);
    const int of = k % 2 == 0 ? kAcross * kUp - 1 - k % 400 : static_cast<int>(random.below(kAcross * kUp));
    const double here = alone.depth(x, y);
    // Deep inside the small table is interpolated, and at corners the large one rounds more.
    EXPECT_NEAR(table.depth(10.0 * (of % kAcross) + x, 10.0 * (of / kAcross) + y), here,
                here < 0.05 ? 1e-4 : 0.05);
  }
}

}  // namespace
}  // namespace lekalo::nest::nest_nofit_test

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/distance.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/nest/nest.hpp"
#include "nest/run/outer_outlines.hpp"
#include "nest/table/convex_pieces.hpp"
#include "nest/table/simplify.hpp"
#include "nest/tuning/tuning.hpp"
#include "support/cases.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::nest::nest_outer_outline_test {
namespace {

using geom::GridPoint;
using geom::GridRegion;

/// A ring of many corners around (0, 0), about 100 mm across, with waves and some noise.
GridRegion wavy(Random random, std::size_t corners, double noise) {
  const double phase = random.uniform(0, 6), height = random.uniform(0.02, 0.2);
  std::vector<GridPoint> loop;
  for (std::size_t k = 0; k < corners; ++k) {
    const double a = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
    const double r = 50 * (1 + height * std::sin(5 * a + phase) + random.uniform(-noise, noise));
    loop.push_back({geom::grid_from_mm(r * std::cos(a)), geom::grid_from_mm(r * std::sin(a))});
  }
  return geom::make_grid_region({loop}).value();
}

double distance_to(const GridRegion& region, GridPoint p) {
  double least = 1e300;
  for (std::size_t k = 0; k < region.points.size(); ++k)
    least = std::min(
        least, geom::distance_to_segment(geom::mm_from_grid(p), geom::mm_from_grid(region.points[k]),
                                         geom::mm_from_grid(region.points[(k + 1) % region.points.size()])));
  return least;
}

/// Some steps of the grid, mm: what the corners of an outer outline are rounded by.
constexpr double kRounding = 8 * geom::kGridStep;

TEST(OuterOutline, HoldsTheOutlineWithFewCornersNotFarAway) {
  for (std::size_t index = 0; index < cases::case_count(12); ++index) {
    SCOPED_TRACE(index);
    Random random(cases::seed(), index);
    const GridRegion outline = wavy(random, 300 + random.below(2700), index % 3 == 0 ? 0.002 : 0);
    const double size = std::sqrt(geom::area_mm2(outline));
    const GridRegion outer = outer_outline(outline, size);
    EXPECT_LE(outer.points.size(), tuning::kMostCorners);
    const auto outside_by = [](const GridRegion& region, GridPoint p) {
      return geom::locate_point(region, p) == geom::PointLocation::outside ? distance_to(region, p) : 0;
    };
    for (const GridPoint p : outline.points) EXPECT_LE(outside_by(outer, p), kRounding);
    for (const GridPoint p : outer.points)
      EXPECT_LE(outside_by(outline, p), 2 * tuning::kSimplifyMost * size);
  }
}

TEST(OuterOutline, OfFewCornersIsTheOutlineItself) {
  const GridRegion outline = wavy(Random(1), tuning::kEnoughCorners, 0.1);
  EXPECT_EQ(outer_outline(outline, 90), outline);
}

TEST(OuterOutline, IsNotGivenToPartsThatLieSomewhere) {
  layout::Document document = cases::two_squares();
  document.parts[0].outline.polygon = wavy(Random(2), 1000, 0);
  layout::Part other = document.parts[0];
  other.id = "other";
  document.parts.push_back(other);
  const auto corners = [](const layout::Document& d, std::size_t part) {
    return d.parts[part].outline.polygon.points.size();
  };
  const layout::Document afresh = with_outer_outlines(document, false);
  EXPECT_LE(corners(afresh, 0), tuning::kMostCorners);
  EXPECT_LE(corners(afresh, 1), tuning::kMostCorners);
  const layout::Document from_given = with_outer_outlines(document, true);
  EXPECT_EQ(corners(from_given, 0), 1000u);
  EXPECT_LE(corners(from_given, 1), tuning::kMostCorners);
  document.placements[0].locked = true;
  EXPECT_EQ(corners(with_outer_outlines(document, false), 0), 1000u);
}

TEST(OuterOutline, ConvexPiecesOfManyCornersCoverTheirOutline) {
  const GridRegion outline = wavy(Random(3), 1500, 0.003);
  double area = 0;
  for (const ConvexPiece& piece : convex_pieces(outline)) {
    double twice = 0;
    for (std::size_t k = 1; k + 1 < piece.size(); ++k)
      twice += cross(piece[k] - piece[0], piece[k + 1] - piece[0]);
    EXPECT_GT(twice, 0);
    area += 0.5 * twice;
  }
  EXPECT_NEAR(area, geom::area_mm2(outline), 1e-6 * area);
}

TEST(OuterOutline, PartsOfThousandsOfCornersAreNestedByAllOfThem) {
  layout::Document document = cases::two_squares();
  document.placements.clear();
  document.stocks[0].count = 9;
  document.rules.gap = geom::grid_from_mm(1);
  document.stocks[0].outline.polygon =
      geom::rectangle({{0, 0}, {geom::grid_from_mm(400), geom::grid_from_mm(300)}});
  document.parts.resize(1);
  document.parts[0].outline.polygon = wavy(Random(4), 2600, 0.001);
  document.parts[0].demand = 6;
  RunControl control;
  control.work_limit = 1;
  const auto nested = nest(document, {}, control);
  ASSERT_TRUE(nested) << nested.error().message;
  EXPECT_TRUE(nested->unplaced.empty());
  EXPECT_TRUE(layout::check(nested->document).empty());
  EXPECT_EQ(nested->document.parts, document.parts);
}

}  // namespace
}  // namespace lekalo::nest::nest_outer_outline_test

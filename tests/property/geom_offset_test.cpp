// The laws of geom/offset.hpp.

#include "lekalo/geom/offset.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "lekalo/geom/region_check.hpp"
#include "lekalo/geom/region_index.hpp"
#include "support/boolean_cases.hpp"
#include "support/cases.hpp"
#include "support/offset_check.hpp"
#include "support/region_cases.hpp"

namespace lekalo::geom::geom_offset_test {
namespace {

using cases::BooleanKind;
using Regions = std::vector<Region>;
constexpr double kPi = std::numbers::pi;

Region region(Contour outer, std::vector<Contour> holes = {}) {
  return make_region(std::move(outer), std::move(holes)).value();
}
BooleanResult grown(const Regions& regions, double distance) {
  auto result = offset(regions, distance);
  EXPECT_TRUE(result.has_value()) << result.error().message;
  return result ? *std::move(result) : BooleanResult{};
}
std::string fault(const Regions& regions, double distance, std::uint64_t stream = 0) {
  Random random(cases::seed(), 31 + stream);
  return cases::offset_fault(regions, distance, grown(regions, distance), random, 200);
}
double area_of(const Regions& regions, double distance) {
  return cases::area_of(grown(regions, distance).regions);
}

/// Simple, disjoint: a part or blank, or the union of pieces on a grid; some turned, moved, mirrored.
Regions random_regions(Random& random, std::size_t index) {
  Regions regions;
  if (index % 3 == 0) {
    const cases::RegionKind kind = cases::kRegionKinds[random.below(cases::kRegionKinds.size())];
    const auto one = cases::region_case(random.below(1000), random.below(1000), kind, 8 + random.below(40));
    regions = random.below(2) == 0 ? one.part : one.blank;
  } else {
    const auto pieces =
        cases::boolean_operand(random, index % 3 == 1 ? BooleanKind::grid : BooleanKind::turned);
    regions = united(pieces).value().regions;
  }
  if (random.below(2) == 0)
    regions = cases::map_regions(
        regions, BlankFromPart::from_angle(random.uniform(0, 6.28), {random.uniform(-20, 20), 3},
                                           random.below(2) == 0));
  return regions;
}
double random_distance(Random& random) {
  const double sign = random.below(2) == 0 ? 1 : -1;
  switch (random.below(6)) {
    case 0:
      return random.uniform(-3, 3);
    case 1:
      return static_cast<double>(random.below(9)) * 0.5 - 2;  // where arcs vanish and pieces just touch
    case 2:
      return sign * std::pow(10.0, -random.uniform(2, 13));
    case 3:
      return random.uniform(0, 1e3);
    case 4:
      return random.uniform(-20, 0);
    default:
      return std::pow(10.0, random.uniform(1, 7));
  }
}

TEST(OffsetLaws, EveryBoundaryPointIsAtTheDistanceAndMembershipIsByDistance) {
  const std::size_t count = cases::case_count(1500);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed(), 4000 + i);
    const Regions regions = random_regions(random, i);
    const double distance = random_distance(random);
    SCOPED_TRACE(fmt::format("case {} seed {} distance {}", i, cases::seed(), distance));
    ASSERT_EQ(cases::offset_fault(regions, distance, grown(regions, distance), random, 60), "");
  }
}

TEST(OffsetLaws, OpeningLiesInsideAndClosingAround) {
  const std::size_t count = cases::case_count(300);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed(), 8000 + i);
    const Regions regions = random_regions(random, i);
    const double d = random.uniform(0.01, 3);
    SCOPED_TRACE(fmt::format("case {} seed {} distance {}", i, cases::seed(), d));
    const BooleanResult less = grown(regions, -d), more = grown(regions, d);
    const BooleanResult opened = grown(less.regions, d), closed = grown(more.regions, -d);
    if (regions.empty()) continue;
    const RegionIndex index(regions), in_opened(opened.regions), in_closed(closed.regions);
    const auto edges = cases::edges_of(regions);
    const double slack = 8 * (less.edge_error + more.edge_error + opened.edge_error + closed.edge_error);
    for (int k = 0; k < 100; ++k) {
      const auto& edge = edges[random.below(edges.size())];
      const Point on = cases::point_on(edge, random.uniform(0, 1));
      const double off = random.uniform(0, 2 * d);
      const Point p = on + off * cases::direction_of(random.uniform(0, 6.28));
      if (index.nearest(p).distance < slack) continue;
      if (in_opened.contains(p)) {
        ASSERT_TRUE(index.contains(p)) << p.x << ' ' << p.y;
      }
      if (index.contains(p)) {
        ASSERT_TRUE(in_closed.contains(p)) << p.x << ' ' << p.y;
      }
    }
  }
}

TEST(OffsetLaws, AConvexRegionGrowsByLengthTimesDistanceAndADisc) {
  const std::size_t count = cases::case_count(200);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed(), 9000 + i);
    Regions regions{region(cases::boolean_rounded(0, 0, random.uniform(2, 9), random.uniform(2, 9), 1))};
    if (i % 3 == 1) regions = {region(cases::boolean_circle({1, 2}, random.uniform(0.1, 5)))};
    if (i % 3 == 2)
      regions = {region(cases::boolean_polygon(cases::random_case(cases::seed(), i).part.vertices()))};
    const double d = std::pow(10.0, random.uniform(-3, 3));
    const double before = cases::area_of(regions), length = cases::length_of(regions);
    const BooleanResult result = grown(regions, d);
    const double wanted = before + length * d + kPi * d * d;
    ASSERT_NEAR(cases::area_of(result.regions), wanted,
                4 * result.edge_error * (length + 2 * kPi * d) + 1e-13 * wanted)
        << i << " seed " << cases::seed();
    ASSERT_EQ(result.regions.size(), 1u);
    ASSERT_TRUE(result.regions[0].holes.empty());
  }
}

TEST(OffsetLaws, GrowingTwiceIsGrowingByTheSum) {
  const std::size_t count = cases::case_count(200);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed(), 10000 + i);
    const Regions regions = random_regions(random, i);
    const double r = random.uniform(0.01, 2), s = random.uniform(0.01, 2);
    const BooleanResult first = grown(regions, r), twice = grown(first.regions, s),
                        once = grown(regions, r + s);
    const double error = 2 * (first.edge_error + twice.edge_error + once.edge_error);
    const double length = cases::length_of(once.regions) + cases::length_of(first.regions);
    // Tips and mouths that edge_error closes are small: hardly any area.
    ASSERT_NEAR(cases::area_of(twice.regions), cases::area_of(once.regions), 4 * error * (1 + length))
        << i << " seed " << cases::seed();
  }
}

TEST(OffsetLaws, DoNotDependOnThePlace) {
  const std::size_t count = cases::case_count(200);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed(), 12000 + i);
    const Regions regions = random_regions(random, i);
    const double d = random.uniform(-2, 2);
    const auto pose = BlankFromPart::from_angle(random.uniform(0, 6.28), {random.uniform(-20, 20), 7},
                                                random.below(2) == 0);
    const BooleanResult here = grown(regions, d), there = grown(cases::map_regions(regions, pose), d);
    ASSERT_NEAR(cases::area_of(here.regions), cases::area_of(there.regions),
                4 * (here.edge_error + there.edge_error) * (1 + cases::length_of(here.regions)))
        << i << " seed " << cases::seed();
  }
}

TEST(Offset, HolesClosePiecesMergeNecksPart) {
  const Regions ring{region(cases::boolean_circle({0, 0}, 10), {cases::boolean_circle({0, 0}, 2)})};
  EXPECT_EQ(grown(ring, 1.9).regions[0].holes.size(), 1u);
  EXPECT_TRUE(grown(ring, 2.1).regions[0].holes.empty());
  EXPECT_TRUE(grown(ring, 2).regions[0].holes.empty());
  EXPECT_TRUE(grown(ring, -4.1).regions.empty());
  EXPECT_NEAR(area_of(ring, -3.9), kPi * (6.1 * 6.1 - 5.9 * 5.9), 1e-9);

  const Regions two{region(cases::boolean_rectangle(0, 0, 4, 4)),
                    region(cases::boolean_rectangle(5, 0, 4, 4))};
  EXPECT_EQ(grown(two, 0.49).regions.size(), 2u);
  EXPECT_EQ(grown(two, 0.51).regions.size(), 1u);
  EXPECT_EQ(fault(two, 0.5), "");

  // Two squares joined by a neck of width 1.
  const Regions neck{region(cases::boolean_polygon({{0, 0},
                                                    {4, 0},
                                                    {4, 1.5},
                                                    {8, 1.5},
                                                    {8, 0},
                                                    {12, 0},
                                                    {12, 4},
                                                    {8, 4},
                                                    {8, 2.5},
                                                    {4, 2.5},
                                                    {4, 4},
                                                    {0, 4}}))};
  EXPECT_EQ(grown(neck, -0.49).regions.size(), 1u);
  EXPECT_EQ(grown(neck, -0.51).regions.size(), 2u);
  for (const double d : {-0.49, -0.5, -0.51, -2.0, 0.7, 2.0}) EXPECT_EQ(fault(neck, d), "") << d;
  EXPECT_TRUE(grown(neck, -2.01).regions.empty());
}

/// What a hole or an edge is grown by once ended at the wall beside it, because only the side without
/// material was swept.
TEST(OffsetEdges, ReachBeyondAWallThatIsThinnerThanTheDistance) {
  const auto line = [](Point a, Point b) { return Edge{EdgeKind::line, a, b, {}}; };
  const Contour outer{line({0, 0}, {100, 0}), line({100, 0}, {100, 40}), line({100, 40}, {0, 40}),
                      line({0, 40}, {0, 0})};
  const Point bore{50, 10};
  const Regions plate{region(outer, {{{EdgeKind::arc_cw, {56, 10}, {56, 10}, bore}}})};
  const auto covers = [](const Regions& regions, Point p) { return RegionIndex(regions).contains(p); };

  const Regions by_bore = offset_edges(plate, {0, 0, 0, 0, 15}).value().regions;
  EXPECT_TRUE(covers(by_bore, bore));
  EXPECT_TRUE(covers(by_bore, {50, -10.999}));
  EXPECT_FALSE(covers(by_bore, {50, -11.001}));
  EXPECT_TRUE(covers(by_bore, {60, -8.46}));  // 10 and 18.46 from the middle: 20.99
  EXPECT_FALSE(covers(by_bore, {60, -8.48}));
  EXPECT_FALSE(covers(by_bore, {50, 40.001}));

  const Regions by_top = offset_edges(plate, {0, 0, 50, 0, 0}).value().regions;
  EXPECT_TRUE(covers(by_top, {50, -9.999}));
  EXPECT_FALSE(covers(by_top, {50, -10.001}));
}

TEST(Offset, PiecesThatTouchOrOverlapCountAsTheirUnion) {
  const Regions touching{region(cases::boolean_rectangle(0, 0, 4, 4)),
                         region(cases::boolean_rectangle(4, 0, 4, 4))};
  const Regions overlapping{region(cases::boolean_rectangle(0, 0, 5, 4)),
                            region(cases::boolean_rectangle(3, 0, 5, 4))};
  for (const Regions& regions : {touching, overlapping}) {
    EXPECT_NEAR(area_of(regions, -1), 6 * 2, 1e-9);
    EXPECT_NEAR(area_of(regions, 1), 32 + 24 + kPi, 1e-9);
    EXPECT_NEAR(area_of(regions, 0), 32, 1e-9);
  }
}

TEST(Offset, ArcsVanishAndComeOutExactly) {
  // A slot with concave ends of radius 1: at 1 they are points, beyond it corners.
  const Regions waist{region(cases::boolean_slot(0, 0, 6, 1, true))};
  for (const double d : {0.5, 0.999999, 1.0, 1.000001, 1.5, 10.0, -0.25, -0.9, -0.999999, -1.0})
    EXPECT_EQ(fault(waist, d), "") << d;
  // The arcs of a rounded rectangle are those of its corners.
  const BooleanResult sharp = grown({region(cases::boolean_rounded(0, 0, 10, 6, 1))}, -1);
  ASSERT_EQ(sharp.regions.size(), 1u);
  for (const Edge& e : sharp.regions[0].outer) EXPECT_EQ(e.kind, EdgeKind::line);
  EXPECT_NEAR(cases::area_of(sharp.regions), 8 * 4, 1e-9);
  const BooleanResult back = grown(sharp.regions, 1);
  ASSERT_EQ(back.regions.size(), 1u);
  ASSERT_EQ(back.regions[0].outer.size(), 8u);
  for (const Edge& e : back.regions[0].outer) {
    if (e.kind != EdgeKind::line) {
      EXPECT_NEAR(arc_radius(e), 1, 1e-10);
    }
  }
}

TEST(Offset, NothingFromNothingAndFromTooMuch) {
  EXPECT_TRUE(grown({}, 1).regions.empty());
  EXPECT_TRUE(grown({}, -1).regions.empty());
  const Regions square{region(cases::boolean_rectangle(0, 0, 4, 4))};
  for (const double d : {-2.0, -2.1, -1e3, -1e12}) EXPECT_TRUE(grown(square, d).regions.empty()) << d;
  EXPECT_EQ(fault(square, 1e9), "");
  EXPECT_EQ(grown(square, 0).regions, united(square).value().regions);
}

TEST(Offset, ADistanceThatIsNoneIsRefused) {
  const Regions square{region(cases::boolean_rectangle(0, 0, 4, 4))};
  for (const double d : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                         -std::numeric_limits<double>::infinity(), 1e200, -1e200, 1e-200}) {
    const auto result = offset(square, d);
    ASSERT_FALSE(result.has_value()) << d;
    EXPECT_EQ(result.error().code, ErrorCode::bad_input);
    EXPECT_NE(result.error().message.find("an offset by"), std::string::npos);
  }
}

// ---- what was wrong once ----------------------------------------------------------------------------------

TEST(Offset, ALoopThatWindsTheOtherWayIsNoMaterial) {
  // A hole that reaches out of its outline: out there is nothing, and nothing grows.
  const Regions wrong{
      region(cases::boolean_rectangle(0, 0, 10, 10), {cases::boolean_rectangle(8, 4, 12, 2)})};
  // At 1.5 the two sides' sweeps overlap in its middle.
  const RegionIndex index(grown(wrong, 1.5).regions);
  EXPECT_TRUE(index.contains({11.4, 2}));
  EXPECT_FALSE(index.contains({12, 5.9}));
  EXPECT_FALSE(index.contains({19.9, 5}));
  EXPECT_FALSE(index.contains({15, 5}));
  // A figure of eight whose second loop runs clockwise.
  const Regions eight{region(cases::boolean_polygon({{0, 0}, {6, 0}, {10, 4}, {10, 0}, {6, 4}, {0, 4}}))};
  EXPECT_FALSE(RegionIndex(grown(eight, 0.1).regions).contains({9.95, 2}));
}

TEST(Offset, TipsOfNeedlesAreNotBluntedBeforehand) {
  // The arcs meet the sides at no angle: a union would cut the tips, and a large disc about them shows it.
  const Regions waist = cases::map_regions({region(cases::boolean_slot(3, 2, 4, 1, true))},
                                           BlankFromPart::from_angle(0.5235987755982988, {1, -2}));
  EXPECT_EQ(fault(waist, 1), "");
  EXPECT_LT(grown(waist, 1).edge_error, 1e-10);
}

TEST(Offset, AShiftOfOneSnappingDistanceDoesNotTurnTheMapInsideOut) {
  const Regions waist{region(cases::boolean_slot(4, 0, 4, 1, true))};
  for (int k = 1; k <= 400; ++k) {
    const double d = 0.01 * k * kBooleanSnap * 9;
    ASSERT_NEAR(area_of(waist, -d), 8 - kPi, 1e-9) << d;
    ASSERT_NEAR(area_of(waist, d), 8 - kPi, 1e-9) << d;
  }
}

TEST(Offset, NoCracksAtHugeDistances) {
  // Neighbouring sides whose parallels end a little more than a snapping distance apart.
  for (std::uint64_t i = 0; i < 60; ++i) {
    const auto one = cases::region_case(7, i, cases::RegionKind::rounded, 24);
    for (const double d : {1e4, 3e4, 1e5, 1e6}) {
      const BooleanResult result = grown(one.part, d);
      ASSERT_EQ(result.regions.size(), 1u);
      EXPECT_TRUE(result.regions[0].holes.empty()) << i << ' ' << d;
      Random random(1, i);
      ASSERT_EQ(cases::offset_fault(one.part, d, result, random, 20), "") << i << ' ' << d;
    }
  }
}

TEST(Offset, ArcsWhoseEndsMissTheirCircleAreSweptAsTheyAreMeant) {
  // 9e-4 mm: within kArcConsistency. A disc of 2 about the end that sticks out reaches as far as it must.
  const Regions half{region(
      {{EdgeKind::arc_ccw, {5, 0}, {-5.0009, 0}, {0, 0}}, {EdgeKind::line, {-5.0009, 0}, {5, 0}, {}}})};
  const BooleanResult result = grown(half, 2);
  const RegionIndex index(result.regions);
  EXPECT_TRUE(index.contains({-7.00089, 0.0}));
  EXPECT_FALSE(index.contains({-7.00091, 0.0}));
  EXPECT_TRUE(index.contains({0, 5.00045 + 1.9999}));
  EXPECT_FALSE(index.contains({0, 5.00045 + 2.0001}));
}

}  // namespace
}  // namespace lekalo::geom::geom_offset_test

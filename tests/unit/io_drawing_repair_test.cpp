#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "lekalo/geom/region_check.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "support/drawn.hpp"

// What make_regions does with drawings that have faults: mends, marks, and what it sets aside.

namespace lekalo::io::io_drawing_repair_test {
namespace {

using cases::Sketch;
using geom::Point;

DrawnRegions made(const Sketch& sketch, const DrawingOptions& options = {}) {
  auto result = make_regions(sketch.drawing(), options);
  EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().message);
  if (!result) return {};
  for (const geom::Region& region : result->regions) EXPECT_FALSE(geom::fault_of({region}));
  EXPECT_EQ(result->curve_of_edge.size(), geom::edges_in(result->regions));
  EXPECT_LE(result->repaired, options.repair);
  return *std::move(result);
}

bool refused_when_strict(const Sketch& sketch) {
  DrawingOptions options;
  options.strict = true;
  return !make_regions(sketch.drawing(), options);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Shape loop_at(Point p, Point a, Point b) {
  return Spline{3, {0, 0, 0, 0, 1, 1, 1, 1}, {p, p + a, p + b, p}, {}};
}

const std::vector<Point> kSquare{{0, 0}, {10, 0}, {10, 10}, {0, 10}};

TEST(DrawingRepair, ALoopInACornerHangsOnItByANeck) {
  // As a box maker draws the inner corner of a hole: C 21.1 310.5 21.2 310.6 21.2 310.6.
  Sketch sketch;
  sketch.polyline(kSquare).add(loop_at({10, 10}, {0.1, 0}, {0, 0.1}), "path");
  EXPECT_TRUE(refused_when_strict(sketch));
  const auto found = made(sketch);
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_TRUE(found.regions[0].holes.empty());
  EXPECT_GT(found.regions[0].outer.size(), 5u);
  EXPECT_GT(geom::area(found.regions[0]), 100.001);
  EXPECT_TRUE(found.set_aside.empty());
  EXPECT_TRUE(found.cut_off.empty());
  // The neck is all that moved.
  EXPECT_GE(found.repaired, 1e-4);
  EXPECT_LE(found.tolerance, 0.0015);
}

TEST(DrawingRepair, ALoopAtACrossingHangsOnANeckAndASpeckIsCutOff) {
  const auto overshot = [](double by) {
    Sketch sketch;
    sketch.polyline({{0, 0}, {10 + by, 0}, {10 + by, -by}, {10, -by}, {10, 10}, {0, 10}});
    EXPECT_TRUE(refused_when_strict(sketch));
    return sketch;
  };
  const auto loop = made(overshot(0.1));
  ASSERT_EQ(loop.regions.size(), 1u);
  EXPECT_NEAR(geom::area(loop.regions[0]), 100.01, 2e-3);
  EXPECT_LE(loop.tolerance, 2e-4);
  EXPECT_TRUE(loop.cut_off.empty());
  // As small as what is joined anyway: the reach of the loop is the loss.
  const auto speck = made(overshot(0.006));
  ASSERT_EQ(speck.regions.size(), 1u);
  EXPECT_EQ(speck.regions[0].outer.size(), 4u);
  EXPECT_GE(speck.tolerance, 0.006 * 1.41421);
  EXPECT_LE(speck.tolerance, 0.006 * 1.41422 + 0.0003);
  EXPECT_EQ(speck.cut_off, (std::vector<std::uint32_t>{1, 2}));
  // What reaches too far for that is marks, and no part of a third of a millimetre.
  const auto ear = made(overshot(0.25));
  EXPECT_EQ(ear.regions.size(), 1u);
  EXPECT_FALSE(ear.marks.empty());
  // More than is mended is a shape of its own.
  const auto large = made(overshot(0.5));
  EXPECT_EQ(large.regions.size(), 2u);
  EXPECT_LE(large.tolerance, 1e-6);
}

TEST(DrawingRepair, AFigureOfEightIsTwoParts) {
  Sketch bow;
  bow.polyline({{0, 0}, {10, 10}, {10, 0}, {0, 10}});
  EXPECT_TRUE(refused_when_strict(bow));
  const auto found = made(bow);
  ASSERT_EQ(found.regions.size(), 2u);
  EXPECT_NEAR(geom::area(found.regions), 50, 1e-6);
  EXPECT_LE(found.tolerance, 1e-6);
}

TEST(DrawingRepair, PartsThatShareAnEdgeAreTwo) {
  // Two squares of which the second is drawn with three lines: three ends meet in two places.
  Sketch sketch;
  sketch.polyline(kSquare).polyline({{10, 10}, {20, 10}, {20, 0}, {10, 0}}, false);
  EXPECT_TRUE(refused_when_strict(sketch));
  const auto found = made(sketch);
  ASSERT_EQ(found.regions.size(), 2u);
  EXPECT_NEAR(geom::area(found.regions[0]), 100, 1e-9);
  EXPECT_NEAR(geom::area(found.regions[1]), 100, 1e-9);
  EXPECT_TRUE(found.marks.empty());
  // Drawn whole, too.
  Sketch whole;
  whole.polyline(kSquare).polyline({{10, 10}, {20, 10}, {20, 0}, {10, 0.001}});
  EXPECT_EQ(made(whole).regions.size(), 2u);
}

TEST(DrawingRepair, WhatTouchingLinesEncloseOfTheSizeOfAMendIsLinesAndACircleOfThatSizeAHole) {
  const auto roof = [](double width, double height) {
    Sketch sketch;
    sketch.line({0, 0}, {30, 0}).polyline({{10, 0}, {10 + width / 2, height}, {10 + width, 0}}, false);
    sketch.polyline({{0, 20}, {10, 20}, {10, 30}, {0, 30}}).circle({5, 25}, 0.1);
    return made(sketch);
  };
  // Something small, or long and nowhere wider than a mend.
  for (const auto& found : {roof(0.2, 0.2), roof(5, 0.2)}) {
    ASSERT_EQ(found.regions.size(), 1u);
    EXPECT_EQ(found.regions[0].holes.size(), 1u);
    EXPECT_FALSE(found.marks.empty());
  }
  EXPECT_EQ(roof(0.5, 0.5).regions.size(), 2u);
  EXPECT_EQ(roof(5, 0.3).regions.size(), 2u);
}

TEST(DrawingRepair, PartsThatTouchInACornerAreTwo) {
  Sketch sketch;
  sketch.polyline(kSquare).polyline({{10, 10}, {20, 10}, {20, 20}, {10, 20}});
  EXPECT_TRUE(refused_when_strict(sketch));
  const auto found = made(sketch);
  EXPECT_EQ(found.regions.size(), 2u);
  EXPECT_LE(found.tolerance, 1e-9);
}

TEST(DrawingRepair, AHoleThatTouchesTheOutlineKeepsAWall) {
  Sketch sketch;
  sketch.polyline(kSquare).polyline({{5, 0}, {7, 3}, {3, 3}});
  EXPECT_TRUE(refused_when_strict(sketch));
  const auto found = made(sketch);
  ASSERT_EQ(found.regions.size(), 1u);
  ASSERT_EQ(found.regions[0].holes.size(), 1u);
  EXPECT_NEAR(geom::area(found.regions[0]), 94, 1e-3);
  EXPECT_LE(found.tolerance, 3e-4);
}

TEST(DrawingRepair, ALineThatHangsOnAnOutlineIsAMarkOnIt) {
  Sketch sketch;
  sketch.polyline(kSquare).layer("BEND").line({0, 0}, {10, 10});
  const auto found = made(sketch);
  ASSERT_EQ(found.regions.size(), 1u);
  ASSERT_EQ(found.marks.size(), 1u);
  EXPECT_EQ(found.marks[0].curve_of_edge, (std::vector<std::uint32_t>{4}));
  EXPECT_EQ(found.marks[0].region, 0u);
  EXPECT_TRUE(has(found.notices.back(), "1 line that encloses nothing is a mark"));
}

TEST(DrawingRepair, FacesOfOneLayerAreParts) {
  Sketch sketch;
  sketch.polyline(kSquare).line({0, 0}, {10, 10});
  const auto found = made(sketch);
  EXPECT_EQ(found.regions.size(), 2u);
  EXPECT_TRUE(found.marks.empty());
}

TEST(DrawingRepair, ContoursThatOverlapAreSetAsideAndTheRestIsTaken) {
  Sketch sketch;
  sketch.polyline(kSquare).layer("B").circle({9, 5}, 5).circle({9, 5}, 1).layer("0").circle({50, 5}, 2);
  EXPECT_TRUE(refused_when_strict(sketch));
  const auto found = made(sketch);
  ASSERT_EQ(found.regions.size(), 1u);
  // The hole of what is set aside is no part.
  ASSERT_EQ(found.set_aside.size(), 3u);
  EXPECT_EQ(found.set_aside[0].reason, AsideReason::crosses_another);
  EXPECT_EQ(found.set_aside[0].curves, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(found.set_aside[1].curves, (std::vector<std::uint32_t>{4}));
  EXPECT_TRUE(has(found.set_aside[1].sentence, "the CIRCLE at line 50, layer 'B'"))
      << found.set_aside[1].sentence;
  EXPECT_TRUE(has(found.set_aside[1].sentence, "--repair"));
  EXPECT_EQ(found.set_aside[2].reason, AsideReason::lies_in_another);
  EXPECT_STREQ(word_of(found.set_aside[2].reason), "lies in another");
}

TEST(DrawingRepair, WhatCrossesALargerOutlineIsLinesOnIt) {
  // An engraved square that reaches across the fingers of a panel must not cut the panel's corners off.
  Sketch sketch;
  sketch.polyline(kSquare).circle({9.5, 5}, 2);
  EXPECT_TRUE(refused_when_strict(sketch));
  const auto found = made(sketch);
  EXPECT_TRUE(found.set_aside.empty());
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_NEAR(geom::area(found.regions[0]), 100, 1e-9);
  ASSERT_EQ(found.marks.size(), 1u);
  EXPECT_EQ(found.marks[0].curve_of_edge, (std::vector<std::uint32_t>{4}));
  ASSERT_EQ(found.doubtful.size(), 1u);
  EXPECT_TRUE(has(found.doubtful[0], "the CIRCLE at line 50")) << found.doubtful[0];
  EXPECT_EQ(found.tolerance, 0);
}

TEST(DrawingRepair, PartsThatWereDrawnTooNearStayParts) {
  // A tab reaches 0.5 mm into the next part; neither is far larger.
  Sketch sketch;
  sketch.polyline({{0, 0}, {10, 0}, {10, 4}, {11, 4}, {11, 6}, {10, 6}, {10, 10}, {0, 10}})
      .polyline({{10.5, 0}, {20.5, 0}, {20.5, 10}, {10.5, 10}});
  EXPECT_TRUE(refused_when_strict(sketch));
  const auto found = made(sketch);
  EXPECT_TRUE(found.set_aside.empty());
  ASSERT_EQ(found.regions.size(), 2u);
  EXPECT_NEAR(geom::area(found.regions[0]), 102, 1e-9);
  EXPECT_NEAR(geom::area(found.regions[1]), 100, 1e-9);
  EXPECT_TRUE(std::any_of(found.notices.begin(), found.notices.end(), [](const std::string& notice) {
    return has(notice, "1 pair of contours overlaps, and each");
  }));
  // A hole in both would be a hole of one, and covered by the other.
  sketch.circle({10.75, 5}, 0.1);
  EXPECT_EQ(made(Sketch(sketch).circle({50, 50}, 1)).regions.size(), 1u);
}

TEST(DrawingRepair, EndsThatRunPastEachOtherCloseWhereTheyCross) {
  // The blade of a fan: its arcs cross 0.4 mm before their ends.
  Sketch crossing;
  crossing.line({-0.3, 0}, {10, 0}).line({10, 0}, {10, 10}).line({10, 10}, {-0.3, -0.3});
  EXPECT_TRUE(refused_when_strict(crossing));
  const auto found = made(crossing);
  EXPECT_TRUE(found.set_aside.empty());
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_NEAR(geom::area(found.regions[0]), 50, 1e-6);
  EXPECT_LE(found.tolerance, 1e-6);
  // What lies behind the crossing is kept, both ends in a row.
  ASSERT_EQ(found.marks.size(), 1u);
  EXPECT_EQ(found.marks[0].edges.size(), 2u);
}

TEST(DrawingRepair, AnEndOnTheInsideOfALineClosesAnOutline) {
  // A flag in one stroke: its end lies on its own pole.
  Sketch flag;
  flag.polyline({{0, 0}, {0, 20}, {10, 20}, {10, 12}, {0, 12}}, false);
  EXPECT_TRUE(refused_when_strict(flag));
  const auto one = made(flag);
  ASSERT_EQ(one.regions.size(), 1u);
  EXPECT_NEAR(geom::area(one.regions[0]), 80, 1e-6);
  ASSERT_EQ(one.marks.size(), 1u);
  EXPECT_EQ(one.marks[0].edges.size(), 1u);
  EXPECT_LE(one.tolerance, 1e-8);
  // Four lines, each of which ends on the next.
  Sketch wheel;
  wheel.line({0, -3}, {0, 10}).line({-3, 10}, {12, 10}).line({12, 13}, {12, 0}).line({15, 0}, {0, 0});
  const auto square = made(wheel);
  ASSERT_EQ(square.regions.size(), 1u);
  EXPECT_NEAR(geom::area(square.regions[0]), 120, 1e-6);
  EXPECT_EQ(square.marks.size(), 4u);
  // An arc that stands on a longer line, and a line that ends on the arc.
  Sketch half;
  half.line({-20, 0}, {20, 0}).arc({10, 0}, {-10, 0}, {0, 0}).line({6, 0}, {6, 8});
  const auto halves = made(half);
  EXPECT_EQ(halves.regions.size(), 2u);
  EXPECT_EQ(halves.marks.size(), 2u);
  EXPECT_TRUE(halves.set_aside.empty());
  // An arc that lies on two others together bounds nothing more than they do, and is listed.
  const auto at = [](double degrees) {
    return 10.0 * geom::Point{std::cos(degrees / 57.29577951308232), std::sin(degrees / 57.29577951308232)};
  };
  Sketch twice;
  twice.line({-20, 0}, {20, 0}).arc(at(0), at(100), {0, 0}).arc(at(80), at(180), {0, 0});
  twice.arc(at(30), at(150), {0, 0});
  const auto once = made(twice);
  EXPECT_EQ(once.regions.size(), 1u);
  EXPECT_NEAR(geom::area(once.regions[0]), 50 * 3.14159265358979, 1e-3);
  EXPECT_FALSE(once.duplicates.empty());
}

TEST(DrawingRepair, AnEndThatFallsShortOfALineReachesItWithinTheJoinTolerance) {
  const auto flag = [](double end) {
    Sketch sketch;
    sketch.polyline({{0, 0}, {0, 20}, {10, 20}, {10, 12}, {end, 12}}, false);
    return sketch;
  };
  for (const double end : {0.008, -0.008}) {
    const auto found = made(flag(end));
    ASSERT_EQ(found.regions.size(), 1u);
    EXPECT_NEAR(geom::area(found.regions[0]), 80, 1e-6);
    EXPECT_GE(found.repaired, 0.008);
    EXPECT_LE(found.repaired, 0.0081);
  }
  EXPECT_FALSE(make_regions(flag(0.02).drawing(), {}));
}

TEST(DrawingRepair, EndsOnLinesOfAnotherLayerOrOnAPartCloseNothing) {
  Sketch apart;
  apart.polyline({{0, 0}, {0, 20}}, false).layer("measures");
  apart.polyline({{0, 20}, {10, 20}, {10, 12}, {0, 12}}, false);
  EXPECT_FALSE(make_regions(apart.drawing(), {}));
  // A letter in three strokes on a plate, and a bend line from edge to edge.
  Sketch plate;
  plate.polyline({{-50, -50}, {50, -50}, {50, 50}, {-50, 50}});
  plate.polyline({{0, 0}, {5, 20}, {10, 0}}, false).line({2.5, 10}, {7.5, 10}).line({-50, -20}, {50, -20});
  const auto found = made(plate);
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_TRUE(found.regions[0].holes.empty());
  EXPECT_EQ(found.marks.size(), 3u);
}

TEST(DrawingRepair, ASliverIsCutOffAsASpikeIs) {
  // Out along a line and back along one that is a hair beside it, 0.3 mm long: no neck would hold it.
  Sketch sketch;
  sketch.polyline({{0, 0}, {10, 0}, {10, 10}, {10.3, 10.001}, {10, 9.999}, {9.9, 10}, {0, 10}});
  EXPECT_TRUE(refused_when_strict(sketch));
  const auto found = made(sketch);
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_NEAR(geom::area(found.regions[0]), 100, 1e-2);
  EXPECT_LE(found.repaired, 0.011);
  EXPECT_FALSE(found.marks.empty()) << "0.3 mm is more than may be lost of a spike";
}

TEST(DrawingRepair, ACrackAtAFoldIsLinesAndWhatIsDrawnOfItsWidthAHole) {
  // As a box maker draws a fold: the way back is 0.2 mm beside the end of the way there, and crosses it.
  const auto folded = [](double beside) {
    Sketch sketch;
    sketch.polyline(
        {{0, 0}, {100, 0}, {100, 46}, {50, 50}, {50, 50 - beside}, {100, 50 - beside}, {100, 100}, {0, 100}});
    sketch.polyline({{10, 10}, {12.5, 10}, {12.5, 10.2}, {10, 10.2}})
        .circle({20, 20}, 0.25)
        .circle({30, 20}, 0.1);
    EXPECT_TRUE(refused_when_strict(sketch));
    return made(sketch);
  };
  const auto crack = folded(0.2);
  ASSERT_EQ(crack.regions.size(), 1u);
  EXPECT_EQ(crack.regions[0].holes.size(), 3u) << "the slot and the two round ones";
  EXPECT_FALSE(crack.marks.empty());
  EXPECT_LE(crack.repaired, 0.0101) << "whatever is farther from the outline is a mark";
  const auto hole = folded(0.5);
  ASSERT_EQ(hole.regions.size(), 1u);
  EXPECT_EQ(hole.regions[0].holes.size(), 4u);
}

TEST(DrawingRepair, HolesThatCrossAreOneHole) {
  Sketch sketch;
  sketch.polyline({{-20, -20}, {20, -20}, {20, 20}, {-20, 20}}).circle({0, 0}, 3).circle({4, 0}, 3);
  EXPECT_TRUE(refused_when_strict(sketch));
  const auto found = made(sketch);
  EXPECT_TRUE(found.set_aside.empty());
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_EQ(found.regions[0].holes.size(), 1u);
}

TEST(DrawingRepair, AGapBelowTheSizeOfRepairsIsBridgedAndAWiderOneNamesTheOption) {
  Sketch sketch;
  sketch.line({0, 0}, {10, 0}).line({10, 0}, {10, 10}).line({10, 10}, {0, 0.15});
  EXPECT_TRUE(refused_when_strict(sketch));
  const auto found = made(sketch);
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_EQ(found.gaps.size(), 1u);
  EXPECT_NEAR(found.repaired, 0.075, 1e-9);
  Sketch wide;
  wide.line({0, 0}, {10, 0})
      .line({10, 0}, {10, 10})
      .line({10, 10}, {0, 0.5})
      .circle({5, 3}, 0.5)
      .circle({50, 0}, 1);
  const auto left = made(wide);
  // The hole in what does not close is no part either.
  EXPECT_EQ(left.regions.size(), 1u);
  ASSERT_EQ(left.set_aside.size(), 2u);
  EXPECT_EQ(left.set_aside[0].reason, AsideReason::does_not_close);
  EXPECT_TRUE(has(left.set_aside[0].sentence, "--join 0.505")) << left.set_aside[0].sentence;
}

TEST(DrawingRepair, WhatOneElementDrawsAcrossItselfFollowsItsRule) {
  for (const geom::FillRule rule : {geom::FillRule::even_odd, geom::FillRule::nonzero}) {
    Sketch sketch;
    sketch.polyline(kSquare).polyline({{5, 5}, {15, 5}, {15, 15}, {5, 15}});
    for (io::DrawnCurve& curve : sketch.drawing().curves) curve.entity = 0;
    sketch.drawing().entities[0].fill = rule;
    const auto found = made(sketch);
    EXPECT_TRUE(found.set_aside.empty());
    EXPECT_NEAR(geom::area(found.regions), rule == geom::FillRule::nonzero ? 175 : 150, 1e-6);
  }
}

TEST(DrawingRepair, ACopyThatIsALittleOffIsDropped) {
  Sketch sketch;
  sketch.circle({0, 0}, 10).circle({0.05, 0}, 10);
  EXPECT_TRUE(refused_when_strict(sketch));
  const auto found = made(sketch);
  EXPECT_EQ(found.regions.size(), 1u);
  EXPECT_NEAR(found.tolerance, 0.05, 0.004);
  EXPECT_GE(found.tolerance, 0.05);
  EXPECT_EQ(found.duplicates.size(), 1u);
}

TEST(DrawingRepair, NumbersThatMakeNoCurveAreSetAside) {
  Sketch sketch;
  sketch.circle({0, 0}, 1).add(Spline{16, {}, {}, {}}, "SPLINE");
  const auto found = made(sketch);
  EXPECT_EQ(found.regions.size(), 1u);
  ASSERT_EQ(found.set_aside.size(), 1u);
  EXPECT_EQ(found.set_aside[0].reason, AsideReason::no_curve);
}

TEST(DrawingRepair, ManyEndsInOnePlaceSetNothingElseAside) {
  Sketch sketch;
  sketch.polyline(kSquare);
  for (int i = 0; i < 100; ++i) sketch.layer("FAN").line({50, 50}, {60, 50 + 3.0 * i});
  const auto found = made(sketch);
  EXPECT_EQ(found.regions.size(), 1u);
  EXPECT_EQ(found.marks.size(), 100u);
}

TEST(DrawingRepair, ACircleInArcsThatOverlapByLessThanTheJoinToleranceIsOne) {
  // Every end lies near the next all around, which makes no place of it where they all meet.
  Sketch sketch;
  constexpr int kArcs = 200;
  const double radius = kArcs * 0.0196 / (2 * std::numbers::pi);
  const auto at = [&](double k) {
    const double angle = 2 * std::numbers::pi * k / kArcs;
    return Point{radius * std::cos(angle), radius * std::sin(angle)};
  };
  for (int k = 0; k < kArcs; ++k) sketch.arc(at(k), at(k + 1.5), {0, 0});
  const auto found = made(sketch);
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_TRUE(found.regions[0].holes.empty());
  EXPECT_NEAR(geom::area(found.regions[0]), std::numbers::pi * radius * radius, 1e-3);
  EXPECT_LE(found.tolerance, 0.01);
}

TEST(DrawingRepair, ADrawingThatEnclosesNothingIsRefusedWithCounts) {
  Sketch sketch;
  sketch.line({0, 0}, {10, 0}).line({0, 5}, {10, 5}).layer("B").arc({0, 0}, {0, 5}, {0, 2.5});
  sketch.drawing().unread = {{"TEXT", 3, 99}};
  const auto result = make_regions(sketch.drawing());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::bad_input);
  EXPECT_EQ(result.error().message,
            "sketch.dxf: none of the 3 curves closes a contour: 2 of LINE on layer '0', 1 of ARC on layer "
            "'B'; not read: 3 TEXT");
}

TEST(DrawingRepair, TheSizeOfRepairsIsANumberFromZeroOn) {
  Sketch sketch;
  sketch.circle({0, 0}, 1);
  DrawingOptions options;
  options.repair = -1;
  EXPECT_EQ(make_regions(sketch.drawing(), options).error().code, ErrorCode::usage);
  options.repair = 0;
  EXPECT_TRUE(make_regions(sketch.drawing(), options));
}

}  // namespace
}  // namespace lekalo::io::io_drawing_repair_test

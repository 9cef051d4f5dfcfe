#include <gtest/gtest.h>

#include <cmath>

#include "lekalo/geom/region_check.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "support/boolean_cases.hpp"
#include "support/drawn.hpp"

namespace lekalo::io::io_drawing_regions_test {
namespace {

using cases::Sketch;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;

DrawnRegions made(const Sketch& sketch, const DrawingOptions& options = {}) {
  auto result = make_regions(sketch.drawing(), options);
  EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().message);
  if (!result) return {};
  EXPECT_EQ(geom::fault_of(result->regions), std::nullopt);
  EXPECT_EQ(result->curve_of_edge.size(), geom::edges_in(result->regions));
  return *std::move(result);
}
std::string refusal(const Sketch& sketch, DrawingOptions options = {}) {
  options.strict = true;
  auto result = make_regions(sketch.drawing(), options);
  EXPECT_FALSE(result.has_value());
  return result ? "" : result.error().message;
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const std::vector<Point> kSquare{{0, 0}, {10, 0}, {10, 10}, {0, 10}};

TEST(DrawingRegions, LooseLinesInAnyOrderAndDirectionAreOneRegion) {
  Sketch sketch;
  sketch.line({10, 0}, {0, 0}).line({0, 10}, {10, 10}).line({0, 0}, {0, 10}).line({10, 10}, {10, 0});
  const auto found = made(sketch);
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_EQ(geom::area(found.regions[0]), 100);
  EXPECT_EQ(found.tolerance, 0);
  // Counter-clockwise from the first point of the first curve: (10, 0), (10, 10), (0, 10), (0, 0).
  EXPECT_EQ(found.curve_of_edge, (std::vector<std::uint32_t>{3, 1, 2, 0}));
  EXPECT_TRUE(found.gaps.empty() && found.duplicates.empty() && found.notices.empty());
}

TEST(DrawingRegions, NestsByContainmentInTheOrderOfTheFile) {
  Sketch sketch;
  sketch.circle({5, 5}, 1).polyline({{20, 0}, {30, 0}, {30, 10}}).circle({5, 5}, 3).polyline(kSquare);
  const auto found = made(sketch);
  ASSERT_EQ(found.regions.size(), 3u);
  EXPECT_EQ(found.regions[0].outer[0].kind, EdgeKind::arc_ccw);  // the island in the hole came first
  EXPECT_EQ(found.regions[1].outer.size(), 3u);
  ASSERT_EQ(found.regions[2].holes.size(), 1u);
  EXPECT_EQ(found.regions[2].holes[0][0].kind, EdgeKind::arc_cw);
  EXPECT_EQ(found.curve_of_edge, (std::vector<std::uint32_t>{0, 1, 2, 3, 5, 6, 7, 8, 4}));
}

TEST(DrawingRegions, ALoopNoLongerThanItsGapsIsTooShort) {
  // Closing the gap leaves nothing of the line, which a sentence about its contour once began with.
  const Point from{2, 0}, to{2.0000000000000009, 0};
  DrawingOptions options;
  options.join_tolerance = 1e-6;
  Sketch alone;
  alone.line(from, to);
  EXPECT_EQ(refusal(alone, options),
            "sketch.dxf: none of the 1 curves closes a contour: 1 of LINE on layer '0'");
  Sketch beside;
  beside.line(from, to).polyline({{5, 0}, {15, 0}, {15, 10}, {5, 10}});
  options.strict = true;
  const auto found = made(beside, options);
  EXPECT_EQ(found.regions.size(), 1u);
  EXPECT_EQ(found.specks, std::vector<std::uint32_t>{0});
}

TEST(DrawingRegions, LinesMeetHalfWayAcrossAGap) {
  Sketch sketch;
  sketch.line({0, 0}, {10, 0}).line({10, 0.008}, {10, 10}).line({10, 10}, {0, 0});
  const auto found = made(sketch);
  ASSERT_EQ(found.gaps.size(), 1u);
  EXPECT_NEAR(found.gaps[0].size, 0.008, 1e-12);
  EXPECT_EQ(found.gaps[0].curves[0], 0u);
  EXPECT_EQ(found.gaps[0].curves[1], 1u);
  EXPECT_EQ(found.regions[0].outer[0].to, (Point{10, 0.004}));
  EXPECT_GE(found.moved, 0.004);
  EXPECT_LE(found.moved, 0.004 * (1 + 1e-12));
  EXPECT_EQ(found.tolerance, found.moved * (1 + 0x1p-48));
  ASSERT_EQ(found.notices.size(), 1u);
  EXPECT_TRUE(has(found.notices[0], "1 gap closed, the widest of 0.008 mm")) << found.notices[0];
}

TEST(DrawingRegions, ALineGoesToTheEndOfAnArcWhichStaysAsItIs) {
  Sketch sketch;
  sketch.arc({10, 0}, {0, 0}, {5, 0}).line({0, 0.005}, {10, -0.003});
  const auto found = made(sketch);
  ASSERT_EQ(found.regions[0].outer.size(), 2u);
  EXPECT_EQ(found.regions[0].outer[0], (Edge{EdgeKind::arc_ccw, {10, 0}, {0, 0}, {5, 0}}));
  EXPECT_EQ(found.gaps.size(), 2u);
  EXPECT_NEAR(found.moved, 0.005, 1e-12);
}

TEST(DrawingRegions, ArcsMeetHalfWayOrHaveALineBetweenThem) {
  // Half circles about (5, 0) and (5, 1e-5).
  Sketch close;
  close.arc({10, 0}, {0, 0}, {5, 0}).arc({0, 1e-5}, {10, 1e-5}, {5, 1e-5});
  const auto met = made(close);
  EXPECT_EQ(met.regions[0].outer.size(), 2u);
  EXPECT_EQ(met.regions[0].outer[0].to, (Point{0, 5e-6}));
  EXPECT_NEAR(met.moved, 1e-5, 1e-9);
  EXPECT_EQ(geom::arc_radius(met.regions[0].outer[0]), 5);
  // Larger than what the ends of one arc may differ by in radius: still arcs, still consistent.
  Sketch wide;
  wide.arc({10, 0}, {0, 0}, {5, 0}).arc({-0.008, 0}, {10.008, 0}, {5, 0});
  const auto pulled = made(wide);
  ASSERT_EQ(pulled.regions[0].outer.size(), 2u);
  EXPECT_EQ(pulled.regions[0].outer[0], (Edge{EdgeKind::arc_ccw, {10.004, 0}, {-0.004, 0}, {5, 0}}));
  EXPECT_NEAR(pulled.moved, 0.008, 1e-9);
  // An arc of nearly a full turn is halved, so that its end moves alone.
  const auto [sine, cosine] = geom::sincos(0.02);
  Sketch full;
  full.arc({5, 0}, {5 * cosine, -5 * sine}, {0, 0})
      .arc({5.004, -5 * sine}, {5.004, 0}, {5.004, -2.5 * sine}, false);
  const auto halved = made(full);
  EXPECT_EQ(halved.regions[0].outer.size(), 3u);
  EXPECT_EQ(halved.curve_of_edge, (std::vector<std::uint32_t>{0, 0, 1}));
  EXPECT_LE(halved.moved, 0.006);
  // An arc no longer than a few gaps stays as it is.
  Sketch tiny;
  tiny.arc({5, 0}, {0, 0}, {2.5, 0})
      .arc({-0.006, 0}, {-0.006, -0.02}, {-0.006, -0.01})
      .line({-0.006, -0.02}, {5, 0});
  const auto bridged = made(tiny);
  ASSERT_EQ(bridged.regions[0].outer.size(), 4u);
  EXPECT_EQ(bridged.regions[0].outer[1].kind, EdgeKind::line);
  EXPECT_EQ(bridged.curve_of_edge, (std::vector<std::uint32_t>{0, 0, 1, 2}));
}

TEST(DrawingRegions, ThreeEndsInOnePlaceAreNamed) {
  Sketch sketch;
  sketch.polyline(kSquare).layer("AXES").line({10, 10}, {20, 20});
  const std::string message = refusal(sketch);
  EXPECT_TRUE(has(message, "sketch.dxf: 3 ends of curves lie within 0.01 mm of (10, 10) mm")) << message;
  EXPECT_TRUE(has(message,
                  "the LINE at line 20, layer '0'; the LINE at line 30, layer '0'; the LINE at line 50, "
                  "layer 'AXES'"))
      << message;
  DrawingOptions options;
  options.leave = {"axes"};
  EXPECT_EQ(made(sketch, options).regions.size(), 1u);
  // One end beside a joint that is clear: refused too.
  Sketch beside;
  beside.polyline(kSquare).line({10.005, 10}, {20, 20});
  EXPECT_TRUE(has(refusal(beside), "3 ends of curves"));
  const auto found = made(beside);
  ASSERT_EQ(found.marks.size(), 1u);
  EXPECT_EQ(found.marks[0].curve_of_edge, (std::vector<std::uint32_t>{4}));
}

TEST(DrawingRegions, AnOpenChainIsNamedWithItsGap) {
  Sketch sketch;
  sketch.line({0, 0}, {10, 0}).line({10, 0}, {10, 10}).line({10, 10}, {0, 0.5});
  const std::string message = refusal(sketch);
  EXPECT_TRUE(
      has(message,
          "the chain of 3 curves from (0, 0) mm to (0, 0.5) mm does not close: it ends with the LINE at "
          "line 30, layer '0', and the nearest loose end is 0.5 mm away (join tolerance 0.01 mm)"))
      << message;
  DrawingOptions options;
  options.join_tolerance = 0.6;
  EXPECT_EQ(made(sketch, options).gaps.size(), 1u);
  sketch.circle({30, 0}, 2);
  const auto found = made(sketch);
  EXPECT_EQ(found.regions.size(), 1u);
  ASSERT_EQ(found.set_aside.size(), 1u);
  EXPECT_EQ(found.set_aside[0].edges.back().to, (Point{0, 0.5}));
  EXPECT_TRUE(found.notices.empty());
}

TEST(DrawingRegions, CopiesAreDroppedEitherWayRound) {
  Sketch sketch;
  sketch.polyline(kSquare).circle({5, 5}, 2);
  const auto once = made(sketch);
  sketch.line({10, 0}, {0, 0}).line({0, 10.001}, {0, 0.001}).line({3, 10}, {8, 10});
  sketch.add(Edge{EdgeKind::arc_cw, {5, 7}, {5, 7}, {5, 5}}, "CIRCLE");
  sketch.arc({7, 5}, {3, 5}, {5, 5}).arc({5, 7}, {3, 5}, {5, 5.0005}, true);
  auto& drawing = sketch.drawing();
  std::get<Edge>(drawing.curves.back().shape).to = {3, 5.0005};
  const auto twice = made(sketch);
  EXPECT_EQ(twice.regions, once.regions);
  EXPECT_EQ(twice.curve_of_edge, once.curve_of_edge);
  EXPECT_EQ(twice.duplicates, (std::vector<std::uint32_t>{5, 6, 7, 8, 9, 10}));
  EXPECT_GE(twice.moved, 0.001);
  EXPECT_LE(twice.moved, 0.0012);
}

TEST(DrawingRegions, ACopyOfAWholeContourWithOtherCornersIsDropped) {
  Sketch sketch;
  sketch.polyline(kSquare).polyline({{0, 0}, {4, 0}, {10, 0}, {10, 7}, {10, 10}, {2, 10}, {0, 10}, {0, 5}});
  const auto found = made(sketch);
  EXPECT_EQ(found.regions[0].outer.size(), 4u);
  EXPECT_EQ(found.duplicates.size(), 8u);
}

TEST(DrawingRegions, LinesThatOverlapForAPartAreCut) {
  Sketch sketch;
  sketch.line({0, 0}, {6, 0}).line({10, 0}, {4, 0.001}).line({10, 0}, {10, 10}).line({10, 10}, {0, 0});
  const auto found = made(sketch);
  ASSERT_EQ(found.regions[0].outer.size(), 4u);
  EXPECT_EQ(found.regions[0].outer[0].to, (Point{6, 0}));
  EXPECT_EQ(found.regions[0].outer[1].to, (Point{10, 0}));
  EXPECT_EQ(found.duplicates, (std::vector<std::uint32_t>{1}));
  EXPECT_GE(found.moved, 0.0006);
  EXPECT_LE(found.moved, 0.0011);
}

TEST(DrawingRegions, ShortEdgesOfAFineOutlineAreNotCopiesOfTheirNeighbours) {
  // 3,000 lines of 6 micrometres and a tolerance of 10.
  Sketch sketch;
  std::vector<Point> ring;
  for (int i = 0; i < 3000; ++i) {
    const auto [sine, cosine] = geom::sincos(2 * 3.14159265358979323846 * i / 3000);
    ring.push_back({3 * cosine, 3 * sine});
  }
  sketch.polyline(ring);
  const auto found = made(sketch);
  EXPECT_EQ(found.regions[0].outer.size(), 3000u);
  EXPECT_EQ(found.moved, 0);
}

TEST(DrawingRegions, CurvesOfNoLengthAndSpecksAreDropped) {
  Sketch sketch;
  sketch.line({10, 0}, {10, 0}).polyline(kSquare).line({10, 0}, {10.000001, 0}).line({50, 50}, {50.004, 50});
  const auto found = made(sketch);
  EXPECT_EQ(found.regions[0].outer.size(), 4u);
  EXPECT_EQ(found.specks, (std::vector<std::uint32_t>{0, 5, 6}));
  // But a short line that the outline goes along stays.
  Sketch needed;
  needed.line({0, 0}, {10, 0}).line({10, 0}, {10, 0.004}).line({10, 0.004}, {0, 10}).line({0, 10}, {0, 0});
  EXPECT_EQ(made(needed).regions[0].outer.size(), 4u);
  EXPECT_TRUE(made(needed).specks.empty());
  // With gaps on both sides.
  Sketch loose;
  loose.line({0, 0}, {10, 0})
      .line({10.002, 0.002}, {10.002, 0.008})
      .line({10, 0.01}, {0, 10})
      .line({0, 10}, {0, 0});
  EXPECT_EQ(made(loose).regions[0].outer.size(), 4u);
}

TEST(DrawingRegions, ClosedCurvesAloneAreContours) {
  Sketch sketch;
  sketch.circle({0, 0}, 3);
  // 359.9 degrees of a circle: a gap of 0.005 mm.
  const auto [sine, cosine] = geom::sincos(0.001);
  sketch.arc({25, 0}, {20 + 5 * cosine, -5 * sine}, {20, 0});
  sketch.add(EllipseArc{{45, 0}, {45, 0}, {40, 0}, {5, 0}, {0, 2}, 0, 6.283185307179586}, "ELLIPSE");
  const auto found = made(sketch);
  ASSERT_EQ(found.regions.size(), 3u);
  EXPECT_EQ(found.regions[1].outer.size(), 2u);
  EXPECT_NEAR(geom::area(found.regions[2]), 3.14159265358979 * 10, 0.03);
  EXPECT_LE(found.curve_tolerance, 0.001);
}

TEST(DrawingRegions, CrossingsAreNamed) {
  Sketch sketch;
  sketch.polyline(kSquare).layer("HOLES").circle({9, 5}, 2);
  EXPECT_EQ(refusal(sketch),
            "sketch.dxf: the LINE at line 20, layer '0' and the CIRCLE at line 50, layer 'HOLES' cross or "
            "touch at (10, "
            "3.26794919) mm; outlines must be apart");
  Sketch bow;
  bow.polyline({{0, 0}, {10, 10}, {10, 0}, {0, 9}});
  EXPECT_TRUE(has(refusal(bow),
                  "the LINE at line 10, layer '0' and the LINE at line 30, layer '0' cross or touch at "
                  "(4.73684211, 4.73684211) mm"));
  Sketch loop;
  loop.add(Spline{3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0}, {20, 10}, {-10, 10}, {10, 0}}, {}}, "SPLINE")
      .line({10, 0}, {0, 0});
  EXPECT_TRUE(has(refusal(loop), "the SPLINE at line 10, layer '0' crosses or touches itself at"))
      << refusal(loop);
}

TEST(DrawingRegions, ContoursWithoutAreaAreRefused) {
  Sketch sketch;
  sketch.line({0, 0}, {10, 0})
      .line({10, 0}, {4, 3})
      .line({4, 3}, {0, 0})
      .layer("B")
      .arc({20, 0}, {30, 0}, {25, 0});
  sketch.arc({30, 0}, {20, 0}, {25, 1e-4}, false);
  auto& shape = std::get<Edge>(sketch.drawing().curves.back().shape);
  shape.centre = {25, 0};
  // The same arc there and back is a copy, and leaves an open chain.
  EXPECT_TRUE(has(refusal(sketch), "does not close"));
  EXPECT_TRUE(has(refusal(sketch), "dropped: 1 curve that lies on another"));
}

TEST(DrawingRegions, LayersAreTakenAndLeft) {
  Sketch sketch;
  sketch.layer("CUT").polyline(kSquare).layer("Frame", true).polyline({{-5, -5}, {20, -5}, {20, 20}});
  sketch.layer("HOLES").circle({5, 5}, 1);
  auto found = made(sketch);
  EXPECT_EQ(found.regions.size(), 1u);
  EXPECT_EQ(found.regions[0].holes.size(), 1u);
  ASSERT_EQ(found.notices.size(), 1u);
  EXPECT_EQ(found.notices[0], "layers left out: 'Frame' (3 curves, hidden)");
  DrawingOptions options;
  options.take = {"cut"};
  found = made(sketch, options);
  EXPECT_TRUE(found.regions[0].holes.empty());
  options.take = {"FRAME"};
  EXPECT_EQ(made(sketch, options).regions[0].outer.size(), 3u);
  options.take = {};
  options.leave = {"holes"};
  EXPECT_TRUE(made(sketch, options).regions[0].holes.empty());
  options.leave = {"hole"};
  EXPECT_EQ(refusal(sketch, options),
            "sketch.dxf: no curve is on a layer 'hole'; there are 'CUT', 'Frame', 'HOLES'");
}

TEST(DrawingRegions, SaysWhatWasNotRead) {
  Sketch sketch;
  sketch.circle({0, 0}, 1).drawing().unread = {{"HATCH", 2, 77}, {"TEXT", 3, 99}};
  EXPECT_EQ(made(sketch).notices, (std::vector<std::string>{"not read: 2 HATCH, 3 TEXT"}));
  Sketch empty;
  empty.drawing().unread = {{"TEXT", 3, 99}};
  EXPECT_EQ(refusal(empty), "sketch.dxf: there are no curves in the drawing; not read: 3 TEXT");
}

TEST(DrawingRegions, RefusesTolerancesThatAreNone) {
  Sketch sketch;
  sketch.circle({0, 0}, 1);
  DrawingOptions options;
  options.join_tolerance = -1;
  EXPECT_EQ(make_regions(sketch.drawing(), options).error().code, ErrorCode::usage);
  options.join_tolerance = std::nan("");
  EXPECT_EQ(make_regions(sketch.drawing(), options).error().code, ErrorCode::usage);
  options.join_tolerance = 0;
  EXPECT_TRUE(make_regions(sketch.drawing(), options).has_value());
  options.curve_tolerance = 0;
  EXPECT_EQ(make_regions(sketch.drawing(), options).error().code, ErrorCode::usage);
}

TEST(DrawingRegions, RefusesNumbersThatMakeNoCurve) {
  const auto message = [](Shape shape) {
    Sketch sketch;
    sketch.add(std::move(shape), "X");
    return refusal(sketch);
  };
  EXPECT_TRUE(has(message(Edge{EdgeKind::line, {0, 0}, {std::nan(""), 1}, {}}),
                  "the X at line 10, layer '0' cannot be used"));
  EXPECT_TRUE(has(message(Edge{EdgeKind::line, {0, 0}, {1e300, 1}, {}}), "beyond 1000000000 mm"));
  EXPECT_TRUE(has(message(Edge{EdgeKind::arc_ccw, {0, 0}, {1, 1}, {0, 0}}), "its ends are 0 and 1.41"));
  EXPECT_TRUE(has(message(Spline{3, {0, 1}, {{0, 0}}, {}}), "1 poles and 2 knots are no spline of degree 3"));
  EXPECT_TRUE(has(message(Spline{1, {0, 1, 0, 1}, {{0, 0}, {1, 1}}, {}}), "knot 2"));
  EXPECT_TRUE(has(message(Spline{1, {0, 0, 1, 1}, {{0, 0}, {1, 1}}, {1, -1}}), "its weight -1"));
  EXPECT_TRUE(has(message(Spline{1, {0, 0, 1, 1, 2, 2}, {{0, 0}, {1, 1}, {5, 5}, {6, 6}}, {}}),
                  "it jumps from (1, 1) to (5, 5) mm"));
  EXPECT_TRUE(has(message(Spline{16, {}, {}, {}}), "its degree is 16"));
  EXPECT_TRUE(has(message(EllipseArc{{1, 0}, {1, 0}, {0, 0}, {1, 0}, {0, 2}, 0, 7}), "more than a turn"));
}

TEST(DrawingRegions, AnEllipseThatIsACircleStaysAnArc) {
  Sketch sketch;
  sketch.add(EllipseArc{{3, 4}, {-3, -4}, {0, 0}, {3, 4}, {-4, 3}, 0, 3.141592653589793}, "ELLIPSE");
  sketch.line({-3, -4}, {3, 4});
  const auto found = made(sketch);
  EXPECT_EQ(found.regions[0].outer[0], (Edge{EdgeKind::arc_ccw, {3, 4}, {-3, -4}, {0, 0}}));
  EXPECT_LE(found.tolerance, 1e-10);
}

TEST(DrawingRegions, SumsTheTolerancesUpOfEachCurve) {
  Sketch sketch;
  sketch.line({0, 0}, {10, 0})
      .line({10, 0.008}, {10, 10})
      .add(Edge{EdgeKind::line, {10, 10}, {0, 0}, {}}, "LINE", 0.25);
  const auto found = made(sketch);
  EXPECT_EQ(found.coordinate_error, 0.25 * (1 + 0x1p-48));
  EXPECT_NEAR(found.moved, 0.004, 1e-12);
  // No single curve has both.
  EXPECT_NEAR(found.tolerance, 0.25, 1e-12);
  EXPECT_GT(found.tolerance, 0.25);
}

}  // namespace
}  // namespace lekalo::io::io_drawing_regions_test

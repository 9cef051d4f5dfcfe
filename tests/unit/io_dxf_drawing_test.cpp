#include <fmt/core.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "io/drawing/drawn_shapes.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/drawing/drawing.hpp"
#include "lekalo/io/dxf/dxf.hpp"
#include "support/drawn_curves.hpp"

namespace lekalo::io_dxf_drawing_test {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// "0 LINE 8 cut 10 1.5": codes and values in turn, separated by blanks.
std::string groups(const std::string& words) {
  std::string text;
  for (const char c : words) text += c == ' ' ? '\n' : c;
  return text.empty() ? "" : text + "\n";
}

std::string section(const std::string& name, const std::string& words) {
  return groups("0 SECTION 2 " + name) + groups(words) + groups("0 ENDSEC");
}

std::string file_of(const std::string& entities, const std::string& blocks = "",
                    const std::string& header = "", const std::string& tables = "") {
  std::string text;
  if (!header.empty()) text += section("HEADER", header);
  if (!tables.empty()) text += section("TABLES", tables);
  if (!blocks.empty()) text += section("BLOCKS", blocks);
  return text + section("ENTITIES", entities) + groups("0 EOF");
}

io::Drawing read(const std::string& text, std::optional<LengthUnit> unit = std::nullopt) {
  auto drawing = io::parse_dxf(text, "a.dxf", unit);
  EXPECT_TRUE(drawing.has_value()) << drawing.error().message;
  return drawing ? *drawing : io::Drawing{};
}

/// The sentence about an entity that was set aside, which is one and names the file.
std::string set_aside(const std::string& text) {
  const auto drawing = read(text);
  EXPECT_EQ(drawing.damaged.size(), 1U);
  if (drawing.damaged.empty()) return {};
  EXPECT_EQ(drawing.damaged[0].rfind("a.dxf: line ", 0), 0U);
  return drawing.damaged[0];
}

/// The sentence of a refusal, which is one and names the file.
std::string refusal(const std::string& text, std::optional<LengthUnit> unit = std::nullopt) {
  const auto drawing = io::parse_dxf(text, "a.dxf", unit);
  EXPECT_FALSE(drawing.has_value());
  if (drawing) return {};
  EXPECT_EQ(drawing.error().code, ErrorCode::bad_input);
  EXPECT_EQ(drawing.error().message.rfind("a.dxf: ", 0), 0U);
  return drawing.error().message;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::map<std::string, std::size_t> unread(const io::Drawing& drawing) {
  std::map<std::string, std::size_t> counts;
  for (const io::Unread& one : drawing.unread) counts[one.name] = one.count;
  return counts;
}

const Edge& edge(const io::Drawing& drawing, std::size_t i) {
  return std::get<Edge>(drawing.curves.at(i).shape);
}

void expect_near(Point a, Point b, double tolerance = 1e-12) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
}

using Counts = std::map<std::string, std::size_t>;

TEST(IoDxfDrawing, ALineKeepsItsEndsLayerHandleAndPlace) {
  const auto drawing = read(file_of("0 LINE 5 1F 8 cut 10 1.5 20 -2 30 0.0 11 4e0 21 .25 31 0"));
  ASSERT_EQ(drawing.curves.size(), 1U);
  EXPECT_EQ(edge(drawing, 0), (Edge{EdgeKind::line, {1.5, -2}, {4, 0.25}, {}}));
  EXPECT_EQ(drawing.curves[0].error, 0);
  EXPECT_EQ(drawing.layers[0].name, "cut");
  EXPECT_FALSE(drawing.layers[0].hidden);
  EXPECT_EQ(drawing.entities[0].type, "LINE");
  EXPECT_EQ(drawing.entities[0].handle, "1F");
  EXPECT_EQ(drawing.entities[0].line, 6U);
  EXPECT_TRUE(drawing.unread.empty());
}

TEST(IoDxfDrawing, DecimalsThatAreNoDoublesHaveAnError) {
  const auto drawing = read(file_of("0 LINE 8 0 10 0.1 20 0 11 1 21 0"));
  EXPECT_GT(drawing.curves[0].error, 0);
  EXPECT_LT(drawing.curves[0].error, 2e-17);
}

TEST(IoDxfDrawing, ACircleBeginsOnTheRightAndIsExactWhereItsNumbersAre) {
  const auto drawing = read(file_of("0 CIRCLE 8 0 10 3 20 4 40 2.5"));
  EXPECT_EQ(edge(drawing, 0), (Edge{EdgeKind::arc_ccw, {5.5, 4}, {5.5, 4}, {3, 4}}));
  EXPECT_EQ(drawing.curves[0].error, 0);
}

TEST(IoDxfDrawing, AnArcRunsCounterClockwiseFromBeginToEnd) {
  const auto quarter = read(file_of("0 ARC 8 0 10 1 20 1 40 2 50 270 51 0"));
  EXPECT_EQ(edge(quarter, 0), (Edge{EdgeKind::arc_ccw, {1, -1}, {3, 1}, {1, 1}}));
  EXPECT_EQ(quarter.curves[0].error, 0);
  const auto slanted = read(file_of("0 ARC 8 0 10 0 20 0 40 10 50 30 51 60"));
  expect_near(edge(slanted, 0).from, {10 * std::cos(M_PI / 6), 5});
  expect_near(edge(slanted, 0).to, {5, 10 * std::cos(M_PI / 6)});
  EXPECT_LT(slanted.curves[0].error, 1e-13);
  EXPECT_GT(slanted.curves[0].error, 0);
}

TEST(IoDxfDrawing, AnArcOfAWholeTurnIsACircle) {
  for (const char* angles : {"50 0 51 360", "50 90 51 90", "50 -180 51 180"}) {
    const auto drawing = read(file_of(std::string("0 ARC 8 0 10 0 20 0 40 10 ") + angles));
    EXPECT_EQ(edge(drawing, 0).from, edge(drawing, 0).to) << angles;
    EXPECT_NEAR(drawn::integrals(drawing.curves[0].shape).length, 20 * M_PI, 1e-9);
  }
}

TEST(IoDxfDrawing, ArcsShorterThanRoundingAreLinesAndNotWholeTurns) {
  const auto drawing = read(file_of("0 ARC 8 0 10 1000 20 0 40 1 50 45 51 45.00000000000001"));
  for (const auto& curve : drawing.curves) EXPECT_LT(drawn::integrals(curve.shape).length, 1e-9);
}

TEST(IoDxfDrawing, AnEllipseKeepsItsParametersAndEnds) {
  const auto drawing =
      read(file_of("0 ELLIPSE 8 0 10 1 20 2 30 0 11 4 21 0 31 0 40 0.5 41 0 42 1.5707963267948966"));
  const auto& arc = std::get<io::EllipseArc>(drawing.curves.at(0).shape);
  EXPECT_EQ(arc.centre, (Point{1, 2}));
  EXPECT_EQ(arc.u, (Point{4, 0}));
  EXPECT_EQ(arc.v, (Point{0, 2}));
  expect_near(arc.from, {5, 2});
  expect_near(arc.to, {1, 4});
  EXPECT_LT(drawing.curves[0].error, 1e-13);
}

TEST(IoDxfDrawing, WholeEllipsesCloseHoweverManyDigitsTheirTurnHas) {
  for (const char* end :
       {"6.283185", "6.28318530717958", "6.283185307179586", "6.283185307179587", "6.2831854"}) {
    const auto drawing =
        read(file_of(std::string("0 ELLIPSE 8 0 10 1 20 2 11 4 21 0 40 0.5 41 0.0 42 ") + end));
    const auto& arc = std::get<io::EllipseArc>(drawing.curves.at(0).shape);
    EXPECT_EQ(arc.from, arc.to) << end;
    EXPECT_EQ(arc.end - arc.begin, 2 * kPi) << end;
  }
}

TEST(IoDxfDrawing, AnEllipseSeenFromBelowRunsTheOtherWay) {
  const auto drawing =
      read(file_of("0 ELLIPSE 8 0 10 1 20 2 11 4 21 0 40 0.5 41 0 42 1.5707963267948966 210 0 220 0 230 -1"));
  const auto& arc = std::get<io::EllipseArc>(drawing.curves.at(0).shape);
  expect_near(arc.from, {5, 2});
  expect_near(arc.to, {1, 0});
}

TEST(IoDxfDrawing, AnEllipseWithEqualAxesIsACircle) {
  const auto drawing = read(file_of("0 ELLIPSE 8 0 10 1 20 2 11 3 21 4 40 1"));
  EXPECT_EQ(edge(drawing, 0).kind, EdgeKind::arc_ccw);
  EXPECT_NEAR(drawn::integrals(drawing.curves[0].shape).length, 10 * M_PI, 1e-9);
}

TEST(IoDxfDrawing, BulgesCountAlsoOnTheLastVertexOfAClosedPolyline) {
  const std::string vertices = "10 0 20 0 42 1 10 10 20 0 42 1";
  const auto closed = read(file_of("0 LWPOLYLINE 8 0 90 2 70 1 " + vertices));
  ASSERT_EQ(closed.curves.size(), 2U);
  EXPECT_EQ(edge(closed, 0), (Edge{EdgeKind::arc_ccw, {0, 0}, {10, 0}, {5, 0}}));
  EXPECT_EQ(edge(closed, 1), (Edge{EdgeKind::arc_ccw, {10, 0}, {0, 0}, {5, 0}}));
  EXPECT_EQ(closed.curves[0].error, 0);
  EXPECT_EQ(closed.curves[0].entity, closed.curves[1].entity);
  const auto open = read(file_of("0 LWPOLYLINE 8 0 90 2 70 0 " + vertices));
  EXPECT_EQ(open.curves.size(), 1U);
}

TEST(IoDxfDrawing, OldPolylinesAreReadLikeNewOnes) {
  const std::string vertices =
      "0 VERTEX 8 x 10 0 20 0 42 0.5 0 VERTEX 8 x 10 10 20 0 0 VERTEX 8 x 10 10 20 5 42 -1 0 SEQEND 8 x";
  const auto old_one = read(file_of("0 POLYLINE 8 0 66 1 70 1 10 0 20 0 30 0 " + vertices));
  const auto new_one =
      read(file_of("0 LWPOLYLINE 8 0 90 3 70 1 10 0 20 0 42 0.5 10 10 20 0 10 10 20 5 42 -1"));
  ASSERT_EQ(old_one.curves.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(edge(old_one, i), edge(new_one, i));
  EXPECT_EQ(old_one.layers[0].name, "0") << "the layer is that of the POLYLINE";
}

TEST(IoDxfDrawing, FramePointsOfFittedPolylinesAreSkippedAndFittedPointsAreNot) {
  const auto drawing =
      read(file_of("0 POLYLINE 8 0 66 1 70 4 75 6 0 VERTEX 8 0 10 0 20 99 70 16 0 VERTEX 8 0 10 0 20 0 70 8 "
                   "0 VERTEX 8 0 10 1 20 1 "
                   "70 8 0 VERTEX 8 0 10 50 20 99 70 16 0 VERTEX 8 0 10 2 20 1 70 9 0 SEQEND"));
  ASSERT_EQ(drawing.curves.size(), 2U);
  EXPECT_EQ(edge(drawing, 1), (Edge{EdgeKind::line, {1, 1}, {2, 1}, {}}));
}

TEST(IoDxfDrawing, PolylinesInSpaceAreStraightAndMeshesAreNamed) {
  const auto drawing = read(file_of(
      "0 POLYLINE 8 0 70 9 0 VERTEX 10 0 20 0 30 5 42 1 0 VERTEX 10 3 20 0 0 VERTEX 10 3 20 4 0 SEQEND "
      "0 POLYLINE 8 0 70 64 0 VERTEX 10 0 20 0 70 192 0 VERTEX 10 0 20 0 30 0 70 128 71 1 0 SEQEND"));
  ASSERT_EQ(drawing.curves.size(), 3U);
  EXPECT_EQ(edge(drawing, 2).kind, EdgeKind::line);
  EXPECT_EQ(unread(drawing), (Counts{{"POLYLINE (mesh)", 1}}));
  EXPECT_TRUE(holds(drawing.notices.back(), "z coordinates are ignored"));
}

TEST(IoDxfDrawing, RepeatedPointsMakeNoCurves) {
  const auto drawing = read(file_of(
      "0 LWPOLYLINE 8 0 90 4 70 1 10 0 20 0 10 0 20 0 10 1 20 0 10 0 20 0 0 LWPOLYLINE 8 0 90 1 70 1 10 5 "
      "20 5 0 LINE 8 0 10 1 20 1 30 0 11 1 21 1 31 7"));
  EXPECT_EQ(drawing.curves.size(), 2U);
  EXPECT_EQ(unread(drawing), (Counts{{"LINE (of no length)", 1}, {"LWPOLYLINE (of no length)", 1}}));
}

TEST(IoDxfDrawing, SplinesKeepKnotsPolesAndWeights) {
  const auto drawing =
      read(file_of("0 SPLINE 8 0 70 4 71 2 72 6 73 3 40 0 40 0 40 0 40 1 40 1 40 1 41 1 41 0.5 41 1 10 0 20 "
                   "0 10 1 20 2 10 2 20 0"));
  const auto& spline = std::get<io::Spline>(drawing.curves.at(0).shape);
  EXPECT_EQ(spline.degree, 2U);
  EXPECT_EQ(spline.knots, (std::vector<double>{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(spline.weights, (std::vector<double>{1, 0.5, 1}));
  EXPECT_EQ(spline.poles, (std::vector<Point>{{0, 0}, {1, 2}, {2, 0}}));
  EXPECT_EQ(drawing.curves[0].error, 0);
}

TEST(IoDxfDrawing, EqualWeightsSayNothing) {
  const auto drawing =
      read(file_of("0 SPLINE 8 0 71 1 40 0 40 0 40 1 40 1 41 0.7 41 0.7 10 0 20 0 10 1 20 2"));
  EXPECT_TRUE(std::get<io::Spline>(drawing.curves.at(0).shape).weights.empty());
}

TEST(IoDxfDrawing, SplinesThatCannotBeReadAreNamed) {
  const std::string poles = "10 0 20 0 10 1 20 2 10 2 20 0 ";
  const auto drawing = read(file_of("0 SPLINE 8 0 71 2 " + poles +
                                    "0 SPLINE 8 0 71 2 40 0 40 0 40 0 40 1 40 1 40 1 41 1 41 0 41 1 " +
                                    poles + "0 SPLINE 8 0 71 2 40 1 40 1 40 1 40 1 40 1 40 1 " + poles +
                                    "0 SPLINE 8 0 71 1 40 0 40 0 40 1 40 1 40 1 40 2 40 2 "
                                    "10 0 20 0 10 1 20 0 10 2 20 0 10 3 20 0 10 4 20 0"));
  EXPECT_TRUE(drawing.curves.empty());
  EXPECT_EQ(unread(drawing), (Counts{{"SPLINE (without knots)", 1},
                                     {"SPLINE (a weight not above 0)", 1},
                                     {"SPLINE (of no length)", 1},
                                     {"SPLINE (in pieces)", 1}}));
}

const std::string kArrow =
    "0 BLOCK 8 0 2 Arrow 70 0 10 1 20 1 30 0 0 LINE 8 0 10 1 20 1 11 3 21 1 0 ARC 8 tip 10 1 20 1 40 1 50 0 "
    "51 90 0 "
    "ENDBLK";

TEST(IoDxfDrawing, InsertsMoveTurnScaleAndMirrorABlock) {
  const auto drawing = read(file_of("0 INSERT 8 cut 2 ARROW 10 10 20 20 41 -2 42 2 50 90", kArrow));
  ASSERT_EQ(drawing.curves.size(), 2U);
  // (2, 0) from the base point -> scaled (-4, 0) -> turned (0, -4).
  EXPECT_EQ(edge(drawing, 0), (Edge{EdgeKind::line, {10, 20}, {10, 16}, {}}));
  EXPECT_EQ(edge(drawing, 1).kind, EdgeKind::arc_cw);
  EXPECT_EQ(edge(drawing, 1).from, (Point{10, 18}));
  EXPECT_EQ(edge(drawing, 1).to, (Point{8, 20}));
  EXPECT_EQ(edge(drawing, 1).centre, (Point{10, 20}));
  EXPECT_EQ(drawing.curves[0].error, 0) << "quarter turns and doublings are exact";
  EXPECT_EQ(drawing.layers[drawing.curves[0].layer].name, "cut")
      << "layer 0 of a block is that of the INSERT";
  EXPECT_EQ(drawing.layers[drawing.curves[1].layer].name, "tip");
}

TEST(IoDxfDrawing, UnequalScalesMakeEllipsesOfCircles) {
  const auto drawing = read(file_of("0 INSERT 8 0 2 Arrow 10 0 20 0 41 3 42 1", kArrow));
  const auto& arc = std::get<io::EllipseArc>(drawing.curves.at(1).shape);
  expect_near(arc.from, {3, 0});
  expect_near(arc.to, {0, 1});
  EXPECT_EQ(arc.centre, (Point{0, 0}));
  EXPECT_LT(drawing.curves[1].error, 1e-13);
}

TEST(IoDxfDrawing, ArraysStepAlongTurnedAxesUnscaled) {
  const auto drawing =
      read(file_of("0 INSERT 8 0 2 Arrow 10 10 20 0 41 2 42 2 50 90 70 2 71 3 44 5 45 7", kArrow));
  ASSERT_EQ(drawing.curves.size(), 12U);
  EXPECT_EQ(edge(drawing, 0).from, (Point{10, 0}));
  EXPECT_EQ(edge(drawing, 2).from, (Point{10, 5})) << "columns first, along the turned x axis";
  EXPECT_EQ(edge(drawing, 4).from, (Point{3, 0})) << "then rows, along the turned y axis";
  EXPECT_EQ(edge(drawing, 0).to, (Point{10, 4}));
}

TEST(IoDxfDrawing, NestedBlocksComposeAndLayerZeroFallsThrough) {
  const auto drawing = read(file_of(
      "0 LINE 8 a 10 0 20 0 11 1 21 0 0 INSERT 8 cut 2 outer 10 100 20 0 0 LINE 8 b 10 0 20 0 11 1 21 0",
      kArrow +
          " 0 BLOCK 2 OUTER 10 0 20 0 0 INSERT 8 0 2 arrow 10 5 20 0 50 180 0 INSERT 8 own 2 arrow 10 0 20 "
          "0 0 ENDBLK"));
  ASSERT_EQ(drawing.curves.size(), 6U);
  EXPECT_EQ(edge(drawing, 1).from, (Point{105, 0}));
  EXPECT_EQ(edge(drawing, 1).to, (Point{103, 0}));
  std::vector<std::string> layers;
  for (const auto& curve : drawing.curves) layers.push_back(drawing.layers[curve.layer].name);
  EXPECT_EQ(layers, (std::vector<std::string>{"a", "cut", "tip", "own", "tip", "b"})) << "in file order";
}

TEST(IoDxfDrawing, MirroredPlanesAreExact) {
  const std::string below = " 210 0 220 0 230 -1";
  const auto drawing =
      read(file_of("0 CIRCLE 8 0 10 3 20 4 40 1" + below + " 0 ARC 8 0 10 0 20 0 40 2 50 0 51 90" + below +
                       " 0 LWPOLYLINE 8 0 90 2 10 1 20 0 42 1 10 3 20 0" + below +
                       " 0 LINE 8 0 10 1 20 2 11 3 21 4" + below + " 0 INSERT 8 0 2 Arrow 10 10 20 0" + below,
                   kArrow));
  ASSERT_EQ(drawing.curves.size(), 6U);
  EXPECT_EQ(edge(drawing, 0).centre, (Point{-3, 4}));
  EXPECT_EQ(edge(drawing, 1), (Edge{EdgeKind::arc_cw, {-2, 0}, {0, 2}, {0, 0}}));
  EXPECT_EQ(edge(drawing, 2), (Edge{EdgeKind::arc_cw, {-1, 0}, {-3, 0}, {-2, 0}}));
  EXPECT_EQ(edge(drawing, 3), (Edge{EdgeKind::line, {1, 2}, {3, 4}, {}}))
      << "a LINE's ends are not in its plane";
  EXPECT_EQ(edge(drawing, 4), (Edge{EdgeKind::line, {-10, 0}, {-12, 0}, {}}));
  for (const auto& curve : drawing.curves) EXPECT_EQ(curve.error, 0);
}

TEST(IoDxfDrawing, WhatIsSeenFromTheSideIsNamed) {
  const std::string tilted = " 210 0.6 220 0 230 0.8 ";
  const auto drawing = read(file_of(
      "0 CIRCLE 8 0 10 0 20 0 40 1" + tilted + "0 ARC 8 0 10 0 20 0 40 1 50 0 51 90" + tilted +
          "0 LWPOLYLINE 8 0 90 2 10 0 20 0 10 1 20 0" + tilted + "0 POLYLINE 8 0" + tilted +
          "0 VERTEX 10 0 20 0 0 VERTEX 10 1 20 0 0 SEQEND 0 INSERT 8 0 2 Arrow 10 0 20 0" + tilted +
          "0 ELLIPSE 8 0 10 0 20 0 11 1 21 0 31 1 40 0.5 0 CIRCLE 8 0 10 0 20 0 40 1 210 0 220 0 230 0",
      kArrow));
  EXPECT_TRUE(drawing.curves.empty());
  EXPECT_EQ(unread(drawing), (Counts{{"CIRCLE (tilted)", 2},
                                     {"ARC (tilted)", 1},
                                     {"LWPOLYLINE (tilted)", 1},
                                     {"POLYLINE (tilted)", 1},
                                     {"INSERT (tilted)", 1},
                                     {"ELLIPSE (tilted)", 1}}));
}

TEST(IoDxfDrawing, DirectionsWithRoundingAreNotTilted) {
  const auto drawing = read(file_of("0 CIRCLE 8 0 10 5 20 0 30 100 40 1 210 1e-12 220 0 230 1"));
  ASSERT_EQ(drawing.curves.size(), 1U);
  EXPECT_GE(drawing.curves[0].error, 1e-10) << "its height of 100 moves it by 1e-10";
  EXPECT_LT(drawing.curves[0].error, 2e-9);
}

TEST(IoDxfDrawing, FrozenAndSwitchedOffLayersAreHidden) {
  const auto drawing =
      read(file_of("0 LINE 8 ICE 10 0 20 0 11 1 21 0 0 LINE 8 off 10 0 20 0 11 1 21 0 0 LINE 8 on 10 0 "
                   "20 0 11 1 21 0 0 LINE 8 unlisted 10 0 20 0 11 1 21 0 0 INSERT 8 ice 2 Arrow 10 0 "
                   "20 0 0 INSERT 8 off 2 Arrow 10 0 20 0",
                   kArrow, "",
                   "0 TABLE 2 LAYER 70 3 0 LAYER 2 Ice 70 1 62 7 0 LAYER 2 Off 70 0 62 -7 0 LAYER 2 On "
                   "70 64 62 1 0 LAYER 2 tip 70 0 62 1 0 ENDTAB"));
  ASSERT_EQ(drawing.curves.size(), 8U);
  std::vector<bool> hidden;
  for (const auto& curve : drawing.curves) hidden.push_back(drawing.layers[curve.layer].hidden);
  // What is inserted on a frozen layer is not seen, whatever its own layer; on one switched off only its
  // layer 0 is not.
  EXPECT_EQ(hidden, (std::vector<bool>{true, true, false, false, true, true, true, false}));
  EXPECT_EQ(drawing.layers[0].name, "Ice") << "as the table spells it";
}

TEST(IoDxfDrawing, PaperSpaceAndInvisibleEntitiesAreNamed) {
  const auto drawing =
      read(file_of("0 LINE 67 1 8 0 10 0 20 0 11 1 21 0 0 LINE 60 1 8 0 10 0 20 0 11 1 21 0 0 VIEWPORT "
                   "67 1 8 0 10 1 20 1 40 12 41 9"));
  EXPECT_TRUE(drawing.curves.empty());
  EXPECT_EQ(unread(drawing),
            (Counts{{"LINE (paper space)", 1}, {"LINE (invisible)", 1}, {"VIEWPORT (paper space)", 1}}));
}

TEST(IoDxfDrawing, UnknownEntitiesAreCountedWithTheirCopies) {
  const auto drawing =
      read(file_of("0 TEXT 8 0 10 0 20 0 1 hello 0 INSERT 8 0 2 Note 10 0 20 0 70 3 71 2 44 1 45 1 66 "
                   "1 0 ATTRIB 8 0 10 0 20 0 1 A 0 SEQEND 8 0 0 INSERT 8 0 2 missing 10 0 20 0",
                   "0 BLOCK 2 Note 10 0 20 0 0 TEXT 8 0 10 0 20 0 0 HATCH 8 0 10 0 20 0 0 ENDBLK"));
  EXPECT_EQ(unread(drawing), (Counts{{"TEXT (of no height)", 7},
                                     {"HATCH", 6},
                                     {"ATTRIB (of no height)", 1},
                                     {"INSERT (of a block that is not in the file)", 1}}));
}

TEST(IoDxfDrawing, BlocksMayStandBehindTheEntities) {
  const auto drawing =
      read(section("ENTITIES", "0 INSERT 8 0 2 Arrow 10 5 20 0") + section("BLOCKS", kArrow));
  ASSERT_EQ(drawing.curves.size(), 2U);
  EXPECT_EQ(edge(drawing, 0).from, (Point{5, 0}));
}

TEST(IoDxfDrawing, ABlockWithoutCopiesCountsForNothing) {
  const auto drawing =
      read(file_of("0 LINE 8 0 10 0 20 0 11 1 21 0", kArrow + " 0 BLOCK 2 N 10 0 20 0 0 TEXT 8 0 0 "
                                                              "ENDBLK"));
  EXPECT_EQ(drawing.curves.size(), 1U);
  EXPECT_EQ(drawing.entities.size(), 1U);
  EXPECT_TRUE(drawing.unread.empty());
}

TEST(IoDxfDrawing, UnitsScaleDecimalsExactly) {
  const std::string line = "0 LINE 8 0 10 0 20 0 11 1.1 21 0";
  const auto with = [&](const char* unit) {
    return read(file_of(line, "", fmt::format("9 $INSUNITS 70 {}", unit)));
  };
  EXPECT_EQ(edge(with("1"), 0).to.x, 27.94);
  EXPECT_EQ(edge(with("2"), 0).to.x, 335.28);
  EXPECT_EQ(edge(with("4"), 0).to.x, 1.1);
  EXPECT_EQ(edge(with("5"), 0).to.x, 11);
  EXPECT_EQ(with("5").curves[0].error, 0) << "11 mm is a double, 1.1 cm need not be";
  EXPECT_EQ(edge(with("6"), 0).to.x, 1100);
  EXPECT_EQ(edge(with("9"), 0).to.x, 0.02794);
  EXPECT_EQ(edge(with("13"), 0).to.x, 0.0011);
  EXPECT_EQ(with("5").unit, "cm");
  EXPECT_EQ(with("1").millimetres_per_unit, 25.4);
  EXPECT_EQ(edge(with("0"), 0).to.x, 1.1);
  EXPECT_TRUE(holds(with("0").notices.at(0), "does not say its unit"));
  EXPECT_EQ(edge(read(file_of(line), LengthUnit::inch), 0).to.x, 27.94);
}

TEST(IoDxfDrawing, UnitsThatContradictOrCannotBeReadAreRefused) {
  const auto with = [](const char* unit, std::optional<LengthUnit> asked) {
    return refusal(file_of("0 LINE 8 0 10 0 20 0 11 1 21 0", "", fmt::format("9 $INSUNITS 70 {}", unit)),
                   asked);
  };
  EXPECT_TRUE(holds(with("1", LengthUnit::millimetre), "says inch, but mm was asked for"));
  EXPECT_TRUE(holds(with("21", std::nullopt), "US survey feet"));
  EXPECT_TRUE(holds(with("99", std::nullopt), "'99'"));
}

TEST(IoDxfDrawing, LayerNamesBecomeUtf8) {
  const auto name = [](const std::string& raw, const std::string& header) {
    const auto drawing = read(file_of("0 LINE 8 " + raw + " 10 0 20 0 11 1 21 0", "", header));
    return drawing.layers.at(0).name;
  };
  EXPECT_EQ(name("\xd0\xe5\xe7", "9 $ACADVER 1 AC1009 9 $DWGCODEPAGE 3 ANSI_1251"), "Рез");
  EXPECT_EQ(name("\x90\xa5\xa7", "9 $DWGCODEPAGE 3 dos866"), "Рез");
  EXPECT_EQ(name("\x90\xd8", "9 $DWGCODEPAGE 3 ANSI_932"), "切") << "pairs of bytes";
  EXPECT_EQ(name("\xe9t\xe9", ""), "été");
  EXPECT_EQ(name("Рез", "9 $ACADVER 1 AC1032 9 $DWGCODEPAGE 3 ANSI_1252"), "Рез");
  EXPECT_EQ(name("Рез", "9 $DWGCODEPAGE 3 ANSI_1252"), "Рез") << "UTF-8 whatever the header says";
  EXPECT_EQ(name("\\U+0420\\U+0435\\U+0437", "9 $DWGCODEPAGE 3 ANSI_1252"), "Рез");
  EXPECT_EQ(name("a\\U+d800b", ""), "a\\U+d800b") << "no letter";
  EXPECT_EQ(name("a\x01", ""), "a\\x01");
}

TEST(IoDxfDrawing, CommentsBlanksLineEndsAndAMissingEofDoNotMatter) {
  const std::string plain = file_of("0 LINE 8 0 10 1 20 2 11 3 21 4 0 CIRCLE 8 0 10 0 20 0 40 1");
  const auto wanted = read(plain);
  std::string dos, padded = "\xef\xbb\xbf  999\n  a comment\n", commented;
  bool is_code = true;
  for (std::size_t at = 0; at < plain.size();) {
    const std::size_t end = plain.find('\n', at);
    const std::string line = plain.substr(at, end - at);
    dos += line + "\r\n";
    padded += is_code ? fmt::format("{:>3}\n", line) : "  " + line + " \t\n";
    if (is_code) commented += "999\nnot me\n";
    commented += line + "\n";
    is_code = !is_code;
    at = end + 1;
  }
  const std::string no_eof = plain.substr(0, plain.find("0\nEOF"));
  for (const std::string& text :
       {dos, padded, commented, no_eof, plain.substr(0, plain.size() - 1), plain + "\n\r\n\x1a"}) {
    const auto drawing = read(text);
    ASSERT_EQ(drawing.curves.size(), 2U) << text;
    EXPECT_EQ(edge(drawing, 0), edge(wanted, 0));
    EXPECT_EQ(edge(drawing, 1), edge(wanted, 1));
  }
}

TEST(IoDxfDrawing, GroupsOfApplicationsAndExtendedDataAreNotTheEntitys) {
  const auto drawing =
      read(file_of("0 CIRCLE 5 A 102 {ACAD_REACTORS 330 1 40 99 102 } 100 AcDbEntity 8 0 10 1 20 2 40 3 "
                   "1001 APP 1010 7 1020 8 1040 9"));
  EXPECT_EQ(edge(drawing, 0).from.x, 4);
}

TEST(IoDxfDrawing, OtherKindsOfFilesAreRefusedByName) {
  using namespace std::string_literals;
  EXPECT_TRUE(holds(refusal("%PDF-1.4\n"), "PDF"));
  EXPECT_TRUE(holds(refusal("AC1032\0\0\0\0\0"s), "DWG"));
  EXPECT_TRUE(holds(refusal("\xff\xfe 0\0"s), "UTF-16"));
  EXPECT_TRUE(holds(refusal(""), "empty"));
  EXPECT_TRUE(holds(refusal("<svg/>\n"), "not a DXF group code"));
  EXPECT_TRUE(holds(refusal("0\nEOF\n"), "no section ENTITIES"));
}

TEST(IoDxfDrawing, FilesCutAnywhereInTheEntitiesAreRefused) {
  const std::string whole = file_of(
      "0 LWPOLYLINE 8 0 90 2 70 1 10 0 20 0 10 1 20 0 0 POLYLINE 8 0 0 VERTEX 10 0 20 0 0 "
      "VERTEX 10 1 20 0 0 SEQEND 0 INSERT 2 Arrow 10 0 20 0 0 ARC 8 0 10 0 20 0 40 1 50 0 "
      "51 90 0 SPLINE 8 0 71 1 40 0 40 0 40 1 40 1 10 0 20 0 10 1 20 0 0 TEXT 8 0",
      kArrow, "9 $INSUNITS 70 4", "0 TABLE 2 LAYER 0 LAYER 2 a 70 0 0 ENDTAB");
  const std::size_t end = whole.rfind("ENDSEC");
  for (std::size_t length = 1; length <= end; ++length) refusal(whole.substr(0, length));
  EXPECT_EQ(read(whole).curves.size(), 7U);
}

TEST(IoDxfDrawing, DamagedEntitiesAreSetAsideWithLineAndNumber) {
  const auto about = [](const std::string& entities) {
    // The neighbours of a damaged entity are read.
    return set_aside(
        file_of("0 LINE 8 0 10 0 20 0 11 1 21 0 " + entities + " 0 LINE 8 0 10 0 20 0 11 1 21 0"));
  };
  EXPECT_TRUE(holds(about("0 LINE 8 0 10 1 20 1 11 2"), "has no group 21"));
  EXPECT_TRUE(holds(about("0 LINE 8 0 10 1 20 one 11 2 21 2"), "line 24: 'one' is not a number"));
  EXPECT_TRUE(holds(about("0 LINE 8 0 10 nan 20 0 11 2 21 2"), "not a finite number"));
  EXPECT_TRUE(holds(about("0 LINE 8 0 10 1e10 20 0 11 2 21 2"), "out of range"));
  EXPECT_TRUE(holds(about("0 LINE 8 0 10 1 10 2 20 0 11 2 21 2"), "group 10 twice"));
  EXPECT_TRUE(holds(about("0 CIRCLE 8 0 10 9e8 20 0 40 2e8"), "reaches beyond"));
  EXPECT_TRUE(holds(about("0 LWPOLYLINE 8 0 90 3 10 0 20 0 10 1 20 0"), "says it has 3 vertices, but has 2"));
  EXPECT_TRUE(holds(about("0 LWPOLYLINE 8 0 10 0 10 1 20 0"), "an x, but the one before has no y"));
  EXPECT_TRUE(holds(about("0 LWPOLYLINE 8 0 20 0 10 1"), "a y without its x"));
  EXPECT_TRUE(holds(about("0 LWPOLYLINE 8 0 10 0 20 0 10 1"), "an x without its y"));
  EXPECT_TRUE(holds(about("0 LWPOLYLINE 8 0 10 0 20 0 42 1e9 10 100 20 0"), "bulge that reaches beyond"));
  EXPECT_TRUE(
      holds(about("0 SPLINE 8 0 71 2 72 5 73 3 40 0 40 0 40 0 40 1 40 1 10 0 20 0 10 1 20 2 10 2 20 0"),
            "has 5 knots, 3 control points"));
  EXPECT_TRUE(
      holds(about("0 SPLINE 8 0 71 1 40 0 40 1 40 0 40 1 10 0 20 0 10 1 20 2"), "below the one before"));
  EXPECT_TRUE(holds(about("0 INSERT 8 0 10 0 20 0"), "no block name"));
  EXPECT_TRUE(holds(about("0 INSERT 8 0 2 A 10 0 20 0 70 1.5"), "a whole number is wanted"));
  EXPECT_TRUE(holds(refusal(file_of("5 1")), "an entity is wanted here"));
  EXPECT_TRUE(holds(refusal(section("ENTITIES", "") + section("ENTITIES", "")), "second section ENTITIES"));
  EXPECT_TRUE(
      holds(refusal(section("ENTITIES", "") + section("HEADER", "9 $INSUNITS 70 1")), "behind the entities"));
}

TEST(IoDxfDrawing, NothingOfADamagedEntityCounts) {
  const auto drawing = read(
      file_of("0 LINE 8 0 10 0 20 0 11 1 21 0 0 LWPOLYLINE 8 0 10 0 20 0 10 1 20 0 42 1e9 10 100 20 0 "
              "0 POLYLINE 8 0 0 VERTEX 8 0 10 0 20 0 0 VERTEX 8 0 10 x 20 0 0 VERTEX 8 0 10 5 20 0 0 SEQEND "
              "0 CIRCLE 8 0 10 0 20 0 40 1"));
  ASSERT_EQ(drawing.curves.size(), 2U);
  EXPECT_EQ(drawing.entities.at(drawing.curves[1].entity).type, "CIRCLE");
  EXPECT_EQ(unread(drawing), (Counts{{"LWPOLYLINE (damaged)", 1}, {"POLYLINE (damaged)", 1}}));
  EXPECT_EQ(drawing.damaged.size(), 2U);
}

/// The same groups as a binary file, with codes of one byte or of two.
std::string binary_of(const std::string& text, bool long_codes) {
  using namespace std::string_literals;
  std::string bytes = "AutoCAD Binary DXF\r\n\x1a\0"s;
  std::istringstream in(text);
  std::string code_line, value;
  const auto put = [&](std::uint64_t bits, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(bits >> (8 * i) & 0xff);
  };
  while (std::getline(in, code_line) && std::getline(in, value)) {
    const int code = std::stoi(code_line);
    if (!long_codes && code >= 255) bytes += '\xff';
    put(static_cast<std::uint64_t>(code), long_codes || code >= 255 ? 2 : 1);
    const bool real = (code >= 10 && code < 60) || (code >= 210 && code < 240);
    const bool is_short = (code >= 60 && code < 80) || (code >= 170 && code < 180);
    if (real) {
      put(std::bit_cast<std::uint64_t>(std::stod(value)), 8);
    } else if (is_short || code == 90 || code == 420) {
      put(static_cast<std::uint64_t>(std::stoll(value)), is_short ? 2 : 4);
    } else {
      bytes += value + '\0';
    }
  }
  return bytes;
}

TEST(IoDxfDrawing, ABinaryFileIsReadAsItsText) {
  const std::string text = file_of(
      "0 LINE 8 cut 62 1 10 0.1 20 -2.5e-7 11 3 21 4 0 CIRCLE 8 0 420 255 10 0 20 0 40 1.25 210 0 220 0 230 "
      "-1 "
      "0 LWPOLYLINE 8 0 90 2 70 1 10 0 20 0 42 1 10 1 20 0 0 INSERT 2 Arrow 10 5 20 6",
      kArrow, "9 $INSUNITS 70 4", "0 TABLE 2 LAYER 0 LAYER 2 cut 70 0 62 3 6 DASHED 0 ENDTAB");
  const io::Drawing wanted = read(text);
  for (const bool long_codes : {false, true}) {
    const std::string bytes = binary_of(text, long_codes);
    const io::Drawing drawing = read(bytes);
    ASSERT_EQ(drawing.curves.size(), wanted.curves.size());
    for (std::size_t i = 0; i < wanted.curves.size(); ++i) EXPECT_EQ(edge(drawing, i), edge(wanted, i));
    EXPECT_EQ(drawing.layers.at(0).colour, "#ff0000");
    EXPECT_EQ(drawing.layers.at(0).line_type, "DASHED");
    EXPECT_EQ(drawing.unit, "mm");
    for (std::size_t cut = 23; cut + 6 < bytes.size(); ++cut) refusal(bytes.substr(0, cut));
  }
}

TEST(IoDxfDrawing, SplinesByFitPointsAreCubicsThroughThem) {
  const auto drawing = read(file_of(
      "0 SPLINE 8 0 71 3 74 3 11 0 21 0 11 10 21 0 11 20 21 10 0 SPLINE 8 0 71 3 74 2 11 0 21 0 11 4 21 0 "
      "12 0 22 5 13 0 23 -5 0 SPLINE 8 0 71 3 74 2 11 1 21 1 11 1 21 1"));
  ASSERT_EQ(drawing.curves.size(), 2U);
  const auto& through = std::get<io::Spline>(drawing.curves[0].shape);
  EXPECT_EQ(through.degree, 3U);
  ASSERT_EQ(through.poles.size(), 7U);
  EXPECT_EQ(through.poles[0], (Point{0, 0}));
  EXPECT_EQ(through.poles[3], (Point{10, 0}));
  EXPECT_EQ(through.poles[6], (Point{20, 10}));
  // The second derivative is 0 at the ends and the same on both sides of the middle, by parameter.
  const double h = std::sqrt(200.0);
  const auto bend = [&](std::size_t k, double length) {
    return (6 / (length * length)) * (through.poles[k] - 2 * through.poles[k + 1] + through.poles[k + 2]);
  };
  EXPECT_LT(norm(bend(0, 10)), 1e-12);
  EXPECT_LT(norm(bend(4, h)), 1e-12);
  EXPECT_LT(norm(bend(1, 10) - bend(3, h)), 1e-12);
  // Directions at the ends are kept.
  const auto& arch = std::get<io::Spline>(drawing.curves[1].shape);
  EXPECT_EQ(arch.poles.at(1), (Point{0, 4.0 / 3}));
  EXPECT_EQ(arch.poles.at(2), (Point{4, 4.0 / 3}));
  EXPECT_EQ(unread(drawing), (Counts{{"SPLINE (of no length)", 1}}));
}

TEST(IoDxfDrawing, ParallelLinesOfAnMlineAreCurves) {
  const auto drawing = read(file_of(
      "0 MLINE 8 0 2 STANDARD 71 1 72 2 73 2 10 0 20 0 30 0 11 0 21 0 31 0 12 1 22 0 32 0 13 0 23 1 33 0 "
      "74 2 41 0.5 41 0 75 0 74 2 41 -0.5 41 0 75 0 11 10 21 0 31 0 12 1 22 0 32 0 13 0 23 1 33 0 "
      "74 2 41 0.5 41 0 75 0 74 2 41 -0.5 41 0 75 0"));
  ASSERT_EQ(drawing.curves.size(), 2U);
  EXPECT_EQ(edge(drawing, 0).from, (Point{0, 0.5}));
  EXPECT_EQ(edge(drawing, 0).to, (Point{10, 0.5}));
  EXPECT_EQ(edge(drawing, 1).from, (Point{0, -0.5}));
}

TEST(IoDxfDrawing, ColoursAndLineTypesMakeEntriesOfALayer) {
  const std::string table =
      "0 TABLE 2 LAYER 0 LAYER 2 cut 70 0 62 5 6 CONTINUOUS 0 LAYER 2 bend 70 0 62 1 6 DASHED 0 ENDTAB";
  const std::string line = " 10 0 20 0 11 1 21 0 ";
  const auto drawing = read(file_of(
      "0 LINE 8 cut" + line + "0 LINE 8 cut 62 1" + line + "0 LINE 8 cut 420 255" + line + "0 LINE 8 bend" +
          line + "0 LINE 8 bend 6 CONTINUOUS 62 12" + line + "0 INSERT 8 cut 62 3 2 B 10 0 20 0",
      "0 BLOCK 2 B 10 0 20 0 0 LINE 8 0 62 0" + line + "0 LINE 8 bend 62 0" + line + "0 LINE 8 0" + line +
          "0 ENDBLK",
      "", table));
  std::string words;
  for (const io::DrawnCurve& curve : drawing.curves) {
    const io::Layer& layer = drawing.layers.at(curve.layer);
    words += layer.name + ":" + layer.colour + (layer.line_type.empty() ? "" : ":" + layer.line_type) + " ";
  }
  // By block is the colour of the insertion, by layer that of the layer, which layer 0 leaves to the
  // insertion.
  EXPECT_EQ(words,
            "cut:#0000ff cut:#ff0000 cut:#0000ff bend:#ff0000:DASHED bend:#a50000 cut:#00ff00 "
            "bend:#00ff00:DASHED cut:#0000ff ");
  EXPECT_EQ(drawing.layers.size(), 6U) << "the same colour, by layer and by number, is one entry";
}

TEST(IoDxfDrawing, WhatASolidHatchFillsIsFilled) {
  const auto drawing = read(file_of(
      "0 CIRCLE 8 0 10 5 20 5 40 2 0 CIRCLE 8 0 10 50 20 5 40 2 0 LWPOLYLINE 8 0 70 1 10 0 20 0 10 9 20 0 10 "
      "9 20 9 "
      "0 HATCH 8 0 10 0 20 0 30 0 2 SOLID 70 1 71 0 91 2 92 1 93 1 72 2 10 5 20 5 40 2 50 0 51 360 73 1 97 0 "
      "92 2 72 0 73 1 93 3 10 0 20 0 10 9 20 0 10 9 20 9 97 0 75 0 76 1 98 1 10 1 20 1 "
      "0 HATCH 8 0 10 0 20 0 30 0 2 ANSI31 70 0 71 0 91 1 92 1 93 1 72 2 10 50 20 5 40 2 50 0 51 360 73 1 97 "
      "0 75 0"));
  ASSERT_EQ(drawing.entities.size(), 3U);
  EXPECT_TRUE(drawing.entities[0].filled);
  EXPECT_FALSE(drawing.entities[1].filled) << "a pattern is a section, no fill";
  EXPECT_TRUE(drawing.entities[2].filled);
  EXPECT_EQ(unread(drawing), (Counts{{"HATCH", 2}}));
}

TEST(IoDxfDrawing, SizesThatSuggestInchesAreTold) {
  const auto notice = [](const std::string& entities, const std::string& header = "") {
    return read(file_of(entities, "", header)).notices.at(0);
  };
  const std::string sixteenths = "0 LINE 8 0 10 0 20 0 11 5.0625 21 0",
                    tenths = "0 LINE 8 0 10 0 20 0 11 5.1 21 0";
  EXPECT_TRUE(holds(notice(sixteenths), "suggest inches: --units inch"));
  EXPECT_FALSE(holds(notice(tenths), "suggest inches"));
  EXPECT_TRUE(holds(notice(tenths, "9 $MEASUREMENT 70 0"), "suggest inches"));
  EXPECT_FALSE(holds(notice("0 LINE 8 0 10 0 20 0 11 500.0625 21 0"), "suggest inches"));
}

TEST(IoDxfDrawing, BlocksInThemselvesAreSetAsideAndTooDeepOnesRefused) {
  const std::string ring =
      "0 BLOCK 2 A 10 0 20 0 0 INSERT 2 B 10 0 20 0 0 ENDBLK 0 BLOCK 2 B 10 0 20 0 0 INSERT 2 A 10 0 "
      "20 0 0 ENDBLK";
  EXPECT_TRUE(holds(set_aside(file_of("0 INSERT 2 A 10 0 20 0", ring)), "inserted in itself"));
  EXPECT_TRUE(read(file_of("0 LINE 10 0 20 0 11 1 21 1", ring)).unread.empty())
      << "a block that nobody shows";
  const auto chain = [](std::size_t depth) {
    std::string blocks = "0 BLOCK 2 b0 10 0 20 0 0 LINE 10 0 20 0 11 1 21 1 0 ENDBLK";
    for (std::size_t i = 1; i < depth; ++i) {
      blocks += fmt::format(" 0 BLOCK 2 b{} 10 0 20 0 0 INSERT 2 b{} 10 1 20 0 0 ENDBLK", i, i - 1);
    }
    return file_of(fmt::format("0 INSERT 2 b{} 10 0 20 0", depth - 1), blocks);
  };
  const auto deepest = read(chain(io::kDeepestNesting));
  EXPECT_EQ(edge(deepest, 0).from, (Point{static_cast<double>(io::kDeepestNesting - 1), 0}));
  EXPECT_TRUE(holds(refusal(chain(io::kDeepestNesting + 1)), "nested more than 32 deep"));
  EXPECT_TRUE(holds(refusal(chain(100'000)), "nested more than 32 deep"));
}

TEST(IoDxfDrawing, CopiesBeyondTheLimitAreRefusedBeforeTheyAreMade) {
  const std::string many = " 70 30000 71 30000 44 1 45 1";
  EXPECT_TRUE(
      holds(refusal(file_of("0 INSERT 2 Arrow 10 0 20 0" + many, kArrow)), "curves, more than 40000"));
  // Nothing to show: counted, not walked.
  std::string blocks = "0 BLOCK 2 e0 10 0 20 0 0 POINT 8 0 0 ENDBLK";
  for (int i = 1; i < 30; ++i) {
    blocks += fmt::format(" 0 BLOCK 2 e{} 10 0 20 0 0 INSERT 2 e{} 10 0 20 0{} 0 ENDBLK", i, i - 1, many);
  }
  const auto drawing = read(file_of("0 INSERT 2 e29 10 0 20 0", blocks));
  EXPECT_EQ(unread(drawing).at("POINT"), SIZE_MAX);
}

TEST(IoDxfDrawing, TwoBlocksOfOneNameAreSetAsideWhereTheyAreUsed) {
  EXPECT_TRUE(holds(set_aside(file_of("0 INSERT 2 Arrow 10 0 20 0", kArrow + " " + kArrow)), "holds two"));
  EXPECT_EQ(read(file_of("", kArrow + " " + kArrow)).curves.size(), 0U);
}

TEST(IoDxfDrawing, ExternalBlocksAndScaleZeroAreNamed) {
  const auto drawing = read(file_of("0 INSERT 2 X 10 0 20 0 0 INSERT 2 Arrow 10 0 20 0 41 0",
                                    kArrow + " 0 BLOCK 2 X 70 4 10 0 20 0 1 other.dwg 0 ENDBLK"));
  EXPECT_EQ(unread(drawing), (Counts{{"INSERT (of another file)", 1}, {"INSERT (scale 0)", 1}}));
}

TEST(IoDxfDrawing, WhatABlockScalesBeyondTheLimitIsSetAside) {
  const auto drawing = read(file_of("0 INSERT 2 Arrow 10 0 20 0 41 1e9 42 1e9", kArrow));
  ASSERT_FALSE(drawing.damaged.empty());
  EXPECT_TRUE(holds(drawing.damaged[0], "beyond 1e+09 mm"));
}

}  // namespace
}  // namespace lekalo::io_dxf_drawing_test

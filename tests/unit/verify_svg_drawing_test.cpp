#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "lekalo/base/limits.hpp"
#include "support/drawn_text.hpp"
#include "verify/origin/drawing.hpp"
#include "verify/read/xml.hpp"
#include "verify/shape/shape_distance.hpp"

/// What the checker's own reader of SVG takes a drawing for, curve by curve.
namespace lekalo::verify::verify_svg_drawing_test {
namespace {

using cases::drawn_text;

std::string read(const std::string& text, const Fraction& mm_per_unit = 1, double off = 1) {
  return drawn_text(read_svg_drawing({"d.svg", text}, mm_per_unit, off));
}

/// On a page of 100 x 100 mm with its unit: y runs up from the lower edge.
std::string on_page(const std::string& body, double off = 1) {
  return read(R"(<svg width="100mm" height="100mm" viewBox="0 0 100 100">)" + body + "</svg>", 1, off);
}
std::string path(const std::string& d) { return on_page("<path d='" + d + "'/>"); }
/// The place of one line under words of its page.
std::string page(const std::string& words, const Fraction& mm_per_unit = 1) {
  return read("<svg " + words + "><line x1='10' y1='10' x2='20' y2='40'/></svg>", mm_per_unit);
}
std::string transformed(const std::string& transform) {
  return on_page("<line x1='1' y1='2' x2='4' y2='8' transform='" + transform + "'/>");
}

TEST(VerifySvgDrawing, ShapesAreTheirSides) {
  EXPECT_EQ(on_page("<line x1='1' y1='2' x2='30' y2='4'/>"), ": L 1,98 30,96\n");
  EXPECT_EQ(on_page("<polyline points='1,2 3,4, 5 8'/>"), ": L 1,98 3,96 L 3,96 5,92\n");
  EXPECT_EQ(on_page("<polygon points='1,2 3,4 5,8'/>"), ": L 1,98 3,96 L 3,96 5,92 L 5,92 1,98\n");
  EXPECT_EQ(on_page("<polygon points='1,2 3,4'/>"), ": L 1,98 3,96\n");
  EXPECT_EQ(on_page("<polygon points='1,2'/><polygon points=''/>"), "");
  EXPECT_EQ(on_page("<polygon points='1,2 3'/>"), "d.svg: points that are no numbers");
  EXPECT_EQ(on_page("<polygon points='1,2 3,x'/>"), "d.svg: points that are no numbers");
  const std::string too_long(limits::kMostDigits + 1, '9');
  EXPECT_EQ(on_page("<polygon points='" + too_long + ",2'/>"), "d.svg: points that are no numbers");
  EXPECT_EQ(on_page("<rect x='1' y='2' width='3' height='5'/>"),
            ": L 1,98 4,98 L 4,98 4,93 L 4,93 1,93 L 1,93 1,98\n");
  EXPECT_EQ(on_page("<rect width='3' height='5'/>"),
            ": L 0,100 3,100 L 3,100 3,95 L 3,95 0,95 L 0,95 0,100\n");
  for (const char* none : {"width='0' height='5'", "width='3' height='0'", "width='-3' height='5'",
                           "width='3' height='-5'", "height='5'", "width='3'"})
    EXPECT_EQ(on_page(std::string("<rect ") + none + "/>"), "") << none;
  EXPECT_EQ(on_page("<rect width='3' height='5' rx='0' ry='0'/>"),
            ": L 0,100 3,100 L 3,100 3,95 L 3,95 0,95 L 0,95 0,100\n");
  EXPECT_EQ(on_page("<rect width='4' height='8' rx='1' ry='2'/>", 100),
            ": L 1,100 3,100 L 4,98 4,94 L 3,92 1,92 L 0,94 0,98 L 4,94 3,92~ L 1,92 0,94~ L 0,98 1,100~ L "
            "3,100 4,98~\n");
  for (const char* round : {"rx='1'", "ry='1'"})
    EXPECT_EQ(on_page(std::string("<rect width='3' height='5' ") + round + "/>"),
              ": L 1,100 2,100 L 3,99 3,96 L 2,95 1,95 L 0,96 0,99 A 2,96 1 2,95 3,96 - A 1,96 1 0,96 1,95 - "
              "A 1,99 1 1,100 0,99 - A 2,99 1 3,99 2,100 -\n")
        << round;
  for (const char* sharp : {"rx='1' ry='0'", "rx='0' ry='1'"})
    EXPECT_EQ(on_page(std::string("<rect width='3' height='5' ") + sharp + "/>"),
              ": L 0,100 3,100 L 3,100 3,95 L 3,95 0,95 L 0,95 0,100\n")
        << sharp;
}

TEST(VerifySvgDrawing, CirclesStayCirclesAndEllipsesBecomeStrokes) {
  EXPECT_EQ(on_page("<circle cx='10' cy='20' r='5'/>"), ": A 10,80 5 15,80 15,80 o\n");
  EXPECT_EQ(on_page("<ellipse cx='10' cy='20' rx='5' ry='5'/>"), ": A 10,80 5 15,80 15,80 o\n");
  EXPECT_EQ(on_page("<circle r='0.5'/>"), ": A 0,100 0.5 0.5,100 0.5,100 o\n");
  for (const char* none : {"<circle r='0'/>", "<circle r='-1'/>", "<circle/>", "<ellipse rx='1' ry='0'/>",
                           "<ellipse rx='0' ry='1'/>", "<ellipse rx='1'/>", "<ellipse ry='1'/>"})
    EXPECT_EQ(on_page(none), "") << none;
  // Within 100 mm of 8 mm and 4 mm the least number of strokes is enough.
  EXPECT_EQ(
      on_page("<ellipse cx='10' cy='20' rx='8' ry='4'/>", 100),
      ": L 18,80 12.47,76.2~ L 12.47,76.2 3.528,77.65~ L 3.528,77.65 3.528,82.35~ L 3.528,82.35 12.47,83.8~ "
      "L 12.47,83.8 18,80~\n");
}

TEST(VerifySvgDrawing, AnEllipseIsWithinTheDistanceOfItsStrokes) {
  for (const double off : {1.0, 0.1, 0.001}) {
    ReadDrawing strokes;
    CurveMaker maker(strokes, off);
    maker.ellipse({}, {just(1), just(2)}, {just(8), just(0)}, {just(0), just(7)}, 10, 300);
    maker.done("", false);
    ASSERT_EQ(strokes.curves.size(), 1U);
    const auto& pieces = strokes.curves[0].pieces;
    double worst = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const double degrees = 10 + 290 * (static_cast<double>(k) + 0.5) / static_cast<double>(pieces.size());
      const double t = degrees * std::acos(-1.0) / 180, x = 1 + 8 * std::cos(t), y = 2 + 7 * std::sin(t);
      const auto middle = [](const Span& a, const Span& b) { return (a.low + a.high + b.low + b.high) / 4; };
      const Side& side = pieces[k].side;
      worst =
          std::max(worst, std::hypot(middle(side.from.x, side.to.x) - x, middle(side.from.y, side.to.y) - y));
      EXPECT_EQ(pieces[k].off, off);
    }
    EXPECT_LE(worst, off);
    EXPECT_GE(worst, off / 20) << "more strokes than are of use";
  }
}

using Place = std::array<double, 2>;
using Poles = std::array<Place, 4>;

Place on_cubic(const Poles& p, double t) {
  const double s = 1 - t;
  const auto at = [&](std::size_t k) {
    return s * s * s * p[0][k] + 3 * s * s * t * p[1][k] + 3 * s * t * t * p[2][k] + t * t * t * p[3][k];
  };
  return {at(0), at(1)};
}
Place middle(const Vec& p) { return {(p.x.low + p.x.high) / 2, (p.y.low + p.y.high) / 2}; }

/// Places along a line, or along an arc of less than half a turn, from end to end.
std::vector<Place> places_along(const Side& side) {
  const Place from = middle(side.from), to = middle(side.to), centre = middle(side.centre);
  const auto angle = [](const Place& p) { return std::atan2(p[1], p[0]); };
  const double begin = angle(middle(side.first));
  const double turn = std::remainder(angle(middle(side.last)) - begin, 2 * std::acos(-1.0));
  std::vector<Place> places;
  for (const double t : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
    const double r = side.radius.low, at = begin + t * turn;
    places.push_back(side.arc ? Place{centre[0] + r * std::cos(at), centre[1] + r * std::sin(at)}
                              : Place{from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])});
  }
  return places;
}

/// A curve and its strokes are within the distance of each other, all along.
void expect_within(const Poles& poles, double off) {
  ReadDrawing strokes;
  CurveMaker maker(strokes, off);
  std::array<Vec, 4> given;
  for (std::size_t k = 0; k < 4; ++k) given[k] = {just(poles[k][0]), just(poles[k][1])};
  maker.cubic({}, given);
  maker.done("", false);
  ASSERT_EQ(strokes.curves.size(), 1U);
  const auto& pieces = strokes.curves[0].pieces;
  // The third root of the distance, and not the second one as of lines.
  EXPECT_LE(static_cast<double>(pieces.size()), 4 + 16 * std::cbrt(1 / off)) << "more than are of use";
  // The curve as lines, which are within 4e-4 of it.
  constexpr std::size_t kCount = 1000;
  std::vector<Side> lines(kCount);
  const auto point = [](const Place& p) { return Vec{just(p[0]), just(p[1])}; };
  for (std::size_t k = 0; k < kCount; ++k) {
    lines[k].from = point(on_cubic(poles, static_cast<double>(k) / kCount));
    lines[k].to = point(on_cubic(poles, static_cast<double>(k + 1) / kCount));
    double nearest = 1e9;
    for (const CurvePiece& piece : pieces)
      nearest = std::min(nearest, distance(lines[k].from, piece.side).low - piece.off);
    ASSERT_LE(nearest, 1e-9) << "the curve at " << k << " of " << kCount << " is off its strokes";
  }
  for (const CurvePiece& piece : pieces) {
    ASSERT_LE(piece.off, off);
    for (const Place& p : places_along(piece.side)) {
      double nearest = 1e9;
      for (const Side& line : lines) nearest = std::min(nearest, distance(point(p), line).low);
      ASSERT_LE(nearest, piece.off + 4e-4) << "a stroke is off its curve at " << p[0] << ", " << p[1];
    }
  }
}

TEST(VerifySvgDrawing, ABezierCurveAndItsStrokesAreWithinTheDistanceOfEachOther) {
  // They bend at one end alone, turn about, have a loop or a cusp, go back on a line or on an arc, or are
  // nearly a circle.
  const Poles parabola{{{0, 0}, {10, 20}, {20, 20}, {30, 0}}}, one_end{{{0, 0}, {0, 0}, {10, 0}, {30, 30}}},
      other_end{{{30, 30}, {10, 0}, {0, 0}, {0, 0}}}, wave{{{0, 0}, {10, 20}, {20, -20}, {30, 0}}},
      loop{{{0, 0}, {60, 30}, {-30, 30}, {30, 0}}}, cusp{{{0, 0}, {30, 30}, {0, 30}, {30, 0}}},
      back{{{0, 0}, {30, 0}, {-10, 0}, {20, 0}}}, round{{{0, 0}, {5.5228, 0}, {10, 4.4772}, {10, 10}}},
      closed{{{5, 5}, {40, 30}, {-30, 30}, {5, 5}}}, beyond{{{0, 0}, {40, 2}, {40, 2}, {20, 1}}};
  for (const double off : {1.0, 1e-2, 1e-4})
    for (const Poles& poles : {parabola, one_end, other_end, wave, loop, cusp, back, round, closed, beyond})
      expect_within(poles, off);
}

TEST(VerifySvgDrawing, ABezierCurveThatLeavesTheSectorOfItsEndsIsNoArc) {
  // Within 1 mm each is as far from one centre all along, but begins or ends outside the sector of its ends,
  // or turns by half a turn and more, so that the arc of less between its ends is another curve.
  const Poles past_end{{{0, 0}, {-19, -8}, {18, 8}, {25, 8}}},
      before_begin{{{0, 0}, {0, 2}, {40, 13}, {19, 7}}}, past_both{{{0, 0}, {-10, -5}, {40, 19}, {17, 8}}},
      long_past{{{0, 0}, {29, -1}, {31, 3}, {27, 1}}}, long_before{{{0, 0}, {-3, -2}, {-4, 0}, {25, 7}}},
      half_turn{{{3, 0}, {3, 4}, {-3, 4}, {-3, 0}}},
      more_than_half{{{3, 0}, {3, 4.37}, {-3.71, 3.78}, {-2.95, -0.52}}};
  for (const Poles& poles :
       {past_end, before_begin, past_both, long_past, long_before, half_turn, more_than_half})
    expect_within(poles, 1);
}

TEST(VerifySvgDrawing, WhatWouldTakeTooManyStrokesIsNotRead) {
  ReadDrawing drawing;
  CurveMaker maker(drawing, 1e-9);
  const Vec nought{just(0), just(0)};
  maker.cubic({}, {nought, {just(0), just(1e6)}, {just(1e6), just(1e6)}, {just(1e6), just(0)}});
  maker.ellipse({}, nought, {just(80), just(0)}, {just(0), just(70)}, 0, 360);
  maker.done("", false);
  EXPECT_EQ(drawing.not_read, (std::set<std::string>{"Bezier curves that are large against the tolerance",
                                                     "ellipses that are large against the tolerance"}));
}

TEST(VerifySvgDrawing, PathsRunAsTheirLettersSay) {
  EXPECT_EQ(path("M1 2L3 4 5 8"), ": L 1,98 3,96 L 3,96 5,92\n");
  EXPECT_EQ(path("m1 2l3 4 5 8"), ": L 1,98 4,94 L 4,94 9,86\n");
  EXPECT_EQ(path("M1 2 3 4"), ": L 1,98 3,96\n");
  EXPECT_EQ(path("m1 2 3 4"), ": L 1,98 4,94\n");
  EXPECT_EQ(path("M1 2H9V5"), ": L 1,98 9,98 L 9,98 9,95\n");
  EXPECT_EQ(path("M1 2h9v5"), ": L 1,98 10,98 L 10,98 10,93\n");
  EXPECT_EQ(path("M1 2H9 12"), ": L 1,98 9,98 L 9,98 12,98\n");
  EXPECT_EQ(path("M1 2L3 4 5 2zl1 1"), ": L 1,98 3,96 L 3,96 5,98 L 5,98 1,98 L 1,98 2,97\n");
  EXPECT_EQ(path("M1 2L3 4Z"), ": L 1,98 3,96 L 3,96 1,98\n");
  EXPECT_EQ(path("M1 2h3m4 0h5z"), ": L 1,98 4,98 L 8,98 13,98 L 13,98 8,98\n");
  EXPECT_EQ(path("M1-2+3.5.5"), ": L 1,102 3.5,99.5\n");
  EXPECT_EQ(path("M1. 2L3 4"), ": L 1,98 3,96\n");
  EXPECT_EQ(path("M1e1,2E+0,3e-1 4"), ": L 10,98 0.3,96\n");
  EXPECT_EQ(path("M1\t2\r\nL3\n,4"), ": L 1,98 3,96\n");
  EXPECT_EQ(path(""), "");
  for (const char* broken :
       {"M1", "M1 2L3", "M1 2L3 x", "M1 2h", "M1 2Lz", "M.", "M1 2C3 4 5 6 7", "M1 2L- 3", "M1 2@"})
    EXPECT_EQ(path(broken), "d.svg: a path that breaks off") << broken;
  for (const char* strange : {"1 2", "M1 2B3 4"})
    EXPECT_EQ(path(strange), "d.svg: a path that is not understood") << strange;
  EXPECT_EQ(path("M1 2L3 4e"), "d.svg: a path that is not understood");
  EXPECT_EQ(path("M1 2L3 4e+"), "d.svg: a path that is not understood");
}

/// The text of the cubics whose poles are these on the page, y down; those of a parabola are its three.
std::string cubics(std::initializer_list<std::vector<double>> curves) {
  ReadDrawing drawing;
  CurveMaker maker(drawing, 0.1);
  for (const std::vector<double>& c : curves) {
    std::vector<Vec> p;
    for (std::size_t k = 0; k < c.size(); k += 2) p.push_back({just(c[k]), just(100 - c[k + 1])});
    const Span third = just(1) / just(3), two = just(2) * third;
    if (p.size() == 2) maker.line({}, p[0], p[1]);
    if (p.size() == 3) maker.cubic({}, {p[0], p[0] * third + p[1] * two, p[2] * third + p[1] * two, p[2]});
    if (p.size() == 4) maker.cubic({}, {p[0], p[1], p[2], p[3]});
  }
  maker.done("", false);
  return drawn_text(drawing);
}

TEST(VerifySvgDrawing, CurvesOfPathsGoOnFromTheirPoles) {
  const auto drawn = [](const std::string& d) { return on_page("<path d='" + d + "'/>", 0.1); };
  const std::string c = cubics({{0, 0, 0, 40, 20, 40, 40, 0}});
  EXPECT_NE(c.find('~'), std::string::npos);
  EXPECT_EQ(drawn("M0 0C0 40 20 40 40 0"), c);
  EXPECT_EQ(drawn("m0 0c0 40 20 40 40 0"), c);
  const std::string s = cubics({{0, 0, 0, 40, 20, 40, 40, 0}, {40, 0, 60, -40, 60, 40, 80, 0}});
  EXPECT_EQ(drawn("M0 0C0 40 20 40 40 0S60 40 80 0"), s);
  EXPECT_EQ(drawn("M0 0C0 40 20 40 40 0s20 40 40 0"), s);
  EXPECT_EQ(drawn("M0 0S20 40 40 0"), cubics({{0, 0, 0, 0, 20, 40, 40, 0}}));
  EXPECT_EQ(drawn("M0 0S20 40 40 0S50 10 80 0"),
            cubics({{0, 0, 0, 0, 20, 40, 40, 0}, {40, 0, 60, -40, 50, 10, 80, 0}}));
  EXPECT_EQ(drawn("M0 0Q20 40 40 0T80 0"), cubics({{0, 0, 20, 40, 40, 0}, {40, 0, 60, -40, 80, 0}}));
  EXPECT_EQ(drawn("M0 0Q20 40 40 0t40 0t40 0"),
            cubics({{0, 0, 20, 40, 40, 0}, {40, 0, 60, -40, 80, 0}, {80, 0, 100, 40, 120, 0}}));
  EXPECT_EQ(drawn("M0 0Q20 40 40 0h5t41 10"),
            cubics({{0, 0, 20, 40, 40, 0}, {40, 0, 45, 0}, {45, 0, 45, 0, 86, 10}}));
  EXPECT_EQ(drawn("M0 0Q20 40 40 0S60 40 80 0"),
            cubics({{0, 0, 20, 40, 40, 0}, {40, 0, 40, 0, 60, 40, 80, 0}}));
}

TEST(VerifySvgDrawing, ArcsOfPathsTurnAsTheirFlagsSay) {
  EXPECT_EQ(path("M10 20A5 5 0 0 1 15 25"), ": A 10,75 5 15,75 10,80 -\n");
  EXPECT_EQ(path("M10 20A5 5 0 0 0 15 25"), ": A 15,80 5 10,80 15,75 -\n");
  EXPECT_EQ(path("M10 20A5 5 0 1 1 15 25"), ": A 15,80 5 15,75 10,80 +\n");
  EXPECT_EQ(path("M10 20A5 5 0 1 0 15 25"), ": A 10,75 5 10,80 15,75 +\n");
  EXPECT_EQ(path("M10 20a5,5 0 0110 0"), ": A 15,80 5 20,80 10,80 =\n");
  EXPECT_EQ(path("M10 20a-5 5 0 00 10 0"), ": A 15,80 5 10,80 20,80 =\n");
  EXPECT_EQ(path("M10 20a1 1 0 0 1 10 0"), ": A 15,80 5 20,80 10,80 =\n");
  EXPECT_EQ(path("M10 20a5.000001 5.000001 0 0 1 10 0"), "not read: arcs of nearly half a turn in paths\n");
  EXPECT_EQ(path("M10 20a5.00001 5.00001 0 0 1 10 0"), ": A 15,79.99 5 20,80 10,80 -\n");
  // The squares of diameter and chord differ by a millionth and hardly more.
  const std::string radius = "0.5000002499999375000313180768";
  EXPECT_EQ(path("M0 0a" + radius + " " + radius + " 0 0 1 1 0"), ": A 0.5,100 0.5 1,100 0,100 -\n");
  EXPECT_EQ(path("M10 20a0 5 0 0 1 10 0"), ": L 10,80 20,80\n");
  EXPECT_EQ(path("M10 20a5 0 0 0 1 10 0"), ": L 10,80 20,80\n");
  EXPECT_EQ(path("M10 20a5 5 0 0 1 0 0"), "");
  EXPECT_EQ(
      path("M10 20a5 6 0 0 1 10 0"),
      ": L 10,80 10.38,82.3~ L 10.38,82.3 11.46,84.24~ L 11.46,84.24 13.09,85.54~ L 13.09,85.54 15,86~ "
      "L 15,86 16.91,85.54~ L 16.91,85.54 18.54,84.24~ L 18.54,84.24 19.62,82.3~ L 19.62,82.3 20,80~\n");
  // Turned by a quarter the two half diameters change places.
  EXPECT_EQ(path("M10 20a5 6 90 0 1 10 0"), path("M10 20a6 5 0 0 1 10 0"));
  for (const char* flags : {"2 1", "0 2", "0 x", "x 0"})
    EXPECT_EQ(path("M10 20a5 5 0 " + std::string(flags) + " 10 0"),
              "d.svg: an arc of a path without its flags");
}

TEST(VerifySvgDrawing, AMapThatKeepsCirclesKeepsArcs) {
  const std::string arc = "<path d='M10 20A5 5 0 0 1 15 25' transform='";
  EXPECT_EQ(on_page(arc + "scale(2)'/>"), ": A 20,50 10 30,50 20,60 -\n");
  EXPECT_EQ(on_page(arc + "scale(0.5)'/>"), ": A 5,87.5 2.5 7.5,87.5 5,90 -\n");
  EXPECT_EQ(on_page(arc + "scale(-1 1)'/>"), ": A -10,75 5 -10,80 -15,75 -\n");
  EXPECT_EQ(on_page(arc + "rotate(90)'/>"), ": A -25,90 5 -25,85 -20,90 -\n");
  EXPECT_EQ(
      on_page(arc + "scale(2 1)'/>"),
      ": L 20,80 23.83,79.62~ L 23.83,79.62 27.07,78.54~ L 27.07,78.54 29.24,76.91~ L 29.24,76.91 30,75~\n");
  EXPECT_EQ(
      on_page(arc + "scale(1 1.000001)'/>"),
      ": L 10,80 11.91,79.62~ L 11.91,79.62 13.54,78.54~ L 13.54,78.54 14.62,76.91~ L 14.62,76.91 15,75~\n");
  EXPECT_EQ(on_page("<circle r='5' transform='scale(2 1)'/>", 100),
            ": L 10,100 3.09,95.24~ L 3.09,95.24 -8.09,97.06~ L -8.09,97.06 -8.09,102.9~ L -8.09,102.9 "
            "3.09,104.8~ L 3.09,104.8 10,100~\n");
}

TEST(VerifySvgDrawing, TransformsAreMapsOneAfterTheOther) {
  EXPECT_EQ(transformed(""), ": L 1,98 4,92\n");
  EXPECT_EQ(transformed("translate(10,20)"), ": L 11,78 14,72\n");
  EXPECT_EQ(transformed("translate(10)"), ": L 11,98 14,92\n");
  EXPECT_EQ(transformed("scale(2,3)"), ": L 2,94 8,76\n");
  EXPECT_EQ(transformed("scale(2)"), ": L 2,96 8,84\n");
  EXPECT_EQ(transformed("rotate(90)"), ": L -2,99 -8,96\n");
  EXPECT_EQ(transformed("rotate(90 10 20)"), ": L 28,89 22,86\n");
  EXPECT_EQ(transformed("skewX(45)"), ": L 3,98 12,92\n");
  EXPECT_EQ(transformed("skewY(45)"), ": L 1,97 4,88\n");
  EXPECT_EQ(transformed("skewX(135)"), ": L -1,98 -4,92\n");
  EXPECT_EQ(transformed("skewY(135)"), ": L 1,99 4,96\n");
  EXPECT_EQ(transformed("matrix(1 2 3 4 5 6)"), ": L 12,84 33,54\n");
  EXPECT_EQ(transformed("translate(10,20) scale(2)"), ": L 12,76 18,64\n");
  EXPECT_EQ(transformed("scale(2),translate(10,20)"), ": L 22,56 28,44\n");
  for (const char* wrong : {"turn(3)",
                            "scale",
                            "scale(",
                            "scale()",
                            "scale(1 2 3)",
                            "translate()",
                            "translate(1 2 3)",
                            "rotate()",
                            "rotate(1 2)",
                            "rotate(1 2 3 4)",
                            "skewX()",
                            "skewX(1 2)",
                            "skewY(1 2)",
                            "matrix(1 2 3 4 5)",
                            "matrix(1 2 3 4 5 6 7)",
                            "scale(x)",
                            "scale 2",
                            "scale(2) 3",
                            "scale(2",
                            "scale(1 2 3 4 5 6)"})
    EXPECT_EQ(transformed(wrong), "d.svg: a transform that is not understood") << wrong;
  EXPECT_EQ(on_page("<g style='transform: var(--a)'><line x2='1'/></g>"),
            "not read: styles that move or shape\n");
  EXPECT_EQ(on_page("<g transform='translate(5)'><g transform='scale(2)'><line x2='1'/></g></g>"),
            ": L 5,100 7,100\n");
}

TEST(VerifySvgDrawing, APageSaysItsUnitAndItsPlace) {
  EXPECT_EQ(page("width='100mm' height='100mm' viewBox='0 0 100 100'"), ": L 10,90 20,60\n");
  EXPECT_EQ(page("width='10cm' height='10cm' viewBox='0 0 100 100'"), ": L 10,90 20,60\n");
  EXPECT_EQ(page("width='10in' height='10in' viewBox='0 0 100 100'"), ": L 25.4,228.6 50.8,152.4\n");
  EXPECT_EQ(page("width='360pt' height='360pt' viewBox='0 0 100 100'"), ": L 12.7,114.3 25.4,76.2\n");
  EXPECT_EQ(page("width='30pc' height='30pc' viewBox='0 0 100 100'"), ": L 12.7,114.3 25.4,76.2\n");
  EXPECT_EQ(page("width='400Q' height='400Q' viewBox='0 0 100 100'"), ": L 10,90 20,60\n");
  EXPECT_EQ(page("width='200mm' height='200mm' viewBox='0 0 100 100'"), ": L 20,180 40,120\n");
  EXPECT_EQ(page("width='100mm' height='100mm' viewBox='5 6 100 100'"), ": L 5,96 15,66\n");
  EXPECT_EQ(page("width='100mm' viewBox='0 0 100 50'"), ": L 10,40 20,10\n");
  EXPECT_EQ(page("height='100mm' viewBox='0 0 100 50'"), ": L 20,80 40,20\n");
  EXPECT_EQ(page("width='100mm' height='100mm' viewBox='0 0 1 1'"), ": L 1000,-900 2000,-3900\n");
  EXPECT_EQ(page("width='80%' height='50mm' viewBox='0 0 100 50'"), ": L 10,40 20,10\n");
  EXPECT_EQ(page("viewBox='0 0 100 50'"), ": L 10,40 20,10\n");
  EXPECT_EQ(page("viewBox='0 0 100 50'", 2), ": L 20,80 40,20\n");
  EXPECT_EQ(page("width='100' height='50' viewBox='0 0 100 50'", 2), ": L 20,80 40,20\n");
  EXPECT_EQ(page("width='100px' height='50px' viewBox='0 0 100 50'", 2), ": L 20,80 40,20\n");
  EXPECT_EQ(page("width='100px' height='50px'", 2), ": L 20,80 40,20\n");
  // 96 pixels are an inch where the page says how large it is.
  EXPECT_EQ(page("width='100mm' height='25.4mm'"), ": L 2.646,22.75 5.292,14.82\n");
  EXPECT_EQ(page("width='100mm'"), ": L 2.646,-2.646 5.292,-10.58\nnot read: pages without a height\n");
  EXPECT_EQ(page("width='100mm' height='100' viewBox='0 0 100 100'"),
            ": L 10,90 20,60\nnot read: pages with two kinds of units\n");
  EXPECT_EQ(page("width='100' height='100mm' viewBox='0 0 100 100'"),
            ": L 10,90 20,60\nnot read: pages with two kinds of units\n");
  EXPECT_EQ(page("width='9em' height='1mm'"), "d.svg: its page has a unit that is not known here");
  EXPECT_EQ(page("width='9mm' height='1ex'"), "d.svg: its page has a unit that is not known here");
  for (const char* view : {"0 0 100", "0 0 100 x", "x"})
    EXPECT_EQ(page("viewBox='" + std::string(view) + "'"), "d.svg: its viewBox is not four numbers") << view;
  for (const char* view : {"0 0 0 1", "0 0 1 0", "0 0 -1 1", "0 0 1 -1"})
    EXPECT_EQ(page("viewBox='" + std::string(view) + "'"), "d.svg: its viewBox is empty") << view;
  EXPECT_EQ(read("<html/>"), "d.svg: its root is no svg");
}

TEST(VerifySvgDrawing, APageLargerThanDoublesHasNoPlaces) {
  const auto drawing = read_svg_drawing(
      {"d.svg", "<svg width='1e308cm' viewBox='0 0 100 50'><line x1='1' y1='2' x2='3' y2='4'/></svg>"}, 1, 1);
  ASSERT_TRUE(drawing) << drawing.error().message;
  for (const DrawnCurve& curve : drawing->curves)
    for (const CurvePiece& piece : curve.pieces) EXPECT_FALSE(std::isfinite(piece.side.to.y.high));
}

TEST(VerifySvgDrawing, WhetherAPageSaysItsUnitIsTold) {
  const auto says = [](const std::string& words) {
    return read_svg_drawing({"d.svg", "<svg " + words + "/>"}, 1, 1)->says_unit;
  };
  EXPECT_TRUE(says("width='1mm' height='1mm'"));
  EXPECT_TRUE(says("width='1mm' height='100%'"));
  EXPECT_FALSE(says("width='1' height='1'"));
  EXPECT_FALSE(says("width='1px' height='1px'"));
  EXPECT_FALSE(says("viewBox='0 0 1 1'"));
}

TEST(VerifySvgDrawing, APageOfOtherProportionsIsPlacedAsItSays) {
  // A view of 100 x 100 on pages that are twice as wide, or twice as high.
  const std::string wide = "width='200mm' height='100mm' viewBox='0 0 100 100' ",
                    high = "width='100mm' height='200mm' viewBox='0 0 100 100' ";
  EXPECT_EQ(page(wide), ": L 60,90 70,60\n");
  EXPECT_EQ(page(wide + "preserveAspectRatio='none'"), ": L 20,90 40,60\n");
  EXPECT_EQ(page(wide + "preserveAspectRatio='xMinYMid'"), ": L 10,90 20,60\n");
  EXPECT_EQ(page(wide + "preserveAspectRatio='xMaxYMid'"), ": L 110,90 120,60\n");
  EXPECT_EQ(page(wide + "preserveAspectRatio='xMidYMid slice'"), ": L 20,130 40,70\n");
  EXPECT_EQ(page(wide + "preserveAspectRatio='xMidYMin slice'"), ": L 20,80 40,20\n");
  EXPECT_EQ(page(wide + "preserveAspectRatio='xMidYMax slice'"), ": L 20,180 40,120\n");
  EXPECT_EQ(page(high), ": L 10,140 20,110\n");
  EXPECT_EQ(page(high + "preserveAspectRatio='xMidYMin'"), ": L 10,190 20,160\n");
  EXPECT_EQ(page(high + "preserveAspectRatio='xMidYMax'"), ": L 10,90 20,60\n");
  EXPECT_EQ(page(high + "preserveAspectRatio='xMinYMin slice'"), ": L 20,180 40,120\n");
  EXPECT_EQ(page("width='200mm' height='100mm' viewBox='5 6 100 100'"), ": L 55,96 65,66\n");
}

TEST(VerifySvgDrawing, LayersAreGroupsAndWhatIsHiddenIsMarked) {
  const std::string line = "<line x2='1'/>", drawn = ": L 0,100 1,100\n";
  EXPECT_EQ(on_page("<g id='a'>" + line + "</g>" + line), "a" + drawn + drawn);
  EXPECT_EQ(on_page("<a id='a'>" + line + "</a>"), "a" + drawn);
  EXPECT_EQ(on_page("<g id='a' inkscape:label='b'>" + line + "</g>"), "b" + drawn);
  EXPECT_EQ(on_page("<g id='a'><g id='b'>" + line + "</g></g>"), "a" + drawn);
  EXPECT_EQ(on_page("<g><g id='b'>" + line + "</g></g>"), "b" + drawn);
  const std::string layer = " inkscape:groupmode='layer'>";
  EXPECT_EQ(on_page("<g id='a'" + layer + "<g id='b'>" + line + "</g><g id='c'" + layer + line + "</g></g>"),
            "a" + drawn + "c" + drawn);
  EXPECT_EQ(on_page("<g id='a'>" + line + "</g><g id='c'" + layer + "</g>"), drawn);
  EXPECT_EQ(on_page("<g id='a' display='none'>" + line + "</g>"), "a!" + drawn);
  EXPECT_EQ(on_page("<g id='a' display='inline'>" + line + "</g>"), "a" + drawn);
  EXPECT_EQ(on_page("<g display='none'><g visibility='visible' display='inline'>" + line + "</g></g>"),
            "!" + drawn);
  EXPECT_EQ(on_page("<line x2='1' style='fill:none;display : none '/>"), "!" + drawn);
  EXPECT_EQ(on_page("<line x2='1' style='display:none;display:inline' display='none'/>"), drawn);
  EXPECT_EQ(on_page("<line x2='1' style='display' display='none'/>"), "!" + drawn);
  EXPECT_EQ(on_page("<line x2='1' style='display:none;fill:red'/>"), "!" + drawn);
  EXPECT_EQ(on_page("<line x2='1' style='fill:none'/>"), drawn);
  EXPECT_EQ(on_page("<line x2='1' style='Display:None !important'/>"), "!" + drawn);
  EXPECT_EQ(on_page("<line x2='1' style=' :a; display: ;' display='none'/>"), "!" + drawn);
  EXPECT_EQ(on_page("<line x2='1' visibility='hidden'/>"), "!" + drawn);
  EXPECT_EQ(on_page("<line x2='1' visibility='collapse'/>"), "!" + drawn);
  EXPECT_EQ(on_page("<g visibility='hidden'>" + line + "<line x2='1' visibility='visible'/></g>"),
            "!" + drawn + drawn);
  EXPECT_EQ(on_page("<text>a</text><defs>" + line + "</defs>" + line), drawn);
  EXPECT_EQ(on_page("<symbol>" + line + "</symbol>"), "");
  EXPECT_EQ(on_page("<svg>" + line + "</svg>"), "not read: svg within the page\n");
  EXPECT_EQ(on_page("<switch>" + line + "</switch>"), "not read: switch within the page\n");
}

/// Whoever shows the drawing does what they say, so that what is drawn without them is another one.
TEST(VerifySvgDrawing, StylesThatMoveOrShapeAreNotRead) {
  for (const char* style : {"transform:scale(2)",
                            "fill:none; TRANSLATE: 5px",
                            "rotate:9deg",
                            "scale:2",
                            "d:path(\"\")",
                            "x:5px;fill:none",
                            "y:5px",
                            "cx:5px",
                            "cy:5px",
                            "r:5px",
                            "rx:5px",
                            "ry:5px",
                            "/**/x:5px",
                            "\\78:5px",
                            "width:2px",
                            "height:2px",
                            "offset-path:none",
                            "offset:none",
                            "zoom:2",
                            "all:unset",
                            "-webkit-transform:scale(2)",
                            "-moz-transform:none"})
    EXPECT_EQ(on_page("<rect width='1' height='1' style='" + std::string(style) + "'/>"),
              "not read: styles that move or shape\n")
        << style;
  const std::string drawn = ": L 0,0 1,0\n";
  const auto root = [](const std::string& words) {
    return read("<svg viewBox='0 0 9 9' height='9mm' width='9mm' " + words +
                "><line y1='9' x2='1' y2='9'/></svg>");
  };
  EXPECT_EQ(root(""), drawn);
  EXPECT_EQ(root("style='fill:none'"), drawn);
  EXPECT_EQ(root("style='scale:2'"), drawn + "not read: pages that are moved\n");
  EXPECT_EQ(root("transform='scale(2)'"), drawn + "not read: pages that are moved\n");
  EXPECT_EQ(root("display='none'"), "!" + drawn);
  EXPECT_EQ(root("visibility='hidden'"), "!" + drawn);
}

TEST(VerifySvgDrawing, ElementsBehindAPrefixAreNotRead) {
  for (const char* name : {"x:path", "x:g", "y:style", "x:svg", "x:use"})
    EXPECT_EQ(on_page("<" + std::string(name) + "/>"), "not read: elements of SVG behind a prefix\n") << name;
  for (const char* name : {"x:other", "inkscape:path-effect", "sodipodi:namedview"})
    EXPECT_EQ(on_page("<" + std::string(name) + "/>"), "") << name;
}

TEST(VerifySvgDrawing, StyleSheetsThatHideOrMoveAreNotRead) {
  for (const char* word : {"display", "visibility", "transform"})
    EXPECT_EQ(on_page("<style>.a{" + std::string(word) + ":none}</style>"),
              "not read: style sheets that hide or move\n");
  for (const char* rule : {"a{DISPLAY:none}", "a{ x : 5px}", "a{fill:none;r:5px}",
                           "@media print{a{rotate:9deg}}", "a{fill:none}b{scale:2}", "a{b{fill:none}x:5px}",
                           "a{/* b */transform:scale(2)}", "/* a */a{visibility:hidden}", "a{\\78:5px}",
                           "a{/* b */r:5px}", "a{fill:none;/**/x/* c */:5px}", "/**/r:5px", "a{&#114;:5px}",
                           "a{-webkit-transform:scale(2)}", "rect{width:5px}", "@import url(other.css);"})
    EXPECT_EQ(on_page("<style>" + std::string(rule) + "</style>"),
              "not read: style sheets that hide or move\n")
        << rule;
  EXPECT_EQ(on_page("<style>/* a */ .a{fill:none;stroke:red}</style>"), "");
  EXPECT_EQ(on_page("<style>.a{fill:none;/* r:5px; */}/* x:1px</style>"), "");
  EXPECT_EQ(on_page("<style>.a{stroke-width:5px;-inkscape-font:b;-:c;--:d}</style>"), "");
  EXPECT_EQ(on_page("<?xml-stylesheet href='other.css'?>"), "not read: style sheets of other files\n");
  EXPECT_EQ(on_page("<?xml-model href='other.rng'?>"), "");
  EXPECT_EQ(on_page("<style>.a{fill:none}</style>"), "");
  EXPECT_EQ(on_page("<text>display</text>"), "");
}

TEST(VerifySvgDrawing, AUseDrawsWhatItNamesElsewhere) {
  const std::string defs = "<defs><line id='l' x2='1'/><symbol id='s'/><svg id='v'/></defs>";
  EXPECT_EQ(on_page(defs + "<use href='#l' x='3' y='4'/>"), ": L 3,96 4,96\n");
  EXPECT_EQ(on_page(defs + "<use xlink:href='#l'/>"), ": L 0,100 1,100\n");
  EXPECT_EQ(on_page(defs + "<use href='#l' xlink:href='#x'/>"), ": L 0,100 1,100\n");
  EXPECT_EQ(on_page(defs + "<use href='#l' x='3' transform='scale(2)'/>"), ": L 6,100 8,100\n");
  EXPECT_EQ(on_page(defs + "<g id='a'><use href='#l'/></g>"), "a: L 0,100 1,100\n");
  for (const char* nothing : {"<use/>", "<use href=''/>", "<use href='#x'/>"})
    EXPECT_EQ(on_page(defs + nothing), "d.svg: a use of nothing") << nothing;
  EXPECT_EQ(on_page(defs + "<use href='#s'/>"), "not read: uses of symbol\n");
  EXPECT_EQ(on_page(defs + "<use href='#v'/>"), "not read: uses of svg\n");
  EXPECT_EQ(on_page("<g id='a'><use href='#a'/></g>"), "not read: groups nested too deep\n");
}

TEST(VerifySvgDrawing, GroupsAreReadTo32Deep) {
  const auto nested = [](int depth) {
    std::string text = "<line x2='1'/>";
    for (int k = 0; k < depth; ++k) text = "<g>" + text + "</g>";
    return on_page(text);
  };
  EXPECT_EQ(nested(32), ": L 0,100 1,100\n");
  EXPECT_EQ(nested(33), "not read: groups nested too deep\n");
  const auto used = [](int depth) {
    std::string text = "<use href='#l'/>";
    for (int k = 0; k < depth; ++k) text = "<g>" + text + "</g>";
    return on_page("<defs><line id='l' x2='1'/></defs>" + text);
  };
  EXPECT_EQ(used(31), ": L 0,100 1,100\n");
  EXPECT_EQ(used(32), "not read: groups nested too deep\n");
}

TEST(VerifySvgDrawing, ADrawingOfMoreThanTwoMillionCurvesIsTooLarge) {
  ReadDrawing drawing;
  drawing.curves.reserve(2'000'001);
  drawing.curves.resize(2'000'000);
  EXPECT_FALSE(drawing.too_large());
  drawing.curves.emplace_back();
  EXPECT_TRUE(drawing.too_large());
}

TEST(VerifySvgDrawing, LengthsAreNumbersOrHaveUnits) {
  EXPECT_EQ(on_page("<line x1='1px' x2='2'/>"), ": L 1,100 2,100\n");
  EXPECT_EQ(on_page("<line x2='2mm'/>"), ": L 0,100 7.559,100\n");
  EXPECT_EQ(on_page("<line x2='5%'/>"),
            ": L 0,100 18.9,100\nnot read: lengths in shares of the page or of letters\n");
  EXPECT_EQ(on_page("<line x2='x'/>"), "d.svg: x2 is no length");
  EXPECT_EQ(on_page("<line x2='1' y2='1e-1'/>"), ": L 0,100 1,99.9\n");
}

// ---- XML --------------------------------------------------------------------------------------------------

std::string told(const XmlElement& element) {
  std::string text = element.name;
  for (const auto& [key, value] : element.attributes) text += " " + key + "=" + value;
  if (!element.text.empty()) text += " '" + element.text + "'";
  for (const XmlElement& child : element.children) text += "(" + told(child) + ")";
  return text;
}
std::string parsed(const std::string& text) {
  const Result<XmlElement> root = parse_xml({"d.svg", text});
  return root ? told(*root) : root.error().message;
}

TEST(VerifyXml, ElementsHaveNamesAttributesTextAndChildren) {
  EXPECT_EQ(parsed("<a/>"), "a");
  EXPECT_EQ(parsed("\xEF\xBB\xBF <a></a>"), "a");
  EXPECT_EQ(parsed("<a></a >"), "a");
  EXPECT_EQ(parsed("<svg:a><svg:b/></svg:a>"), "a(b)");
  EXPECT_EQ(parsed("<a\rb='1'/>"), "a b=1");
  EXPECT_EQ(parsed("<![CDATA[b]]><a/>"), "a");
  EXPECT_EQ(parsed("<x:a\tb = '1'\n c=\"2'\"><b/>text<c d=''>more</c></x:a>"),
            "x:a b=1 c=2' 'text'(b)(c d= 'more')");
  EXPECT_EQ(parsed("<?xml version='1.0'?><!-- <x> --><!DOCTYPE svg><a>1<!-- 2 -->3<![CDATA[<4>]]></a>"),
            "a '13<4>'");
  EXPECT_EQ(parsed("<a b='&lt;&gt;&amp;&quot;&apos;&#65;&#x7a;&#8364;x'/>"), "a b=<>&\"'Az?x");
  EXPECT_EQ(parsed("<a b='&#127;&#128;&#99999999999;&#x80;'/>"), "a b=\x7f???");
  for (const char* wrong : {"&#;", "&#x;", "&#;&#65;", "&#6z;", "&#xg;", "&#-1;", "&#X41;"})
    EXPECT_EQ(parsed("<a b='" + std::string(wrong) + "'/>"), "d.svg: it is no XML that is understood here")
        << wrong;
  EXPECT_EQ(parsed("<a>&#65;<![CDATA[&#65;]]></a>"), parsed("<a>A<![CDATA[&#65;]]></a>"));
  EXPECT_EQ(parsed("text <a/> and what follows </b>"), "a");
}

TEST(VerifyXml, EverythingElseIsRefused) {
  for (const char* text : {"",
                           "text",
                           "<a>",
                           "<a",
                           "<a b",
                           "<a b=",
                           "<a b=1/>",
                           "<a b=1 c=1/>",
                           "<a b '1'/>",
                           "<></>",
                           "<a b='1/>",
                           "<a b='1' c/>",
                           "<a ='1'/>",
                           "</a>",
                           "<a></b>",
                           "<a></a x>",
                           "<a/ >",
                           "< a/>",
                           "<a b='&x;'/>",
                           "<a b='&lt'/>",
                           "<!-- ",
                           "<a><![CDATA[ </a>",
                           "<?xml",
                           "<!DOCTYPE svg [<!ENTITY x 'y'>]><a/>",
                           "<!DOCTYPE svg"})
    EXPECT_EQ(parsed(text), "d.svg: it is no XML that is understood here") << text;
}

TEST(VerifyXml, ElementsNestTo600Deep) {
  const auto nested = [](int depth) {
    std::string text;
    for (int k = 0; k < depth; ++k) text += "<a>";
    for (int k = 0; k < depth; ++k) text += "</a>";
    return parse_xml({"d.svg", text}).has_value();
  };
  EXPECT_TRUE(nested(600));
  EXPECT_FALSE(nested(601));
}

}  // namespace
}  // namespace lekalo::verify::verify_svg_drawing_test

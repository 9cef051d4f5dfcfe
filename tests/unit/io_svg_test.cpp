#include "lekalo/io/svg/svg.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/drawn_measures.hpp"

namespace lekalo::io::io_svg_test {
namespace {

constexpr double kPi = 3.14159265358979323846;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// A page of 100 mm x 80 mm in millimetres: (x, y) of the file is (x, 80 - y).
std::string page(const std::string& content, const std::string& more = "") {
  return R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="100mm" height="80mm" viewBox="0 0 100 80" )" +
         more + ">" + content + "</svg>";
}

Drawing read(const std::string& bytes, std::optional<LengthUnit> unit = std::nullopt) {
  auto drawing = parse_svg(bytes, "part.svg", unit);
  EXPECT_TRUE(drawing.has_value()) << bytes << "\n" << (drawing ? "" : drawing.error().message);
  return drawing ? *std::move(drawing) : Drawing{};
}
Drawing read_path(const std::string& data) { return read(page("<path d=\"" + data + "\"/>")); }

/// "x y" of the first point of every curve, and of the last point of the last, back in the file's
/// coordinates.
std::string corners(const Drawing& drawing) {
  std::string text;
  const auto add = [&](Point p) { text += fmt::format("{:.6g} {:.6g}, ", p.x + 0.0, 80 - p.y + 0.0); };
  for (const DrawnCurve& curve : drawing.curves) add(cases::first_of(curve.shape));
  if (!drawing.curves.empty()) add(cases::last_of(drawing.curves.back().shape));
  return text.substr(0, text.size() < 2 ? 0 : text.size() - 2);
}

double length(const Drawing& drawing) {
  double sum = 0;
  for (const DrawnCurve& curve : drawing.curves) sum += cases::measure(curve.shape).length;
  return sum;
}
double area(const Drawing& drawing) {
  double sum = 0;
  for (const DrawnCurve& curve : drawing.curves) sum += cases::measure(curve.shape).area;
  return sum;
}

TEST(SvgPath, NumbersNeedNoSeparators) {
  EXPECT_EQ(corners(read_path("M1.5.5-3-.25L+2.5e1.5")), "1.5 0.5, -3 -0.25, 25 0.5");
  EXPECT_EQ(corners(read_path("M1,2 3 , 4\n5\t6,7 8")), "1 2, 3 4, 5 6, 7 8");
  EXPECT_EQ(corners(read_path("M 1. 2.l1.e1 0")), "1 2, 11 2");
  EXPECT_EQ(corners(read_path("M0 0L1e1-1E-1")), "0 0, 10 -0.1");
}

TEST(SvgPath, CommandsRepeatAndAreRelative) {
  EXPECT_EQ(corners(read_path("M1 2 3 4 5 2z")), "1 2, 3 4, 5 2, 1 2");
  EXPECT_EQ(corners(read_path("m1 2 3 4 5-2z")), "1 2, 4 6, 9 4, 1 2");
  EXPECT_EQ(corners(read_path("M1 1h3v4h-2-1v-2")), "1 1, 4 1, 4 5, 2 5, 1 5, 1 3");
  EXPECT_EQ(corners(read_path("M1 1H3V4H2 1")), "1 1, 3 1, 3 4, 2 4, 1 4");
  // A subpath after Z begins where the one before did, also for relative moves.
  EXPECT_EQ(corners(read_path("M1 1h3v3z l-1 5")), "1 1, 4 1, 4 4, 1 1, 0 6");
  EXPECT_EQ(corners(read_path("M1 1h3v3zm10 10h1")), "1 1, 4 1, 4 4, 11 11, 12 11");
  EXPECT_EQ(corners(read_path("M1 1h3v3z z")), "1 1, 4 1, 4 4, 1 1");
  EXPECT_EQ(corners(read_path("M1 1 M5 5 h1 M9 9")), "5 5, 6 5");
}

TEST(SvgPath, CurvesAndTheirMirroredControlPoints) {
  const auto poles = [](const Drawing& drawing, std::size_t curve) {
    std::string text;
    const auto& spline = std::get<Spline>(drawing.curves.at(curve).shape);
    EXPECT_EQ(spline.knots.size(), spline.poles.size() + spline.degree + 1);
    EXPECT_TRUE(spline.weights.empty());
    for (const Point p : spline.poles) text += fmt::format("{:.6g} {:.6g}, ", p.x, 80 - p.y);
    return text;
  };
  const Drawing cubic = read_path("M0 0C1 2 3 4 5 6S9 8 9 9s1 1 2 2");
  ASSERT_EQ(cubic.curves.size(), 3u);
  EXPECT_EQ(poles(cubic, 0), "0 0, 1 2, 3 4, 5 6, ");
  EXPECT_EQ(poles(cubic, 1), "5 6, 7 8, 9 8, 9 9, ");
  EXPECT_EQ(poles(cubic, 2), "9 9, 9 10, 10 10, 11 11, ");
  const Drawing quadratic = read_path("M0 0Q1 2 3 4T9 9t1 1M1 1T5 5S6 7 8 8");
  ASSERT_EQ(quadratic.curves.size(), 5u);
  EXPECT_EQ(poles(quadratic, 0), "0 0, 1 2, 3 4, ");
  EXPECT_EQ(poles(quadratic, 1), "3 4, 5 6, 9 9, ");
  EXPECT_EQ(poles(quadratic, 2), "9 9, 13 12, 10 10, ");
  EXPECT_EQ(poles(quadratic, 3), "1 1, 1 1, 5 5, ");  // nothing to mirror
  EXPECT_EQ(poles(quadratic, 4), "5 5, 5 5, 6 7, 8 8, ");
  EXPECT_EQ(poles(read_path("m5 5c1 0 2 1 3 3q1 1 2 0"), 1), "8 8, 9 9, 10 8, ");
}

TEST(SvgPath, ArcsAreCirclesWhereTheyAre) {
  // Flags without separators; y is turned up, so that "sweep" runs clockwise.
  const Drawing quarter = read_path("M10 0a10 10 0 01-10 10");
  ASSERT_EQ(quarter.curves.size(), 1u);
  const Edge arc = std::get<Edge>(quarter.curves[0].shape);
  EXPECT_EQ(arc.kind, EdgeKind::arc_cw);
  EXPECT_NEAR(norm(arc.centre - Point{0, 80}), 0, 1e-14);
  EXPECT_EQ(arc.from, (Point{10, 80}));
  EXPECT_EQ(arc.to, (Point{0, 70}));
  for (const auto& [flags, expected] : {std::pair("0 0", 0.5), {"0 1", 0.5}, {"1 0", 1.5}, {"1 1", 1.5}}) {
    const Drawing drawing = read_path(fmt::format("M10 0A10,10 77 {} 0,10", flags));
    EXPECT_NEAR(length(drawing), expected * kPi * 10, 1e-12) << flags;
    EXPECT_LT(drawing.curves[0].error, 1e-13);
  }
  // Half turns are exact, radii too small grow, negative ones count without sign, none is a line.
  EXPECT_NEAR(length(read_path("M0 0A5 5 0 0 1 10 0")), 5 * kPi, 1e-12);
  EXPECT_NEAR(length(read_path("M0.1 0.2A5 5 0 0 1 10.1 0.2")), 5 * kPi, 1e-12);
  EXPECT_NEAR(length(read_path("M0 0A1 1 0 0 1 10 0")), 5 * kPi, 1e-12);
  EXPECT_NEAR(length(read_path("M0 0A-5-5 0 0 1 10 0")), 5 * kPi, 1e-12);
  EXPECT_TRUE(std::get<Edge>(read_path("M0 0A0 5 0 0 1 10 0").curves.at(0).shape).kind == EdgeKind::line);
  EXPECT_TRUE(read_path("M3 3A5 5 0 1 1 3 3h1").curves.size() == 1);
  // A circle but for a thousandth, a millionth, nothing to speak of.
  for (const char* gap : {"0.001", "0.000001", "0.0000000001"}) {
    const Drawing drawing = read_path(fmt::format("M50 40a20 20 0 1 1 {} 0z", gap));
    EXPECT_NEAR(std::abs(area(drawing)), 400 * kPi, 30 * std::stod(gap)) << gap;
    for (const DrawnCurve& curve : drawing.curves) EXPECT_LT(curve.error, 1e-5) << gap;
  }
}

TEST(SvgPath, ArcsOfEllipses) {
  // Half of an ellipse turned by 30 degrees, then all four arcs between two points of one: they add up.
  EXPECT_NEAR(length(read_path("M30 30A12 5 30 0 0 50.784609690826528 42")),
              length(read_path("M30 30A12 5 30 0 1 50.784609690826528 42")), 1e-9);
  const double ellipse = length(read(page(R"(<ellipse rx="12" ry="5"/>)")));
  EXPECT_NEAR(2 * length(read_path("M30 30A12 5 30 0 0 50.784609690826528 42")), ellipse, 1e-6);
  double sum = 0;
  for (const char* flags : {"0 0", "0 1", "1 0", "1 1"})
    sum += length(read_path(fmt::format("M20 40A9 4-20 {} 24 36.5", flags)));
  EXPECT_NEAR(sum, 2 * length(read(page(R"(<ellipse rx="9" ry="4"/>)"))), 1e-11);
  // Every point lies on it: x^2/144 + y^2/25 = 1 about (20, 40).
  const Drawing drawing = read_path("M32 40A12 5 0 0 1 12.8 44");
  const auto& arc = std::get<EllipseArc>(drawing.curves.at(0).shape);
  EXPECT_NEAR(norm(arc.centre - Point{20, 40}), 0, 1e-12);
  EXPECT_EQ(arc.from, (Point{32, 40}));
  EXPECT_EQ(arc.to, (Point{12.8, 36}));
}

TEST(SvgPath, ClosingLinesThatAreOnlyRoundingAreLeftOut) {
  const Drawing drawing = read_path("m0.1,0.2 h 10.3 v 7.7 h -10.3 v -7.7 z");
  EXPECT_EQ(drawing.curves.size(), 4u);
  EXPECT_EQ(std::get<Edge>(drawing.curves[3].shape).to, std::get<Edge>(drawing.curves[0].shape).from);
  EXPECT_LT(drawing.curves[3].error, 1e-13);
  EXPECT_EQ(read_path("m0 0 h 10 v 7 h -10 v -6.99999 z").curves.size(), 5u);
}

TEST(SvgShapes, BasicShapes) {
  const Drawing rect = read(page(R"(<rect x="10" y="20" width="30" height="15"/>)"));
  EXPECT_EQ(corners(rect), "10 20, 40 20, 40 35, 10 35, 10 20");
  EXPECT_EQ(rect.entities.at(0).type, "rect");
  for (const DrawnCurve& curve : rect.curves) EXPECT_EQ(curve.error, 0);
  const Drawing round = read(page(R"(<rect x="10" y="20" width="30" height="15" rx="4"/>)"));
  EXPECT_EQ(round.curves.size(), 8u);
  EXPECT_NEAR(std::abs(area(round)), 450 - 64 + 16 * kPi, 1e-10);
  EXPECT_NEAR(length(round), 90 - 32 + 8 * kPi, 1e-11);
  const Drawing oval = read(page(R"(<rect x="10" y="20" width="30" height="15" ry="9" rx="4"/>)"));
  EXPECT_EQ(oval.curves.size(), 6u);  // ry is 7.5 then: no upright sides
  EXPECT_NEAR(std::abs(area(oval)), 450 - 4 * 30 + 30 * kPi, 1e-10);
  EXPECT_EQ(corners(read(page(R"(<line x1="1" y2="5"/>)"))), "1 0, 0 5");
  EXPECT_EQ(corners(read(page(R"(<polyline points="1,2 3,4-5.5.5"/>)"))), "1 2, 3 4, -5.5 0.5");
  EXPECT_EQ(corners(read(page(R"(<polygon points="1,2 3,4 5,0"/>)"))), "1 2, 3 4, 5 0, 1 2");
  EXPECT_EQ(corners(read(page(R"(<polygon points="1,2 3,4 5,0 1,2"/>)"))), "1 2, 3 4, 5 0, 1 2");
  const Drawing circle = read(page(R"(<circle cx="10" cy="20" r="5"/>)"));
  EXPECT_EQ(std::get<Edge>(circle.curves.at(0).shape),
            (Edge{EdgeKind::arc_cw, {15, 60}, {15, 60}, {10, 60}}));
  EXPECT_EQ(circle.curves[0].error, 0);
  EXPECT_TRUE(std::holds_alternative<EllipseArc>(
      read(page(R"(<ellipse cx="10" rx="5" ry="3"/>)")).curves.at(0).shape));
  EXPECT_TRUE(
      std::holds_alternative<Edge>(read(page(R"(<ellipse cx="10" rx="5" ry="5"/>)")).curves.at(0).shape));
  const Drawing nothing =
      read(page(R"(<circle r="0"/><rect width="5"/><path/><path d=""/><polygon points=""/>)"));
  EXPECT_TRUE(nothing.curves.empty());
  ASSERT_EQ(nothing.unread.size(), 4u);
  EXPECT_EQ(nothing.unread[1].name, "path (without length)");
  EXPECT_EQ(nothing.unread[1].count, 2u);
}

TEST(SvgTransforms, ChainsAreAppliedFromTheRight) {
  const auto moved = [](const std::string& transform) {
    return corners(
        read(page(R"(<g transform=")" + transform + R"("><line x1="1" y1="2" x2="3" y2="2"/></g>)")));
  };
  EXPECT_EQ(moved("translate(10)"), "11 2, 13 2");
  EXPECT_EQ(moved("translate(10,-1)"), "11 1, 13 1");
  EXPECT_EQ(moved("scale(2)"), "2 4, 6 4");
  EXPECT_EQ(moved("scale(2 , 3)"), "2 6, 6 6");
  EXPECT_EQ(moved("rotate(90)"), "-2 1, -2 3");
  EXPECT_EQ(moved("rotate(-90 1 2)"), "1 2, 1 0");
  EXPECT_EQ(moved("skewX(45)"), "3 2, 5 2");
  EXPECT_EQ(moved("skewY(45)"), "1 3, 3 5");
  EXPECT_EQ(moved("matrix(0 1 -1 0 5 5)"), "3 6, 3 8");
  EXPECT_EQ(moved("matrix(0,1-1,0,5,5)"), "3 6, 3 8");
  EXPECT_EQ(moved("translate(10 0) scale(2), rotate(90)\n"), "6 2, 6 6");
  EXPECT_EQ(moved(""), "1 2, 3 2");
  EXPECT_EQ(moved("none"), "1 2, 3 2");
  EXPECT_EQ(
      corners(read(page(R"~(<line x2="1" transform="translate(3,4)"/>)~", R"~(transform="scale(2)")~"))),
      "6 8, 8 8");
}

TEST(SvgTransforms, CirclesStayCirclesOrBecomeEllipses) {
  const auto shape = [](const std::string& transform) {
    return read(page(R"(<circle r="5" transform=")" + transform + R"("/>)")).curves.at(0).shape;
  };
  for (const char* keeps :
       {"rotate(33)", "scale(-2,2)", "matrix(0.6 0.8 0.8 -0.6 3 3)", "translate(1e3 1) scale(.1)"})
    EXPECT_TRUE(std::holds_alternative<Edge>(shape(keeps))) << keeps;
  for (const char* changes : {"scale(2,1)", "skewX(3)", "matrix(0.6 0.8 0.8 -0.61 3 3)"})
    EXPECT_TRUE(std::holds_alternative<EllipseArc>(shape(changes))) << changes;
  const Drawing mirrored = read(page(R"~(<path d="M10 0A10 10 0 0 1 0 10" transform="scale(-1 1)"/>)~"));
  EXPECT_EQ(std::get<Edge>(mirrored.curves.at(0).shape).kind, EdgeKind::arc_ccw);
}

TEST(SvgPage, UnitsOfThePage) {
  const auto size = [](const std::string& attributes, std::optional<LengthUnit> unit = std::nullopt) {
    const Drawing drawing =
        read("<svg xmlns=\"http://www.w3.org/2000/svg\" " + attributes + "><line x1=\"0\" x2=\"10\"/></svg>",
             unit);
    if (drawing.curves.size() != 1) return 0.0;
    const Edge& line = std::get<Edge>(drawing.curves[0].shape);
    return norm(line.to - line.from);
  };
  EXPECT_EQ(size(R"(width="100mm" height="50mm" viewBox="0 0 100 50")"), 10);
  EXPECT_EQ(size(R"(width="10cm" height="5cm" viewBox="0 0 100 50")"), 10);
  EXPECT_NEAR(size(R"(width="1in" height="1in" viewBox="0 0 10 10")"), 25.4, 1e-13);
  EXPECT_NEAR(size(R"(width="72pt" height="72pt" viewBox="0 0 10 10")"), 25.4, 1e-13);
  EXPECT_NEAR(size(R"(width="6pc" height="6pc" viewBox="0 0 10 10")"), 25.4, 1e-13);
  EXPECT_NEAR(size(R"(width="96px" height="96" viewBox="0 0 10 10")"), 25.4, 1e-13);
  EXPECT_EQ(size(R"(width="400Q" height="400Q" viewBox="0 0 100 100")"), 10);
  EXPECT_NEAR(size(R"(width="100mm" height="50mm")"), 10 * 25.4 / 96, 1e-14);
  EXPECT_NEAR(size(R"(width="100" height="50")"), 10 * 25.4 / 96, 1e-14);
  EXPECT_NEAR(size(R"(width="100%" height="100%" viewBox="0 0 7 7")"), 10 * 25.4 / 96, 1e-14);
  EXPECT_NEAR(size(""), 10 * 25.4 / 96, 1e-14);
  EXPECT_EQ(size(R"(width="50mm" viewBox="0 0 100 50")"), 5);  // the other side follows
  EXPECT_EQ(size(R"(height="50mm" viewBox="0 0 100 50")"), 10);
  // What the user says holds where the page says none.
  EXPECT_EQ(size("", LengthUnit::millimetre), 10);
  EXPECT_EQ(size(R"(width="96px" height="96px" viewBox="0 0 7 7")", LengthUnit::millimetre), 10);
  EXPECT_NEAR(size(R"(viewBox="0 0 100 50")", LengthUnit::inch), 254, 1e-12);
  EXPECT_EQ(size(R"(width="100mm" height="50mm" viewBox="0 0 100 50")", LengthUnit::millimetre), 10);
  EXPECT_FALSE(parse_svg(page(""), "p", LengthUnit::inch).has_value());
  EXPECT_FALSE(parse_svg(R"(<svg width="1in" height="1in"/>)", "p", LengthUnit::millimetre).has_value());
  EXPECT_EQ(read("<svg><line x2=\"1\"/></svg>").notices.size(), 1u);
  EXPECT_EQ(read("<svg><line x2=\"1\"/></svg>", LengthUnit::inch).notices.size(), 0u);
  EXPECT_EQ(read("<svg><line x2=\"1\"/></svg>", LengthUnit::inch).unit, "inch");
}

TEST(SvgPage, ViewBoxAndAlignment) {
  const auto first = [](const std::string& attributes) {
    const Drawing drawing = read(R"(<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="80mm" )" +
                                 attributes + R"(><line x1="0" y1="0" x2="10" y2="10"/></svg>)");
    return corners(drawing);
  };
  EXPECT_EQ(first(R"(viewBox="-5 -5 100 80")"), "5 5, 15 15");
  EXPECT_EQ(first(R"(viewBox="0,0,50,50")"), "10 0, 26 16");
  EXPECT_EQ(first(R"(viewBox="0 0 50 50" preserveAspectRatio="xMinYMid")"), "0 0, 16 16");
  EXPECT_EQ(first(R"(viewBox="0 0 50 50" preserveAspectRatio="xMaxYMax meet")"), "20 0, 36 16");
  EXPECT_EQ(first(R"(viewBox="0 0 50 50" preserveAspectRatio="xMidYMid slice")"), "0 -10, 20 10");
  EXPECT_EQ(first(R"(viewBox="0 0 50 50" preserveAspectRatio="none")"), "0 0, 20 16");
}

TEST(SvgTree, NestedPagesSymbolsAndUses) {
  EXPECT_EQ(corners(read(page(
                R"(<svg x="10" y="20" width="40" height="20" viewBox="0 0 20 20"><line x2="20"/></svg>)"))),
            "20 20, 40 20");
  EXPECT_EQ(corners(read(page(R"(<svg x="10%" y="25%"><line x2="50%"/></svg>)"))), "10 20, 60 20");
  const std::string symbol = R"(<symbol id="s" viewBox="0 0 10 10"><line x2="10"/></symbol>)";
  EXPECT_EQ(corners(read(page(symbol + R"(<use href="#s" x="5" y="6" width="20" height="20"/>)"))),
            "5 6, 25 6");
  EXPECT_EQ(
      corners(read(page(
          R"~(<use xlink:href="#l" x="5" y="6" transform="scale(2)"/><defs><line id="l" x2="1"/></defs>)~"))),
      "10 12, 12 12");
  const Drawing twice =
      read(page(R"(<g id="a"><line id="l" x2="1"/></g><g id="b"><use href="#a" x="3"/></g>)"));
  ASSERT_EQ(twice.curves.size(), 2u);
  EXPECT_EQ(corners(twice), "0 0, 3 0, 4 0");
  EXPECT_EQ(twice.entities.size(), 2u);
  EXPECT_EQ(twice.layers[twice.curves[1].layer].name, "b");
  EXPECT_EQ(corners(read(
                page(R"(<switch><line x2="9" systemLanguage="de"/><line x2="1"/><line x2="2"/></switch>)"))),
            "0 0, 1 0");
  EXPECT_EQ(corners(read(page(R"(<a><line x2="1"/></a>)"))), "0 0, 1 0");
}

TEST(SvgTree, Percentages) {
  EXPECT_EQ(corners(read(page(R"(<line x1="10%" y1="10%" x2="5mm" y2="0"/>)"))),
            fmt::format("10 8, {:.6g} 0", 5 * 96 / 25.4));
  const Drawing circle = read(page(R"(<circle r="10%"/>)"));
  EXPECT_NEAR(length(circle), 2 * kPi * 0.1 * std::sqrt((1e4 + 6.4e3) / 2), 1e-11);
}

TEST(SvgTree, WhatIsHidden) {
  const auto hidden = [](const std::string& content) {
    std::string text;
    const Drawing drawing = read(page(content));
    for (const DrawnCurve& curve : drawing.curves) text += drawing.layers[curve.layer].hidden ? "h" : "v";
    return text;
  };
  const std::string line = R"(<line x2="1"/>)";
  EXPECT_EQ(hidden(line + R"(<g display="none">)" + line + R"(<line x2="1" display="inline"/></g>)"), "vhh");
  EXPECT_EQ(hidden(R"(<g style="fill:red; display : none ">)" + line + "</g>"), "h");
  EXPECT_EQ(hidden(R"(<g visibility="hidden">)" + line + R"(<line x2="1" visibility="visible"/></g>)"), "hv");
  EXPECT_EQ(
      hidden(R"(<style>.a,.b{display:none} #c{visibility:hidden;stroke:red}/*line{display:none}*/</style>
      <line class="x b" x2="1"/><line id="c" x2="1"/><line class="ab" x2="1"/>)" +
             line),
      "hhvv");
  EXPECT_EQ(hidden(R"(<style>#c{display:inline} .a{display:none} line.a{display:none !important}</style>
      <line id="c" class="a" x2="1"/><line class="a" x2="1" style="display:inline"/><line class="a" x2="1"/>)"),
            "vvh");
  const Drawing drawing = read(
      page(R"(<style>g > line{display:none} @media print{.a{display:none}} .c{transform:scale(2)}</style>)" +
           line));
  EXPECT_EQ(drawing.notices.size(), 3u);
}

TEST(SvgTree, LayersAreGroupsThatSaySo) {
  const std::string ink = R"(xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape")";
  const Drawing drawing = read(page(R"(<line x2="1"/><g id="outer"><g id="inner"><line x2="2"/>
      <g inkscape:groupmode="layer" id="l1" inkscape:label="Cut"><g id="deep"><line x2="3"/></g></g>
      <g inkscape:groupmode="layer" id="l2"><line x2="4"/></g></g></g>)",
                                    ink));
  ASSERT_EQ(drawing.curves.size(), 4u);
  const char* expected[] = {"", "outer", "Cut", "l2"};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(drawing.layers[drawing.curves[i].layer].name, expected[i]);
}

TEST(SvgTree, WhatIsNotReadIsCounted) {
  const Drawing drawing =
      read(page(R"(<defs><clipPath id="c"><rect width="1" height="1"/></clipPath><linearGradient/></defs>
      <text>a</text><g id="t"><text>b</text></g><use href="#t"/><image/><foreignObject/><use href="other.svg#x"/><mesh/>
      <metadata><x/></metadata><title>t</title><x:thing xmlns:x="urn:x"><line x2="4"/></x:thing>)"));
  std::string counts;
  for (const Unread& unread : drawing.unread) counts += fmt::format("{} {}, ", unread.name, unread.count);
  EXPECT_EQ(
      counts,
      "clipPath 1, foreignObject 1, image 1, linearGradient 1, mesh 1, text 3, use (of another file) 1, ");
  EXPECT_TRUE(drawing.curves.empty());
}

TEST(SvgTree, NamespacesAsProgramsWriteThem) {
  EXPECT_EQ(read(R"(<svg width="1mm" height="1mm"><line x2="1"/></svg>)").curves.size(), 1u);
  EXPECT_EQ(
      read(R"(<svg:svg xmlns:svg="http://www.w3.org/2000/svg"><svg:line x2="1"/></svg:svg>)").curves.size(),
      1u);
  EXPECT_EQ(read("\xef\xbb\xbf<svg><line x2=\"1\"/></svg>").curves.size(), 1u);
  EXPECT_EQ(
      read(
          R"(<!DOCTYPE svg [<!ENTITY n "http://www.w3.org/2000/svg"><!ENTITY w "2">]><svg xmlns="&n;"><line x2="&w;"/></svg>)")
          .curves.size(),
      1u);
}

std::string nested(std::size_t depth) {
  std::string text = "<line x2=\"1\"/>";
  for (std::size_t i = 0; i < depth; ++i) text = "<g>" + text + "</g>";
  return text;
}

TEST(SvgRefusals, OneSentenceThatNamesThePlace) {
  EXPECT_TRUE(parse_svg(page(nested(kDeepestNesting)), "p").has_value());
  std::string laughs = "<!DOCTYPE svg [<!ENTITY a \"x\">";
  for (char c = 'b'; c < 'm'; ++c)
    laughs += fmt::format("<!ENTITY {} \"&{};&{};&{};\">", c, char(c - 1), char(c - 1), char(c - 1));
  std::string doubling = "<g id=\"u0\"><line x2=\"1\"/></g>";
  for (int i = 1; i < 15; ++i)
    doubling += fmt::format(R"(<g id="u{0}"><use href="#u{1}"/><use href="#u{1}"/><use href="#u{1}"/></g>)",
                            i, i - 1);
  std::string empty = "<g id=\"u0\"></g>";
  for (int i = 1; i < 15; ++i)
    empty += fmt::format(R"(<g id="u{0}"><use href="#u{1}"/><use href="#u{1}"/><use href="#u{1}"/></g>)", i,
                         i - 1);
  struct Case {
    std::string bytes;
    const char* said;
  };
  const auto path = [](const char* d) { return page(fmt::format("\n<path id=\"p1\" d=\"{}\"/>", d)); };
  const Case cases[] = {
      {"", "part.svg: the file is empty"},
      {"\x1f\x8b\x08xx", "compressed"},
      {"0\nSECTION\n", "line 1: this is not well-formed XML"},
      {"<svg><line></svg>", "not well-formed XML"},
      {"<svg><inkscape:x/></svg>", "not well-formed XML"},
      {"<html/>", "no SVG: its root is 'html'"},
      {"<svg xmlns=\"http://example.org\"/>", "no SVG"},
      {laughs + "]><svg>&l;</svg>", "holds other entities"},
      {"<!DOCTYPE svg [<!ENTITY a \"" + std::string(5000, 'x') + "\">]><svg/>", "is very long"},
      {std::string("<svg>") + nested(600) + "</svg>", "elements are nested more than 512 deep"},
      {page(nested(kDeepestNesting + 1)), "nested more than 32 deep"},
      {page(R"(<g id="a"><use href="#a"/></g>)"), "nested more than 32 deep"},
      {page(R"(<use id="a" href="#b"/><use id="b" href="#a"/>)"), "nested more than 32 deep"},
      {page(doubling), "more than 400000 copies"},
      {page(empty), "more than 400000 copies"},
      {page(R"(<use href="#none"/>)"), "there is no element '#none'"},
      {path("L1 1"), "part.svg, line 2, path 'p1': d: a path begins with M or m, not 'L'"},
      {path("M1"), "a number is needed at the end"},
      {path("M1 1L2"), "a number is needed at the end"},
      {path("M1 1L2,"), "a number is needed at the end"},
      {path("M1 1L2 2,"), "after the comma"},
      {path("M1 1L2 2 b"), "a path command is needed at character 10, 'b'"},
      {path("M1 1 z5"), "a path command is needed at character 7, '5'"},
      {path("M1 1A5 5 0 2 1 3 3"), "a flag, 0 or 1"},
      {path("M1 1LNaN 3"), "a number is needed"},
      {path("M1 1L1e99 3"), "out of range"},
      {path("M9e8 1l9e8 3"), "coordinates go up to"},
      {path("M1 1h9e8h9e8"), "coordinates go up to"},
      {page(R"(<circle r="-1"/>)"), "r is -1; it must not be below 0"},
      {page(R"(<rect width="1" height="x"/>)"), "height: a number is needed"},
      {page(R"(<rect width="3em" height="2"/>)"), "the unit 'em' is not known"},
      {page(R"(<polygon points="1 2 3"/>)"), "points: a number is needed"},
      {page(R"~(<g transform="rotate(1 2)"><line x2="1"/></g>)~"), "rotate has 2 numbers"},
      {page(R"~(<g transform="turn(1)"><line x2="1"/></g>)~"), "'turn' is no transform"},
      {page(R"(<g transform="scale(2"><line x2="1"/></g>)"), "a number is needed at the end"},
      {page(R"(<g transform="scale"><line x2="1"/></g>)"), "a transform, a word"},
      {page(R"~(<g transform="matrix(1 2 3 4 5 6 7)"/>)~"), "more than 6 numbers"},
      {page(R"~(<g transform="skewX(90)"/>)~"), "skews by a quarter turn"},
      {page(R"~(<g transform="scale(1e8)"><g transform="scale(1e8)"/></g>)~"), "beyond 1e+09"},
      {page(R"~(<g transform="scale(0)"><circle r="1"/></g>)~"), "make it flat"},
      {page(R"~(<g style="transform:rotate(3deg)"/>)~"), "its style attribute says transform"},
      {page(R"~(<path style="d:path('M0 0')"/>)~"), "its style attribute says d"},
      {R"(<svg width="0" height="3"/>)", "width is '0'; it must be above 0"},
      {R"(<svg width="3em"/>)", "width is '3em'; known units"},
      {R"(<svg width="3mm" viewBox="0 0 0 3"/>)", "width and height must be above 0"},
      {R"(<svg width="3mm" viewBox="0 0 3"/>)", "viewBox: a number is needed"},
      {R"(<svg width="3mm" viewBox="0 0 3 3 3"/>)", "viewBox has four numbers"},
      {R"(<svg width="3mm" viewBox="0 0 3 3" preserveAspectRatio="top"/>)", "no alignment"},
  };
  std::size_t refused = 0;
  for (const Case& c : cases) {
    const auto drawing = parse_svg(c.bytes, "part.svg");
    const std::string shown = c.bytes.substr(0, 300);
    if (!drawing) {
      EXPECT_EQ(drawing.error().code, ErrorCode::bad_input);
    }
    // A damaged element is set aside with the same sentence, and leaves nothing behind.
    if (drawing) {
      ASSERT_FALSE(drawing->damaged.empty()) << shown;
      EXPECT_TRUE(drawing->curves.empty()) << shown;
    }
    const std::string said = drawing ? drawing->damaged[0] : drawing.error().message;
    EXPECT_EQ(said.find("part.svg"), 0u) << said;
    EXPECT_NE(said.find(c.said), std::string::npos) << said << "\n" << shown;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    refused += drawing ? 0 : 1;
  }
  EXPECT_EQ(refused, 21u) << "what is no drawing, its page, and what is beyond the limits";
}

TEST(SvgTree, StrokesFillsAndDashesMakeEntriesOfALayer) {
  const Drawing drawing = read(page(R"~(<style>.e{stroke:rgb(0, 128,0)}</style>
      <g id="p" stroke="RED"><line x2="1"/><line x2="2" style="stroke:#00f;stroke-dasharray:2 1"/>
      <line x2="3" class="e"/><line x2="4" stroke="none" fill="#abc"/><line x2="5" stroke="rgb(100%,0%,0%)"/>
      <line x2="6" stroke="tomato"/><line x2="7" stroke="url(#g)" fill="none"/></g>)~"));
  std::string words;
  for (const DrawnCurve& curve : drawing.curves) {
    const Layer& layer = drawing.layers[curve.layer];
    EXPECT_EQ(layer.name, "p");
    words += layer.colour + (layer.line_type.empty() ? "" : ":" + layer.line_type) +
             (drawing.entities[curve.entity].filled ? "+" : "") + " ";
  }
  EXPECT_EQ(words, "#ff0000 #0000ff:dashed #008000 #aabbcc+ #ff0000 tomato  ");
}

TEST(SvgTree, ADamagedElementTakesNothingElseAway) {
  const Drawing drawing = read(page(R"~(<line x2="1"/><path id="bad" d="M0 0L1 1 L x"/><g><line x2="2"/>
      <g transform="turn(1)"><line x2="3"/></g></g><line x2="4"/>)~"));
  EXPECT_EQ(drawing.curves.size(), 3u);
  ASSERT_EQ(drawing.damaged.size(), 2u);
  EXPECT_NE(drawing.damaged[0].find("line 1, path 'bad'"), std::string::npos);
  std::string counts;
  for (const Unread& unread : drawing.unread) counts += fmt::format("{} {}, ", unread.name, unread.count);
  EXPECT_EQ(counts, "g (damaged) 1, path (damaged) 1, ");
}

TEST(SvgPage, OtherResolutionsAreNoticed) {
  const auto notice = [](const std::string& sides, const std::string& more = "") {
    const Drawing drawing = read(
        "<svg xmlns='http://www.w3.org/2000/svg' "
        "xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' " +
        sides + " " + more + "><line x2='1'/></svg>");
    return drawing.notices.at(0);
  };
  EXPECT_NE(
      notice("width='850.39368' height='566.92908'").find("at 72 px to the inch it would be 300 x 200 mm"),
      std::string::npos);
  EXPECT_NE(
      notice("width='744.09448' height='1052.3622'").find("at 90 px to the inch it would be 210 x 297 mm"),
      std::string::npos);
  EXPECT_NE(notice("width='100' height='33.3'", "inkscape:version='0.48.4 r9939'").find("at 90 px"),
            std::string::npos);
  EXPECT_EQ(notice("width='377.95276' height='755.90551'").find("it would be"), std::string::npos);
}

TEST(SvgRefusals, NoOtherFileIsOpened) {
  // Were it read, /etc/passwd would not be well-formed.
  const auto drawing = parse_svg(
      R"(<!DOCTYPE svg SYSTEM "/etc/passwd" [<!ENTITY x SYSTEM "/etc/passwd">]><svg>&x;<line x2="1"/></svg>)",
      "p");
  ASSERT_TRUE(drawing.has_value()) << drawing.error().message;
  EXPECT_EQ(drawing->curves.size(), 1u);
}

}  // namespace
}  // namespace lekalo::io::io_svg_test

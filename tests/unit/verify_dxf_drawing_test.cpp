#include <gtest/gtest.h>

#include <algorithm>

#include "support/drawn_text.hpp"
#include "verify/origin/drawing.hpp"

/// What the checker's own reader of DXF takes a drawing for, curve by curve.
namespace lekalo::verify::verify_dxf_drawing_test {
namespace {

using cases::drawn_cubics;
using cases::drawn_text;

/// Groups are written as words: every blank ends a line.
std::string lines(std::string words) {
  std::replace(words.begin(), words.end(), ' ', '\n');
  return words + "\n";
}
std::string read(const std::string& words, LengthUnit unit = LengthUnit::millimetre, double off = 1) {
  return drawn_text(read_dxf_drawing({"d.dxf", lines(words)}, unit, off));
}
std::string entities(const std::string& words, double off = 1) {
  return read("0 SECTION 2 ENTITIES " + words + " 0 ENDSEC 0 EOF", LengthUnit::millimetre, off);
}
std::string with_header(const std::string& header, const std::string& words = "0 LINE 10 1 20 2 11 3 21 5",
                        LengthUnit unit = LengthUnit::millimetre) {
  return read("0 SECTION 2 HEADER " + header + " 0 ENDSEC 0 SECTION 2 ENTITIES " + words + " 0 ENDSEC 0 EOF",
              unit);
}
std::string with_layers(const std::string& layers, const std::string& words) {
  return read("0 SECTION 2 TABLES 0 TABLE " + layers + " 0 ENDTAB 0 ENDSEC 0 SECTION 2 ENTITIES " + words +
              " 0 ENDSEC 0 EOF");
}
std::string with_blocks(const std::string& blocks, const std::string& words) {
  return read("0 SECTION 2 BLOCKS " + blocks + " 0 ENDSEC 0 SECTION 2 ENTITIES " + words + " 0 ENDSEC 0 EOF");
}
const std::string kLine = "0 LINE 10 1 20 2 11 3 21 5";

TEST(VerifyDxfDrawing, LinesHaveTwoEnds) {
  EXPECT_EQ(entities(kLine), ": L 1,2 3,5\n");
  EXPECT_EQ(entities("0 LINE 8 a 10 1 20 2 30 9 11 3 21 5 31 9"), "a: L 1,2 3,5\n");
  EXPECT_EQ(entities("0 LINE 10 1 20 2 11 1 21 2"), "");
  for (const char* part : {"10 1", "20 2", "11 3", "21 5"}) {
    std::string less = "0 LINE 10 1 20 2 11 3 21 5 ";
    less.erase(less.find(part), std::string(part).size() + 1);
    EXPECT_EQ(entities(less + "8 a"), "d.dxf: a LINE lacks an end") << part;
  }
  EXPECT_EQ(entities("0 LINE 10 x 20 2 11 3 21 5"), "d.dxf: \"x\" is no number");
}

TEST(VerifyDxfDrawing, ArcsRunCounterClockwiseBetweenTheirAngles) {
  EXPECT_EQ(entities("0 CIRCLE 10 1 20 2 40 5"), ": A 1,2 5 6,2 6,2 o\n");
  EXPECT_EQ(entities("0 ARC 10 1 20 2 40 5 50 0 51 90"), ": A 1,2 5 6,2 1,7 -\n");
  EXPECT_EQ(entities("0 ARC 10 1 20 2 40 5 50 90 51 0"), ": A 1,2 5 1,7 6,2 +\n");
  EXPECT_EQ(entities("0 ARC 10 1 20 2 40 5 50 0 51 180"), ": A 1,2 5 6,2 -4,2 =\n");
  EXPECT_EQ(entities("0 ARC 10 1 20 2 40 5 50 450 51 -90"), ": A 1,2 5 1,7 1,-3 =\n");
  EXPECT_EQ(entities("0 ARC 10 1 20 2 40 5 50 -90 51 450"), ": A 1,2 5 1,-3 1,7 =\n");
  EXPECT_EQ(entities("0 ARC 10 1 20 2 40 5 50 30 51 30"), ": A 1,2 5 5.33,4.5 5.33,4.5 o\n");
  EXPECT_EQ(entities("0 ARC 10 1 20 2 40 5 50 0 51 360"), ": A 1,2 5 6,2 6,2 o\n");
  EXPECT_EQ(entities("0 ARC 10 1 20 2 40 5 50 0 51 450"), ": A 1,2 5 6,2 1,7 -\n");
  EXPECT_EQ(entities("0 CIRCLE 10 1 20 2 40 0"), "");
  for (const char* less : {"0 CIRCLE 10 1 20 2", "0 CIRCLE 10 1 40 5", "0 ARC 10 1 20 2 40 5 50 0",
                           "0 ARC 10 1 20 2 40 5 51 0", "0 ARC 20 1 40 5 50 0 51 9"})
    EXPECT_EQ(entities(less), "d.dxf: an arc lacks a number") << less;
}

TEST(VerifyDxfDrawing, PolylinesBulge) {
  const std::string three = "10 0 20 0 10 10 20 0 10 10 20 8";
  EXPECT_EQ(entities("0 LWPOLYLINE 70 0 " + three), ": L 0,0 10,0 L 10,0 10,8\n");
  EXPECT_EQ(entities("0 LWPOLYLINE 70 1 " + three), ": L 0,0 10,0 L 10,0 10,8 L 10,8 0,0\n");
  EXPECT_EQ(entities("0 LWPOLYLINE 70 129 " + three), ": L 0,0 10,0 L 10,0 10,8 L 10,8 0,0\n");
  EXPECT_EQ(entities("0 LWPOLYLINE 70 128 " + three), ": L 0,0 10,0 L 10,0 10,8\n");
  EXPECT_EQ(entities("0 LWPOLYLINE 42 1 10 0 20 0 42 1 10 10 20 0"), ": A 5,0 5 0,0 10,0 =\n");
  EXPECT_EQ(entities("0 LWPOLYLINE 10 0 20 0 42 -1 10 10 20 0"), ": A 5,0 5 10,0 0,0 =\n");
  EXPECT_EQ(entities("0 LWPOLYLINE 10 0 20 0 42 0.5 10 10 20 0"), ": A 5,3.75 6.25 0,0 10,0 -\n");
  EXPECT_EQ(entities("0 LWPOLYLINE 10 0 20 0 42 -0.5 10 10 20 0"), ": A 5,-3.75 6.25 10,0 0,0 -\n");
  EXPECT_EQ(entities("0 LWPOLYLINE 10 0 20 0 42 2 10 10 20 0"), ": A 5,-3.75 6.25 0,0 10,0 +\n");
  EXPECT_EQ(entities("0 LWPOLYLINE 10 0 20 0 42 2 10 0 20 0"), "");
  EXPECT_EQ(entities("0 LWPOLYLINE 10 0 20 0 42 1e-3 10 10 20 0"), ": A 5,2500 2500 0,0 10,0 -\n");
  EXPECT_EQ(entities("0 LWPOLYLINE 10 0 20 0 42 9e-8 10 10 20 0"), ": L 0,0 10,0~\n");
  EXPECT_EQ(entities("0 LWPOLYLINE 10 0 20 0 10 10 20 x"), "d.dxf: \"x\" is no number");
  EXPECT_EQ(entities("0 LWPOLYLINE 10 0 20 0"), "");
  EXPECT_EQ(entities("0 LWPOLYLINE 70 1 10 0 20 0"), "");
  EXPECT_EQ(entities("0 LWPOLYLINE 20 1 10 0 20 0 20 3 10 5 20 7"), ": L 0,0 5,7\n");
}

TEST(VerifyDxfDrawing, AFlatArcIsItsChordWithinItsHeight) {
  ReadDrawing drawing;
  CurveMaker maker(drawing, 1);
  maker.bulge({}, {just(0), just(0)}, {just(10), just(0)}, Decimal{5, -8});
  maker.done("", false);
  ASSERT_EQ(drawing.curves.size(), 1U);
  EXPECT_GE(drawing.curves[0].pieces[0].off, 2.5e-7);  // the height is half the bulge times the chord
  EXPECT_LE(drawing.curves[0].pieces[0].off, 5.1e-7);
}

TEST(VerifyDxfDrawing, PolylinesOfTheOldKindHaveVertices) {
  const std::string vertices = " 0 VERTEX 10 0 20 0 42 1 0 VERTEX 10 10 20 0 0 VERTEX 10 10 20 8 0 SEQEND";
  EXPECT_EQ(entities("0 POLYLINE 8 a 70 0" + vertices), "a: A 5,0 5 0,0 10,0 = L 10,0 10,8\n");
  EXPECT_EQ(entities("0 POLYLINE" + vertices), ": A 5,0 5 0,0 10,0 = L 10,0 10,8\n");
  EXPECT_EQ(entities("0 POLYLINE 70 1" + vertices), ": A 5,0 5 0,0 10,0 = L 10,0 10,8 L 10,8 0,0\n");
  // In space there are no bulges, and a direction says nothing; meshes draw nothing here.
  EXPECT_EQ(entities("0 POLYLINE 70 8" + vertices), ": L 0,0 10,0 L 10,0 10,8\n");
  EXPECT_EQ(entities("0 POLYLINE 70 8 230 -1" + vertices), ": L 0,0 10,0 L 10,0 10,8\n");
  EXPECT_EQ(entities("0 POLYLINE 70 0 230 -1" + vertices), ": A -5,0 5 -10,0 0,0 = L -10,0 -10,8\n");
  EXPECT_EQ(entities("0 POLYLINE 70 16" + vertices), "");
  EXPECT_EQ(entities("0 POLYLINE 70 64" + vertices), "");
  EXPECT_EQ(entities("0 POLYLINE 70 4 0 VERTEX 10 0 20 0 0 VERTEX 70 16 10 5 20 5 0 VERTEX 70 8 10 9 20 0"),
            ": L 0,0 9,0\n");
  EXPECT_EQ(entities("0 POLYLINE 0 VERTEX 10 0 20 0 0 VERTEX 10 5"), "d.dxf: a VERTEX lacks a number");
  EXPECT_EQ(entities("0 POLYLINE 0 VERTEX 10 0 20 0 0 VERTEX 20 5"), "d.dxf: a VERTEX lacks a number");
  EXPECT_EQ(read("0 SECTION 2 ENTITIES 0 POLYLINE 0 VERTEX 10 1 20 2 0 VERTEX 10 3 20 5"), ": L 1,2 3,5\n");
}

TEST(VerifyDxfDrawing, EllipsesRunBetweenTheirParameters) {
  const std::string turned = "0 ELLIPSE 10 1 20 2 11 0 21 8 ", pi = "3.14159265358979",
                    quarter = "1.5707963267949";
  EXPECT_EQ(entities(turned + "40 0.5 41 0 42 " + quarter, 100),
            ": L 1,10 -0.2361,9.608~ L -0.2361,9.608 -1.351,8.472~ L -1.351,8.472 -2.236,6.702~ L "
            "-2.236,6.702 -2.804,4.472~ L -2.804,4.472 -3,2~\n");
  EXPECT_EQ(entities(turned + "40 0.5 230 -1 41 0 42 " + quarter, 100),
            ": L 1,10 2.236,9.608~ L 2.236,9.608 3.351,8.472~ L 3.351,8.472 4.236,6.702~ L 4.236,6.702 "
            "4.804,4.472~ L 4.804,4.472 5,2~\n");
  EXPECT_EQ(entities(turned + "40 1 41 0 42 " + quarter), ": A 1,2 8 1,10 -7,2 -\n");
  EXPECT_EQ(entities(turned + "40 1 230 -1 41 0 42 " + quarter), ": A 1,2 8 9,2 1,10 -\n");
  EXPECT_EQ(entities(turned + "40 1 41 " + quarter + " 42 0"), ": A 1,2 8 -7,2 1,10 +\n");
  EXPECT_EQ(entities(turned + "40 1 41 0 42 6.28318530717958"), ": A 1,2 8 1,10 1,10 o\n");
  EXPECT_EQ(entities(turned + "40 1 41 0 42 6.2831"), ": A 1,2 8 1,10 1.001,10 +\n");
  EXPECT_EQ(entities(turned + "40 1 41 0 42 6.28318"), ": A 1,2 8 1,10 1,10 +\n");
  // Parameters that lack a ten-thousandth of a degree are those of the whole.
  EXPECT_EQ(entities(turned + "40 1 41 0 42 6.2831827"), ": A 1,2 8 1,10 1,10 +\n");
  EXPECT_EQ(entities(turned + "40 1 41 0 42 6.2831840"), ": A 1,2 8 1,10 1,10 o\n");
  EXPECT_EQ(entities(turned + "40 1 41 0 42 7.85398163397448"), ": A 1,2 8 1,10 -7,2 -\n");
  EXPECT_EQ(entities(turned + "40 1 41 1 42 1"), ": A 1,2 8 -5.732,6.322 -5.732,6.322 o\n");
  for (const char* part : {"10 1 ", "21 8 ", "40 1 ", "41 0 ", "42 1 "}) {
    std::string less = "0 ELLIPSE 10 1 20 2 11 0 21 8 40 1 41 0 42 1 ";
    less.erase(less.find(part), std::string(part).size());
    EXPECT_EQ(entities(less + "8 a"), "d.dxf: an ELLIPSE lacks a number") << part;
  }
}

TEST(VerifyDxfDrawing, SplinesAreTheBezierCurvesBetweenTheirKnots) {
  const std::string poles3 = " 10 0 20 0 10 0 20 40 10 40 20 40 10 40 20 0";
  const std::string one = entities("0 SPLINE 71 3 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1" + poles3, 0.1);
  EXPECT_EQ(one, drawn_cubics({{0, 0, 0, 40, 40, 40, 40, 0}}, 0.1));
  EXPECT_EQ(entities("0 SPLINE 71 3 40 2 40 2 40 2 40 2 40 5 40 5 40 5 40 5" + poles3, 0.1), one);
  EXPECT_EQ(entities("0 SPLINE 71 3 41 1 41 1.0 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1" + poles3, 0.1), one);
  EXPECT_EQ(entities("0 SPLINE 71 1 40 0 40 0 40 1 40 2 40 3 40 3" + poles3),
            ": L 0,0 0,40 L 0,40 40,40 L 40,40 40,0\n");
  // The middle poles of a parabola are two thirds of the way to its own.
  EXPECT_EQ(
      entities("0 SPLINE 71 2 40 0 40 0 40 0 40 1 40 2 40 2 40 2" + poles3, 0.1),
      drawn_cubics({{0, 0, 0, 80.0 / 3, 20 / 3.0, 40, 20, 40}, {20, 40, 100 / 3.0, 40, 40, 80 / 3.0, 40, 0}},
                   0.1));
  EXPECT_EQ(entities("0 SPLINE 71 2 40 0 40 0 40 0 40 1 40 1 40 1 10 0 20 0 10 20 20 40 10 40 20 0", 0.1),
            drawn_cubics({{0, 0, 40 / 3.0, 80 / 3.0, 80 / 3.0, 80 / 3.0, 40, 0}}, 0.1));
  EXPECT_EQ(
      entities("0 SPLINE 71 3 40 0 40 0 40 0 40 0 40 1 40 3 40 3 40 3 40 3" + poles3 + " 10 60 20 10", 0.1),
      drawn_cubics({{0, 0, 0, 40, 40 / 3.0, 40, 200 / 9.0, 320 / 9.0},
                    {200 / 9.0, 320 / 9.0, 40, 80 / 3.0, 40, 0, 60, 10}},
                   0.1));
  const std::string not_read = "not read: splines with weights, of a degree above 3, or without knots\n";
  EXPECT_EQ(entities("0 SPLINE 71 3 41 1 41 2 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1" + poles3), not_read);
  EXPECT_EQ(entities("0 SPLINE 71 3 41 2 41 1 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1" + poles3), not_read);
  EXPECT_EQ(entities("0 SPLINE 71 3 40 0 40 0 40 0 40 0 40 1 40 1 40 1" + poles3), not_read);
  EXPECT_EQ(entities("0 SPLINE 71 0 40 0 40 0 40 0 40 0 40 1" + poles3), not_read);
  EXPECT_EQ(entities("0 SPLINE 71 0 40 0 40 0 40 0 40 0 40 1 40 1" + poles3), not_read);
  EXPECT_EQ(entities("0 SPLINE 71 -1 40 0 40 0 40 0 40 0" + poles3), not_read);
  EXPECT_EQ(
      entities("0 SPLINE 71 4 40 0 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1 40 1" + poles3 + " 10 50 20 0"),
      not_read);
  EXPECT_EQ(entities("0 SPLINE 71 3 40 0 40 0 40 0 40 1 40 1 40 1 40 1 10 0 20 0 10 1 20 0 10 2 20 5"),
            not_read);
  EXPECT_EQ(entities("0 SPLINE 71 1 40 0 40 0 40 2 40 1 40 3 40 3" + poles3),
            "d.dxf: a SPLINE whose knots descend");
  EXPECT_EQ(entities("0 SPLINE 71 1 40 x"), "d.dxf: \"x\" is no number");
  // Knots before and behind the poles bound no span, and a place needs its x.
  EXPECT_EQ(entities("0 SPLINE 71 1 40 0 40 1 40 2 40 3 40 4 40 5" + poles3),
            ": L 0,0 0,40 L 0,40 40,40 L 40,40 40,0\n");
  EXPECT_EQ(entities("0 SPLINE 71 1 20 9 40 0 40 0 40 1 40 1 10 0 20 0 10 5 20 7"), ": L 0,0 5,7\n");
  // A double knot is no span.
  EXPECT_EQ(entities("0 SPLINE 71 1 40 0 40 0 40 1 40 1 40 3 40 3" + poles3), ": L 0,0 0,40 L 40,40 40,0\n");
}

TEST(VerifyDxfDrawing, UnitsAreThoseOfTheHeader) {
  const auto unit = [](const std::string& code) { return with_header("9 $INSUNITS 70 " + code); };
  EXPECT_EQ(with_header("9 $INSUNITS 70 0"), ": L 1,2 3,5\n");
  EXPECT_EQ(with_header("9 $INSUNITS 70 0", kLine, LengthUnit::inch), ": L 25.4,50.8 76.2,127\n");
  EXPECT_EQ(with_header("9 $X 70 1"), ": L 1,2 3,5\n");
  EXPECT_EQ(with_header("9 $X", kLine, LengthUnit::inch), ": L 25.4,50.8 76.2,127\n");
  EXPECT_EQ(unit("1"), ": L 25.4,50.8 76.2,127\n");
  EXPECT_EQ(unit("2"), ": L 304.8,609.6 914.4,1524\n");
  EXPECT_EQ(unit("3"), ": L 1.609e+06,3.219e+06 4.828e+06,8.047e+06\n");
  EXPECT_EQ(unit("4"), ": L 1,2 3,5\n");
  EXPECT_EQ(unit("5"), ": L 10,20 30,50\n");
  EXPECT_EQ(unit("6"), ": L 1000,2000 3000,5000\n");
  EXPECT_EQ(unit("7"), ": L 1e+06,2e+06 3e+06,5e+06\n");
  EXPECT_EQ(unit("8"), ": L 2.54e-05,5.08e-05 7.62e-05,0.000127\n");
  EXPECT_EQ(unit("9"), ": L 0.0254,0.0508 0.0762,0.127\n");
  EXPECT_EQ(unit("10"), ": L 914.4,1829 2743,4572\n");
  EXPECT_EQ(unit("11"), ": L 1e-07,2e-07 3e-07,5e-07\n");
  EXPECT_EQ(unit("12"), ": L 1e-06,2e-06 3e-06,5e-06\n");
  EXPECT_EQ(unit("13"), ": L 0.001,0.002 0.003,0.005\n");
  EXPECT_EQ(unit("14"), ": L 100,200 300,500\n");
  EXPECT_EQ(unit("15"), ": L 1e+04,2e+04 3e+04,5e+04\n");
  EXPECT_EQ(unit("16"), ": L 1e+05,2e+05 3e+05,5e+05\n");
  for (const char* other : {"17", "-1", "x", "99"})
    EXPECT_EQ(unit(other), "d.dxf: its unit is not known here");
  for (const char* code : {"0", "1", "4"}) {
    const std::string text =
        lines("0 SECTION 2 HEADER 9 $INSUNITS 70 " + std::string(code) + " 0 ENDSEC 0 EOF");
    EXPECT_EQ(read_dxf_drawing({"d.dxf", text}, LengthUnit::millimetre, 1)->says_unit,
              code != std::string("0"));
  }
}

TEST(VerifyDxfDrawing, LayersAreOffOrFrozen) {
  const std::string a = "0 LINE 8 a 10 1 20 2 11 3 21 5", off = "0 LAYER 2 A 62 -7 70 0",
                    frozen = "0 LAYER 2 A 62 7 70 1";
  EXPECT_EQ(with_layers("0 LAYER 2 A 62 7 70 0", a), "a: L 1,2 3,5\n");
  EXPECT_EQ(with_layers("0 LAYER 2 A 62 0 70 4", a), "a: L 1,2 3,5\n");
  EXPECT_EQ(with_layers(off, a), "a!: L 1,2 3,5\n");
  EXPECT_EQ(with_layers(frozen, a), "a!: L 1,2 3,5\n");
  EXPECT_EQ(with_layers("0 LAYER 2 A 62 7 70 5", a), "a!: L 1,2 3,5\n");
  EXPECT_EQ(with_layers("0 LAYER 2 B 62 -7 70 1", a), "a: L 1,2 3,5\n");
  EXPECT_EQ(with_layers("0 LAYER 2 z{Z@[` 62 -7", "0 LINE 8 Z{z@[` 10 1 20 2 11 3 21 5"),
            "Z{z@[`!: L 1,2 3,5\n");
  EXPECT_EQ(with_layers("0 LAYER 2 [", "0 LINE 8 { 10 1 20 2 11 3 21 5"), "{: L 1,2 3,5\n");
  EXPECT_EQ(with_layers("0 LAYER 2 { 70 1", "0 LINE 8 [ 10 1 20 2 11 3 21 5"), "[: L 1,2 3,5\n");
  EXPECT_EQ(with_layers("0 LAYER 2 @ 70 1", "0 LINE 8 ` 10 1 20 2 11 3 21 5"), "`: L 1,2 3,5\n");
  // The name of the table is no layer.
  EXPECT_EQ(with_layers("2 LAYER 70 1 0 LAYER 2 A", kLine), ": L 1,2 3,5\n");
}

TEST(VerifyDxfDrawing, CountsAndBitsAreWholeNumbersOfAUsualSize) {
  const std::string no = "d.dxf: 1e+20 is no whole number of up to 1e9";
  EXPECT_EQ(with_layers("0 LAYER 2 A 70 1e20", kLine), no);
  EXPECT_EQ(with_header("9 $INSUNITS 70 1e20"), no);
  EXPECT_EQ(with_blocks("0 BLOCK 2 b " + kLine + " 0 ENDBLK", "0 INSERT 2 b 10 0 20 0 70 1e20"), no);
  EXPECT_EQ(with_layers("0 LAYER 2 A 70 0.5", kLine), "d.dxf: 0.5 is no whole number of up to 1e9");
  EXPECT_EQ(with_layers("0 LAYER 2 A 70 1e9", kLine), ": L 1,2 3,5\n");
}

TEST(VerifyDxfDrawing, WhatIsOnPaperOrInvisibleOrLeansIsNotDrawn) {
  EXPECT_EQ(entities(kLine + " 67 1"), "");
  EXPECT_EQ(entities(kLine + " 67 0"), ": L 1,2 3,5\n");
  EXPECT_EQ(entities(kLine + " 60 1"), "");
  EXPECT_EQ(entities(kLine + " 60 0"), ": L 1,2 3,5\n");
  EXPECT_EQ(entities(kLine + " 210 1 220 0 230 0"), "");
  EXPECT_EQ(entities(kLine + " 210 0 220 -1 230 1"), "");
  EXPECT_EQ(entities(kLine + " 210 0 220 0 230 0"), "");
  EXPECT_EQ(entities(kLine + " 210 1e-9 220 0 230 1"),
            ": L 1,2 3,5\nnot read: planes that lean by rounding\n");
  EXPECT_EQ(entities(kLine + " 210 0 220 -9e-10 230 1"),
            ": L 1,2 3,5\nnot read: planes that lean by rounding\n");
  EXPECT_EQ(entities(kLine + " 210 2e-9 220 0 230 1"), "");
  // Lines stand in the coordinates of the drawing, arcs in those of their plane.
  EXPECT_EQ(entities(kLine + " 230 -1"), ": L 1,2 3,5\n");
  EXPECT_EQ(entities("0 ARC 10 1 20 2 40 5 50 0 51 90 230 -1"), ": A -1,2 5 -1,7 -6,2 -\n");
  EXPECT_EQ(entities("0 LWPOLYLINE 10 1 20 2 10 3 20 5 230 -1"), ": L -1,2 -3,5\n");
  EXPECT_EQ(entities("0 TEXT 10 1 20 2 1 a 0 POINT 10 1 20 2"), "");
}

TEST(VerifyDxfDrawing, BlocksAreInsertedWhereTheySay) {
  const std::string block = "0 BLOCK 2 b 10 1 20 2 " + kLine + " 0 ENDBLK";
  const auto insert = [&](const std::string& words) { return with_blocks(block, "0 INSERT 2 B " + words); };
  EXPECT_EQ(insert("10 0 20 0"), ": L 0,0 2,3\n");
  EXPECT_EQ(insert("10 7 20 8"), ": L 7,8 9,11\n");
  EXPECT_EQ(insert("10 7 20 8 41 2"), ": L 7,8 11,11\n");
  EXPECT_EQ(insert("10 7 20 8 42 2"), ": L 7,8 9,14\n");
  EXPECT_EQ(insert("10 7 20 8 50 90"), ": L 7,8 4,10\n");
  EXPECT_EQ(insert("10 7 20 8 41 2 42 3 50 90"), ": L 7,8 -2,12\n");
  EXPECT_EQ(insert("10 7 20 8 230 -1"), ": L -7,8 -9,11\n");
  EXPECT_EQ(insert("10 0 20 0 70 2 44 10"), ": L 0,0 2,3\n: L 10,0 12,3\n");
  EXPECT_EQ(insert("10 0 20 0 71 2 45 10"), ": L 0,0 2,3\n: L 0,10 2,13\n");
  EXPECT_EQ(insert("10 0 20 0 70 2 71 2 44 10 45 20 50 90"),
            ": L 0,0 -3,2\n: L 0,10 -3,12\n: L -20,0 -23,2\n: L -20,10 -23,12\n");
  EXPECT_EQ(insert("10 0 20 0 70 0 71 -3"), ": L 0,0 2,3\n");
  EXPECT_EQ(insert("10 0 20 0 70 2000 71 1001"), "d.dxf: an INSERT makes too many copies");
  // The first copy that is wrong ends it, be it of 2 million.
  for (const char* copies : {"70 2000000", "71 2000000", "70 2000 71 1000"})
    EXPECT_EQ(with_blocks("0 BLOCK 2 b 0 LINE 0 ENDBLK", "0 INSERT 2 b 10 0 20 0 " + std::string(copies)),
              "d.dxf: a LINE lacks an end")
        << copies;
  EXPECT_EQ(insert("10 0"), "d.dxf: an INSERT lacks a number");
  EXPECT_EQ(with_blocks(block, "0 INSERT 2 c 10 0 20 0"), "");
  EXPECT_EQ(with_blocks("0 BLOCK 2 b " + kLine + " 0 ENDBLK", "0 INSERT 2 b 10 0 20 0"), ": L 1,2 3,5\n");
  EXPECT_EQ(with_blocks(block + " 0 BLOCK 2 b 0 CIRCLE 10 0 20 0 40 5 0 ENDBLK", "0 INSERT 2 b 10 1 20 2"),
            ": L 1,2 3,5\n");
  EXPECT_EQ(with_blocks("0 BLOCK 2 b 0 INSERT 2 b 10 0 20 0 0 ENDBLK", "0 INSERT 2 b 10 0 20 0"),
            "d.dxf: its blocks are nested too deep");
  EXPECT_EQ(
      with_blocks("0 BLOCK 2 b 0 ARC 10 0 20 0 40 5 50 0 51 90 0 ENDBLK", "0 INSERT 2 b 10 0 20 0 41 2 42 2"),
      ": A 0,0 10 10,0 0,10 -\n");
  EXPECT_EQ(with_blocks("0 BLOCK 2 b 0 LWPOLYLINE 10 0 20 0 42 2 10 0 20 0 0 ENDBLK",
                        "0 INSERT 2 b 10 0 20 0 41 2"),
            "");
  EXPECT_EQ(
      with_blocks("0 BLOCK 2 b 0 LWPOLYLINE 10 0 20 0 42 0.5 10 10 20 0 0 ENDBLK",
                  "0 INSERT 2 b 10 0 20 0 41 2"),
      ": L 0,0 1.991,-1.048~ L 1.991,-1.048 4.41,-1.84~ L 4.41,-1.84 7.128,-2.333~ L 7.128,-2.333 10,-2.5~ "
      "L 10,-2.5 12.87,-2.333~ L 12.87,-2.333 15.59,-1.84~ L 15.59,-1.84 18.01,-1.048~ L 18.01,-1.048 "
      "20,0~\n");
}

TEST(VerifyDxfDrawing, BlocksNestTo32Deep) {
  const auto nested = [](int depth) {
    std::string blocks = "0 BLOCK 2 b0 " + kLine + " 0 ENDBLK";
    for (int k = 1; k < depth; ++k)
      blocks += " 0 BLOCK 2 b" + std::to_string(k) + " 0 INSERT 2 b" + std::to_string(k - 1) +
                " 10 0 20 0 0 ENDBLK";
    return with_blocks(blocks, "0 INSERT 2 b" + std::to_string(depth - 1) + " 10 0 20 0");
  };
  EXPECT_EQ(nested(32), ": L 1,2 3,5\n");
  EXPECT_EQ(nested(33), "d.dxf: its blocks are nested too deep");
}

TEST(VerifyDxfDrawing, WhatABlockDrawsOnLayer0IsOnItsInsertsLayer) {
  const std::string block =
      "0 BLOCK 2 b 0 LINE 8 0 10 1 20 2 11 3 21 5 0 LINE 8 own 10 1 20 2 11 3 21 6 0 ENDBLK";
  const auto with = [&](const std::string& layer) {
    return read(
        "0 SECTION 2 TABLES " + layer + " 0 ENDSEC 0 SECTION 2 BLOCKS " + block +
        " 0 ENDSEC 0 SECTION 2 ENTITIES 0 INSERT 8 in 2 b 10 0 20 0 0 LINE 8 0 10 0 20 0 11 1 21 1 0 ENDSEC");
  };
  EXPECT_EQ(with("0 LAYER 2 x"), "in: L 1,2 3,5\nown: L 1,2 3,6\n0: L 0,0 1,1\n");
  // Off hides what lies on the layer; frozen also all that is inserted on it.
  EXPECT_EQ(with("0 LAYER 2 in 62 -1"), "in!: L 1,2 3,5\nown: L 1,2 3,6\n0: L 0,0 1,1\n");
  EXPECT_EQ(with("0 LAYER 2 in 70 1"), "in!: L 1,2 3,5\nin!: L 1,2 3,6\n0: L 0,0 1,1\n");
  EXPECT_EQ(with("0 LAYER 2 own 70 1"), "in: L 1,2 3,5\nown!: L 1,2 3,6\n0: L 0,0 1,1\n");
}

TEST(VerifyDxfDrawing, GroupsAreACodeAndAValue) {
  EXPECT_EQ(entities(kLine + " 999 comment"), ": L 1,2 3,5\n");
  EXPECT_EQ(entities("999 0 0 LINE 999 10 10 1 20 2 11 3 21 5"), ": L 1,2 3,5\n");
  // What applications add says nothing of the drawing.
  EXPECT_EQ(entities("0 LINE 102 {a 10 9 102 } 10 1 20 2 11 3 21 5 1000 x 1010 4"), ": L 1,2 3,5\n");
  EXPECT_EQ(entities("5 ENDSEC " + kLine), ": L 1,2 3,5\n");
  EXPECT_EQ(read("x"), "d.dxf: line 1 is no group of a DXF");
  EXPECT_EQ(read("0 SECTION  2 ENTITIES"), "d.dxf: line 4 is no group of a DXF");
  EXPECT_EQ(read("0"), "d.dxf: line 1 is no group of a DXF");
  EXPECT_EQ(read("0 SECTION x ENTITIES"), "d.dxf: line 4 is no group of a DXF");
  EXPECT_EQ(read("0 SECTION 10000 a"), "d.dxf: line 4 is no group of a DXF");
  EXPECT_EQ(read("0 SECTION -10000 a"), "d.dxf: line 4 is no group of a DXF");
  EXPECT_EQ(read("0 SECTION 9999 a"), "");
  EXPECT_EQ(read("0 SECTION 2 ENTITIES " + kLine + " 0 ENDSEC 0 EOF\n\n\n"), ": L 1,2 3,5\n");
  EXPECT_EQ(read(""), "");
  EXPECT_EQ(read("0 SECTION"), "");
  for (const char* section : {"HEADER 9 $X", "TABLES 0 TABLE", "BLOCKS 0 BLOCK", "ENTITIES", "HEADER"})
    EXPECT_EQ(read("0 SECTION 2 " + std::string(section)), "") << section;
  EXPECT_EQ(read("5 a 0 SECTION 2 ENTITIES " + kLine), ": L 1,2 3,5\n");
  EXPECT_EQ(read("0 SECTION 2 OBJECTS " + kLine + " 0 ENDSEC"), "");
}

TEST(VerifyDxfDrawing, WhatStandsBehindTheEndOrASecondTimeIsNoDrawing) {
  const std::string one = "0 SECTION 2 ENTITIES " + kLine + " 0 ENDSEC",
                    other = "0 SECTION 2 ENTITIES 0 CIRCLE 10 1 20 2 40 5 0 ENDSEC";
  EXPECT_EQ(read(one + " 0 EOF " + other), ": L 1,2 3,5\n");
  EXPECT_EQ(read("0 SECTION 2 ENTITIES " + kLine + " 0 EOF " + other), ": L 1,2 3,5\n");
  EXPECT_EQ(read(one + " " + other + " 0 EOF"), "d.dxf: a second section ENTITIES");
}

}  // namespace
}  // namespace lekalo::verify::verify_dxf_drawing_test

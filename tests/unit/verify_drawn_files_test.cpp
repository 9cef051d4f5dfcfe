#include <gtest/gtest.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "verify/drawn/drawn_file.hpp"

/// What the checker reads in an export, and that it refuses every word that lekalo does not write there.
namespace lekalo::verify::verify_drawn_files_test {
namespace {

std::string number(double value) { return fmt::format("{:.4g}", std::abs(value) < 1e-9 ? 0.0 : value); }
std::string point(Place p) { return number(p.x) + "," + number(p.y); }

std::string told(const Result<DrawnFile>& file) {
  if (!file) return file.error().message;
  std::string text;
  for (const DrawnLetters& one : file->texts)
    text += one.layer + one.colour + " '" + one.text + "' " + one.anchor + " " + point(one.at) + " " +
            point(one.right) + " " + point(one.up) + "\n";
  for (const DrawnLine& line : file->lines) {
    text += line.layer + line.colour + (line.closed ? "" : "!") + ":";
    for (const Stroke& edge : line.edges)
      text += (edge.arc ? " A " + point(edge.centre) + " " + number(edge.radius) + (edge.ccw ? " +" : " -")
                        : " L") +
              " " + point(edge.from) + " " + point(edge.to);
    text += "\n";
  }
  return text;
}

// ---- DXF --------------------------------------------------------------------------------------------------

/// Every blank ends a line.
std::string dxf_text(std::string words) {
  std::replace(words.begin(), words.end(), ' ', '\n');
  return words + "\n";
}
const std::string kHead = "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC ", kTail = " 0 ENDSEC 0 EOF";
std::string dxf(const std::string& entities) {
  return told(read_dxf({"e.dxf", dxf_text(kHead + "0 SECTION 2 ENTITIES " + entities + kTail)}));
}
std::string dxf_whole(const std::string& words) { return told(read_dxf({"e.dxf", dxf_text(words)})); }

TEST(VerifyDrawnDxf, PolylinesCirclesAndLinesAreRead) {
  EXPECT_EQ(dxf("0 LWPOLYLINE 5 1F 330 0 100 x 8 CUT 90 3 70 1 43 0 10 0 20 0 10 4 20 0 10 4 20 3"),
            "CUT: L 0,0 4,0 L 4,0 4,3 L 4,3 0,0\n");
  EXPECT_EQ(dxf("0 LWPOLYLINE 8 CUT 90 2 70 1 10 0 20 0 42 1 10 4 20 0 42 0.5"),
            "CUT: A 2,0 2 + 0,0 4,0 A 2,-1.5 2.5 + 4,0 0,0\n");
  EXPECT_EQ(dxf("0 LWPOLYLINE 8 CUT 90 2 70 1 10 0 20 0 42 -1 10 4 20 0 42 0"),
            "CUT: A 2,0 2 - 0,0 4,0 L 4,0 0,0\n");
  EXPECT_EQ(dxf("0 CIRCLE 8 CUT 10 1 20 2 30 0 40 5"), "CUT: A 1,2 5 + 6,2 6,2\n");
  EXPECT_EQ(dxf("0 LINE 8 MARK 10 1 20 2 30 0 11 3 21 5 31 0.0"), "MARK!: L 1,2 3,5\n");
  EXPECT_EQ(dxf("0 TEXT 8 LABEL 10 1 1 any 0 LINE 8 MARK 10 1 20 2 11 3 21 5"), "MARK!: L 1,2 3,5\n");
  EXPECT_EQ(dxf("0 LWPOLYLINE 8 ENG 420 255 90 2 70 0 10 0 20 0 42 1 10 4 20 0"),
            "ENG#0000ff!: A 2,0 2 + 0,0 4,0\n");
  EXPECT_EQ(dxf("0 LINE 8 A 10 1 20 2 11 3 21 5 0 LINE 10 1 20 2 11 3 21 6"),
            "A!: L 1,2 3,5\n!: L 1,2 3,6\n");
}

TEST(VerifyDrawnDxf, TextsHaveTheirAxes) {
  EXPECT_EQ(dxf("0 TEXT 8 T 420 16711680 10 1 20 2 30 0 40 3 1 N7 50 90 41 2"),
            "T#ff0000 'N7' left 1,2 0,6 -3,0\n");
  EXPECT_EQ(dxf("0 TEXT 8 T 10 1 20 2 40 3 1 N7 71 2 72 2 11 1 21 2"), "T 'N7' right 1,2 -3,0 0,3\n");
  EXPECT_EQ(dxf("0 TEXT 8 T 10 1 20 2 40 0.5 1 N7 41 0.5"), "T 'N7' left 1,2 0.25,0 0,0.5\n");
}

TEST(VerifyDrawnDxf, OnlyTextsAreLabels) {
  EXPECT_EQ(dxf("0 TEXT 8 LABEL 10 1 62 3 1 any 0 LINE 8 LABEL 10 1 20 2 11 3 21 5"), "LABEL!: L 1,2 3,5\n");
}

TEST(VerifyDrawnDxf, WhatLekaloDoesNotWriteIsRefusedWithItsLine) {
  const auto refused = [](const std::string& entities, const std::string& said) {
    EXPECT_NE(dxf(entities).find(said), std::string::npos) << entities << "\n" << dxf(entities);
  };
  refused("0 ARC 8 CUT", "line 16: lekalo writes no ARC");
  refused("0 LWPOLYLINE 8 CUT 90 2 70 8 10 0 20 0 10 4 20 0", "a polyline of another kind");
  refused("0 LINE 8 CUT 420 -1 10 1 20 2 11 3 21 5", "a colour that is none");
  refused("0 TEXT 8 T 10 1 20 2 1 x", "a text that lekalo does not write so");
  for (const char* lacking : {"20 2 40 3", "10 1 40 3", "10 1 20 2 40 0", "10 1 20 2 40 -1"})
    refused(std::string("0 TEXT 8 T 1 x ") + lacking, "a text that lekalo does not write so");
  refused("0 TEXT 8 T 10 1 20 2 40 3 1 x 71 4", "a text that lekalo does not write so");
  refused("0 TEXT 8 T 10 1 20 2 40 3 1 x 72 3 11 1 21 2", "a text that lekalo does not write so");
  refused("0 TEXT 8 T 10 1 20 2 40 3 1 x 72 1 11 2 21 2", "a text that lekalo does not write so");
  refused("0 LWPOLYLINE 8 CUT 90 3 70 1 10 0 20 0 10 4 20 0", "a polyline that is not of the vertices");
  refused("0 LWPOLYLINE 8 CUT 90 1 70 1 10 0 20 0", "a polyline that is not of the vertices");
  refused("0 LWPOLYLINE 8 CUT 70 1 10 0 20 0 10 4 20 0", "a polyline that is not of the vertices");
  refused("0 LWPOLYLINE 8 CUT 90 2 70 1 10 0 20 x", "x is no number");
  refused("0 LWPOLYLINE 8 CUT 90 2 70 1 20 0", "lekalo writes no group 20 there");
  refused("0 LWPOLYLINE 8 CUT 90 2 70 1 42 0", "lekalo writes no group 42 there");
  refused("0 LWPOLYLINE 8 CUT 90 2 70 1 10 0 30 0", "lekalo writes no group 30 there");
  refused("0 LINE 10 1 10 2", "lekalo writes no group 10 there");
  refused("0 LINE 10 1 20 2 30 1", "groups are missing");
  refused("0 LINE 10 1 20 2 31 1 11 3 21 4", "groups are missing");
  refused("0 LINE 10 1 20 2 11 3", "groups are missing in a LINE");
  refused("0 LINE 10 1 20 2 11 3 40 4", "groups are missing in a LINE");
  refused("0 CIRCLE 10 1 20 2", "groups are missing in a CIRCLE");
  refused("0 CIRCLE 10 1 20 2 40 5 50 0", "groups are missing in a CIRCLE");
  refused("0 CIRCLE 10 1 0 LINE 10 1 0 LWPOLYLINE 10 1", "groups are missing in a CIRCLE");
  refused("0 LWPOLYLINE 8 CUT 90 2 70 1 43 0.5 10 0 20 0", "lekalo writes no group 43 there");
  refused("0 LINE 43 0 10 1 20 2 11 3 21 5", "groups are missing in a LINE");
  refused("0 SECTION 2 ENTITIES", "line 16: lekalo writes no SECTION");
}

TEST(VerifyDrawnDxf, TheFileSaysItsUnitAndShowsItsLayers) {
  const std::string entities = "0 SECTION 2 ENTITIES 0 LINE 8 M 10 1 20 2 11 3 21 5" + kTail;
  EXPECT_EQ(dxf_whole("0 SECTION 2 HEADER 9 $INSUNITS 70 1 0 ENDSEC " + entities),
            "M!: L 25.4,50.8 76.2,127\n");
  EXPECT_EQ(
      dxf_whole(
          "0 SECTION 2 HEADER 9 $INSUNITS 70 1 0 ENDSEC 0 SECTION 2 ENTITIES 0 CIRCLE 8 C 10 1 20 0 40 2" +
          kTail),
      "C: A 25.4,0 50.8 + 76.2,0 76.2,0\n");
  EXPECT_EQ(dxf_whole("0 SECTION 2 HEADER 9 $INSUNITS 40 1 70 4 9 $X 70 1 0 ENDSEC " + entities),
            "M!: L 1,2 3,5\n");
  EXPECT_EQ(dxf_whole("0 SECTION 2 HEADER 9 $INSUNITS 70 5 0 ENDSEC " + entities),
            "e.dxf: line 8: its unit is neither mm nor inch");
  EXPECT_EQ(dxf_whole("0 SECTION 2 HEADER 9 $X 70 4 0 ENDSEC " + entities),
            "e.dxf: it does not say its unit");
  EXPECT_EQ(dxf_whole("0 SECTION 2 CLASSES 9 $INSUNITS 70 4 0 ENDSEC " + entities),
            "e.dxf: it does not say its unit");
  const auto table = [&](const std::string& layer) {
    return dxf_whole(kHead + "0 SECTION 2 TABLES 0 TABLE 2 LAYER 70 3 " + layer + " 0 ENDTAB 0 ENDSEC " +
                     entities);
  };
  EXPECT_EQ(table("0 LAYER 2 A 70 0 62 7"), "M!: L 1,2 3,5\n");
  EXPECT_EQ(table("0 LAYER 2 -A 70 0 62 7"), "M!: L 1,2 3,5\n") << "a name is no colour";
  EXPECT_EQ(table("0 LTYPE 2 A 70 1 62 -7"), "M!: L 1,2 3,5\n");
  EXPECT_EQ(table("0 LINE 2 A"), "M!: L 1,2 3,5\n") << "lines are drawn in ENTITIES alone";
  EXPECT_NE(table("0 LAYER 2 A 70 1 62 7").find("a layer is not shown"), std::string::npos);
  EXPECT_NE(table("0 LAYER 2 A 70 0 62 -7").find("a layer is not shown"), std::string::npos);
  EXPECT_EQ(table("0 LAYER 5 1F 330 1 100 x 2 A 70 0 62 7 6 Continuous"), "M!: L 1,2 3,5\n");
  EXPECT_EQ(table("0 LAYER 2 A 70 0 62 7 290 0"), "e.dxf: line 30: lekalo writes no group 290 there");
}

/// Each was confirmed once: readers take one of two, and not all the same one.
TEST(VerifyDrawnDxf, NothingIsSaidTwice) {
  const auto refused = [](const std::string& entities, const std::string& said) {
    EXPECT_NE(dxf(entities).find(said), std::string::npos) << entities << "\n" << dxf(entities);
  };
  refused("0 LINE 8 SHEET 8 CUT 10 1 20 2 11 3 21 5", "line 20: a second group 8");
  refused("0 LINE 8 CUT 420 1 420 2 10 1 20 2 11 3 21 5", "a second group 420");
  refused("0 LWPOLYLINE 8 CUT 90 3 90 2 70 1 10 0 20 0 10 4 20 0", "a second group 90");
  refused("0 LWPOLYLINE 8 CUT 90 2 70 1 70 0 10 0 20 0 10 4 20 0", "a second group 70");
  refused("0 TEXT 8 T 10 1 20 2 40 3 1 x 1 y", "a second group 1");
  refused("0 LINE 8 M 10 1 20 2 30 0 30 0 11 3 21 5", "a second group 30");
  refused("0 LINE 8 M 10 1 20 2 11 3 21 5 31 0 31 0", "a second group 31");
  refused("0 LWPOLYLINE 8 CUT 90 2 70 1 43 0 43 0 10 0 20 0 10 4 20 0", "a second group 43");
  const std::string line = "0 LINE 8 M 10 1 20 2 11 3 21 5";
  refused(line + " 0 ENDSEC 0 SECTION 2 ENTITIES " + line, "a section for the second time");
  EXPECT_EQ(dxf_whole("0 SECTION 2 HEADER 9 $INSUNITS 70 1 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 ENTITIES " +
                      line + kTail),
            "e.dxf: line 12: it says its unit twice");
}

TEST(VerifyDrawnDxf, LettersAndCirclesAreShownAsTheyAreMeant) {
  EXPECT_NE(dxf("0 CIRCLE 8 C 10 1 20 2 40 -5").find("a circle without a radius"), std::string::npos);
  EXPECT_NE(dxf("0 CIRCLE 8 C 10 1 20 2 40 0").find("a circle without a radius"), std::string::npos);
  const auto with = [](const std::string& version, const std::string& letters) {
    return told(read_dxf(
        {"e.dxf", dxf_text("0 SECTION 2 HEADER 9 $ACADVER 1 " + version +
                           " 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 ENTITIES 0 TEXT 8 T 10 1 20 2 40 3 1") +
                      letters + "\n" + dxf_text("0 ENDSEC 0 EOF")}));
  };
  EXPECT_EQ(with("AC1021", " Жук"), "T ' Жук' left 1,2 3,0 0,3\n") << "a blank moves the letters";
  EXPECT_EQ(with("AC1015", "a "), "T 'a ' left 1,2 3,0 0,3\n");
  const std::string unsaid = "e.dxf: its letters are UTF-8, which it does not say by $ACADVER AC1021";
  EXPECT_EQ(with("AC1015", "Жук"), unsaid);
  EXPECT_EQ(with("AC1015 9 $MENU 1 AC1021", "Жук"), unsaid) << "another variable";
  EXPECT_EQ(with("AC1015 9 $ACADVER 3 AC1021", "Жук"), unsaid) << "no text";
  // What was wrong before is told.
  EXPECT_EQ(with("AC1015 9 $INSUNITS 70 6", "Жук"), "e.dxf: line 12: its unit is neither mm nor inch");
}

TEST(VerifyDrawnDxf, AFileIsWholeAndItsBlocksAreEmpty) {
  const std::string line = "0 LINE 8 M 10 1 20 2 11 3 21 5", read = "M!: L 1,2 3,5\n";
  const std::string body = kHead + "0 SECTION 2 ENTITIES " + line;
  EXPECT_EQ(dxf_whole(body + kTail), read);
  EXPECT_EQ(dxf_whole(body), "e.dxf: line 26: it ends in the middle");
  EXPECT_EQ(dxf_whole(body + kTail + " 0 x"), "e.dxf: line 32: it goes on after its end");
  EXPECT_EQ(dxf_whole(body + kTail + " 5 x"), "e.dxf: line 32: it goes on after its end");
  EXPECT_EQ(dxf_whole("x " + body), "e.dxf: line 1: it ends in the middle");
  EXPECT_EQ(dxf_whole("0x SECTION"), "e.dxf: line 1: it ends in the middle");
  EXPECT_EQ(dxf_whole(body + "  x" + kTail), "e.dxf: line 27: it ends in the middle") << "a code left empty";
  EXPECT_EQ(dxf_whole(body + " 99999999999 x" + kTail), "e.dxf: line 27: it ends in the middle");
  EXPECT_EQ(told(read_dxf({"e.dxf", ""})), "e.dxf: line 0: it ends in the middle");
  const auto blocks = [&](const std::string& words) {
    return dxf_whole(kHead + "0 SECTION 2 BLOCKS " + words + " 0 ENDSEC 0 SECTION 2 ENTITIES " + line +
                     kTail);
  };
  EXPECT_EQ(blocks("0 BLOCK 8 0 10 1 0 ENDBLK 8 0"), read);
  EXPECT_EQ(blocks("0 BLOCK 0 LINE 0 ENDBLK"), "e.dxf: line 18: lekalo writes no LINE in a block");
  // Readers take one of two names, and none of what stands before a name.
  const std::string named = "a section without a name, or with a second one";
  EXPECT_EQ(dxf_whole(kHead + "0 SECTION 2 OBJECTS 2 ENTITIES " + line + kTail), "e.dxf: line 16: " + named);
  EXPECT_EQ(dxf_whole(kHead + "0 SECTION 3 ENTITIES " + line + kTail), "e.dxf: line 14: " + named);
  // Blanks around a line and the other ends of lines say nothing.
  std::string other_ends;
  for (const char c : dxf_text(body + kTail)) other_ends += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(told(read_dxf({"e.dxf", other_ends})), read);
  EXPECT_EQ(told(read_dxf({"e.dxf", "  0 \r\nSECTION\n2\n ENTITIES \n0\nENDSEC\n0\nEOF"})),
            "e.dxf: it does not say its unit");
}

// ---- SVG --------------------------------------------------------------------------------------------------

const std::string kProlog = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
const std::string kSpaces =
    R"( xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape")";
std::string svg_whole(const std::string& text) { return told(read_svg({"e.svg", text})); }
std::string svg(const std::string& body) {
  return svg_whole(kProlog + "<svg" + kSpaces + R"( version="1.1" width="100mm" height="100mm" )" +
                   R"(viewBox="-50 -50 100 100" data-lekalo-corner="-50 -50">
<g inkscape:groupmode="layer" inkscape:label="CUT" fill="none" stroke="#d00000" stroke-width="0.2">)" +
                   body + "</g>\n</svg>\n");
}
std::string path(const std::string& d) { return svg("<path d=\"" + d + "\"/>"); }

TEST(VerifyDrawnSvg, PathsCirclesAndLinesAreReadWithYUp) {
  EXPECT_EQ(path("M0 0L4 0L4,-3Z"), "CUT: L 0,0 4,0 L 4,0 4,3 L 4,3 0,0\n");
  EXPECT_EQ(path("M 0 0 L 4 0 L 4 -3 L 0 0 Z"), "CUT: L 0,0 4,0 L 4,0 4,3 L 4,3 0,0\n");
  EXPECT_EQ(path("M0 0L4 0L4 -3L0 -1e-3Z"), "CUT: L 0,0 4,0 L 4,0 4,3 L 4,3 0,0.001 L 0,0.001 0,0\n");
  EXPECT_EQ(path("M0 0L4 0L4 -3L1e-3 0Z"), "CUT: L 0,0 4,0 L 4,0 4,3 L 4,3 0.001,0 L 0.001,0 0,0\n");
  EXPECT_EQ(path("M0 0A2 2 0 0 0 4 0Z"), "CUT: A 2,0 2 + 0,0 4,0 L 4,0 0,0\n");
  EXPECT_EQ(path("M0 0A2.5 2.5 0 0 0 4 0Z"), "CUT: A 2,1.5 2.5 + 0,0 4,0 L 4,0 0,0\n");
  EXPECT_EQ(path("M0 0A2.5 2.5 0 1 0 4 0Z"), "CUT: A 2,-1.5 2.5 + 0,0 4,0 L 4,0 0,0\n");
  EXPECT_EQ(path("M0 0A2.5 2.5 0 0 1 4 0Z"), "CUT: A 2,-1.5 2.5 - 0,0 4,0 L 4,0 0,0\n");
  EXPECT_EQ(path("M0 0A2.5 2.5 0 1 1 4 0Z"), "CUT: A 2,1.5 2.5 - 0,0 4,0 L 4,0 0,0\n");
  EXPECT_EQ(path("M0 0A1 1 0 0 0 4 0Z"), "CUT: A 2,0 2 + 0,0 4,0 L 4,0 0,0\n");
  EXPECT_EQ(path("M0 0A.25 .25 0 0 0 .5 0Z"), "CUT: A 0.25,0 0.25 + 0,0 0.5,0 L 0.5,0 0,0\n");
  EXPECT_EQ(svg(R"(<circle cx="1" cy="-2" r="5" data-lekalo-arcs="1"/>)"), "CUT: A 1,2 5 + 6,2 6,2\n");
  EXPECT_EQ(svg(R"(<line x1="1" y1="-2" x2="3" y2="-5"/>)"), "CUT!: L 1,2 3,5\n");
  EXPECT_EQ(
      svg("</g><g inkscape:groupmode=\"layer\" inkscape:label=\"LABEL\" fill=\"none\" stroke=\"#008000\" "
          "stroke-width=\"1\"><text x=\"1\">any words</text>"),
      "");
  EXPECT_EQ(path("M0 0L4 0L4,-3"), "CUT!: L 0,0 4,0 L 4,0 4,3\n");
  EXPECT_EQ(svg("<text transform=\"matrix(0 -2 1 0 3 -4)\" font-family=\"sans-serif\" font-size=\"10\" "
                "text-anchor=\"end\" fill=\"#0000ff\" stroke=\"none\">a&lt;&amp;b</text>"),
            "CUT#0000ff 'a<&b' right 3,4 0,14.4 -7.2,0\n");
}

TEST(VerifyDrawnSvg, PathsOfOtherWordsAreRefused) {
  const std::string strange = "a path with other words than M, L, A and a Z at its end",
                    cut = "path data that cannot be read";
  const auto refused = [](const std::string& d, const std::string& said) {
    EXPECT_EQ(path(d), "e.svg: " + said + ": path d=\"" + d + "\"/");
  };
  refused("L0 0Z", "a path that does not begin with M");
  refused("0 0Z", "a path that does not begin with M");
  refused("", "a path that does not begin with M");
  refused("M0 0L1 1C1 2 3 4 5 6Z", strange);
  refused("M0 0L1 1ZL2 2Z", strange);
  refused("M0 0L1 1Z Z", strange);
  refused("M0 0L1 1 2 2Z", strange);
  refused("M0 0l1 1Z", cut);
  refused("M0 0", cut);
  refused("M0 0L1Z", cut);
  refused("M0 0L1 xZ", cut);
  refused("M0 0L1", cut);
  refused("M0", cut);
  for (const char* arc :
       {"A2 3 0 0 0 4 0Z", "A2 2 1 0 0 4 0Z", "A2 2 0 2 0 4 0Z", "A2 2 0 -1 0 4 0Z", "A2 2 0 0 2 4 0Z",
        "A2 2 0 0 -1 4 0Z", "A0 0 0 0 0 4 0Z", "A-2 -2 0 0 0 4 0Z", "A2 2 0 0 0 0 0Z"})
    refused(std::string("M0 0") + arc, "an arc that is not of a circle");
}

TEST(VerifyDrawnSvg, OtherElementsAndAttributesAreRefused) {
  const auto refused = [](const std::string& body, const std::string& said) {
    EXPECT_NE(svg(body).find(said), std::string::npos) << body << "\n" << svg(body);
  };
  refused("<rect/>", "lekalo writes no such element");
  refused("words<line x1=\"1\" y1=\"2\" x2=\"3\" y2=\"4\"/>", "text where lekalo writes none");
  refused("<line x1=\"1\" y1=\"2\" x2=\"3\"/>", "y2 is no number");
  refused("<line x1=\"1\" y1=\"2\" x2=\"3\" y2=\"x\"/>", "y2 is no number");
  refused("<line x1=\"1\" y1=\"2\" x2=\"3\" y2=\"4\" id=\"5\"/>", "lekalo writes no attribute id there");
  refused("<line x1=\"1\" y1=\"2\" x2=\"3\" y2=\"4\" transform=\"5\"/>",
          "lekalo writes no attribute transform there");
  refused("<circle cx=\"1\" cy=\"2\" r=\"3\" x=\"3\"/>", "lekalo writes no attribute x there");
  refused("<path d=\"M0 0L1 1L1 0Z\" x=\"3\"/>", "lekalo writes no attribute x there");
  refused("<path/>", "a path without data");
  refused("<line x1=\"1\" x1=\"1\" y1=\"2\" x2=\"3\" y2=\"4\"/>", "attributes that cannot be read");
  refused("<line x1/>", "attributes that cannot be read");
  refused("<line x1=\"1/>", "attributes that cannot be read");
  refused("<g inkscape:label=\"X\"></g>", "a group that is no layer");
  refused("<g>", "a group that is no layer");
  refused("<path d=\"m0 0L1 1L1 0Z\"/>", "a path that does not begin with M");
  refused("<path d=\"M0 0 l1 1L1 0Z\"/>", "a path with other words than M, L, A and a Z at its end");
  refused("<path d=\"M0 0L1 1 2 2L1 0Z\"/>", "a path with other words than M, L, A and a Z at its end");
  refused("<path d=\"M0 0L1 1L1 0Z5\"/>", "a path with other words than M, L, A and a Z at its end");
  refused("<path d=\"M0 0L1 1L1 xZ\"/>", "path data that cannot be read");
}

TEST(VerifyDrawnSvg, LinesAreShownAsLines) {
  const auto layer = [](const std::string& words) {
    return svg("</g><g inkscape:groupmode=\"layer\" inkscape:label=\"MARK\" " + words +
               "><line x1=\"1\" y1=\"-2\" x2=\"3\" y2=\"-5\"/>");
  };
  EXPECT_EQ(layer(R"(fill="none" stroke="#0000ff" stroke-width="0.2")"), "MARK!: L 1,2 3,5\n");
  for (const char* hidden :
       {"", R"(stroke="#0000ff" stroke-width="0.2")", R"(fill="#0000ff" stroke="#0000ff" stroke-width="0.2")",
        R"(fill="none" stroke-width="0.2")", R"(fill="none" stroke="none" stroke-width="0.2")",
        R"(fill="none" stroke="#0000f" stroke-width="0.2")",
        R"(fill="none" stroke="#0000fg" stroke-width="0.2")",
        R"(fill="none" stroke="0000ff0" stroke-width="0.2")",
        R"(fill="none" stroke="#0000ff" stroke-width="0")"})
    EXPECT_NE(layer(hidden).find("a layer whose lines are not shown as lines"), std::string::npos) << hidden;
  EXPECT_NE(layer(R"(fill="none" stroke="#0000ff")").find("stroke-width is no number"), std::string::npos);
  EXPECT_EQ(
      svg(R"(<path d="M0 0L4 0L4 -3" stroke="#0000ff"/><circle cx="1" cy="-2" r="5" stroke="#00ff00"/>)"),
      "CUT#0000ff!: L 0,0 4,0 L 4,0 4,3\nCUT#00ff00: A 1,2 5 + 6,2 6,2\n");
  for (const char* line : {R"(<path d="M0 0L4 0" stroke="none"/>)", R"(<path d="M0 0L4 0" stroke=""/>)",
                           R"(<circle cx="1" cy="-2" r="5" stroke="none"/>)"})
    EXPECT_NE(svg(line).find("a line in no colour"), std::string::npos) << line;
}

/// Each was confirmed once.
TEST(VerifyDrawnSvg, WhatHidesLettersIsRefused) {
  const auto text = [](const std::string& words, const std::string& rest = ">ab</text>") {
    return svg("<text transform=\"matrix(1 0 0 1 3 -4)\" font-size=\"10\" text-anchor=\"start\"" + words +
               rest);
  };
  const std::string fine = R"( font-family="sans-serif" fill="#000000" stroke="none")",
                    strange = "a text that lekalo does not write so";
  EXPECT_EQ(text(fine), "CUT#000000 'ab' left 3,4 7.2,0 0,7.2\n");
  EXPECT_NE(text(fine, "/>ab").find("a text without letters"), std::string::npos);
  for (const char* words :
       {R"( font-family="sans-serif" stroke="none")", R"( font-family="sans-serif" fill="" stroke="none")",
        R"( font-family="sans-serif" fill="none" stroke="none")",
        R"( font-family="sans-serif" fill="#000000")",
        R"( font-family="sans-serif" fill="#000000" stroke="#ff0000")",
        R"( font-family="Symbol" fill="#000000" stroke="none")", R"( fill="#000000" stroke="none")"})
    EXPECT_NE(text(words).find(strange), std::string::npos) << words;
  const std::string label =
      "</g><g inkscape:groupmode=\"layer\" inkscape:label=\"LABEL\" fill=\"none\" stroke=\"#008000\" "
      "stroke-width=\"1\">";
  EXPECT_NE(svg(label + "<text display=\"none\">a</text>").find("lekalo writes no attribute display there"),
            std::string::npos);
}

TEST(VerifyDrawnSvg, WhatHidesLinesIsRefused) {
  EXPECT_NE(svg(R"(<circle cx="1" cy="-2" r="-5"/>)").find("a circle without a radius"), std::string::npos);
  EXPECT_NE(svg(R"(<circle cx="1" cy="-2" r="0"/>)").find("a circle without a radius"), std::string::npos);
  EXPECT_EQ(path("M-50 0L50 50"), "CUT!: L -50,0 50,-50\n");
  EXPECT_EQ(path("M-50 0A50 50 0 0 1 50 0Z"), "CUT: A 0,0 50 - -50,0 50,0 L 50,0 -50,0\n");
  EXPECT_EQ(svg(R"(<circle cx="0" cy="0" r="50"/>)"), "CUT: A 0,0 50 + 50,0 50,0\n");
  EXPECT_EQ(path("M0 0L50.0000019073486328125 0"), "CUT!: L 0,0 50,0\n") << "as far off as it may be";
  EXPECT_NE(path("M0 0L50.0000020 0").find("something lies beyond the page"), std::string::npos);
  EXPECT_NE(svg(R"(<circle cx="0" cy="0" r="50.01"/>)").find("something lies beyond the page"),
            std::string::npos);
  for (const char* beyond :
       {"M-50.01 0L50 50", "M-50 1A50 50 0 0 0 50 1Z", "M-50 -1A50 50 0 0 1 50 -1Z", "M-50 0L50 50.01",
        "M0 50A50 50 0 0 1 50.01 0", "M-49 40A50 50 0 0 1 -49 -40Z", "M49 40A50 50 0 0 0 49 -40Z"})
    EXPECT_NE(path(beyond).find("something lies beyond the page"), std::string::npos) << beyond;
  const std::string words =
      "<text transform=\"matrix(1 0 0 1 51 -4)\" font-size=\"10\" text-anchor=\"end\" "
      "font-family=\"sans-serif\" fill=\"#000000\" stroke=\"none\">a</text>";
  EXPECT_NE(svg(words).find("a text stands beyond the page"), std::string::npos);
  EXPECT_NE(svg("</g><g inkscape:label=\"A\" fill=\"none\" stroke=\"#008000\" stroke-width=\"1\">")
                .find("a group that is no layer"),
            std::string::npos);
  for (
      const char* group :
      {R"(</g><g inkscape:groupmode="layer" fill="none" stroke="#008000" stroke-width="1">)",
       R"(<g inkscape:groupmode="layer" inkscape:label="A" fill="none" stroke="#008000" stroke-width="1"></g>)"})
    EXPECT_NE(svg(group).find("a group that is no layer"), std::string::npos) << group;
  EXPECT_NE(svg(R"(<line x1="1"y1="2" x2="3" y2="4"/>)").find("attributes that cannot be read"),
            std::string::npos);
}

TEST(VerifyDrawnSvg, TheFileIsADrawingInUtf8WithoutStyles) {
  const std::string page = "<svg" + kSpaces + R"( width="9mm" height="9mm" viewBox="0 -9 9 9"></svg>)";
  EXPECT_EQ(svg_whole(kProlog + page), "");
  const std::string strange = "attributes that cannot be read";
  for (const char* words : {R"(<?xml version="1.0" encoding="ISO-8859-1"?>)", "<?xml version=\"1.0\"?>",
                            R"(<?xml-stylesheet type="text/css" href="a.css"?>)"}) {
    EXPECT_NE(svg_whole(words + page).find(strange), std::string::npos) << words;
    EXPECT_NE(svg_whole(kProlog + words + page).find(strange), std::string::npos) << words;
  }
  EXPECT_NE(svg_whole(kProlog + kProlog + page).find(strange), std::string::npos);
  EXPECT_NE(svg_whole(page + "x").find("text where lekalo writes none"), std::string::npos);
  for (const char* space : {"http://www.w3.org/2000/svg\"", "namespaces/inkscape\""}) {
    std::string other = page;
    other.insert(other.find(space), "x");
    EXPECT_NE(svg_whole(other).find("a page in another name space"), std::string::npos) << space;
  }
}

TEST(VerifyDrawnSvg, ThePageIsAsLargeAsItsView) {
  const auto page = [](const std::string& words) {
    return svg_whole("<svg" + kSpaces + " " + words + "></svg>");
  };
  EXPECT_EQ(page(R"(width="100mm" height="50mm" viewBox="0 -50 100 50")"), "");
  EXPECT_EQ(page(R"(width="100mm" height="50mm" viewBox="3 -54 100 50" data-lekalo-corner="3 4")"), "");
  const auto refused = [&](const std::string& words, const std::string& said) {
    EXPECT_NE(page(words).find(said), std::string::npos) << words << "\n" << page(words);
  };
  const std::string large = "the page is not as large as its viewBox",
                    corner = "the corner of the page is not that of its viewBox";
  refused(R"(width="100" height="50mm" viewBox="0 -50 100 50")", "width is not in mm");
  refused(R"(width="100mm" height="50in" viewBox="0 -50 100 50")", "height is not in mm");
  refused(R"(width="xmm" height="50mm" viewBox="0 -50 100 50")", "width is no number");
  refused(R"(width="100mm" height="50mm")", "a page without a viewBox");
  refused(
      R"(width="100mm" height="50mm" viewBox="0 -50 100 50"><svg width="100mm" height="50mm" viewBox="0 -50 100 50"/)",
      "a second one");
  refused(R"(width="101mm" height="50mm" viewBox="0 -50 100 50")", large);
  refused(R"(width="100mm" height="51mm" viewBox="0 -51 100 50")", large);
  refused(R"(width="100mm" height="50mm" viewBox="0 -50 100 50 1")", large);
  refused(R"(width="100mm" height="50mm" viewBox="0 -50 100")", large);
  refused(R"(width="100mm" height="50mm" viewBox="x -50 100 50")", large);
  refused(R"(width="100mm" height="50mm" viewBox="1 -50 100 50")", corner);
  refused(R"(width="100mm" height="50mm" viewBox="0 -49 100 50")", corner);
  refused(R"(width="100mm" height="50mm" viewBox="0 -50 100 50" data-lekalo-corner="0")", corner);
  refused(R"(width="100mm" height="50mm" viewBox="0 -50 100 50" data-lekalo-corner="0 0 0")", corner);
  refused(R"(width="100mm" height="50mm" viewBox="0 -50 100 50" viewbox="0")",
          "lekalo writes no attribute viewbox there");
}

TEST(VerifyDrawnSvg, AFileIsWhole) {
  const std::string open = "<svg" + kSpaces + R"( width="100mm" height="50mm" viewBox="0 -50 100 50">)";
  EXPECT_EQ(svg_whole(open + "</svg>"), "");
  EXPECT_EQ(svg_whole(open + "\r\n\t </svg>"), "");
  EXPECT_NE(svg_whole(open).find("an element is not closed"), std::string::npos);
  EXPECT_NE(svg_whole(open + "</svg></svg>").find("an element that is not open is closed"),
            std::string::npos);
  EXPECT_NE(svg_whole(open + "</g></svg>").find("an element that is not open is closed"), std::string::npos);
  EXPECT_NE(svg_whole("").find("an element is not closed"), std::string::npos);
  EXPECT_NE(svg_whole(open + "</g>").find("an element that is not open is closed"), std::string::npos);
  EXPECT_NE(
      svg_whole(open + R"(<line x1="1" y1="2" x2="3" y2="4"/></svg>)").find("something is drawn on no layer"),
      std::string::npos);
  EXPECT_EQ(svg_whole(open + "<g></g></svg>"), "e.svg: a group that is no layer: g");
  EXPECT_NE(svg_whole("<text></text>").find("something is drawn on no layer"), std::string::npos);
  EXPECT_NE(svg_whole(open + "</svg").find("an element is cut off"), std::string::npos);
  EXPECT_NE(svg_whole("words" + open + "</svg>").find("text where lekalo writes none"), std::string::npos);
}

// ---- HPGL -------------------------------------------------------------------------------------------------

std::string hpgl(const std::string& body) { return told(read_hpgl({"e.plt", "IN;PA;" + body + "SP0;"})); }

TEST(VerifyDrawnHpgl, PensAreLayersAndUnitsAre40ToAMillimetre) {
  EXPECT_EQ(hpgl("SP1;PU0,0;PD160,0,160,120,0,0;PU;"), "CUT: L 0,0 4,0 L 4,0 4,3 L 4,3 0,0\n");
  EXPECT_EQ(hpgl("SP2;PU40,80;PD120,200;"), "MARK!: L 1,2 3,5\n");
  EXPECT_EQ(hpgl("SP2;PU40,80;PD40,200;"), "MARK!: L 1,2 1,5\n");
  EXPECT_EQ(hpgl("SP2;PU40,80;PD80,80;"), "MARK!: L 1,2 2,2\n");
  EXPECT_EQ(hpgl("SP2;PU40,80;PD120,200;PD40,80;"), "MARK!: L 1,2 3,5\nMARK!: L 3,5 1,2\n");
  EXPECT_EQ(hpgl("SP4;PU40,80;PD;"), "SHEET: L 1,2 1,2\n");
  EXPECT_EQ(hpgl("SP5;PU0,0;PD;SP6;PD;SP7;PD;"), "DEFECT: L 0,0 0,0\nZONE: L 0,0 0,0\nAREA: L 0,0 0,0\n");
  EXPECT_EQ(hpgl("SP3;PU1,1;SI0.2,0.3;LO5;LBany; words\x03;"), "");
  EXPECT_EQ(hpgl("\nSP3;\r\nPU1,1;\r"), "");
}

/// Each was confirmed once: labels are for people, and their pen draws nothing else.
TEST(VerifyDrawnHpgl, NothingIsDrawnBesideLabels) {
  EXPECT_EQ(hpgl("SP3;PU0,0;PD1,1;"), "e.plt: instruction 4: lekalo writes no PD1,1 there");
  EXPECT_EQ(hpgl("SP1;LBa\x03;"), "e.plt: instruction 3: lekalo writes no LBa there");
  EXPECT_EQ(hpgl("LBa\x03;"), "e.plt: instruction 2: lekalo writes no LBa there");
  EXPECT_EQ(hpgl("SP3;LBa\x03PD1,1;LB\x03;"), "e.plt: instruction 3: lekalo writes no LBa there");
  EXPECT_EQ(told(read_hpgl({"e.plt", "IN;PA;SP3;SP0;LBa\x03;"})),
            "e.plt: instruction 4: lekalo writes no LBa there");
}

TEST(VerifyDrawnHpgl, WhatLekaloDoesNotWriteIsRefused) {
  const auto refused = [](const std::string& body, const std::string& word, int at) {
    EXPECT_EQ(hpgl(body), fmt::format("e.plt: instruction {}: lekalo writes no {} there", at, word)) << body;
  };
  refused("SP8;", "SP8", 2);
  refused("SP/;", "SP/", 2);
  refused("SP;", "SP", 2);
  refused("SP11;", "SP11", 2);
  refused("SP1;SI1,1;", "SI1,1", 3);
  refused("SP1;LO5;", "LO5", 3);
  refused("SP3;LO4;", "LO4", 3);
  refused("SP1;CI5;", "CI5", 3);
  refused("PD1,1;", "PD1,1", 2);
  refused("SP1;PU1,1,2,2;", "PU1,1,2,2", 3);
  refused("SP1;PU1,1;PD1,1.5;", "1.5", 4);
  refused("SP1;PU1,1;PD1,x;", "x", 4);
  refused("SP1;PU1,1;PD1,2,3;", "odd list of numbers", 4);
  refused("SP0;PU1,1;", "PU1,1", 3);
  refused("S;", "S", 2);
  EXPECT_EQ(told(read_hpgl({"e.plt", "PA;IN;SP0;"})), "e.plt: instruction 0: lekalo writes no PA there");
  EXPECT_EQ(told(read_hpgl({"e.plt", "IN;IN;SP0;"})), "e.plt: instruction 1: lekalo writes no IN there");
  EXPECT_EQ(told(read_hpgl({"e.plt", "IN;PA;SP1;PU1,1;"})), "e.plt: it does not end with SP0");
  EXPECT_EQ(told(read_hpgl({"e.plt", "IN;PA;SP1;PU1,1;SP0"})), "e.plt: an instruction is cut off");
  EXPECT_EQ(told(read_hpgl({"e.plt", "IN;PA;SP3;LBx;SP0;"})), "e.plt: an instruction is cut off");
}

}  // namespace
}  // namespace lekalo::verify::verify_drawn_files_test

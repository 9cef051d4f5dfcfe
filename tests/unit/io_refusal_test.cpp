#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lekalo/io/contour/contour_file.hpp"
#include "support/io_contours.hpp"

namespace lekalo::io_refusal_test {
namespace {

using namespace std::string_literals;

struct Bad {
  const char* title;
  const char* name;
  std::string bytes;
  std::vector<const char*> says;  ///< all of these stand in the sentence
  std::optional<LengthUnit> unit{};
};

std::string entities(const std::string& text) { return io_cases::dxf_entities(text); }
std::string header(const std::string& units) {
  return "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n" + units + "\n0\nENDSEC\n";
}
std::string square(int flags = 1, const char* layer = "CUT") {
  return io_cases::polyline({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 0, flags, layer);
}
std::string side(int ax, int ay, int bx, int by) { return io_cases::line({ax, ay}, {bx, by}, 0); }

std::vector<Bad> unreadable() {
  const std::string line_ends = "0\n0,0\n";
  return {
      // text
      {"words", "a.csv", "0,0\n10,zero\n", {"a.csv", "line 2", "'zero' is not a number"}},
      {"letter O", "a.csv", "x,y\n0,0\nl0,0\n", {"line 3", "'l0' is not a number"}},
      {"a mistyped first point is no header", "a.csv", "O,5\n0,0\n", {"line 1", "'O' is not a number"}},
      {"one number", "a.txt", "0 0\n10\n", {"line 2", "one number where x and y are wanted"}},
      {"four numbers", "a.txt", "0 0 0 0\n", {"line 1", "4 numbers where x and y are wanted"}},
      {"decimal comma, semicolon", "a.csv", "12,5;3,7\n", {"line 1", "decimal comma", "12.5"}},
      {"decimal comma in one column", "a.csv", "12;3\n12,5;3\n", {"line 2", "decimal comma"}},
      {"decimal comma, blank", "a.txt", "12,5 3,7\n", {"line 1", "decimal comma"}},
      {"decimal comma, tab", "a.txt", "12,5\t3\n", {"line 1", "decimal comma"}},
      {"decimal comma, comma", "a.csv", "12,5,3,7\n", {"line 1", "decimal comma"}},
      {"mixed separators", "a.csv", "1;2,x\n", {"line 1", "mixes separators"}},
      {"comma and blank", "a.csv", "1, 2 3\n", {"line 1", "mixes separators"}},
      {"missing field", "a.csv", "0,0\n,5\n", {"line 2", "a number is missing"}},
      {"two commas", "a.csv", "0,,5\n", {"line 1", "a number is missing"}},
      {"trailing comma", "a.csv", "1,2,\n", {"line 1", "a number is missing"}},
      {"nan", "a.csv", "0,0\nnan,1\n", {"line 2", "'nan' is not a finite number"}},
      {"nan in the first line is no header",
       "a.csv",
       "NaN,NaN\n",
       {"line 1", "'NaN' is not a finite number"}},
      {"infinity", "a.csv", "0 0\n0 -Infinity\n", {"line 2", "'-Infinity' is not a finite number"}},
      {"overflow", "a.csv", "1e999,0\n", {"line 1", "'1e999' is out of range", "1e+09 mm"}},
      {"a little too large", "a.csv", "0,1000000001\n", {"line 1", "'1000000001' is out of range"}},
      {"too large only in inches", "a.csv", "0,40000000\n", {"'40000000' is out of range"}, LengthUnit::inch},
      {"hexadecimal", "a.csv", "0x10,0\n", {"'0x10' is not a number"}},
      {"two points in a number", "a.csv", "1.2.3,0\n", {"'1.2.3' is not a number"}},
      {"empty exponent", "a.csv", "1e,0\n", {"'1e' is not a number"}},
      {"lone sign", "a.csv", "0,0\n-,0\n", {"line 2", "'-' is not a number"}},
      {"typographic minus",
       "a.csv",
       "0,0\n\xe2\x88\x92"
       "5,0\n",
       {"line 2", "is not a number"}},
      {"control characters are shown",
       "a.csv",
       "0,0\n1\x07\x1b,0\n",
       {"line 2", "'1\\x07\\x1b' is not a number"}},
      {"a long word is shortened", "a.csv", "0,0\n0," + std::string(5000, 'a') + "\n", {"line 2", "aaa...'"}},
      {"old line ends", "a.csv", "0,0\r1,0\r1,1\r", {"line 1", "\\x0d"}},
      {"nothing", "a.csv", "# only a comment\n\n", {"a.csv", "there are no points"}},
      {"only a header", "a.csv", "x;y\n", {"there are no points"}},
      {"UTF-16 with mark",
       "a.csv",
       "\xff\xfe"
       "1\0,\0"
       "2\0"s,
       {"UTF-16", "UTF-8"}},
      {"UTF-16 without mark",
       "a.txt",
       "1\0,\0"
       "2\0\n\0"s,
       {"UTF-16"}},
      {"zero bytes", "a.txt", "1,2\n3,\0"s, {"zero bytes"}},
      // names
      {"no ending", "part", "0,0\n", {"part", "name without ending", ".csv"}},
      {"ending of a folder", "a.csv/part", "0,0\n", {"name without ending"}},
      {"other ending", "a.step", "0,0\n", {"'.step'", ".dxf"}},
      {"drawing by its name", "a.dwg", "AC1032\0\0"s, {"DWG", "ASCII DXF"}},
      // JSON
      {"not JSON", "a.json", "[[0,0],\n[1,0],\n", {"line 3", "not JSON"}},
      {"JSON nan", "a.json", "[[NaN,0]]", {"line 1", "not JSON"}},
      {"JSON overflow", "a.json", "[[0,0],\n[1e999,0]]", {"line 2", "'1e999' is out of range"}},
      {"JSON too large", "a.json", "[[0,0],[2e9,0]]", {"point 1", "'2e9' is out of range"}},
      {"JSON word", "a.json", "[[0,0],[\"1\",0]]", {"point 1", "two numbers are wanted, not '1'"}},
      {"JSON one number", "a.json", "[[0,0],[1]]", {"point 1 has 1 number where"}},
      {"JSON three numbers", "a.json", "[[0,0,0]]", {"point 0 has 3 numbers where"}},
      {"JSON flat list", "a.json", "[0,0,1,0]", {"point 0 is 0"}},
      {"JSON nested too deep", "a.json", "[[[0,0],[1,0]]]", {"point 0", "not a list"}},
      {"JSON empty", "a.json", "[]", {"there are no points"}},
      {"JSON number", "a.json", "7", {"a list of points or an object is wanted, not 7"}},
      {"JSON without points", "a.json", R"({"units": "mm"})", {"neither \"points\" nor \"outer\""}},
      {"JSON both forms", "a.json", R"({"points": [[0,0]], "outer": []})", {"second contour"}},
      {"JSON key twice", "a.json", R"({"points": [[0,0]], "points": [[0,1]]})", {"'points'", "twice"}},
      {"JSON units unknown",
       "a.json",
       R"({"points": [[0,0]], "units": "cm"})",
       {"\"units\"", "'cm'", "inch"}},
      {"JSON units no word", "a.json", R"({"points": [[0,0]], "units": 1})", {"'units'", "cannot be 1"}},
      {"JSON units contradict",
       "a.json",
       R"({"points": [[0,0]], "units": "inch"})",
       {"says inch, but mm was asked for", "--units"},
       LengthUnit::millimetre},
      {"JSON structure nobody knows",
       "a.json",
       R"({"points": [[0,0]], "hole": [[1,1]]})",
       {"'hole'", "a list"}},
      {"JSON hole", "a.json", R"({"outer": [], "holes": [[]]})", {"holes or islands"}},
      {"JSON arc",
       "a.json",
       R"({"outer": [{"arc": {"from": [0,0], "to": [1,0], "centre": [0.5,0], "ccw": true}}]})",
       {"edge 0", "any-shape"}},
      {"JSON edge without to", "a.json", R"({"outer": [{"line": {"from": [0,0]}}]})", {"edge 0", "\"to\""}},
      {"JSON edges apart",
       "a.json",
       R"({"outer": [{"line": {"from": [0,0], "to": [1,0]}}, {"line": {"from": [1,0.1], "to": [0,0]}}]})",
       {"edge 1 begins at (1, 0.1)", "edge 0 ends at (1, 0)"}},
      {"JSON edge with another word",
       "a.json",
       R"({"outer": [{"line": {"from": [0,0], "till": [1,0]}}]})",
       {"edge 0", "'till'"}},
      // DXF
      {"not DXF", "a.dxf", "0,0\n1,0\n", {"line 1", "'0,0' is not a DXF group code"}},
      {"binary DXF", "a.dxf", "AutoCAD Binary DXF\r\n\x1a\0"s, {"binary DXF", "save it as ASCII"}},
      {"PDF", "a.dxf", "%PDF-1.7\n"s, {"PDF", "save it as SVG or DXF"}},
      {"gzip", "a.dxf", "\x1f\x8b\x08"s, {"gzip", "unpack it first"}},
      {"STEP", "a.dxf", "ISO-10303-21;\nHEADER;"s, {"STEP", "as DXF"}},
      {"an image", "a.dxf", "\x89PNG\r\n\x1a\n"s, {"PNG", "trace it"}},
      {"DWG", "a.dxf", "AC1015\0\0\0"s, {"DWG", "save it as ASCII DXF"}},
      {"cut off in a pair", "a.dxf", "0\nSECTION\n2\n", {"line 3", "ends after a group code"}},
      {"cut off in ENTITIES", "a.dxf", "0\nSECTION\n2\nENTITIES\n" + square(), {"line 2", "not complete"}},
      {"cut off in HEADER", "a.dxf", "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n", {"line 2", "not complete"}},
      {"no ENTITIES", "a.dxf", header("4") + "0\nEOF\n", {"no section ENTITIES"}},
      {"nothing drawn", "a.dxf", entities(""), {"no LWPOLYLINE and no LINE"}},
      {"open polyline", "a.dxf", entities(square(0)), {"line 6", "layer 'CUT'", "not closed"}},
      {"two polylines",
       "a.dxf",
       entities(square(1, "OUTER") + square(1, "MARK")),
       {"2 LWPOLYLINEs", "'OUTER'", "'MARK'"}},
      {"polyline and line", "a.dxf", entities(square() + side(0, 0, 1, 1)), {"LWPOLYLINE (line 6", "LINEs"}},
      {"bulge", "a.dxf", entities(square() + "42\n0.5\n"), {"line 30", "bulge at vertex 3"}},
      {"arc",
       "a.dxf",
       entities("0\nARC\n8\nCUT\n10\n0\n20\n0\n40\n5\n50\n0\n51\n90\n"),
       {"line 6", "'ARC'", "'CUT'", "curves"}},
      {"circle", "a.dxf", entities(square() + "0\nCIRCLE\n8\nHOLES\n"), {"'CIRCLE'", "'HOLES'"}},
      {"spline", "a.dxf", entities("0\nSPLINE\n8\n0\n"), {"'SPLINE'"}},
      {"insert", "a.dxf", entities("0\nINSERT\n8\n0\n2\nPART\n"), {"'INSERT'", "explode the block"}},
      {"old polyline", "a.dxf", entities("0\nPOLYLINE\n8\n0\n66\n1\n"), {"'POLYLINE'", "R2000"}},
      {"text",
       "a.dxf",
       entities(square() + "0\nTEXT\n8\nNOTES\n1\nhello\n"),
       {"'TEXT'", "'NOTES'", "delete it"}},
      {"vertex count",
       "a.dxf",
       entities("0\nLWPOLYLINE\n90\n3\n70\n1\n10\n0\n20\n0\n10\n1\n20\n0\n"),
       {"'3' vertices, but has 2"}},
      {"x without y",
       "a.dxf",
       entities("0\nLWPOLYLINE\n70\n1\n10\n0\n10\n1\n20\n0\n"),
       {"line 12", "has no y"}},
      {"y without x", "a.dxf", entities("0\nLWPOLYLINE\n70\n1\n20\n0\n"), {"line 10", "a y without its x"}},
      {"DXF word as number", "a.dxf", entities("0\nLINE\n10\nzero\n"), {"line 8", "'zero' is not a number"}},
      {"line with one end", "a.dxf", entities("0\nLINE\n10\n0\n20\n0\n"), {"line 6", "two ends"}},
      {"seen from below", "a.dxf", entities(square() + "210\n0\n220\n0\n230\n-1\n"), {"extrusion"}},
      {"chain with a gap",
       "a.dxf",
       entities(side(0, 0, 10, 0) + side(10, 1, 0, 1)),
       {"breaks", "line 6", "(10, 0)", "1 mm away"}},
      {"chain not closed",
       "a.dxf",
       entities(side(0, 0, 10, 0) + side(10, 0, 10, 10)),
       {"not closed", "(10, 10)"}},
      {"two chains",
       "a.dxf",
       entities(side(0, 0, 1, 0) + side(1, 0, 0, 1) + side(0, 1, 0, 0) + side(5, 5, 6, 5) + side(6, 5, 5, 5)),
       {"more than one contour", "line 54", "line 6"}},
      {"drawing in centimetres",
       "a.dxf",
       header("5") + entities(square()),
       {"line 12", "$INSUNITS", "centimetres"}},
      {"drawing contradicts",
       "a.dxf",
       header("1") + entities(square()),
       {"line 12", "says inch, but mm was asked for"},
       LengthUnit::millimetre},
  };
}

TEST(IoRefusal, EveryUnreadableFileGivesOneSentenceThatNamesThePlace) {
  EXPECT_GE(unreadable().size(), 40U);
  for (const Bad& bad : unreadable()) {
    SCOPED_TRACE(bad.title);
    const auto file = io::parse_contour(bad.bytes, bad.name, bad.unit);
    ASSERT_FALSE(file.has_value());
    EXPECT_EQ(file.error().code, ErrorCode::bad_input);
    const std::string& message = file.error().message;
    EXPECT_EQ(message.find(bad.name), 0U) << message;
    EXPECT_EQ(message.find_first_of("\n\r\t"), std::string::npos) << message;
    EXPECT_LT(message.size(), 400U) << message;
    for (const char* part : bad.says)
      EXPECT_NE(message.find(part), std::string::npos) << message << "\nwithout " << part;
  }
}

TEST(IoRefusal, EveryContourThatIsNotConvexIsRefusedWithTheVertex) {
  const std::vector<Bad> all{
      {"one point", "a.csv", "1,1\n", {"1 different point"}},
      {"two points", "a.csv", "0,0\n1,1\n0,0\n", {"2 different points"}},
      {"one point many times", "a.csv", "1,1\n1,1\n1,1\n", {"1 different point"}},
      {"a straight line", "a.csv", "0,0\n1,1\n2,2\n", {"no area", "point 0 (line 1: 0, 0 mm)", "point 2"}},
      {"decimals on a straight line", "a.csv", "0.1,0.3\n0.2,0.6\n0.3,0.9\n", {"no area"}},
      {"there and back", "a.csv", "0,0\n5,0\n10,0\n5,0\n", {"no area"}},
      {"dent",
       "a.csv",
       "0,0\n10,0\n10,10\n5,9\n0,10\n",
       {"point 3 (line 4: 5, 9 mm)", "1 mm inside", "--trim 1.1"}},
      {"dent, clockwise",
       "a.csv",
       "0,10\n5,9\n10,10\n10,0\n0,0\n",
       {"point 1 (line 2: 5, 9 mm)", "1 mm inside"}},
      {"dent of a nanometre",
       "a.csv",
       "0,0\n100,0\n100,100\n50,99.999999\n0,100\n",
       {"point 3 (line 4", "1e-06 mm inside", "--trim"}},
      {"dent in JSON", "a.json", "[[0,0],[10,0],[10,10],[5,9],[0,10]]", {"point 3 (5, 9 mm)"}},
      {"dent of several points names the deepest",
       "a.csv",
       "0,0\n10,0\n10,10\n7,9\n5,7\n3,9\n0,10\n",
       {"point 4", "3 mm"}},
      {"star",
       "a.csv",
       "0,10\n6,-8\n-9.5,3\n9.5,3\n-6,-8\n",
       {"crosses itself or goes around more than once"}},
      {"figure of eight", "a.csv", "0,0\n10,10\n10,0\n0,10\n", {"crosses itself"}},
      {"twice around",
       "a.csv",
       "0,0\n10,0\n10,10\n0,0\n10,0\n10,10\n",
       {"comes to point", "again", "once around"}},
      {"runs back", "a.csv", "0,0\n6,0\n4,0\n10,0\n10,10\n", {"runs back", "point 2 (line 3: 4, 0 mm)"}},
      {"spike outwards",
       "a.csv",
       "0,0\n10,0\n20,0\n10,0\n10,10\n0,10\n",
       {"comes to point 1", "again at point 3"}},
      {"thinner than its digits",
       "a.csv",
       "1000.1,0.1\n2000.1,0.1\n1500.1,0.10000000000001\n",
       {"no area", "wider"}},
  };
  for (const Bad& bad : all) {
    SCOPED_TRACE(bad.title);
    const auto file = io::parse_contour(bad.bytes, bad.name, bad.unit);
    ASSERT_TRUE(file.has_value()) << file.error().message;
    const auto contour = io::make_convex(*file);
    ASSERT_FALSE(contour.has_value());
    EXPECT_EQ(contour.error().code, ErrorCode::bad_input);
    const std::string& message = contour.error().message;
    EXPECT_EQ(message.find(bad.name), 0U) << message;
    for (const char* part : bad.says)
      EXPECT_NE(message.find(part), std::string::npos) << message << "\nwithout " << part;
  }
}

TEST(IoRefusal, MoreThanFiveMillionPointsAreTooMany) {
  std::string text;
  for (std::size_t i = 0; i < io::kMostContourPoints; ++i) text += "1 2\n";
  EXPECT_EQ(io::parse_contour(text, "a.xyz", std::nullopt)->points.size(), io::kMostContourPoints);
  text += "1 2\n";
  const auto file = io::parse_contour(text, "a.xyz", std::nullopt);
  ASSERT_FALSE(file.has_value());
  EXPECT_NE(file.error().message.find("line 5000001: more than 5000000 points"), std::string::npos);
}

TEST(IoRefusal, ManyLineEndsInOnePlaceAreRefusedInsteadOfSearchedForever) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += side(0, 0, 0, 0);
  const auto file = io::parse_contour(entities(text), "a.dxf", std::nullopt);
  ASSERT_FALSE(file.has_value());
  EXPECT_NE(file.error().message.find("ends of LINEs meet at (0, 0)"), std::string::npos)
      << file.error().message;
}

}  // namespace
}  // namespace lekalo::io_refusal_test

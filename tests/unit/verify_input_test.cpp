// What verify reads: every way of writing the same contour gives the same exact numbers; what cannot be read
// is refused with one sentence.

#include <gtest/gtest.h>

#include <functional>

#include "support/verify_cases.hpp"

namespace lekalo::verify_input_test {
namespace {

using namespace verify_cases;
using verify::Verdict;

const Case& example() {
  static const Case c = examples()[0];
  return c;
}
const Files& honest() {
  static const Files files = write(example());
  return files;
}

std::string lines(const Points& points, const char* separator, const char* end = "\n") {
  std::string text;
  for (const auto& p : points) text += text_of(p[0]) + separator + text_of(p[1]) + end;
  return text;
}

std::string region(const Points& points) {
  std::string edges;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto &a = points[i], &b = points[(i + 1) % points.size()];
    edges += fmt::format(R"({}{{"line": {{"from": [{}, {}], "to": [{}, {}]}}}})", edges.empty() ? "" : ", ",
                         a[0], a[1], b[0], b[1]);
  }
  return fmt::format(R"({{"units": "mm", "outer": [{}], "holes": []}})", edges);
}

std::string dxf(const std::string& entities, const std::string& header = "") {
  return "0\nSECTION\n2\nHEADER\n" + header + "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities +
         "0\nENDSEC\n0\nEOF\n";
}

std::string polyline(const Points& points, int flags, const std::string& more = "") {
  std::string text = fmt::format("0\nLWPOLYLINE\n8\n0\n90\n{}\n70\n{}\n", points.size(), flags);
  for (const auto& p : points) text += fmt::format(" 10\n{}\n 20\n{}\n", p[0], p[1]);
  return text + more;
}

std::string line(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return fmt::format("0\nLINE\n8\n0\n10\n{}\n20\n{}\n30\n0\n11\n{}\n21\n{}\n31\n0\n", a[0], a[1], b[0], b[1]);
}

/// The lines of an outline in a scrambled order, every other one drawn backwards; the first stays.
std::string scrambled_lines(const Points& points) {
  const std::size_t n = points.size();
  std::string text;
  for (std::size_t i = 0, k = 0; i < n; ++i, k = (k + 3) % n) {  // 3 and 10 share no factor
    const auto &a = points[k], &b = points[(k + 1) % n];
    text += i % 2 == 0 ? line(a, b) : line(b, a);
  }
  return text;
}

TEST(VerifyInput, EveryWayToWriteAContourGivesTheSameNumbers) {
  const Points& points = example().blank;
  const std::string expected = check(honest())->clearance_low;
  Points closed = points;
  closed.push_back(points[0]);
  const std::vector<std::pair<std::string, std::string>> forms{
      {"b.csv", lines(points, ",")},
      {"b.csv", lines(points, ";")},
      {"b.txt", lines(points, " ")},
      {"b.xyz", lines(points, "\t")},
      {"B.CSV", "x,y\n" + lines(points, ", ")},
      {"b.csv", "\xEF\xBB\xBFx;y\r\n" + lines(points, " ; ", "\r\n")},
      {"b.txt", "# comment\n; comment\n// comment\n% comment\n\n" + lines(points, " ", " # remark\n")},
      {"b.xyz", lines(points, " ", " 12.5\n")},
      {"b.txt", lines(points, "e0\t+", "000e-3\n")},
      {"b.json", points_json(points)},
      {"b.json", "{\"points\": " + points_json(points) + ", \"name\": \"\\u0062\"}"},
      {"b.json", "{\"units\": \"mm\", \"\\u0070oints\": " + points_json(points) + "}"},
      {"b.json", region(points)},
      {"b.dxf", dxf(polyline(points, 1))},
      {"b.DXF", dxf(polyline(points, 129), "9\n$INSUNITS\n70\n4\n")},
      {"b.dxf", dxf(polyline(points, 1, "210\n0.0\n220\n0.0\n230\n1.0\n"), "9\n$INSUNITS\n70\n0\n")},
      {"b.dxf", dxf(scrambled_lines(points))},
  };
  for (const auto& [name, text] : forms) {
    Files files = honest();
    files.blank_name = name;
    files.blank = text;
    const auto report = check(files);
    ASSERT_TRUE(report) << name << ": " << report.error().message << "\n" << text;
    EXPECT_EQ(report->verdict, Verdict::confirmed) << name << "\n" << findings(report) << text;
    EXPECT_EQ(report->clearance_low, expected) << name;
  }
}

TEST(VerifyInput, AClosingPointAndCollinearPointsChangeNothingWhenListedAsDropped) {
  const std::string expected = check(honest())->clearance_low;
  Files files = honest();
  Points more = example().blank;
  more.push_back({43.5, 145.0});  // halfway between the last point and the first
  more.push_back(more[0]);        // closes
  files.blank = points_json(more);
  files["inputs"] = inputs_json(10, 12, "[]", "[10, 11]");
  const auto report = check(files);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->verdict, Verdict::confirmed) << findings(report);
  EXPECT_EQ(report->clearance_low, expected);

  files["inputs"] = inputs_json(10, 12, "[]", "[10]");
  EXPECT_NE(findings(check(files)).find("points 11 and 0 of the blank are equal"), std::string::npos)
      << findings(check(files));
}

TEST(VerifyInput, TheSameOutlineFromAnyPointAndEitherWayRoundIsConfirmed) {
  for (Case c : examples()) {
    for (int turn = 0; turn < 3; ++turn) {
      std::rotate(c.blank.begin(), c.blank.begin() + 3, c.blank.end());
      std::rotate(c.part.begin(), c.part.begin() + 4, c.part.end());
      if (turn == 1) std::reverse(c.blank.begin(), c.blank.end());
      if (turn == 2) std::reverse(c.part.begin(), c.part.end());
      const auto report = check(write(c));
      ASSERT_TRUE(report) << c.name << ": " << report.error().message;
      EXPECT_EQ(report->verdict, Verdict::confirmed) << c.name << "\n" << findings(report);
    }
  }
}

TEST(VerifyInput, InchesAreExactly25Point4Mm) {
  const auto square = [](double a, double b) { return Points{{a, a}, {b, a}, {b, b}, {a, b}}; };
  Files files = write({"", square(0, 12 * 25.4), square(0, 10 * 25.4), 25.4}, {}, 0, 360);
  files["inputs"] = inputs_json(4, 4, "[]", "[]", "inch");
  files["contacts"] = "[]";
  files.certificate.clear();
  files.part = points_json(square(0, 10));
  for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
           {"b.json", points_json(square(0, 12))},
           {"b.json", R"({"units": "inch", "points": )" + points_json(square(0, 12)) + "}"},
           {"b.dxf", dxf(polyline(square(0, 12), 1), "9\n$INSUNITS\n70\n1\n")}}) {
    files.blank_name = name;
    files.blank = text;
    set_pose(files, 25.4, 25.4, 0);
    files["clearance"] = "25.4";
    EXPECT_EQ(findings(check(files)).find("clearance 25.4 mm"), std::string::npos)
        << name << findings(check(files));
    files["clearance"] = "25.40000000000000000000000000000000000000001";
    EXPECT_NE(findings(check(files)).find("clearance 25.4 mm is above"), std::string::npos) << name;
  }
  files.blank_name = "b.json";
  files.blank = R"({"units": "mm", "points": )" + points_json(square(0, 12)) + "}";
  EXPECT_NE(findings(check(files)).find("the blank file says its unit is mm, the result says inch"),
            std::string::npos);
}

struct BadInput {
  const char* what;
  const char* words;
  std::function<void(Files&)> change;
};

void expect_bad_input(const BadInput& bad) {
  Files files = honest();
  bad.change(files);
  const auto report = check(files);
  ASSERT_FALSE(report) << bad.what << ":\n" << findings(report);
  EXPECT_EQ(report.error().code, ErrorCode::bad_input) << bad.what;
  const std::string& message = report.error().message;
  EXPECT_NE(message.find(bad.words), std::string::npos) << bad.what << ": " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << bad.what << ": " << message;
  EXPECT_LT(message.size(), 400U) << bad.what;
}

BadInput blank(const char* what, const char* words, std::string name, std::string text) {
  return {what, words, [name = std::move(name), text = std::move(text)](Files& f) {
            f.blank_name = name;
            f.blank = text;
          }};
}
BadInput field(const char* what, const char* words, const char* key, std::string value) {
  return {what, words, [key, value = std::move(value)](Files& f) { f[key] = value; }};
}

BadInput without(const char* words, const char* key) {
  return {key, words, [key](Files& f) { f.erase(key); }};
}

TEST(VerifyInput, WhatCannotBeReadIsRefusedInOneSentence) {
  const Points& points = example().blank;
  const Points open_end{{0, 0}, {5, 0}, {5, 5}};
  const std::vector<BadInput> table{
      blank("empty", "0 points", "b.csv", ""),
      blank("two points", "2 points", "b.csv", "1 2\n3 4\n"),
      blank("no area", "no area", "b.csv", "0 0\n1 1\n2 2\n3 3\n"),
      blank("star", "does not run once around", "b.csv", "0 3\n2 -2\n-3 1\n3 1\n-2 -2\n"),
      blank("eight", "does not run once around", "b.csv", "0 0\n4 4\n4 0\n0 4\n"),
      blank("one number", "b.csv:2: 1 fields", "b.csv", "1 2\n3\n4 5\n6 7\n"),
      blank("four numbers", "b.csv:1: 4 fields", "b.csv", "1 2 3 4\n"),
      blank("two commas", "b.csv:2: ", "b.csv", "1,2\n3,,4\n"),
      blank("a word", "b.csv:2: \"three\" is not a decimal number", "b.csv", "1 2\nthree 4\n5 6\n"),
      blank("nan", "\"nan\" is not", "b.csv", "1 2\nnan 4\n5 6\n"),
      blank("decimal comma", "b.csv:1: 4 fields", "b.csv", "1,5 2,5\n"),
      blank("1e999", "1e999", "b.csv", "1 2\n3 1e999\n5 6\n"),
      blank("huge exponent", "1e999999999", "b.csv", "1 2\n3 1e999999999\n5 6\n"),
      blank("huge negative exponent", "1e-99999999999999999999", "b.csv",
            "1 2\n3 1e-99999999999999999999\n5 6\n"),
      blank("very many digits", "at most 800 digits", "b.csv",
            "1 2\n3 0." + std::string(900, '7') + "\n5 6\n"),
      blank("unknown ending", "does not end in", "b.step", "1 2\n"),
      blank("no ending", "does not end in", "blank", "1 2\n"),
      blank("not JSON", "b.json:2: not JSON", "b.json", "[[1, 2],\n[3, ]]"),
      blank("JSON text", "neither a list", "b.json", "\"hello\""),
      blank("JSON point of three", "point 1 is not a list of two", "b.json", "[[1, 2], [3, 4, 5], [6, 7]]"),
      blank("JSON point of texts", "point 1", "b.json", "[[1, 2], [\"3\", 4], [6, 7]]"),
      blank("JSON with both forms", "either", "b.json", R"({"points": [], "outer": []})"),
      blank("JSON with neither", "either", "b.json", "{}"),
      blank("JSON field twice", "twice", "b.json", R"({"points": [], "points": []})"),
      blank("JSON field twice, once escaped", "twice", "b.json", R"({"points": [], "\u0070oints": []})"),
      blank("JSON units", "units are", "b.json", R"({"units": "cm", "points": [[0, 0], [1, 0], [0, 1]]})"),
      blank("JSON arc", "edge 0 of", "b.json", R"({"outer": [{"arc": {"from": [0, 0]}}]})"),
      blank("JSON hole", "holes", "b.json", R"({"outer": [], "holes": [[]]})"),
      blank(
          "JSON gap", "edge 1 does not begin where edge 0 ends", "b.json",
          R"({"outer": [{"line": {"from": [0, 0], "to": [1, 0]}}, {"line": {"from": [1, 0.001], "to": [0, 1]}},
                {"line": {"from": [0, 1], "to": [0, 0]}}]})"),
      blank("DXF open polyline", "not closed", "b.dxf", dxf(polyline(points, 0))),
      blank("DXF two polylines", "2 LWPOLYLINE", "b.dxf", dxf(polyline(points, 1) + polyline(points, 1))),
      blank("DXF nothing", "0 LWPOLYLINE and 0 LINE", "b.dxf", dxf("")),
      blank("DXF bulge", "bulge", "b.dxf", dxf(polyline(points, 1, "42\n0.5\n"))),
      blank("DXF circle", "entity CIRCLE", "b.dxf", dxf("0\nCIRCLE\n10\n0\n20\n0\n40\n5\n")),
      blank("DXF mixture", "1 LWPOLYLINE and 1 LINE", "b.dxf",
            dxf(polyline(points, 1) + line({0, 0}, {1, 1}))),
      blank("DXF seen from below", "seen from above", "b.dxf", dxf(polyline(points, 1, "230\n-1\n"))),
      blank("DXF units", "$INSUNITS 5", "b.dxf", dxf(polyline(points, 1), "9\n$INSUNITS\n70\n5\n")),
      blank("DXF broken chain", "no LINE continues", "b.dxf",
            dxf(line({0, 0}, {5, 0}) + line({5, 0.00001}, {0, 5}) + line({0, 5}, {0, 0}))),
      blank("DXF open chain", "does not come back", "b.dxf",
            dxf(line(open_end[0], open_end[1]) + line(open_end[1], open_end[2]))),
      blank("DXF two chains", "no LINE continues", "b.dxf",
            dxf(line({0, 0}, {5, 0}) + line({5, 0}, {0, 5}) + line({0, 5}, {0, 0}) + line({9, 9}, {8, 8}))),
      blank("DXF bad number", "\"1,5\" is not", "b.dxf", dxf("0\nLINE\n10\n1,5\n20\n0\n11\n1\n21\n1\n")),
      blank("DXF without an end", "no two ends", "b.dxf", dxf("0\nLINE\n10\n1.5\n20\n0\n11\n1\n")),
      blank("DXF that is text", "group code", "b.dxf", "hello\nworld\n"),
      blank("DXF cut off", "ends after a group code", "b.dxf", "0\nSECTION\n2\n"),
      field("NaN", "result.json:", "clearance", "NaN"),
      field("1e999", "field clearance is 1e999", "clearance", "1e999"),
      field("1e999999999", "field x is 1e999999999", "x", "1e999999999"),
      field("-1e-999999999", "field y is -1e-999999999", "y", "-1e-999999999"),
      field("a text for a number", "field theta is \"0.5\"", "theta", "\"0.5\""),
      field("null for a number", "field clearance is null", "clearance", "null"),
      field("another format", "format", "format", R"({"name": "other", "version": 1})"),
      field("another version", "format", "format", R"({"name": "lekalo-locate", "version": 2})"),
      without("field trim is missing", "trim"),
      without("field nc is missing", "nc"),
      without("field comparison is missing", "comparison"),
      without("field deviations is missing", "deviations"),
      field("mirrored", "mirrored", "mirrored", "true"),
      field("units inch", "units", "units", "\"inch\""),
      field("no such status", "\"fine\" is no status", "status", "\"fine\""),
      field("window of one", "window_deg", "window_deg", "[0]"),
      field("window backwards", "window_deg", "window_deg", "[10, 5]"),
      field("inputs without blank", "1 part and 0 blank", "inputs", "[" + input_json("part", 10) + "]"),
      field("two parts", "2 part and 1 blank", "inputs",
            "[" + input_json("part", 10) + ", " + input_json("part", 10) + ", " + input_json("blank", 10) +
                "]"),
      field("units of a part", "units of an input", "inputs", inputs_json(10, 10, "[]", "[]", "cm")),
      field("negative index", "field contacts[0].part_vertex is -1", "contacts",
            "[" + ContactText{"-1", "0", "1"}.json() + "]"),
      field("broken index", "field contacts[0].blank_edge is 1.5", "contacts",
            "[" + ContactText{"1", "1.5", "1"}.json() + "]"),
      field("deep nesting", "nested", "warnings", std::string(100'000, '[') + std::string(100'000, ']')),
      field("unclosed deep nesting", "nested", "warnings", std::string(1'000'000, '[')),
      field("control character", "control character", "warnings", "[\"\n\"]"),
      field("bad escape", "escape", "warnings", R"(["\x"])"),
      field("trim that is a number", "trim is not an object", "trim", "5"),
      field("trim of triples", "trim.contour[0]", "trim",
            R"({"tolerance": 1, "loss": 1, "contour": [[1, 2, 3]]})"),
      field("trim without area", "trim.contour: the contour has no area", "trim",
            R"({"tolerance": 1, "loss": 1, "contour": [[1, 2], [2, 3]]})"),
      {"a field twice", "given twice", [](Files& f) { f.fields.emplace_back("clearance", "0"); }},
      {"two contacts", "it has 2 contacts", [](Files& f) { f.certificate[3].contacts.pop_back(); }},
      {"four contacts", "more than three",
       [](Files& f) {
         f.certificate[3].contacts.push_back({"1", "1", "0"});
       }},
      {"an angle that is no number", "certificate interval 4",
       [](Files& f) { f.certificate[4].from = "\"0\""; }},
      {"an angle that is too large", "1e999", [](Files& f) { f.certificate[4].to = "1e999"; }},
      {"a vertex that is negative", "part_vertex is \"-1\"",
       [](Files& f) { f.certificate[4].contacts[0].part_vertex = "-1"; }},
      {"a vertex beyond all memory", "larger than 1e15",
       [](Files& f) { f.certificate[4].contacts[0].part_vertex = "1e300"; }},
  };
  for (const BadInput& bad : table) expect_bad_input(bad);
}

TEST(VerifyInput, AMissingFieldIsNamed) {
  for (const char* key : {"format", "status", "units", "inputs", "mirrored", "x", "y", "theta", "theta_deg",
                          "clearance", "upper_bound", "gap", "min_allowance", "shortfall", "window_deg",
                          "contacts", "alternatives", "trim", "nc"}) {
    expect_bad_input({key, key, [key](Files& f) { f.erase(key); }});
  }
}

TEST(VerifyInput, AResultCutOffAnywhereIsRefusedOrRefuted) {
  const std::string whole = honest().result();
  for (std::size_t length = 0; length < whole.size(); length += 97) {
    const std::string part = whole.substr(0, length);
    const auto report = verify::verify_locate(
        {{"result.json", part}, {"part.json", honest().part}, {"blank.json", honest().blank}, {}});
    ASSERT_FALSE(report) << length;
    EXPECT_EQ(report.error().code, ErrorCode::bad_input);
  }
}

TEST(VerifyInput, NumbersOfVeryDifferentSizeAreRefusedBeforeTheyEatTheMemory) {
  Files files = honest();
  std::string many = "1e-390 0\n";
  for (int i = 0; i < 80'000; ++i) many += "1e390 1e390\n";
  files.blank_name = "b.csv";
  files.blank = many;
  const auto report = check(files);
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().message.find("differ so much in magnitude"), std::string::npos)
      << report.error().message;
}

TEST(VerifyInput, ACertificateInAFileCountsAsOneInTheResult) {
  Files files = honest();
  files.inline_certificate = false;
  auto report = check(files);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->verdict, Verdict::confirmed) << findings(report);
  EXPECT_EQ(report->intervals, files.certificate.size());

  files.give_certificate = false;
  report = check(files);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->verdict, Verdict::unproved) << findings(report);
  EXPECT_TRUE(report->bound_high.empty());
}

TEST(VerifyInput, ACertificateFileMustBeOneAndAsLongAsTheResultSays) {
  Files files = honest();
  files.inline_certificate = false;
  const std::string result = files.result();
  const auto with = [&](const std::string& certificate) {
    return verify::verify_locate({{"result.json", result},
                                  {"part.json", files.part},
                                  {"blank.json", files.blank},
                                  verify::Document{"c.json", certificate}});
  };
  Files shorter = files;
  shorter.certificate[10].to = shorter.certificate[11].to;
  shorter.certificate.erase(shorter.certificate.begin() + 11);
  EXPECT_NE(findings(with(shorter.certificate_document())).find("intervals, the result says"),
            std::string::npos);
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {"", "c.json:1: not JSON"},
           {"[]", "format"},
           {R"({"format": {"name": "lekalo-locate", "version": 1}, "intervals": []})", "lekalo-certificate"},
           {R"({"format": {"name": "lekalo-certificate", "version": 1}})", "intervals"}}) {
    const auto report = with(text);
    ASSERT_FALSE(report) << text;
    EXPECT_NE(report.error().message.find(words), std::string::npos) << report.error().message;
  }
}

}  // namespace
}  // namespace lekalo::verify_input_test

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "lekalo/verify/claims.hpp"
#include "support/layout_texts.hpp"
#include "support/lies.hpp"

/// What the checker says of layouts and of reports about them, from bytes made by hand.
namespace lekalo::verify::verify_claims_test {
namespace {

using cases::Json;
using test::Lie;

// ---- kinds ------------------------------------------------------------------------------------------------

std::string kind(const std::string& bytes) {
  const Result<Kind> kind = kind_of({"f", bytes});
  return kind ? std::string(name_of(*kind)) : kind.error().message;
}

TEST(VerifyClaimsKind, JsonIsToldByItsFormat) {
  const auto named = [](const std::string& name) {
    return kind(R"({"format": {"name": "lekalo-)" + name + "\"}}");
  };
  EXPECT_EQ(named("locate"), "a placement");
  EXPECT_EQ(named("nest"), "a report of nest");
  EXPECT_EQ(named("order"), "a report of an order");
  EXPECT_EQ(named("check"), "a report of check");
  EXPECT_EQ(named("show"), "a report of show");
  EXPECT_EQ(named("pocket"), "a report of pocket");
  EXPECT_EQ(named("simulate"), "a report of simulate");
  EXPECT_EQ(named("verify"), "a report of verify");
  EXPECT_EQ(named("certificate"), "a certificate");
  const std::string none = "none of lekalo's files";
  EXPECT_EQ(named("other"), none);
  EXPECT_EQ(kind(R"({"format": "lekalo-layout/1"})"), "a layout");
  EXPECT_EQ(kind(R"({"format": "lekalo-layout/2"})"), none);
  EXPECT_EQ(kind(R"({"format": 1})"), none);
  EXPECT_EQ(kind(R"({"format": {"name": 1}})"), none);
  EXPECT_EQ(kind(R"({"format": "lekalo-layout/1", "format": "lekalo-layout/1"})").find("layout"),
            std::string::npos);
  EXPECT_EQ(kind(R"({"placements": [], "strip_height": 5})"), "placements on a strip");
  EXPECT_EQ(kind(R"({"placements": []})"), none);
  EXPECT_EQ(kind(R"({"placements": 1, "strip_height": 5})"), none);
  EXPECT_EQ(kind(R"({"strip_height": 5})"), none);
  EXPECT_EQ(kind("[1]"), none);
  EXPECT_EQ(kind("\xEF\xBB\xBF \t\r\n{\"format\": \"lekalo-layout/1\"}"), "a layout");
  for (const char* text : {"{", "["}) EXPECT_TRUE(kind(text).starts_with("f:")) << kind(text);
}

TEST(VerifyClaimsKind, OtherFilesAreToldByTheirFirstBytes) {
  const std::string none = "none of lekalo's files", program = "an NC program", dxf = "a DXF drawing",
                    picture = "a picture";
  EXPECT_EQ(kind("\x89PNG..."), picture);
  EXPECT_EQ(kind("%PDF-1.4"), picture);
  EXPECT_EQ(kind(""), none);
  EXPECT_EQ(kind(" \n"), none);
  EXPECT_EQ(kind("<svg><g inkscape:groupmode=\"layer\"/></svg>"), "an SVG drawing");
  EXPECT_EQ(kind("<svg></svg>"), picture);
  EXPECT_EQ(kind("<html></html>"), picture);
  EXPECT_EQ(kind("<x inkscape:groupmode=\"layer\"/>"), none);
  EXPECT_EQ(kind("IN;PA;"), "an HPGL plot");
  EXPECT_EQ(kind("  0\nSECTION\n"), dxf);
  EXPECT_EQ(kind("0\r\nSECTION  \r\n"), dxf);
  EXPECT_EQ(kind("999\nby hand\n0\nSECTION\n"), dxf);
  EXPECT_EQ(kind("0\nEOF\n"), none);
  EXPECT_EQ(kind("1\nSECTION\n"), none);
  for (const char* text :
       {"%\n", "(a)\n", ";a\n", "\n\nG0 X1\n", "g1", "N10", "X-1", "X .5", "Z+1", "T\t1", "O100"})
    EXPECT_EQ(kind(text), program) << text;
  for (const char* text : {"G", "G ", "GX", "any", "A1", "X=1", "5"}) EXPECT_EQ(kind(text), none) << text;
}

// ---- layouts ----------------------------------------------------------------------------------------------

Json circle(double x, double r) {
  return Json::parse(R"({"outer": [{"arc": {"from": [)" + std::to_string(x + r) + ", 5], \"to\": [" +
                     std::to_string(x + r) + ", 5], \"centre\": [" + std::to_string(x) +
                     R"(, 5], "ccw": true}}]})");
}

/// A layout with everything that one may have.
Json rich_layout() {
  Json layout = Json::parse(R"({"format": "lekalo-layout/1", "units": "mm", "name": "rich",
   "rules": {"gap": 1, "border_gap": 2, "defect_gap": 3},
   "stocks": [
    {"id": "s", "name": "sheet", "kind": "sheet", "count": 2, "cost": 7.5, "grain_deg": 0,
     "outline": {"polygon": {"outer": [[0, 0], [100, 0], [100, 80], [0, 80]], "holes": [[[90, 70], [95, 70], [95, 75], [90, 75]]]}},
     "defects": [{"id": "d", "severity": 2, "outline": {"polygon": {"outer": [[1, 1], [2, 1], [2, 2], [1, 2]]}}}],
     "zones": [{"id": "z", "quality": 1, "outline": {"polygon": {"outer": [[0, 0], [9, 0], [9, 8], [0, 8]]}}}]},
    {"id": "t", "kind": "strip", "height": 60},
    {"id": "u", "kind": "strip", "height": 60, "length": 300}],
   "parts": [
    {"id": "p", "name": "part", "material": "steel", "thickness": 2, "customer": "c", "due": "2026-12-01", "label": "l", "outline": {"polygon": {"outer": [[0, 0], [10, 0], [10, 6], [0, 6]], "holes": [[[2, 2], [2, 4], [4, 4], [4, 2]]]}},
     "quality": 1, "areas": [{"quality": 2, "outline": {"polygon": {"outer": [[1, 1], [2, 1], [2, 2], [1, 2]]}}}],
     "rotations": [0, {"from": 80, "to": 100}], "mirror": true, "grain": {"deg": 0, "tolerance_deg": 10},
     "tolerated_severity": 1, "priority": 3, "demand": 2, "gap": 1.5, "border_gap": 2.5, "defect_gap": 3.5},
    {"id": "q", "outline": {"curves": {}, "chord_tolerance": 0.5}}],
   "kits": [{"id": "k", "name": "kit", "demand": 2, "value": 5, "pieces": [{"part": "p", "count": 2, "mirrored": true}, {"part": "q"}]}],
   "placements": [{"id": 1, "part": "p", "stock": "s", "copy": 1, "rotation_deg": 0, "x": 40, "y": 30, "mirrored": true, "locked": true},
                  {"id": 2, "part": "p", "stock": "s", "rotation_deg": 0, "x": 60, "y": 30}],
   "next_id": 9})");
  layout.at("/parts/1/outline/curves") = circle(3, 2);
  return layout;
}

std::string findings(const std::string& layout, const std::string& given) {
  const auto report = verify_layout_claims({"l.json", layout}, Document{"g.json", given});
  if (!report) return report.error().message;
  std::string text;
  for (const std::string& finding : report->findings) text += finding + "\n";
  return text;
}

TEST(VerifyClaims, NothingOfTheGivenLayoutMayBeOtherButWhatLiesFree) {
  Json made = rich_layout();
  // The layout itself needs the polygon of its curves; that of a circle of radius 2 within 0.5 mm.
  made["parts"].erase(1);
  made.at("/kits/0/pieces").erase(1);
  const std::string layout = made.dump();
  ASSERT_EQ(findings(layout, layout), "");
  std::size_t told = 0;
  for (const Lie& lie : test::lies_of_json(layout, [](double v) { return v + 0.25; })) {
    const std::string& path = lie.path;
    const bool free = path.starts_with("/placements/1") || path.ends_with("/name") || path == "/next_id";
    // A piece that was not locked, or not there, may have come; parts have gaps of their own beside the
    // rules'.
    const bool unlocked = path == "/placements" || path == "/placements/0" || path == "/placements/0/id" ||
                          path == "/placements/0/locked";
    if (free || unlocked || path.starts_with("/rules")) continue;
    EXPECT_NE(findings(layout, lie.bytes()), "") << path << " " << lie.how;
    ++told;
  }
  EXPECT_GT(told, 150U);
}

/// The one thing that is other in the layout that another was made from, and the sentence.
TEST(VerifyClaims, EachWordOfAStockAPartAndAPieceCounts) {
  Json made = rich_layout();
  const std::string square =
      R"({"outer": [{"line": {"from": [0, 0], "to": [9, 0]}}, {"line": {"from": [9, 0], "to": [9, 9]}},
    {"line": {"from": [9, 9], "to": [0, 9]}}, {"line": {"from": [0, 9], "to": [0, 0]}}]})";
  made.at("/parts/1") = Json::parse(
      R"({"id": "q", "outline": {"polygon": {"outer": [[0, 0], [9, 0], [9, 9], [0, 9]]}, "chord_tolerance": 0.5, "curves": )" +
      square + R"(}, "marks": [{"layer": "fold", "edges": [{"line": {"from": [1, 1], "to": [2, 2]}}]}]})");
  made.at("/kits/0/pieces").erase(1);
  const std::string layout = made.dump();
  ASSERT_EQ(findings(layout, layout), "");
  const auto of = [](const std::string& what) {
    return what + " is not that of the layout it was made from\n";
  };
  const std::string s = of("stock \"s\""), t = of("stock \"t\""), p = of("part \"p\""), q = of("part \"q\""),
                    locked = "placement 1 is locked and does not lie where it lay\n";
  struct Case {
    std::string path, value, finding;
  };
  const std::vector<Case> cases{
      {"/stocks/0/kind", "\"hide\"", s},
      {"/stocks/0/count", "3", s},
      {"/stocks/0/cost", "8", s},
      {"/stocks/0/grain_deg", "1", s},
      {"/stocks/0/outline/polygon/outer/1", "[101, 0]", s},
      {"/stocks/0/defects/0/id", "\"e\"", s},
      {"/stocks/0/defects/0/severity", "3", s},
      {"/stocks/0/defects/0/outline/polygon/outer/2", "[2, 3]", s},
      {"/stocks/0/zones/0/id", "\"e\"", s},
      {"/stocks/0/zones/0/quality", "2", s},
      {"/stocks/0/zones/0/outline/polygon/outer/2", "[9, 9]", s},
      {"/stocks/1/id", "\"v\"", t},
      {"/stocks/1/height", "61", t},
      // As long as one without a length is taken to be.
      {"/stocks/1/length", "262144", t},
      {"/parts/0/outline/polygon/outer/1", "[11, 0]", p},
      {"/parts/0/quality", "2", p},
      {"/parts/0/areas/0/quality", "3", p},
      {"/parts/0/areas/0/outline/polygon/outer/2", "[2, 3]", p},
      {"/parts/0/rotations/0", "1", p},
      {"/parts/0/rotations/1/from", "81", p},
      {"/parts/0/rotations/1/to", "101", p},
      {"/parts/0/mirror", "false", p},
      {"/parts/0/grain/deg", "1", p},
      {"/parts/0/grain/tolerance_deg", "11", p},
      {"/parts/0/tolerated_severity", "2", p},
      {"/parts/0/priority", "4", p},
      {"/parts/0/material", "\"brass\"", p},
      {"/parts/0/thickness", "2.000001", p},
      {"/parts/0/customer", "\"d\"", p},
      {"/parts/0/due", "\"2026-12-02\"", p},
      {"/parts/0/label", "\"\"", p},
      {"/stocks/0/material", "\"steel\"", s},
      {"/parts/0/demand", "3", p},
      {"/parts/0/gap", "1.75", p},
      {"/parts/0/border_gap", "2.75", p},
      {"/parts/0/defect_gap", "3.75", p},
      {"/parts/1/id", "\"v\"", q},
      {"/parts/1/marks/0/layer", "\"cut\"", q},
      {"/parts/1/marks/0/edges/0/line/to", "[2, 3]", q},
      {"/parts/1/outline/chord_tolerance", "0.25", q},
      {"/parts/1/outline", R"({"polygon": {"outer": [[0, 0], [9, 0], [9, 9], [0, 9]]}})", q},
      // Without a polygon it is the drawing that counts.
      {"/parts/1/outline", R"({"chord_tolerance": 0.5, "curves": )" + square + "}", ""},
      {"/parts/1/outline",
       R"({"chord_tolerance": 0.5, "curves": {"outer": [{"line": {"from": [0, 0], "to": [9, 0]}},
       {"line": {"from": [9, 0], "to": [9, 8]}}, {"line": {"from": [9, 8], "to": [0, 0]}}]}})",
       q},
      {"/kits/0/value", "6", of("kit \"k\"")},
      {"/placements/0/part", "\"q\"", locked},
      {"/placements/0/stock", "\"u\"", locked},
      {"/placements/0/copy", "0", locked},
      {"/placements/0/rotation_deg", "90", locked},
      {"/placements/0/x", "41", locked},
      {"/placements/0/mirrored", "false", locked},
      {"/placements/1/x", "61", ""}};
  for (const Case& c : cases) {
    Json given = made;
    given.at(c.path) = Json::parse(c.value);
    EXPECT_EQ(findings(layout, given.dump()), c.finding) << c.path;
  }
}

TEST(VerifyClaims, ALockedPlacementLiesWhereItLay) {
  const std::string text = [] {
    Json made = rich_layout();
    made["parts"].erase(1);
    made.at("/kits/0/pieces").erase(1);
    return made.dump();
  }();
  const auto moved = [&](const std::string& path, Json value) {
    Json changed = Json::parse(text);
    changed.at(path) = value;
    return findings(changed.dump(), text);
  };
  const std::string locked = "placement 1 is locked and does not lie where it lay\n";
  EXPECT_EQ(moved("/placements/1/x", 61), "");
  EXPECT_EQ(moved("/placements/0/x", 41), locked);
  EXPECT_EQ(moved("/placements/0/y", 31), locked);
  EXPECT_EQ(moved("/placements/0/copy", 0), locked);
  EXPECT_EQ(moved("/placements/0/locked", false), locked);
  EXPECT_EQ(moved("/placements/0/id", 5), locked);
  EXPECT_EQ(moved("/placements/0/mirrored", false), locked);
  EXPECT_NE(moved("/placements/0/rotation_deg", 1).find(locked), std::string::npos);
}

TEST(VerifyClaims, ABrokenRuleIsToldWithThosePlacementsThatBreakIt) {
  Json layout = cases::empty_layout();
  cases::add_part(layout, "p", cases::outline_json(cases::rectangle(0, 0, 10, 10)));
  cases::place(layout, "p", 5, 5);
  cases::place(layout, "p", 14, 5);
  const auto report = verify_layout_claims({"l.json", layout.dump()}, {});
  EXPECT_EQ(report->findings, std::vector<std::string>{
                                  "the rule overlap is broken by placement 1 and placement 2 on \"s\" #1"});
  layout.at("/placements/1/x") = 95;
  const auto outside = verify_layout_claims({"l.json", layout.dump()}, {});
  EXPECT_EQ(outside->findings,
            std::vector<std::string>{"the rule outside is broken by placement 2 on \"s\" #1"});
}

TEST(VerifyClaims, AnOutlineMayBeginAndRunOtherwiseOnlyWhereItIsTheSame) {
  const auto with = [](const std::string& outer) {
    return R"({"format": "lekalo-layout/1", "units": "mm", "stocks": [], "placements": [],
       "parts": [{"id": "p", "outline": {"polygon": {"outer": )" +
           outer + "}}}]}";
  };
  const std::string square = with("[[0, 0], [9, 0], [9, 9], [0, 9]]");
  EXPECT_EQ(findings(square, with("[[9, 0], [9, 9], [0, 9], [0, 0]]")), "");
  EXPECT_NE(findings(square, with("[[0, 0], [9, 0], [9, 8], [0, 9]]")), "");
  EXPECT_NE(findings(square, with("[[0, 0], [9, 0], [9, 9]]")), "");
}

// ---- reports ----------------------------------------------------------------------------------------------

/// Two parts of 40 x 20 on the first of two sheets of 100 x 50 and one on the other; a kit of two of them
/// mirrored or not; one piece finds no room.
const std::string kLayout = R"({"format": "lekalo-layout/1", "units": "mm",
 "stocks": [{"id": "s", "kind": "sheet", "count": 2, "cost": 3, "outline": {"polygon": {"outer": [[0, 0], [100, 0], [100, 50], [0, 50]]}},
   "defects": [{"id": "d", "outline": {"polygon": {"outer": [[90, 1], [91, 1], [91, 2]]}}}]}],
 "parts": [{"id": "p", "demand": 1, "mirror": true, "outline": {"polygon": {"outer": [[0, 0], [40, 0], [40, 20], [0, 20]]}}}],
 "kits": [{"id": "k", "demand": 2, "value": 5, "pieces": [{"part": "p", "count": 1}, {"part": "p", "mirrored": true}]}],
 "placements": [{"part": "p", "stock": "s", "rotation_deg": 0, "x": 0, "y": 0},
                {"part": "p", "stock": "s", "rotation_deg": 0, "x": 90, "y": 25, "mirrored": true},
                {"part": "p", "stock": "s", "copy": 1, "rotation_deg": 0, "x": 10, "y": 10},
                {"part": "p", "stock": "s", "copy": 1, "rotation_deg": 0, "x": 50, "y": 10}]})";
const std::string kGiven = [] {
  Json given = Json::parse(kLayout);
  given["placements"] = Json::array();
  return given.dump();
}();

std::string head(const std::string& name, const std::string& status) {
  return R"({"format": {"name": "lekalo-)" + name + R"(", "version": 1}, "units": "mm", "status": ")" +
         status + R"(", "version": "0.2", "seed": 0, "work": 1, "warnings": [], "run": {}, )";
}
const std::string kNest =
    head("nest", "incomplete") +
    R"("inputs": [{"role": "layout", "path": "g.json", "sha256": "x"}], "outputs": [{"role": "nested", "path": "l.json", "sha256": "x"}],
  "merges": 0, "density": 0.32, "cost": 6, "kits": [{"kit": "k", "wanted": 2, "value": 5, "complete": 1}],
  "stocks": [{"stock": "s", "copy": 0, "parts": 2, "density": 0.32, "length": 90, "remnant": [41, 1, 89, 24]},
             {"stock": "s", "copy": 1, "parts": 2, "density": 0.32, "length": 90, "remnant": null}],
  "unplaced": [{"part": "p", "count": 1, "reason": "room"}]})";

std::string judged(const std::string& report, const std::vector<std::string>& files) {
  std::vector<Document> documents;
  for (const std::string& file : files)
    documents.push_back({"d" + std::to_string(documents.size()) + ".json", file});
  const auto claims = verify_layout_report({"r.json", report}, documents);
  if (!claims) return claims.error().message;
  std::string text;
  for (const std::string& finding : claims->findings) text += finding + "\n";
  for (const std::string& unchecked : claims->unchecked) text += "unchecked: " + unchecked + "\n";
  return text;
}
bool begins(const Lie& lie, std::initializer_list<const char*> paths) {
  return std::any_of(paths.begin(), paths.end(),
                     [&](const char* path) { return lie.path.starts_with(path); });
}

TEST(VerifyClaims, EveryFigureOfAReportOfNestIsMadeAnew) {
  ASSERT_EQ(judged(kNest, {kGiven, kLayout}), "");
  for (const Lie& lie : test::lies_of_json(kNest)) {
    const bool changes_information =
        lie.how != std::string("deleted") &&
        begins(lie, {"/seed", "/work", "/version", "/merges", "/unplaced/0/reason", "/warnings"});
    const bool names_a_file = lie.path.ends_with("/path") || lie.path.ends_with("/sha256");
    const bool leaves_a_remnant_out =
        lie.path == "/stocks/0/remnant" || lie.path == "/outputs" || lie.path == "/merges";
    // Sums are held to their rounding.
    const bool is_rounding = lie.how == std::string("last place") && lie.path.ends_with("density");
    if (changes_information || (names_a_file && lie.how != std::string("deleted")) || leaves_a_remnant_out ||
        is_rounding)
      continue;
    if (lie.path == "/stocks/1/remnant") continue;
    EXPECT_NE(judged(lie.bytes(), {kGiven, kLayout}), "") << lie.path << " " << lie.how;
  }
}

TEST(VerifyClaims, OneFigureOfAReportOfNestThatIsWrongIsNamed) {
  Json report = Json::parse(kNest), layout = Json::parse(kLayout), given = Json::parse(kGiven);
  const auto said = [&] { return judged(report.dump(), {given.dump(), layout.dump()}); };
  for (const char* list : {"stocks", "kits"}) {
    report = Json::parse(kNest);
    const Json first = report[list][0];
    const std::size_t count = report[list].size();
    report[list].push_back(first);
    EXPECT_EQ(said(), fmt::format("{} has {} items and is to have {}\n", list, count + 1, count));
  }
  report = Json::parse(kNest);
  layout.at("/parts/0/demand") = 2, given.at("/parts/0/demand") = 2;
  EXPECT_EQ(said(), "unplaced says 1 of \"p\" and is to say 2\n");
  report["unplaced"].push_back({{"part", "p"}, {"count", 0}, {"reason", "room"}});
  EXPECT_EQ(said(), "r.json: field unplaced[1].count is 0");
}

/// A layout of an order: parts of 10 x 10 on a sheet of 100 x 100.
Json layout_of(const char* material, double thickness, int wanted, int placed) {
  Json layout = cases::empty_layout();
  Json& part = cases::add_part(layout, "a", cases::outline_json(cases::rectangle(0, 0, 10, 10)));
  part["demand"] = wanted;
  for (Json* item : {&part, &layout["stocks"][0]}) {
    (*item)["material"] = material;
    if (thickness > 0) (*item)["thickness"] = thickness;
  }
  for (int i = 0; i < placed; ++i) cases::place(layout, "a", 20 * i, 0);
  return layout;
}

/// Of steel one piece of three is missing; of birch nobody said the thickness.
const std::string kOrder = head("order", "incomplete") +
                           R"("inputs": [{"role": "part", "path": "a.svg", "sha256": "x"}],
  "outputs": [{"role": "nested", "path": "o-steel-2.json", "sha256": "x"}, {"role": "nested", "path": "o-birch.json", "sha256": "x"}],
  "layouts": [{"material": "steel", "thickness": 2, "placed": 2, "missing": 1, "sheets": 1, "density": 0.02, "cost": 1, "work": 1,
               "unplaced": [{"part": "a", "count": 1, "reason": "no-stock"}]},
              {"material": "birch", "thickness": null, "placed": 1, "missing": 0, "sheets": 1, "density": 0.01, "cost": 1, "work": 1,
               "unplaced": []}],
  "placed": 3, "missing": 1, "sheets": 2, "density": 0.015, "cost": 2})";

TEST(VerifyClaims, EveryFigureOfAReportOfAnOrderIsMadeAnew) {
  const Json steel = layout_of("steel", 2, 3, 2), birch = layout_of("birch", 0, 1, 1);
  const std::string open =
      "unchecked: that stocks and parts are those of the order's drawings was not rechecked\n";
  const auto said = [&](const std::string& report) {
    return judged(report, {"", steel.dump(), birch.dump()});
  };
  ASSERT_EQ(said(kOrder), open);
  std::size_t told = 0;
  for (const Lie& lie : test::lies_of_json(kOrder)) {
    const bool changes_information =
        lie.how != std::string("deleted") &&
        (begins(lie, {"/seed", "/work", "/version", "/warnings", "/layouts/0/unplaced/0/reason"}) ||
         lie.path.ends_with("/work"));
    // The bytes come in one order here, whatever the names of the files are.
    const bool names_a_file = lie.path.ends_with("/path") || lie.path.ends_with("/sha256") ||
                              (begins(lie, {"/outputs"}) && lie.how == std::string("exchanged"));
    const bool is_rounding = lie.how == std::string("last place") && lie.path.ends_with("density");
    if (changes_information || (names_a_file && lie.how != std::string("deleted")) || is_rounding ||
        begins(lie, {"/inputs"}))
      continue;
    EXPECT_NE(said(lie.bytes()), open) << lie.path << " " << lie.how;
    ++told;
  }
  EXPECT_GT(told, 60U);
  Json report = Json::parse(kOrder);
  std::swap(report["layouts"][0], report["layouts"][1]);
  EXPECT_NE(said(report.dump()).find("layouts[0].material is not that of the part \"a\""), std::string::npos);
  report = Json::parse(kOrder);
  report["outputs"][1]["path"] = "o-steel-2.json";
  EXPECT_NE(said(report.dump()).find("it names o-steel-2.json twice"), std::string::npos);
}

TEST(VerifyClaims, ARuleThatALayoutOfAnOrderBreaksIsNamedWithItsFile) {
  Json steel = layout_of("steel", 2, 3, 2);
  const Json birch = layout_of("birch", 0, 1, 1);
  steel.at("/placements/1/x") = 5;
  EXPECT_NE(judged(kOrder, {"", steel.dump(), birch.dump()}).find("d1.json: the rule overlap is broken by"),
            std::string::npos);
  steel.at("/placements/1/x") = 20;
  steel.at("/stocks/0/thickness") = 3;
  EXPECT_NE(
      judged(kOrder, {"", steel.dump(), birch.dump()}).find("layouts[0].material is not that of the stock"),
      std::string::npos);
}

TEST(VerifyClaims, SheetsThatAreNotThereCountForNothing) {
  Json report = Json::parse(kNest), layout = Json::parse(kLayout);
  layout.at("/placements/3/copy") = 2;
  report.at("/stocks/1/parts") = 1, report.at("/stocks/1/density") = 0.16, report.at("/stocks/1/length") = 50;
  report["density"] = 0.24;
  EXPECT_EQ(judged(report.dump(), {kGiven, layout.dump()}),
            "the rule stock is broken by placement 4 on \"s\" #3\n");
  layout["placements"] = Json::array();
  report["density"] = 0, report["cost"] = 0, report["stocks"] = Json::array();
  report.at("/kits/0/complete") = 0, report.at("/unplaced/0/count") = 5;
  EXPECT_EQ(judged(report.dump(), {kGiven, layout.dump()}), "");
}

/// Of parts of a few steps the area is held to the very square step.
TEST(VerifyClaims, ADensityIsThatOfTheVeryAreas) {
  const double side = 0x1p-18;
  Json layout = Json::parse(kLayout), report = Json::parse(kNest);
  layout.at("/stocks/0/outline") = cases::outline_json(cases::rectangle(0, 0, 2, 1));
  layout.at("/stocks/0").erase("defects");
  layout.at("/parts/0/outline") = cases::outline_json(cases::rectangle(0, 0, side, side));
  layout["kits"] = Json::array();
  layout["placements"] = Json::array();
  Json given = layout;
  cases::place(layout, "p", 1, 0.5);
  report["kits"] = Json::array(), report["unplaced"] = Json::array(), report["status"] = "complete";
  report["stocks"].erase(1);
  report.at("/stocks/0/parts") = 1, report.at("/stocks/0/remnant") = nullptr;
  report["density"] = report.at("/stocks/0/density") = side * side / 2;
  report["length"] = report.at("/stocks/0/length") = 1 + side;
  report["cost"] = 3;
  EXPECT_EQ(judged(report.dump(), {given.dump(), layout.dump()}), "");
}

TEST(VerifyClaims, ARemnantIsFree) {
  const auto with = [](const std::string& remnant) {
    std::string report = kNest;
    const std::string before = "[41, 1, 89, 24]";
    return judged(report.replace(report.find(before), before.size(), remnant), {kGiven, kLayout});
  };
  const std::string no = "stocks[0].remnant is no free rectangle\n";
  EXPECT_EQ(with("[40, 0, 90, 25]"), "");
  EXPECT_EQ(with("[91, 2, 100, 50]"), "") << "behind all parts of a sheet";
  EXPECT_EQ(with("null"), "");
  for (const char* taken :
       {"[39.5, 1, 89, 24]", "[41, 1, 89, 25.5]", "[41, 1, 91, 24]", "[41, -1, 89, 24]", "[41, 1, 101, 1.5]",
        "[41, 1, 41, 24]", "[41, 1, 89, 1]", "[89, 1, 41, 24]", "[41, 24, 89, 1]", "[41, 1, 89]",
        "[41, 1, 89, 24, 25]", "[41, 1, 89, \"24\"]", "[41.0000001, 1, 89, 24]", "[41, 1, 89, 1e9]", "[]"})
    EXPECT_EQ(with(taken), no) << taken;
}

TEST(VerifyClaims, KitsAreThoseThatThePlacementsMake) {
  const auto with = [](int complete, int upright, int mirrored, int demand = 2) {
    Json layout = Json::parse(kLayout), report = Json::parse(kNest);
    layout["placements"] = Json::array();
    layout.at("/kits/0/demand") = demand, layout.at("/parts/0/demand") = 0;
    int k = 0;
    for (; k < upright + mirrored; ++k) {
      Json piece = Json::parse(R"({"part": "p", "stock": "s", "rotation_deg": 0, "x": 0, "y": 0})");
      const bool hand = k >= upright;
      piece["x"] = (k % 2) * 50 + (hand ? 40 : 0), piece["y"] = (k / 2 % 2) * 25, piece["copy"] = k / 4;
      if (hand) piece["mirrored"] = true;
      layout["placements"].push_back(piece);
    }
    if (k <= 4) report["length"] = 1;
    report.at("/kits/0/complete") = complete, report.at("/kits/0/wanted") = demand;
    std::string said;
    std::istringstream lines(judged(report.dump(), {kGiven, layout.dump()}));
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("kits")) said += line + "\n";
    return said;
  };
  const std::string more = "kits: more are complete than the placements make\n",
                    less = "kits[0].complete is less than the placements make\n";
  EXPECT_EQ(with(1, 1, 1), "");
  EXPECT_EQ(with(0, 1, 1), less);
  EXPECT_EQ(with(0, 2, 0), "");
  EXPECT_EQ(with(1, 2, 0), more);
  EXPECT_EQ(with(1, 0, 2), "");  // either hand will do for the first piece
  EXPECT_EQ(with(2, 2, 2), "");
  EXPECT_EQ(with(1, 2, 2), less);
  EXPECT_EQ(with(2, 1, 2), more);
  EXPECT_EQ(with(2, 3, 1), more);
  EXPECT_EQ(with(2, 0, 4), "");
  EXPECT_EQ(with(3, 3, 3), "kits[0].complete is more than is wanted\n");
  EXPECT_EQ(with(4, 3, 3), "kits[0].complete is more than is wanted\n");
  EXPECT_EQ(with(2, 3, 3), "");
}

TEST(VerifyClaims, AReportOfCheckHasTheViolationsOfItsLayout) {
  const std::string none =
      head("check", "valid") +
      R"("inputs": [{"role": "layout", "path": "l.json", "sha256": "x"}], "valid": true, "checked_by": ["a"], "disagreements": [], "violations": []})";
  ASSERT_EQ(judged(none, {kLayout}), "");
  Json broken = Json::parse(kLayout);
  broken.at("/placements/1/x") = 60, broken.at("/placements/1/y") = 5;
  const std::string one =
      head("check", "violations") +
      R"("inputs": [{"role": "layout", "path": "l.json", "sha256": "x"}], "valid": false, "checked_by": ["a"], "disagreements": [],
     "violations": [{"kind": "overlap", "a": 1, "b": 2, "stock": "s", "copy": 0, "amount_mm": 1, "at": [1, 2], "direction": [1, 0]}]})";
  const std::string open =
      "unchecked: violations: by how much, where, and the way out (amount_mm, at, direction)\n";
  ASSERT_EQ(judged(one, {broken.dump()}), open);
  EXPECT_NE(judged(none, {broken.dump()}), "");
  EXPECT_NE(judged(one, {kLayout}), open);
  for (const Lie& lie : test::lies_of_json(one)) {
    const bool deleted = lie.how == std::string("deleted");
    if (!deleted &&
        begins(lie, {"/seed", "/work", "/version", "/inputs/0/path", "/inputs/0/sha256", "/checked_by",
                     "/violations/0/amount_mm", "/violations/0/at", "/violations/0/direction"}))
      continue;
    if (lie.path.starts_with("/checked_by/") || lie.path.starts_with("/violations/0/at/") ||
        lie.path.starts_with("/violations/0/direction"))
      continue;
    EXPECT_NE(judged(lie.bytes(), {broken.dump()}), open) << lie.path << " " << lie.how;
  }
  std::string doubt = none;
  doubt.replace(doubt.find(R"("disagreements": [])"), 19, R"("disagreements": ["b"])");
  EXPECT_NE(judged(doubt, {kLayout}).find("status is valid and is to be refuted"), std::string::npos);
}

TEST(VerifyClaims, AReportOfShowHasTheSumsOfItsLayout) {
  const std::string shown =
      head("show", "shown") +
      R"("inputs": [{"role": "layout", "path": "l.json", "sha256": "x"}], "violations": 0, "density": 0.32, "cost": 6, "sheets": [], "kits": [], "parts": []})";
  const std::string open =
      "unchecked: sheets: what lekalo show counts there\nunchecked: kits: what lekalo show counts there\n"
      "unchecked: parts: what lekalo show counts there\n";
  ASSERT_EQ(judged(shown, {kLayout}), open);
  // What was shown may be a drawing, a region or an instance: no error, but nothing that was rechecked.
  for (const char* const other : {"0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n", R"({"outer": []})"})
    EXPECT_NE(judged(shown, {other}).find("unchecked: violations, density, cost: "), std::string::npos)
        << other;
  // The polygons of its curves are not made yet.
  Json curved = Json::parse(kLayout);
  curved.at("/parts/0/outline") = {{"curves", circle(3, 2)}, {"chord_tolerance", 0.5}};
  EXPECT_NE(judged(shown, {curved.dump()}).find("has no polygon; let lekalo write the file"),
            std::string::npos)
      << judged(shown, {curved.dump()});
  for (const Lie& lie : test::lies_of_json(shown)) {
    if (lie.how != std::string("deleted") &&
        begins(lie, {"/seed", "/work", "/version", "/inputs/0/path", "/inputs/0/sha256"}))
      continue;
    if (lie.path == "/density" && lie.how == std::string("last place")) continue;
    EXPECT_NE(judged(lie.bytes(), {kLayout}), open) << lie.path << " " << lie.how;
  }
}

TEST(VerifyClaims, AStripIsAsLongAsItIsUsed) {
  const std::string layout =
      R"({"format": "lekalo-layout/1", "units": "mm", "stocks": [{"id": "t", "kind": "strip", "height": 50}],
   "parts": [{"id": "p", "demand": 1, "outline": {"polygon": {"outer": [[0, 0], [40, 0], [40, 20], [0, 20]]}}}],
   "placements": [{"part": "p", "stock": "t", "rotation_deg": 0, "x": 10, "y": 0}]})";
  Json given = Json::parse(layout);
  given["placements"] = Json::array();
  const auto with = [&](const std::string& density, const std::string& remnant) {
    return judged(head("nest", "complete") +
                      R"("inputs": [{"role": "layout", "path": "g.json", "sha256": "x"}],
      "outputs": [{"role": "nested", "path": "l.json", "sha256": "x"}], "merges": 0, "density": )" +
                      density + R"(, "cost": 1, "length": 50, "kits": [],
      "stocks": [{"stock": "t", "copy": 0, "parts": 1, "density": )" +
                      density + R"(, "length": 50, "remnant": )" + remnant + R"(}], "unplaced": []})",
                  {given.dump(), layout});
  };
  EXPECT_EQ(with("0.32", "[0, 20, 50, 50]"), "");
  EXPECT_NE(with("0.33", "[0, 20, 50, 50]"), "");
  EXPECT_NE(with("0.32", "[0, 20, 51, 50]"), "");
}

TEST(VerifyClaims, AReportNamesItsInputsAndItsOutputsWhereItHasAny) {
  const auto named = [](const std::string& bytes) {
    const auto files = named_files({"r.json", bytes});
    return files ? std::to_string(files->size()) : files.error().message;
  };
  EXPECT_EQ(named(R"({"inputs": []})"), "0");
  EXPECT_EQ(named(R"({"outputs": []})"), "r.json: field inputs is not a list");
  EXPECT_EQ(named(R"({"inputs": [], "outputs": 5})"), "r.json: field outputs is not a list");
  const std::string file = R"([{"role": "layout", "path": "l.json", "sha256": "x"}])";
  EXPECT_EQ(named(R"({"inputs": )" + file + R"(, "outputs": )" + file + "}"), "2");
  EXPECT_EQ(named(R"({"inputs": 5, "outputs": [5]})"), "r.json: field inputs is not a list");
}

TEST(VerifyClaims, FilesAreThoseThatTheReportNames) {
  EXPECT_EQ(judged(kNest, {kGiven, kLayout}), "");
  Json twice = Json::parse(kNest);
  twice["inputs"].push_back(twice["inputs"][0]);
  EXPECT_EQ(judged(twice.dump(), {kGiven, kGiven, kLayout}),
            "r.json: it names two files with the role \"layout\"");
  Json drawn = Json::parse(kNest);
  drawn.at("/inputs/0/role") = "part";
  EXPECT_EQ(judged(drawn.dump(), {kGiven, kLayout}),
            "unchecked: that stocks and parts are those of the order's drawings was not rechecked\n");
  Json none = Json::parse(kNest);
  none.at("/outputs/0/role") = "other";
  EXPECT_EQ(judged(none.dump(), {kGiven, kLayout}), "r.json: it names no file with the role \"nested\"");
  EXPECT_EQ(
      judged(kNest, {"<svg/>", kLayout}),
      "unchecked: that stocks and parts are those of d0.json, which is in another form, was not rechecked\n");
}

}  // namespace
}  // namespace lekalo::verify::verify_claims_test

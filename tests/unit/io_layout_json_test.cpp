#include "lekalo/io/layout/layout_json.hpp"
#include "support/json.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lekalo::io::io_layout_json_test {
namespace {

using cases::Json;

constexpr const char* kLayout = R"({"format": "lekalo-layout/1", "units": "mm",
 "stocks": [{"id": "roll", "kind": "strip", "height": 100},
            {"id": "board", "kind": "sheet", "count": 2,
             "outline": {"polygon": {"outer": [[0, 0], [60, 0], [60, 40], [0, 40]]}}}],
 "parts": [{"id": "a", "outline": {"polygon": {"outer": [[0, 0], [3, 0], [3, 2], [0, 2]]}}, "mirror": true},
           {"id": "b", "outline": {"polygon": {"outer": [[0, 0], [9, 0], [0, 9]],
                                               "holes": [[[1, 1], [2, 1], [1, 2]]]}}}],
 "kits": [{"id": "k", "pieces": [{"part": "a", "mirrored": true}, {"part": "b", "count": 3}]}],
 "placements": [{"part": "a", "stock": "roll", "rotation_deg": 90, "x": 5, "y": 6},
                {"part": "b", "stock": "board", "copy": 7, "c": 0.6, "s": 0.8, "x": -1, "y": 0}]})";

std::string message_of(const std::string& text) {
  const auto file = read_layout(text, "plan.json");
  return file ? "read" : file.error().message;
}

TEST(LayoutJson, ReadsAHandWrittenFileWithItsDefaults) {
  const auto file = read_layout(kLayout, "plan.json");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  const layout::Document& d = file->document;
  EXPECT_TRUE(d.stocks[0].open_length);
  EXPECT_EQ(geom::bounds(d.stocks[0].outline.polygon).high.x, layout::kLongestStrip);
  EXPECT_EQ(d.stocks[1].count, 2);
  EXPECT_EQ(d.stocks[1].cost, 1);
  EXPECT_TRUE(d.parts[0].rotations.empty());
  EXPECT_EQ(d.parts[1].outline.polygon.loops(), 2u);
  EXPECT_EQ(d.kits[0].pieces[0].count, 1);
  EXPECT_EQ(layout::wanted(d, 1), 3);
  ASSERT_EQ(d.placements.size(), 2u);
  EXPECT_EQ(d.placements[0].id, 1u);
  EXPECT_EQ(d.placements[1].id, 2u);
  EXPECT_EQ(d.next_id, 3u);
  EXPECT_EQ(d.placements[0].rotation, geom::rotation_from_degrees(90));
  EXPECT_EQ(d.placements[1].copy, 7);  // beyond the count: the check's business
  EXPECT_EQ(d.placements[1].at.x, -geom::kGridPerMm);
}

TEST(LayoutJson, MarksOfPartsAreKeptAsTheyAre) {
  Json json = Json::parse(kLayout);
  const Json line = Json::parse(R"({"line": {"from": [0.1, 1], "to": [2, 1]}})");
  const Json arc = Json::parse(R"({"arc": {"from": [2, 1], "to": [1, 2], "centre": [1, 1], "ccw": true}})");
  json["parts"][0]["marks"] = {{{"layer", "bend"}, {"edges", {line, arc}}}, {{"edges", Json::array({line})}}};
  const auto file = read_layout(json.dump(), "plan.json");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  const layout::Part& part = file->document.parts[0];
  ASSERT_EQ(part.marks.size(), 2u);
  EXPECT_EQ(part.marks[0].layer, "bend");
  EXPECT_EQ(part.marks[0].edges[0].from, (geom::Point{0.1, 1}));
  EXPECT_EQ(part.marks[0].edges[1].kind, geom::EdgeKind::arc_ccw);
  EXPECT_EQ(part.marks[1].layer, "");
  EXPECT_EQ(read_layout(write_layout(file->document), "plan.json")->document, file->document);

  json["parts"][0]["marks"] = {{{"edges", {arc, line}}}};
  EXPECT_NE(
      message_of(json.dump()).find("parts[0].marks[0].edges, edge 1: it begins at (0.1, 1), but edge 0 ends"),
      std::string::npos)
      << message_of(json.dump());
  json["parts"][0]["marks"] = {{{"layer", "bend"}}};
  EXPECT_NE(message_of(json.dump()).find("\"edges\", its lines and arcs"), std::string::npos);
  json["parts"][0]["marks"] = {{{"edges", Json::array()}}};
  EXPECT_NE(message_of(json.dump()).find("there are no edges"), std::string::npos) << message_of(json.dump());
}

TEST(LayoutJson, GapsAreRoundedUpAndCoordinatesToTheNearestStep) {
  Json json = Json::parse(kLayout);
  json["rules"] = {{"gap", 0.1}, {"border_gap", 3}, {"defect_gap", 1e-300}, {"kerf", 0.2}};
  const auto file = read_layout(json.dump(), "plan.json");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  EXPECT_EQ(file->document.rules.gap, 104858);  // 104857.6 steps
  EXPECT_EQ(file->document.rules.border_gap, 3 * geom::kGridPerMm);
  EXPECT_EQ(file->document.rules.defect_gap, 1);
  EXPECT_EQ(file->document.rules.kerf, geom::grid_from_mm_up(0.2));
}

TEST(LayoutJson, PlacementsAreOrderedByIdAndIdsNotUsedAgain) {
  Json json = Json::parse(kLayout);
  json["placements"][0]["id"] = 9;
  json["placements"][1]["id"] = 4;
  json["next_id"] = 20;
  const auto file = read_layout(json.dump(), "plan.json");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  EXPECT_EQ(file->document.placements[0].id, 4u);
  EXPECT_EQ(file->document.placements[1].id, 9u);
  EXPECT_EQ(file->document.next_id, 20u);
}

TEST(LayoutJson, FieldsOfOnesOwnAreLeftOutWithANotice) {
  Json json = Json::parse(kLayout);
  json["x_plan"] = {{"deep", {1, 2}}};
  json["parts"][0]["x_note"] = "left shoe";
  json["parts"][1]["x_note"] = "right shoe";
  const auto file = read_layout(json.dump(), "plan.json");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  ASSERT_EQ(file->notices.size(), 1u);
  EXPECT_NE(file->notices[0].find("x_note (2 times), x_plan"), std::string::npos) << file->notices[0];
  EXPECT_EQ(file->document, read_layout(kLayout, "plan.json")->document);
}

TEST(LayoutJson, CurvesAloneBecomeChordsOutsideAPartAndInsideAStock) {
  const Json disc = Json::parse(R"({"curves": {"outer": [{"arc": {"from": [10, 0], "to": [10, 0],
                                    "centre": [0, 0], "ccw": true}}]}, "chord_tolerance": 0.05})");
  Json json = Json::parse(kLayout);
  json["parts"][0]["outline"] = disc;
  json["stocks"][1]["outline"] = disc;
  const auto file = read_layout(json.dump(), "plan.json");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  const double circle = 314.159265358979;
  EXPECT_GT(geom::area_mm2(file->document.parts[0].outline.polygon), circle);
  EXPECT_LT(geom::area_mm2(file->document.parts[0].outline.polygon), circle + 0.05 * 63);
  EXPECT_LT(geom::area_mm2(file->document.stocks[1].outline.polygon), circle);
  EXPECT_GT(geom::area_mm2(file->document.stocks[1].outline.polygon), circle - 0.05 * 63);
  EXPECT_EQ(file->document.parts[0].outline.curves.size(), 1u);
  EXPECT_EQ(file->notices.size(), 1u);
}

TEST(LayoutJson, RefusesWithPlaceAndNumber) {
  struct Wrong {
    const char *place, *value, *expected;
  };
  const std::vector<Wrong> all{
      {"/format", "\"lekalo-layout/2\"", "format: the format is 'lekalo-layout/2'; this program reads"},
      {"/units", "\"inch\"", "units: a layout is in millimetres"},
      {"/colour", "3", "unknown field 'colour'; known here: format, units"},
      {"/rules", "{\"gap\": -0.5}", "rules.gap: -0.5 is out of range; from 0 to 262144"},
      {"/rules", "{\"gap\": 1e300}", "rules.gap: 1e+300 is out of range"},
      {"/rules", "{\"gap\": \"3\"}", "rules.gap: a number is needed, not a text"},
      {"/stocks/1/id", "\"roll\"", "stocks[1].id: the id 'roll' stands twice among stocks"},
      {"/stocks/0/outline", "{}", "stocks[0].outline: a strip has \"height\""},
      {"/stocks/1/length", "5", "stocks[1].length: it belongs to a strip"},
      {"/stocks/0/count", "2", "stocks[0].count: there is one of a strip"},
      {"/stocks/1/count", "0", "stocks[1].count: 0 is out of range"},
      {"/stocks/1/count", "1.5", "stocks[1].count: 1.5 is no whole number"},
      {"/stocks/0/height", "0", "stocks[0].height: 0 is out of range"},
      {"/stocks/1/outline/polygon/outer/3", "[0, 300000]",
       "stocks[1].outline.polygon.outer[3]: (0, 300000) is further from the origin than 262144 mm"},
      {"/parts/0/outline/polygon/outer/1", "[1, 2, 3]", "parts[0].outline.polygon.outer[1]: a point [x, y]"},
      {"/parts/0/outline/polygon/outer/1", "[1, \"2\"]",
       "parts[0].outline.polygon.outer[1]: a point needs two"},
      {"/parts/0/outline/polygon/outer/1", "[-3, 1.5]", "parts[0].outline.polygon: outline: edge"},
      {"/parts/0/outline/polygon/outer", "[[0, 0], [5, 0], [9, 0]]",
       "parts[0].outline.polygon: outline: its area is 0"},
      {"/parts/0/outline/polygon/outer", "[]", "outline: it has 0 different points"},
      {"/parts/1/outline/polygon/holes/0", "[[50, 50], [51, 50], [50, 51]]", "hole 0: it lies outside"},
      {"/parts/0/outline/chord_tolerance", "0.1",
       "parts[0].outline.chord_tolerance: it belongs to \"curves\""},
      {"/parts/0/outline", "{}", "parts[0].outline: \"polygon\" or \"curves\", the shape, is missing"},
      {"/parts/0/outline/curves",
       R"({"outer": [{"arc": {"from": [1, 0], "to": [1, 0], "centre": [0, 0], "ccw": true}}]})",
       "parts[0].outline: the area of the polygon is 6 mm2, that of the curves 3.14159 mm2"},
      {"/parts/0/outline/curves", R"({"outer": [{"line": {"from": [1, 0]}}]})",
       "parts[0].outline.curves, outer contour, edge 0"},
      {"/parts/0/rotations", "[]", "parts[0].rotations: no rotation at all"},
      {"/parts/0/rotations", "[{\"from\": 9, \"to\": 1}]", "parts[0].rotations[0]: from 9 to 1 degrees"},
      {"/parts/0/rotations", "[4000]", "parts[0].rotations[0]: 4000 is out of range"},
      {"/parts/0/quality", "\"good\"", "parts[0].quality: a whole number is needed, not a text"},
      {"/parts/0/id", "\"\"", "parts[0].id: an empty text"},
      {"/parts/0/name", "\"a\\nb\"", "parts[0].name: the text 'a\\x0ab' has a control character"},
      {"/parts/1/id", "\"a\"", "parts[1].id: the id 'a' stands twice among parts"},
      {"/parts/0/due", "\"2026-02-29\"", "parts[0].due: '2026-02-29' is no day; write it as in 2026-12-01"},
      {"/parts/0/thickness", "0", "parts[0].thickness: 0 is out of range; from 0.001 to 262144"},
      {"/stocks/1/customer", "\"Orlova\"", "stocks[1]: unknown field 'customer'"},
      {"/parts/0/mirror", "false", "kits[0].pieces[0].mirrored: the part 'a' may not be mirrored"},
      {"/kits/0/pieces/1/part", "\"c\"",
       "kits[0].pieces[1].part: there is no part 'c'; \"parts\" has 2 others"},
      {"/kits/0/pieces/1/count", "0", "kits[0].pieces[1].count: 0 is out of range"},
      {"/kits/0/pieces", "[]", "kits[0].pieces: a kit of no pieces"},
      {"/placements/0/part", "\"c\"", "placements[0].part: there is no part 'c'"},
      {"/placements/1/stock", "\"c\"", "placements[1].stock: there is no stock 'c'"},
      {"/placements/1/stock", "3", "placements[1].stock: the id of a stock is needed, not a number"},
      {"/placements/1/c", "0.61", "placements[1]: c 0.61 and s 0.8 are no rotation"},
      {"/placements/0/c", "1", "placements[0].rotation_deg: it stands beside \"c\" or \"s\""},
      {"/placements/0/x", "524289", "placements[0].x: 524289 is out of range"},
      {"/placements/1/id", "1", "placements[1].id: the id 1 stands twice among placements"},
      {"/next_id", "2", "next_id: 2 is not above the id 2 of a placement"},
  };
  for (const Wrong& wrong : all) {
    Json json = Json::parse(kLayout);
    json.at(wrong.place) = Json::parse(wrong.value);
    const std::string message = message_of(json.dump());
    EXPECT_EQ(message.rfind("plan.json: ", 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find(wrong.expected), std::string::npos) << wrong.place << " " << wrong.value << "\n"
                                                               << message;
  }
}

TEST(LayoutJson, RefusesWhatIsMissing) {
  struct Missing {
    const char *place, *key, *expected;
  };
  for (const Missing& missing :
       {Missing{"", "format", "\"format\""},
        {"", "units", "\"units\""},
        {"/stocks/0", "id", "stocks[0]: \"id\""},
        {"/stocks/0", "kind", "stocks[0]: \"kind\""},
        {"/stocks/0", "height", "stocks[0]: \"height\""},
        {"/stocks/1", "outline", "stocks[1]: \"outline\""},
        {"/parts/0", "outline", "parts[0]: \"outline\""},
        {"/kits/0", "pieces", "kits[0]: \"pieces\""},
        {"/placements/0", "x", "placements[0]: \"x\""},
        {"/placements/0", "rotation_deg", "placements[0]: \"c\" and \"s\", or \"rotation_deg\", are missing"},
        {"/placements/1", "s", "placements[1]: \"c\" and \"s\""}}) {
    Json json = Json::parse(kLayout);
    json.at(missing.place).erase(missing.key);
    const std::string message = message_of(json.dump());
    EXPECT_NE(message.find(missing.expected), std::string::npos) << message;
    EXPECT_NE(message.find("missing"), std::string::npos) << message;
  }
}

TEST(LayoutJson, RefusesBrokenFiles) {
  const std::string whole = kLayout;
  for (std::size_t cut = 0; cut + 1 < whole.size(); cut += 7) {
    const std::string message = message_of(whole.substr(0, cut));
    EXPECT_NE(message.find("the file ends too early"), std::string::npos) << cut << " " << message;
    EXPECT_EQ(message.rfind("plan.json, line ", 0), 0u) << message;
  }
  EXPECT_NE(message_of(R"({"units": NaN})").find("this is not JSON"), std::string::npos);
  EXPECT_NE(message_of(R"({"units": 1e999})").find("the number '1e999' is out of range"), std::string::npos);
  EXPECT_NE(message_of("{\"format\": \"\xff\"}").find("this is not JSON"), std::string::npos);
  EXPECT_NE(message_of("[]").find("a layout is an object, not a list"), std::string::npos);
  EXPECT_NE(message_of(R"({"a": {"b": 1, "c": 2, "b": 3}})").find("a: the key 'b' stands twice"),
            std::string::npos)
      << message_of(R"({"a": {"b": 1, "c": 2, "b": 3}})");
  const std::string deep = R"({"format": "lekalo-layout/1", "x_a": )" + std::string(100'000, '[');
  EXPECT_NE(message_of(deep).find("more than 64 deep"), std::string::npos);
  EXPECT_LT(message_of(deep).size(), 1000u);
}

TEST(LayoutJson, RefusesToCountIdsBeyondTheLast) {
  Json json = Json::parse(kLayout);
  json["placements"][0]["id"] = 9007199254740991;
  EXPECT_NE(message_of(json.dump()).find("placements[1]: its id would be"), std::string::npos);
}

TEST(LayoutJson, RefusesTooManyPoints) {
  std::string text =
      R"({"format": "lekalo-layout/1", "units": "mm", "parts": [{"id": "a", "outline": {"polygon": {"outer": [)";
  for (std::size_t i = 0; i <= kMostOutlinePoints; ++i)
    text += (i == 0 ? "[" : ",[") + std::to_string(i) + ",0]";
  EXPECT_NE(message_of(text + "]}}}]}").find("parts[0].outline.polygon.outer: 100001 items; at most 100000"),
            std::string::npos);
}

/// 5000 round holes in 400 kB are 140,000 points, which took 640 MB before they were counted.
TEST(LayoutJson, CountsThePointsOfCurvesBeforeItMakesThem) {
  // The second hole is beside the plate: whoever makes the points first speaks of that.
  std::string holes;
  for (int i = 0; i < 5000; ++i) {
    const int x = i == 1 ? -50 : 4 + 12 * (i % 80), y = 5 + 12 * (i / 80);
    holes +=
        fmt::format(R"({}[{{"arc": {{"from": [{}, {}], "to": [{}, {}], "centre": [{}, {}], "ccw": true}}}}])",
                    i == 0 ? "" : ",", x + 1, y, x + 1, y, x, y);
  }
  const std::string text =
      R"({"format": "lekalo-layout/1", "units": "mm", "parts": [{"id": "a", "outline": {"curves": {"outer": [
      {"line": {"from": [0, 0], "to": [1000, 0]}}, {"line": {"from": [1000, 0], "to": [1000, 1000]}},
      {"line": {"from": [1000, 1000], "to": [0, 1000]}}, {"line": {"from": [0, 1000], "to": [0, 0]}}],
      "holes": [)" +
      holes + "]}}}]}";
  const std::string message = message_of(text);
  EXPECT_NE(message.find("parts[0].outline.curves: 140004 points"), std::string::npos) << message;
  EXPECT_NE(message.find("at most 100000 are taken: a larger tolerance needs fewer"), std::string::npos)
      << message;
}

}  // namespace
}  // namespace lekalo::io::io_layout_json_test

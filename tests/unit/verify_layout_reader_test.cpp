// What the checker reads of a layout, and where a number, a kind or a mark is none.

#include <gtest/gtest.h>

#include <limits>

#include "support/layout_texts.hpp"
#include "verify/layout/layout_document.hpp"

namespace lekalo::verify::verify_layout_reader_test {
namespace {

using cases::add_part;
using cases::empty_layout;
using cases::Json;
using cases::outline_json;
using cases::place;
using cases::rectangle;

const Json kSquare = outline_json(rectangle(0, 0, 10, 10));

Json one_part() {
  Json layout = empty_layout();
  add_part(layout, "a", kSquare);
  place(layout, "a", 0, 0);
  return layout;
}

struct Case {
  std::string pointer;
  Json value;
  std::string words;  ///< of the refusal; none where it is read
};
void expect(const Json& layout, const std::vector<Case>& cases) {
  for (const auto& [pointer, value, words] : cases) {
    Json other = layout;
    other.at(pointer) = value;
    const auto read = read_layout({"layout.json", other.dump()});
    const std::string sentence = read ? "" : read.error().message;
    EXPECT_TRUE(words.empty() ? sentence.empty() : sentence.find(words) != std::string::npos)
        << pointer << " " << value.dump() << ": " << sentence;
  }
}

TEST(VerifyLayoutReader, WhatIsNotThereHasItsUsualValue) {
  const auto read = read_layout({"layout.json", one_part().dump()});
  ASSERT_TRUE(read);
  const WrittenPart& part = read->parts[0];
  EXPECT_EQ(part.quality, 0);
  EXPECT_EQ(part.priority, 0);
  EXPECT_EQ(part.tolerated_severity, 0);
  EXPECT_EQ(part.demand, 0);
  EXPECT_EQ(read->stocks[0].count, 1);
  EXPECT_EQ(read->placements[0].copy, 0);
  Json other = one_part();
  other["parts"][0]["quality"] = "best";
  other["parts"][0]["grain"] = {{"deg", 7}};
  other["stocks"][0]["defects"] = {{{"id", "d"}, {"outline", kSquare}}};
  other["stocks"].push_back({{"id", "strip"}, {"kind", "strip"}, {"height", 5}, {"length", 7}});
  const auto more = read_layout({"layout.json", other.dump()});
  ASSERT_TRUE(more) << more.error().message;
  EXPECT_EQ(more->parts[0].quality, std::numeric_limits<int>::max());
  EXPECT_EQ(more->parts[0].grain->tolerance, 0);
  EXPECT_EQ(more->stocks[0].defects[0].grade, 1);
  const GridOutline& strip = more->stocks[1].outline;
  ASSERT_EQ(strip.edges.size(), 4U);
  EXPECT_EQ(strip.edges[0].from, (GridPoint{0, 0}));
  EXPECT_EQ(strip.edges[1].from, (GridPoint{7 << 20, 0}));
  EXPECT_EQ(strip.edges[2].from, (GridPoint{7 << 20, 5 << 20}));
  EXPECT_EQ(strip.edges[3].from, (GridPoint{0, 5 << 20}));
}

TEST(VerifyLayoutReader, WholeNumbersUpToTheirBounds) {
  const auto demand = [](const std::string& written) {
    std::string text = one_part().dump();
    const std::string id = R"("id":"a",)";
    text.insert(text.find(id), "\"demand\":" + written + ",");
    const auto read = read_layout({"layout.json", text});
    return read ? std::to_string(read->parts[0].demand) : read.error().message;
  };
  EXPECT_EQ(demand("0"), "0");
  EXPECT_EQ(demand("12"), "12");
  EXPECT_EQ(demand("12e1"), "120");
  EXPECT_EQ(demand("1000000000"), "1000000000");
  EXPECT_EQ(demand("1e9"), "1000000000");
  EXPECT_EQ(demand("12.0"), "12");
  EXPECT_EQ(demand("0.0"), "0");
  EXPECT_EQ(demand("1000000000.0"), "1000000000");
  EXPECT_EQ(demand("1.5e1"), "15");
  EXPECT_EQ(demand("999999999.99999999999"), "1000000000") << "as doubles are read";
  EXPECT_EQ(demand("0.00000000000000000000000001e26"), "1");
  EXPECT_EQ(demand("1e-400"), "0") << "as doubles are read";
  for (const char* written :
       {"-1", "1000000001", "1e10", "12.5", "-1.0", "1000000001.0", "1e30", "1e19", "-0.5",
        "-0.99999999999999999999", "1000000000.99999999999999999999", "true", "\"1\""})
    EXPECT_NE(demand(written).find("not a whole number from 0 to 1000000000"), std::string::npos) << written;
}

TEST(VerifyLayoutReader, NumbersAndKindsUpToTheirBounds) {
  Json layout = one_part();
  layout["placements"][0]["id"] = 7;
  expect(layout,
         {{"/stocks/0/cost", 0, ""},
          {"/stocks/0/cost", 0.5, ""},
          {"/stocks/0/cost", -0.5, "stocks[0].cost is -0.5, not from 0"},
          {"/stocks/0/kind", "hide", ""},
          {"/stocks/0/height", 5, "has a height or length, but is no strip"},
          {"/stocks/0/length", 5, "has a height or length, but is no strip"},
          {"/stocks/0/zones", {{{"id", "z"}, {"quality", 0}, {"outline", kSquare}}}, ""},
          {"/stocks/0/zones", {{{"id", "z"}, {"outline", kSquare}}}, "zones[0].quality is missing"},
          {"/stocks/0/defects", {{{"id", "d"}, {"severity", 1}, {"outline", kSquare}}}, ""},
          {"/stocks/0/defects", {{{"id", "d"}, {"severity", 0}, {"outline", kSquare}}}, "not a whole number"},
          {"/stocks/1", {{"id", "s"}, {"kind", "roll"}}, "strip, sheet or hide"},
          {"/parts/0/outline/polygon/outer/0", {0, 0, 0}, "is not a list of two numbers"},
          {"/parts/0/outline/polygon/outer/0", {0}, "is not a list of two numbers"},
          {"/parts/0/rotations", {3600, -3600}, ""},
          {"/parts/0/rotations", {{{"from", 90}, {"to", 90}}}, ""},
          {"/parts/0/rotations", {{{"from", 90}, {"to", 89}}}, "ends before it begins"},
          {"/parts/0/grain", {{"deg", 0}, {"tolerance_deg", 90}}, ""},
          {"/parts/0/grain", {{"deg", 0}, {"tolerance_deg", 90.5}}, "not from 0 to 90"},
          {"/parts/0/thickness", 0, "parts[0].thickness is 0, not from 0.001"},
          {"/parts/0/material", 2, "parts[0].material"},
          {"/parts/0/due", "2028-02-29", ""},
          {"/parts/0/due", "2100-02-29", "parts[0].due is no day"},
          {"/parts/0/due", "2000-02-29", ""},
          {"/parts/0/due", "2027-02-29", "is no day"},
          {"/parts/0/due", "2027-02-28", ""},
          {"/parts/0/due", "2028-02-30", "is no day"},
          {"/parts/0/due", "2026-01-01", ""},
          {"/parts/0/due", "2026-01-31", ""},
          {"/parts/0/due", "2026-07-31", ""},
          {"/parts/0/due", "2026-08-31", ""},
          {"/parts/0/due", "2026-08-32", "is no day"},
          {"/parts/0/due", "2026-09-31", "is no day"},
          {"/parts/0/due", "2026-11-31", "is no day"},
          {"/parts/0/due", "2026-04-31", "is no day"},
          {"/parts/0/due", "2026-00-10", "is no day"},
          {"/parts/0/due", "2026-13-10", "is no day"},
          {"/parts/0/due", "2026-1-100", "is no day"},
          {"/parts/0/due", "20261201", "is no day"},
          {"/parts/0/due", "", "is no day"},
          {"/parts/0/due", "2026-10-30", ""},
          {"/parts/0/due", "2026-12-31", ""},
          {"/parts/0/due", "2026-12-00", "is no day"},
          {"/parts/0/due", "2026-12-011", "is no day"},
          {"/parts/0/due", "2026/12-01", "is no day"},
          {"/parts/0/due", "2026-12/01", "is no day"},
          {"/parts/0/due", "2O26-12-01", "is no day"},
          {"/parts/0/due", "2026-12-0:", "is no day"},
          {"/placements/0/c", 1, "beside c and s"},
          {"/placements/0/s", 0, "beside c and s"},
          {"/next_id", 8, ""},
          {"/next_id", std::int64_t{1} << 53, ""},
          {"/next_id", (std::int64_t{1} << 53) + 1, "not a whole number"},
          {"/next_id", 7, "field next_id is 7, not a whole number from 8"}});
}

TEST(VerifyLayoutReader, MarksAreLinesAndArcsThatHangTogether) {
  const Json line{{"line", {{"from", {0, 0}}, {"to", {3, 4}}}}};
  const Json arc{{"arc", {{"from", {3, 4}}, {"to", {5, 6}}, {"centre", {3, 6}}, {"ccw", true}}}};
  Json layout = one_part();
  layout["parts"][0]["marks"] = {{{"layer", "pen"}, {"edges", {line, arc}}}};
  const auto read = read_layout({"layout.json", layout.dump()});
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->parts[0].marks[0].layer, "pen");
  EXPECT_EQ(read->parts[0].marks[0].numbers, (std::vector<double>{0, 0, 3, 4, 3, 4, 5, 6, 3, 6, 1}));
  const std::string at = "/parts/0/marks/0/edges";
  Json clockwise = arc, round = arc, both = line;
  clockwise["arc"]["ccw"] = false;
  round["arc"]["to"] = {3, 4};
  both["arc"] = arc["arc"];
  expect(layout, {{at + "/1", clockwise, ""},
                  {at + "/1", round, ""},
                  {at, Json::array(), "has no edges"},
                  {at + "/0", both, "is not one line or one arc"},
                  {at + "/0", Json::object(), "is not one line or one arc"},
                  {at + "/0/line/to", {3}, "is not two numbers"},
                  {at + "/0/line/to", {3, 4, 5}, "is not two numbers"},
                  {at + "/1/arc/centre", {3}, "is not two numbers"},
                  {at + "/1/arc/ccw", 1, "neither true nor false"},
                  {at, {{{"line", {{"from", {1, 2}}, {"to", {1, 2}}}}}}, "has no length"},
                  {at, {{{"line", {{"from", {1, 2}}, {"to", {1, 3}}}}}}, ""},
                  {at, {{{"line", {{"from", {1, 2}}, {"to", {0, 2}}}}}}, ""},
                  {at, {{{"line", {{"from", {2, 2}}, {"to", {1, 2}}}}}}, ""},
                  {at, {{{"line", {{"from", {1, 1}}, {"to", {1, 2}}}}}}, ""},
                  {at + "/0/line/centre", {0, 0}, "is a line with a centre or a direction"},
                  {at + "/0/line/ccw", true, "is a line with a centre or a direction"},
                  {at + "/1/arc/from", {3, 5}, "does not begin where the edge before it ends"},
                  {at + "/1/arc/from", {2, 4}, "does not begin where the edge before it ends"},
                  {at + "/2", {{"line", {{"from", {5, 6}}, {"to", {3, 6}}}}}, ""},
                  {at + "/2",
                   {{"line", {{"from", {3, 6}}, {"to", {5, 6}}}}},
                   "does not begin where the edge before it ends"}});
  EXPECT_EQ(read_layout({"l", layout.dump()})->parts[0].marks[0].numbers.back(), 1);
  layout.at(at)[1] = clockwise;
  EXPECT_EQ(read_layout({"l", layout.dump()})->parts[0].marks[0].numbers.back(), -1);
}

TEST(VerifyLayoutReader, OutlinesThatAreOnlyDrawnWaitForTheirPolygon) {
  Json layout = one_part();
  const auto line = [](int a, int b, int c, int d) {
    return Json{{"line", {{"from", {a, b}}, {"to", {c, d}}}}};
  };
  layout["parts"][0]["outline"] = {
      {"curves", {{"outer", {line(0, 0, 9, 0), line(9, 0, 0, 9), line(0, 9, 0, 0)}}}}};
  const auto unmade = read_layout({"layout.json", layout.dump()}, true);
  ASSERT_TRUE(unmade) << unmade.error().message;
  EXPECT_EQ(unmade->parts[0].outline.unmade, "parts[0].outline");
  EXPECT_NE(unmade->parts[0].outline.drawn, nullptr);
  const std::string missing =
      "layout.json: parts[0].outline has no polygon; let lekalo write the file, which makes it";
  EXPECT_EQ(read_layout({"layout.json", layout.dump()}).error().message, missing);
  layout["parts"][0]["outline"] = Json::object();
  EXPECT_EQ(read_layout({"layout.json", layout.dump()}, true).error().message, missing);
}

}  // namespace
}  // namespace lekalo::verify::verify_layout_reader_test

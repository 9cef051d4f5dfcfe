#include "lekalo/io/text/json_writer.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "lekalo/io/text/words.hpp"

namespace lekalo::io::io_json_writer_test {
namespace {

std::string sample(JsonLayout layout) {
  JsonWriter json(layout);
  json.begin_object().fields({{"id", 7}, {"whole", 1.0}, {"name", "a"}});
  json.key("list").list({1, 2.5, true, nullptr}).key("empty").list(std::vector<int>{});
  json.key("none").object({}).key("inside").begin_list().object({{"x", -3}}).begin_list().end().end().end();
  return json.take();
}

TEST(JsonWriter, CompactTextHasNoBlanks) {
  EXPECT_EQ(
      sample(JsonLayout::compact),
      R"({"id":7,"whole":1.0,"name":"a","list":[1,2.5,true,null],"empty":[],"none":{},"inside":[{"x":-3},[]]})");
}

TEST(JsonWriter, SpacedTextHasABlankAfterColonsAndCommas) {
  EXPECT_EQ(sample(JsonLayout::spaced),
            R"({"id": 7, "whole": 1, "name": "a", "list": [1, 2.5, true, null], "empty": [], "none": {}, )"
            R"("inside": [{"x": -3}, []]})");
}

TEST(JsonWriter, IndentedTextHasALineForEachItemAndNoneForEmptyBrackets) {
  EXPECT_EQ(sample(JsonLayout::indented), R"({
  "id": 7,
  "whole": 1.0,
  "name": "a",
  "list": [
    1,
    2.5,
    true,
    null
  ],
  "empty": [],
  "none": {},
  "inside": [
    {
      "x": -3
    },
    []
  ]
})");
}

TEST(JsonWriter, LinesOfSpacedTextBreakWhereTheyAreAskedTo) {
  JsonWriter json(JsonLayout::spaced);
  json.begin_object().field("format", 1).line(0).field("next", 2).line(1).key("items");
  json.list_of_lines(std::vector<int>{3, 4}, 2, 1, [&](int item) { json.list({item, item}); });
  json.line(1).key("none").list_of_lines(std::vector<int>{}, 2, 1, [](int) {});
  json.line(0).end();
  EXPECT_EQ(json.take(),
            "{\"format\": 1,\n\"next\": 2,\n \"items\": [\n  [3, 3],\n  [4, 4]\n ],\n \"none\": []\n}");
}

TEST(JsonWriter, AScalarIsADocumentAndAWriterWritesOneAfterAnother) {
  JsonWriter json(JsonLayout::indented);
  EXPECT_EQ(json.value("a").take(), "\"a\"");
  EXPECT_EQ(json.value(nullptr).take(), "null");
  EXPECT_EQ(json.list({}).take(), "[]");
}

TEST(JsonWriter, JsonThatStandsAlreadyIsTakenAsItIs) {
  JsonWriter json(JsonLayout::spaced);
  json.begin_list().value(1);
  json.raw() += "{\"a\":1.50}";
  json.value(2).end();
  EXPECT_EQ(json.take(), "[1, {\"a\":1.50}, 2]");
}

TEST(JsonWriter, WholeNumbersKeepAllTheirDigits) {
  JsonWriter json(JsonLayout::spaced);
  json.list({std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::uint64_t>::max(),
             std::uint8_t{255}, std::int8_t{-1}, std::optional<int>{}, std::optional<int>(5)});
  EXPECT_EQ(json.take(), "[-9223372036854775808, 18446744073709551615, 255, -1, null, 5]");
}

TEST(JsonWriter, DoublesSayAPointWhereReportsHadOne) {
  const std::vector<double> numbers{0.0, -0.0, 1, -2.5, 0.1, 1e-5, 123456789012345, 1e15, 1e16, 5e-324};
  JsonWriter spaced(JsonLayout::spaced), compact(JsonLayout::compact);
  EXPECT_EQ(spaced.list(numbers).take(),
            "[0, -0, 1, -2.5, 0.1, 1e-05, 123456789012345, 1000000000000000, 1e+16, 5e-324]");
  EXPECT_EQ(compact.list(numbers).take(),
            "[0.0,-0.0,1.0,-2.5,0.1,1e-05,123456789012345.0,1e+15,1e+16,5e-324]");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(compact.list({kInfinity, -kInfinity, kInfinity - kInfinity}).take(), "[null,null,null]");
}

TEST(JsonWriter, TextsAndKeysAreEscaped) {
  JsonWriter json(JsonLayout::compact);
  json.object({{"a\"b", std::string("\b\t\n\f\r\"\\/\0\x1f\x7f", 11)}});
  EXPECT_EQ(json.take(), "{\"a\\\"b\":\"\\b\\t\\n\\f\\r\\\"\\\\/\\u0000\\u001f\x7f\"}");
}

TEST(Utf8, EachPieceThatIsNotUtf8BecomesOneReplacement) {
  const std::string replacement = "\xef\xbf\xbd";
  for (const auto& [bytes, pieces] : std::vector<std::pair<std::string, int>>{{"\xff", 1},
                                                                              {"\x80\x80", 2},
                                                                              {"\xe2\x82", 1},
                                                                              {"\xf0\x9f\x98", 1},
                                                                              {"\xc0\xaf", 2},
                                                                              {"\xed\xa0\x80", 3},
                                                                              {"\xf4\x90\x80\x80", 4},
                                                                              {"\xe0\x80", 2}}) {
    std::string wanted = "a";
    for (int i = 0; i < pieces; ++i) wanted += replacement;
    wanted += "b";
    EXPECT_EQ(as_utf8("a" + bytes + "b"), wanted);
    EXPECT_EQ(json_string("a" + bytes + "b"), '"' + wanted + '"');
  }
  EXPECT_EQ(as_utf8("ж😀\xc3"), "ж😀" + replacement);
}

TEST(AsciiJson, HoldsTheSameTextInEscapes) {
  EXPECT_EQ(ascii_json(json_string("a\nж😀\x7f")), R"("a\n\u0436\ud83d\ude00\u007f")");
}

}  // namespace
}  // namespace lekalo::io::io_json_writer_test

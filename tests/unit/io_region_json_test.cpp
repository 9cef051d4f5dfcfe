#include "lekalo/io/shape/region_json.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

namespace lekalo::io::io_region_json_test {
namespace {

constexpr const char* kKeyhole = R"({"name": "keyhole", "units": "mm",
 "outer": [{"arc": {"from": [-30, 0], "to": [30, 0], "centre": [0, 0], "ccw": true}},
  {"line": {"from": [30, 0], "to": [30, 32.1]}}, {"line": {"from": [30, 32.1], "to": [-30, 32.1]}},
  {"line": {"from": [-30, 32.1], "to": [-30, 0]}}],
 "islands": [[{"arc": {"from": [5, 10], "to": [5, 10], "centre": [0, 10], "ccw": true}}]]})";

TEST(RegionJson, ReadsPocketsAndWritesWhatItReads) {
  const auto file = parse_regions(kKeyhole, "keyhole.json");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  ASSERT_EQ(file->regions.size(), 1u);
  EXPECT_NEAR(geom::area(file->regions[0]),
              60 * 32.1 + 0.5 * 3.141592653589793 * 900 - 3.141592653589793 * 25, 1e-9);
  const auto again = parse_regions(regions_json(file->regions), "again.json");
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(again->regions, file->regions);
}

TEST(RegionJson, RefusesWithOneSentence) {
  for (const char* bad :
       {"", "[]", "{}", R"({"outer": []})", R"({"units": "furlong", "outer": []})",
        R"({"outer": [{"line": {"from": [0, 0], "to": [1, "x"]}}]})", R"({"outer": [{"spline": {}}]})",
        R"({"outer": [{"line": {"from": [0, 0], "to": [1, 1e999]}}]})"}) {
    const auto file = parse_regions(bad, "bad.json");
    ASSERT_FALSE(file.has_value()) << bad;
    EXPECT_EQ(file.error().code, ErrorCode::bad_input) << bad;
    EXPECT_EQ(file.error().message.find("bad.json"), 0u) << file.error().message;
    EXPECT_EQ(file.error().message.find('\n'), std::string::npos) << file.error().message;
  }
}

TEST(RegionJson, NothingFollowsAZeroByteUnread) {
  for (const std::string& tail : {std::string(1, '\0'), std::string("\n\0\n{\"a\": 1}", 11)}) {
    const auto file = parse_regions(kKeyhole + tail, "tail.json");
    ASSERT_FALSE(file.has_value());
    EXPECT_EQ(file.error().message, fmt::format("tail.json, line {}: this is not JSON from '\\x00' on",
                                                tail.front() == '\n' ? 6 : 5));
  }
}

TEST(RegionJson, SaysWhereAFileIsNoJson) {
  const auto message = [](const std::string& text) {
    const auto file = parse_regions(text, "bad.json");
    return file ? std::string("read") : file.error().message;
  };
  EXPECT_EQ(message("{\"outer\": [\n"), "bad.json, line 2: the file ends too early; it may be cut off");
  EXPECT_EQ(message("{\"outer\":\n [1e999]}"), "bad.json, line 2: the number '1e999' is out of range");
  EXPECT_EQ(message(R"({"outer": [{"line": {"from": [0, 0], "from": [1, 0]}}]})"),
            "bad.json: outer[0].line: the key 'from' stands twice in one object");
  EXPECT_NE(message(R"({"outer": )" + std::string(1'000'000, '[')).find("more than 64 deep here"),
            std::string::npos);
}

}  // namespace
}  // namespace lekalo::io::io_region_json_test

// The published schema of processes accepts the example, and refuses what the reader refuses.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/layout/process_file.hpp"
#include "support/json.hpp"
#include "support/places.hpp"
#include "support/schemas.hpp"

namespace lekalo::io::io_processes_test {
namespace {

using cases::Json;

const char* const kSchema = "lekalo-process-1.schema.json";

Json example() {
  return Json::parse(disk::read_file(cases::source_dir() + "/examples/processes/shop.json").value());
}

TEST(ProcessSchema, AcceptsTheExampleAndWhatMayBeLeftOut) {
  ASSERT_NE(cases::python_with_jsonschema(), "")
      << "python3-jsonschema is not installed (tools/setup.sh installs it)";
  std::vector<std::string> texts{example().dump()};
  for (const char* field : {"post", "speed", "pierce_s", "lead_in_mm"}) {
    Json less = example();
    less["processes"][0].erase(field);
    texts.push_back(less.dump());
  }
  Json pierced = example();
  pierced["processes"][5]["pierce_s"] = 0;
  texts.push_back(pierced.dump());
  Json held = example();
  for (const auto& [key, value] : {std::pair<const char*, Json>{"joints", "tipping"},
                                   {"joint_width_mm", 0.5},
                                   {"joints_up_to_mm", 300},
                                   {"slat_pitch_mm", 60},
                                   {"slats", "x"},
                                   {"heat_spread_mm", 40}})
    held["processes"][0][key] = value;
  held["processes"][5]["joints"] = 2;
  held["processes"][5]["joint_width_mm"] = 3;
  held["processes"][5]["tab_height_mm"] = 1;
  texts.push_back(held.dump());
  for (const char* field : {"turn_above_deg", "overcut_mm", "knife_tolerance_mm"}) {
    Json less = example();
    less["processes"][6].erase(field);
    texts.push_back(less.dump());
  }
  const auto said = cases::schema_verdicts(kSchema, texts);
  ASSERT_EQ(said.size(), texts.size());
  for (std::size_t i = 0; i < said.size(); ++i) {
    EXPECT_TRUE(read_processes(texts[i], "p.json")) << texts[i];
    EXPECT_EQ(said[i], "ok") << texts[i];
  }
}

TEST(ProcessSchema, RefusesWhatTheReaderRefuses) {
  ASSERT_NE(cases::python_with_jsonschema(), "")
      << "python3-jsonschema is not installed (tools/setup.sh installs it)";
  std::vector<std::string> texts;
  struct Wrong {
    const char *place, *value;
  };
  for (const Wrong& wrong : {Wrong{"/format", "\"lekalo-process/2\""},
                             {"/processes", "[]"},
                             {"/units", "\"mm\""},
                             {"/processes/0/material", "\"\""},
                             {"/processes/0/material", "\"a\\u0007\""},
                             {"/processes/0/thickness_mm", "0"},
                             {"/processes/0/process", "\"saw\""},
                             {"/processes/0/post", "\"\""},
                             {"/processes/0/kerf_mm", "0"},
                             {"/processes/0/kerf_mm", "\"0.2\""},
                             {"/processes/0/feed_mm_per_min", "1e7"},
                             {"/processes/0/speed", "0"},
                             {"/processes/0/pierce_s", "-1"},
                             {"/processes/0/lead", "\"loop\""},
                             {"/processes/0/lead_in_mm", "1001"},
                             {"/processes/0/depth_mm", "3"},
                             {"/processes/0/gas", "\"O2\""},
                             {"/processes/1/holes", "{}"},
                             {"/processes/1/holes/0/up_to_diameter_mm", "0"},
                             {"/processes/1/holes/0/feed_share", "2"},
                             {"/processes/1/holes/0/feed", "2"},
                             {"/processes/5/pass_mm", "0"},
                             {"/processes/5/safe_height_mm", "0"},
                             {"/processes/0/heat_spread_mm", "-1"},
                             {"/processes/0/common_line", "\"yes\""},
                             {"/processes/0/tool", "1"},
                             {"/processes/5/tool", "1.5"},
                             {"/processes/5/engrave_tool", "2"},
                             {"/processes/0/corner_feed_share", "0.5"},
                             {"/processes/0/corner_distance_mm", "2"},
                             {"/processes/0/pierce_diameter_mm", "0"},
                             {"/processes/0/joints", "2"},
                             {"/processes/0/joints", "\"2\""},
                             {"/processes/0/joint_width_mm", "1"},
                             {"/processes/0/joints_up_to_mm", "100"},
                             {"/processes/0/slat_pitch_mm", "60"},
                             {"/processes/0/slats", "\"z\""},
                             {"/processes/0/tab_height_mm", "1"},
                             {"/processes/5/tab_height_mm", "1"},
                             {"/processes/5/pierce_diameter_mm", "8"},
                             {"/processes/5/pierce_s", "1"},
                             {"/processes/0/blade_offset_mm", "1"},
                             {"/processes/0/overcut_mm", "1"},
                             {"/processes/6/kerf_mm", "1"},
                             {"/processes/6/holes", "[]"},
                             {"/processes/6/blade_offset_mm", "0"},
                             {"/processes/6/turn_above_deg", "91"},
                             {"/processes/6/overcut_mm", "-1"},
                             {"/processes/6/knife_tolerance_mm", "0.01"},
                             {"/processes/7/blade_offset_mm", "1"}}) {
    Json changed = example();
    const std::string place = wrong.place;
    const std::size_t last = place.rfind('/');
    Json& object = last == 0 ? changed : changed.at(place.substr(0, last));
    object[place.substr(last + 1)] = Json::parse(wrong.value);
    texts.push_back(changed.dump());
  }
  const std::vector<std::pair<int, const char*>> needed{
      {0, "material"},          {0, "thickness_mm"},   {0, "process"}, {0, "kerf_mm"},
      {0, "feed_mm_per_min"},   {3, "speed"},          {5, "speed"},   {5, "depth_mm"},
      {5, "plunge_mm_per_min"}, {6, "blade_offset_mm"}};
  for (const auto& [entry, field] : needed) {
    Json less = example();
    less["processes"][entry].erase(field);
    texts.push_back(less.dump());
  }
  const auto said = cases::schema_verdicts(kSchema, texts);
  ASSERT_EQ(said.size(), texts.size());
  for (std::size_t i = 0; i < said.size(); ++i) {
    EXPECT_FALSE(read_processes(texts[i], "p.json")) << texts[i];
    EXPECT_NE(said[i], "ok") << texts[i];
  }
}

}  // namespace
}  // namespace lekalo::io::io_processes_test

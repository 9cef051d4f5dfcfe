#include "lekalo/io/layout/process_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lekalo/base/angle.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "support/json.hpp"
#include "support/layout_texts.hpp"
#include "support/places.hpp"

namespace lekalo::io::io_process_file_test {
namespace {

using cases::Json;

Json laser() {
  return {{"material", "steel"},
          {"thickness_mm", 2},
          {"process", "laser"},
          {"kerf_mm", 0.2},
          {"feed_mm_per_min", 3000}};
}
Json router() {
  return {{"material", "plywood"},   {"thickness_mm", 12}, {"process", "router"}, {"kerf_mm", 6},
          {"feed_mm_per_min", 1500}, {"speed", 18000},     {"depth_mm", 12.5},    {"plunge_mm_per_min", 300}};
}
Json drag_knife() {
  return {{"material", "leather"}, {"thickness_mm", 2}, {"process", "drag-knife"}, {"blade_offset_mm", 0.5}};
}
Json with(Json entry, const char* key, const Json& value) {
  entry[key] = value;
  return entry;
}
Json without(Json entry, const char* key) {
  entry.erase(key);
  return entry;
}
std::string text_of(const std::vector<Json>& entries) {
  return Json{{"format", "lekalo-process/1"}, {"processes", entries}}.dump();
}
ProcessFile file_of(const std::vector<Json>& entries) {
  auto read = read_processes(text_of(entries), "shop.json");
  if (!read) throw std::logic_error("test input: " + read.error().message);
  return *std::move(read);
}
std::string trouble(const std::string& text) {
  const auto read = read_processes(text, "shop.json");
  if (!read) {
    EXPECT_EQ(read.error().code, ErrorCode::bad_input);
    return read.error().message;
  }
  return "none";
}

TEST(ProcessFile, TheExampleIsRead) {
  const auto bytes = disk::read_file(cases::source_dir() + "/examples/processes/shop.json");
  ASSERT_TRUE(bytes) << bytes.error().message;
  const auto file = read_processes(*bytes, "shop.json");
  ASSERT_TRUE(file) << file.error().message;
  ASSERT_EQ(file->processes.size(), 8U);
  const CutProcess& plasma = file->processes[1];
  EXPECT_EQ(plasma.material, "steel");
  EXPECT_EQ(plasma.thickness_mm, 6);
  EXPECT_EQ(plasma.kind, "plasma");
  ASSERT_EQ(plasma.holes.size(), 2U);
  EXPECT_EQ(plasma.holes[0].up_to_diameter_mm, 12);
  EXPECT_EQ(plasma.holes[0].lead_in_mm, 1.5);
  EXPECT_EQ(plasma.holes[0].feed_share, 0.4);
  EXPECT_FALSE(file->processes[4].holes.at(0).lead_in_mm);
}

TEST(ProcessFile, AnEntryIsTheWordsOfTheLine) {
  const Json entry = {{"material", "plywood"}, {"thickness_mm", 9.5}, {"process", "router"},
                      {"post", "fanuc"},       {"kerf_mm", 3.175},    {"feed_mm_per_min", 1234.5},
                      {"speed", 18000},        {"lead", "arc"},       {"lead_in_mm", 2},
                      {"depth_mm", 9.7},       {"pass_mm", 3.3},      {"plunge_mm_per_min", 250},
                      {"safe_height_mm", 7}};
  const auto request = process_request(file_of({entry}).processes.front(), {}, "--");
  ASSERT_TRUE(request) << request.error().message;
  const nc::ProfileOptions& p = request->profile;
  EXPECT_EQ(request->form, ExportForm::gcode);
  EXPECT_EQ(p.process, nc::Process::router);
  EXPECT_EQ(p.post.name, "fanuc");
  EXPECT_EQ(p.kerf_mm, 3.175);
  EXPECT_EQ(p.feed_mm_per_min, 1234.5);
  EXPECT_EQ(p.speed, 18000);
  EXPECT_EQ(p.lead, nc::LeadShape::arc);
  EXPECT_EQ(p.lead_in_mm, 2);
  EXPECT_EQ(p.depth_mm, 9.7);
  EXPECT_EQ(p.pass_mm, 3.3);
  EXPECT_EQ(p.plunge_mm_per_min, 250);
  EXPECT_EQ(p.safe_height_mm, 7);
  EXPECT_TRUE(p.holes.empty());
  const auto beam = process_request(file_of({with(laser(), "pierce_s", 0.7)}).processes.front(), {}, "--");
  ASSERT_TRUE(beam) << beam.error().message;
  EXPECT_EQ(beam->profile.pierce_s, 0.7);
  for (const bool wanted : {true, false}) {
    const auto common =
        process_request(file_of({with(laser(), "common_line", wanted)}).processes.front(), {}, "--");
    ASSERT_TRUE(common) << common.error().message;
    EXPECT_EQ(common->profile.common_line, wanted);
  }
  // A jet of water is switched as a plasma is.
  const auto jet = process_request(file_of({with(laser(), "process", "waterjet")}).processes.front(), {}, "");
  ASSERT_TRUE(jet) << jet.error().message;
  EXPECT_EQ(jet->profile.process, nc::Process::plasma);
}

TEST(ProcessFile, KnivesArePlots) {
  Json drag = drag_knife();
  drag["turn_above_deg"] = 10, drag["overcut_mm"] = 1.5, drag["knife_tolerance_mm"] = 0.2;
  Json tangential = with(without(drag_knife(), "blade_offset_mm"), "process", "tangential-knife");
  const ProcessFile file = file_of({with(laser(), "material", "leather"), drag, tangential});
  const auto request = process_request(file.processes[1], {{"overcut", "2"}, {"only", "CUT"}}, "--");
  ASSERT_TRUE(request) << request.error().message;
  EXPECT_EQ(request->form, ExportForm::hpgl);
  ASSERT_TRUE(request->knife);
  EXPECT_EQ(request->knife->kind, nc::KnifeKind::drag);
  EXPECT_EQ(request->knife->offset_mm, 0.5);
  EXPECT_DOUBLE_EQ(request->knife->turn_above, kDegree * 10);
  EXPECT_EQ(request->knife->overcut_mm, 2) << "the line says so";
  EXPECT_EQ(request->knife->tolerance_mm, 0.2);
  const auto turned = process_request(file.processes[2], {}, "--");
  ASSERT_TRUE(turned) << turned.error().message;
  EXPECT_EQ(turned->knife->kind, nc::KnifeKind::tangential);
  EXPECT_DOUBLE_EQ(turned->knife->turn_above, kDegree * 20);
  // Of one material each form finds its own.
  EXPECT_EQ(find_process(file, "leather", 2, "").value(), 0U);
  EXPECT_EQ(find_process(file, "leather", 2, "drag-knife", ExportForm::hpgl).value(), 1U);
  const auto several = find_process(file, "leather", 2, "", ExportForm::hpgl);
  ASSERT_FALSE(several);
  EXPECT_EQ(several.error().message,
            "shop.json: entries 2 and 3 are for leather, 2 mm: drag-knife and tangential-knife; say which "
            "with --process");
  const auto other = find_process(file, "leather", 2, "drag-knife");
  ASSERT_FALSE(other);
  EXPECT_EQ(
      other.error().message,
      "shop.json: the programs of leather, 2 mm (drag-knife) have the form hpgl, and gcode was asked for");
}

TEST(ProcessFile, WordsOfTheLineReplaceWhatTheEntrySays) {
  Json entry = with(with(laser(), "speed", 900), "lead_in_mm", 2);
  entry["holes"] = Json::array({{{"up_to_diameter_mm", 3}, {"lead_in_mm", 0.5}, {"feed_share", 0.4}},
                                {{"up_to_diameter_mm", 8}, {"feed_share", 0.6}}});
  const CutProcess process = file_of({entry}).processes.front();
  const auto request =
      process_request(process, {{"kerf", "0.3"}, {"post", "grbl"}, {"unit", "inch"}, {"sheet", "s#2"}}, "--");
  ASSERT_TRUE(request) << request.error().message;
  EXPECT_EQ(request->profile.kerf_mm, 0.3);
  EXPECT_EQ(request->profile.post.name, "grbl");
  EXPECT_EQ(request->profile.feed_mm_per_min, 3000);
  EXPECT_EQ(request->profile.unit, LengthUnit::inch);
  EXPECT_EQ(request->sheet, "s#2");
  ASSERT_EQ(request->profile.holes.size(), 2U);
  EXPECT_EQ(request->profile.holes[0].lead_in_mm, 0.5);
  EXPECT_FALSE(request->profile.holes[1].lead_in_mm);
  // The length of leads is that of holes, too; their feeds stay shares.
  const auto leads = process_request(process, {{"lead-in", "1.25"}, {"feed", "1000"}}, "--");
  ASSERT_TRUE(leads) << leads.error().message;
  EXPECT_EQ(leads->profile.lead_in_mm, 1.25);
  EXPECT_FALSE(leads->profile.holes[0].lead_in_mm);
  EXPECT_EQ(leads->profile.feed_mm_per_min, 1000);
  EXPECT_EQ(leads->profile.holes[0].feed_share, 0.4);
}

TEST(ProcessFile, WordsThatDoNotGoWithTheEntryAreRefusedAsOnTheLine) {
  const CutProcess process = file_of({laser()}).processes.front();
  const auto refused = [&](const std::vector<ExportWord>& words) {
    const auto request = process_request(process, words, "--");
    EXPECT_FALSE(request);
    return request ? std::string() : request.error().message;
  };
  EXPECT_NE(refused({{"post", "grbl"}}).find("--speed is missing: the power of the beam"), std::string::npos);
  EXPECT_NE(refused({{"depth", "3"}}).find("--depth has a meaning for routers alone"), std::string::npos);
  EXPECT_NE(refused({{"tolerance", "0.1"}}).find("at most a quarter of the kerf of 0.2 mm"),
            std::string::npos);
  EXPECT_NE(refused({{"kerf", "x"}}).find("--kerf x: has to be a number"), std::string::npos);
  EXPECT_NE(refused({{"only", "CUT"}}).find("--only has no meaning for the form gcode"), std::string::npos);
}

TEST(ProcessFile, TheProgramIsThatOfTheSameWordsOnTheLine) {
  Json layout = cases::empty_layout();
  cases::add_part(layout, "plate",
                  cases::outline_json(cases::rectangle(0, 0, 30, 20), {cases::rectangle(5, 5, 10, 10)}));
  cases::place(layout, "plate", 10, 10, 17);
  cases::place(layout, "plate", 60, 20, 90);
  const auto document = read_layout(layout.dump(), "layout");
  ASSERT_TRUE(document) << document.error().message;
  const auto program = [&](const Result<ExportRequest>& request) {
    if (!request) return request.error().message;
    const auto made = export_layout(document->document, "plates", *request);
    return made ? made->files.at(0).bytes : made.error().message;
  };
  const auto line = [](const std::vector<ExportWord>& words) {
    return read_export_words(ExportForm::gcode, words, "--");
  };
  const CutProcess beam =
      file_of({with(with(with(laser(), "lead_in_mm", 1.5), "pierce_s", 0.35), "post", "fanuc")}).processes[0];
  EXPECT_EQ(program(process_request(beam, {}, "--")), program(line({{"process", "laser"},
                                                                    {"post", "fanuc"},
                                                                    {"kerf", "0.2"},
                                                                    {"feed", "3000"},
                                                                    {"pierce", "0.35"},
                                                                    {"lead-in", "1.5"}})));
  EXPECT_EQ(program(process_request(file_of({with(router(), "pass_mm", 4.1)}).processes[0], {}, "--")),
            program(line({{"process", "router"},
                          {"kerf", "6"},
                          {"feed", "1500"},
                          {"speed", "18000"},
                          {"depth", "12.5"},
                          {"plunge", "300"},
                          {"pass", "4.1"}})));
}

TEST(ProcessFile, NumbersThatDecimalsDoNotHoldAreTheSameOnTheLine) {
  for (const double kerf : {0.1 + 0.2, 1.0 / 3, 0.010000000000000002, 99.99999999999999}) {
    const auto request = process_request(file_of({with(laser(), "kerf_mm", kerf)}).processes[0], {}, "--");
    ASSERT_TRUE(request) << request.error().message;
    EXPECT_EQ(request->profile.kerf_mm, kerf);
  }
}

TEST(ProcessFile, OneProcessIsFoundOrASentenceSaysWhichThereAre) {
  const ProcessFile file =
      file_of({laser(), with(laser(), "process", "plasma"), with(laser(), "thickness_mm", 3.5), router(),
               with(laser(), "process", "waterjet")});
  const auto found = [&](const char* material, double thickness, const char* kind) {
    const auto index = find_process(file, material, thickness, kind);
    if (index) return std::to_string(*index);
    EXPECT_EQ(index.error().code, ErrorCode::usage);
    return index.error().message;
  };
  EXPECT_EQ(found("steel", 2, "plasma"), "1");
  EXPECT_EQ(found("steel", 3.5, ""), "2");
  EXPECT_EQ(found("plywood", 12, ""), "3");
  EXPECT_EQ(found("steel", 2, ""),
            "shop.json: entries 1, 2 and 5 are for steel, 2 mm: laser, plasma and waterjet; say which with "
            "--process");
  EXPECT_EQ(
      found("steel", 2, "router"),
      "shop.json: there is no process for steel, 2 mm (router); there are: steel, 2 mm (laser); steel, 2 mm "
      "(plasma); steel, 3.5 mm (laser); steel, 2 mm (waterjet)");
  EXPECT_EQ(
      found("brass", 2, ""),
      "shop.json: there is no process for brass, 2 mm; there are: steel, 2 mm (laser); steel, 2 mm (plasma); "
      "steel, 3.5 mm (laser); plywood, 12 mm (router); steel, 2 mm (waterjet)");
  std::vector<Json> many;
  for (int k = 1; k <= 23; ++k) many.push_back(with(laser(), "thickness_mm", k));
  const auto none = find_process(file_of(many), "steel", 0.5, "");
  ASSERT_FALSE(none);
  EXPECT_TRUE(none.error().message.ends_with("steel, 20 mm (laser); and 3 more")) << none.error().message;
}

TEST(ProcessFile, WhatIsWrongIsToldWithItsEntry) {
  const auto hole = [](const Json& rows) { return with(laser(), "holes", rows); };
  struct Case {
    Json entry;
    std::string says;
  };
  const std::vector<Case> wrong{
      {without(laser(), "kerf_mm"), "kerf_mm is missing: the width of the cut in mm"},
      {without(laser(), "feed_mm_per_min"), "feed_mm_per_min is missing: the speed of the cut in mm/min"},
      {without(laser(), "material"), "material is missing: the name that --material says"},
      {without(laser(), "thickness_mm"), "thickness_mm is missing"},
      {without(laser(), "process"), "process is missing: the kind of machine"},
      {with(laser(), "kerf_mm", 0), "kerf_mm 0: has to be a number from 0.01 to 100"},
      {with(laser(), "kerf_mm", "0.2"), "kerf_mm a text: has to be a number from 0.01 to 100"},
      {with(laser(), "kerf_mm", nullptr), "kerf_mm null: has to be a number from 0.01 to 100"},
      {with(laser(), "feed_mm_per_min", -5), "feed_mm_per_min -5: has to be a number from 0.1 to 1e+06"},
      {with(laser(), "speed", 0), "speed 0: has to be a number from 1 to 1e+06"},
      {with(laser(), "pierce_s", 101), "pierce_s 101: has to be a number from 0 to 100"},
      {with(laser(), "lead_in_mm", 1001), "lead_in_mm 1001: has to be a number from 0 to 1000"},
      {with(laser(), "lead", "loop"), "lead loop: has to be one of line, arc"},
      {with(laser(), "process", "saw"),
       "process saw: has to be one of laser, plasma, waterjet, router, drag-knife, tangential-knife"},
      {with(laser(), "process", 3), "process has to be a text of 1 to 1000 bytes without control characters"},
      {with(laser(), "post", "siemens"), "post siemens: has to be one of " + nc::post_names(", ", ", ")},
      {with(laser(), "post", ""), "post has to be a text of 1 to 1000 bytes without control characters"},
      {with(laser(), "material", ""),
       "material has to be a text of 1 to 1000 bytes without control characters"},
      {with(laser(), "material", "a\nb"),
       "material has to be a text of 1 to 1000 bytes without control characters"},
      {with(laser(), "thickness_mm", 0), "thickness_mm 0: has to be a number from 0.001 to 1000"},
      {with(laser(), "thickness_mm", "2"), "thickness_mm has to be a number from 0.001 to 1000"},
      {with(laser(), "kerf", 0.2),
       "there is no key 'kerf'; known are material, thickness_mm, process, post, kerf_mm, feed_mm_per_min, "
       "speed, "
       "pierce_s, lead, lead_in_mm, depth_mm, pass_mm, plunge_mm_per_min, safe_height_mm, tool, "
       "engrave_tool, "
       "engrave_feed_mm_per_min, "
       "engrave_speed, engrave_depth_mm, "
       "pierce_diameter_mm, "
       "heat_spread_mm, corner_feed_share, corner_distance_mm, common_line, joints, joints_up_to_mm, "
       "joint_width_mm, slat_pitch_mm, slats, tab_height_mm, "
       "blade_offset_mm, turn_above_deg, overcut_mm, knife_tolerance_mm and holes"},
      {with(laser(), "depth_mm", 3), "depth_mm has a meaning for routers alone: process router"},
      {with(laser(), "safe_height_mm", 3), "safe_height_mm has a meaning for routers alone: process router"},
      {with(laser(), "post", "grbl"),
       "speed is missing: the power of the beam, the S word; without it the beam stays dark"},
      {without(router(), "speed"), "speed is missing: the speed of the spindle, the S word"},
      {without(router(), "depth_mm"), "depth_mm is missing: how deep a router cuts, in mm"},
      {without(router(), "plunge_mm_per_min"),
       "plunge_mm_per_min is missing: how fast a router goes down, in mm/min"},
      {with(router(), "pierce_s", 1), "pierce_s has no meaning for routers: leave it out"},
      {with(router(), "pierce_diameter_mm", 8),
       "pierce_diameter_mm has no meaning for routers: leave it out"},
      {with(laser(), "pierce_diameter_mm", 0.05),
       "pierce_diameter_mm 0.05: has to be at least the kerf of 0.2 mm"},
      {with(with(laser(), "pierce_diameter_mm", 5), "lead_in_mm", 2),
       "lead_in_mm 2: a pierce of 5 mm and a kerf of 0.2 mm need a lead of at least 2.4 mm, or the pierce "
       "burns "
       "into the part"},
      {with(laser(), "heat_spread_mm", -1), "heat_spread_mm -1: has to be a number from 0 to 10000"},
      {with(laser(), "joints", 2), "joint_width_mm is missing: the material that a joint leaves, in mm"},
      {with(laser(), "joints", 21), "joints 21: has to be tipping, or a whole number from 1 to 20"},
      {with(laser(), "joints", 1.5), "joints 1.5: has to be tipping, or a whole number from 1 to 20"},
      {with(laser(), "joints", "2"), "joints \"2\": a number stands without quotation marks"},
      {with(laser(), "joints", "many"), "joints many: has to be tipping, or a whole number from 1 to 20"},
      {with(with(laser(), "joints", "tipping"), "joint_width_mm", 0.5),
       "slat_pitch_mm is missing: how far apart the slats of the table are, in mm"},
      {with(laser(), "slat_pitch_mm", 60), "slat_pitch_mm says nothing without joints tipping"},
      {with(laser(), "joint_width_mm", 0.5), "joint_width_mm says nothing without joints"},
      {with(laser(), "joints_up_to_mm", 100), "joints_up_to_mm says nothing without joints"},
      {with(laser(), "tab_height_mm", 1), "tab_height_mm has a meaning for routers alone: process router"},
      {with(with(router(), "joints", 2), "joint_width_mm", 3),
       "tab_height_mm is missing: how high the tabs of a router are, in mm"},
      {with(with(with(router(), "joints", 2), "joint_width_mm", 3), "tab_height_mm", 100),
       "tab_height_mm 100: has to be below the depth of 12.5 mm"},
      {with(laser(), "tool", 3), "tool has a meaning for routers alone: process router"},
      {with(router(), "tool", 2.5), "tool 2.5: has to be a whole number"},
      {with(router(), "tool", 0), "tool 0: has to be a number from 1 to 9999"},
      {with(with(with(router(), "engrave_feed_mm_per_min", 300), "engrave_depth_mm", 1), "engrave_tool", 3),
       "tool is missing: the number of the tool that cuts"},
      {with(with(with(with(with(router(), "post", "grbl"), "engrave_feed_mm_per_min", 300),
                      "engrave_depth_mm", 1),
                 "engrave_tool", 3),
            "tool", 2),
       "engrave_tool 3: GRBL changes no tool on the way; engrave with tool 2, or leave both out"},
      {with(laser(), "corner_feed_share", 0.5),
       "corner_distance_mm is missing: how near a corner the cut is slow, in mm"},
      {with(laser(), "corner_distance_mm", 2),
       "corner_feed_share is missing: the share of the feed near corners"},
      {with(with(laser(), "corner_distance_mm", 2), "corner_feed_share", 1.5),
       "corner_feed_share 1.5: has to be a number from 0.01 to 1"},
      {with(laser(), "common_line", "yes"), "common_line has to be true or false, not a text"},
      {with(with(laser(), "common_line", true), "heat_spread_mm", 5),
       "common_line and heat_spread_mm do not go together: leave one of them out"},
      {with(with(laser(), "common_line", true), "lead", "arc"),
       "common_line and lead arc do not go together: take lines for leads"},
      {with(drag_knife(), "common_line", true), "common_line has no meaning for the form hpgl"},
      {hole(3), "holes has to be a list of at most 100 rows"},
      {without(drag_knife(), "blade_offset_mm"),
       "blade_offset_mm is missing: how far a drag knife's tip is behind its axis, in mm"},
      {with(drag_knife(), "blade_offset_mm", 11), "blade_offset_mm 11: has to be a number from 0.05 to 10"},
      {with(drag_knife(), "turn_above_deg", 0.5), "turn_above_deg 0.5: has to be a number from 1 to 90"},
      {with(drag_knife(), "overcut_mm", -1), "overcut_mm -1: has to be a number from 0 to 100"},
      {with(drag_knife(), "knife_tolerance_mm", 0.01),
       "knife_tolerance_mm 0.01: has to be a number from 0.02 to 10"},
      {with(drag_knife(), "kerf_mm", 0.2), "kerf_mm has no meaning for the form hpgl"},
      {with(drag_knife(), "holes", Json::array()), "holes has no meaning for knives: leave it out"},
      {with(drag_knife(), "process", "tangential-knife"),
       "blade_offset_mm has a meaning for drag knives alone: process drag-knife"},
      {with(laser(), "overcut_mm", 1), "overcut_mm has no meaning for the form gcode"},
      {Json(7), "an object is needed, not a number"},
  };
  for (const Case& one : wrong)
    EXPECT_EQ(trouble(text_of({with(laser(), "thickness_mm", 99), one.entry})),
              "shop.json: entry 2: " + one.says);
  const std::vector<Case> rows{
      {{{"lead_in_mm", 1}}, "up_to_diameter_mm is missing"},
      {{{"up_to_diameter_mm", 0}}, "up_to_diameter_mm 0: has to be a number from 0.01 to 10000"},
      {{{"up_to_diameter_mm", 4}, {"lead_in_mm", "1"}}, "lead_in_mm has to be a number from 0 to 1000"},
      {{{"up_to_diameter_mm", 4}, {"feed_share", 1.01}},
       "feed_share 1.01: has to be a number from 0.01 to 1"},
      {{{"up_to_diameter_mm", 4}, {"feed", 100}},
       "there is no key 'feed' in a row; known are up_to_diameter_mm, lead_in_mm and feed_share"},
      {{{"up_to_diameter_mm", 3}}, "up_to_diameter_mm 3: has to be above that of the row before"},
      {Json::array(), "an object is needed, not a list"},
  };
  for (const Case& one : rows)
    EXPECT_EQ(trouble(text_of({hole(Json::array({{{"up_to_diameter_mm", 3}}, one.entry}))})),
              "shop.json: entry 1, row 2 of holes: " + one.says);
  EXPECT_EQ(trouble(text_of({with(hole(Json::array({{{"up_to_diameter_mm", 3}, {"feed_share", 0.5}}})),
                                  "feed_mm_per_min", 0.15)})),
            "shop.json: entry 1, row 1 of holes: feed_share 0.5 leaves less than 0.1 of 0.15 mm/min");
}

TEST(ProcessFile, FilesThatAreNoneAreRefused) {
  EXPECT_NE(trouble("{").find("shop.json"), std::string::npos);
  EXPECT_EQ(trouble("[]"), "shop.json: a file of processes is an object, not a list");
  const std::string none =
      "shop.json: this is no file of processes: \"format\" has to be \"lekalo-process/1\"";
  EXPECT_EQ(trouble("{}"), none);
  EXPECT_EQ(trouble(R"({"format": "lekalo-layout/1", "units": "mm"})"), none);
  EXPECT_EQ(trouble(R"({"format": 1})"), none);
  const std::string list = "shop.json: \"processes\" has to be a list of 1 to 10000 entries";
  EXPECT_EQ(trouble(R"({"format": "lekalo-process/1"})"), list);
  EXPECT_EQ(trouble(text_of({})), list);
  EXPECT_EQ(trouble(R"({"format": "lekalo-process/1", "processes": {}})"), list);
  Json units = Json::parse(text_of({laser()}));
  units["units"] = "mm";
  EXPECT_EQ(trouble(units.dump()), "shop.json: there is no key 'units' beside \"format\" and \"processes\"");
  EXPECT_NE(
      trouble(R"({"format": "lekalo-process/1", "processes": [{"kerf_mm": 1, "kerf_mm": 2}]})").find("twice"),
      std::string::npos);
}

TEST(ProcessFile, AllThatIsWrongIsToldAtOnce) {
  Json bad = without(laser(), "kerf_mm");
  bad["pierce_s"] = -1;
  bad["feeds"] = 2;
  bad["speeds"] = 2;
  const std::string said = trouble(text_of({laser(), bad, router(), laser()}));
  EXPECT_TRUE(
      said.starts_with("shop.json: entry 2: pierce_s -1: has to be a number from 0 to 100; entry 2: there "
                       "is no key 'feeds'; known are "))
      << said;
  for (const char* part : {"; entry 2: there is no key 'speeds'; entry 2: kerf_mm is missing: ",
                           "; entry 2: steel, 2 mm (laser) is entry 1 already",
                           "; entry 4: steel, 2 mm (laser) is entry 1 already"})
    EXPECT_NE(said.find(part), std::string::npos) << part << "\n" << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 0);
  std::vector<Json> many(23, without(laser(), "kerf_mm"));
  for (std::size_t k = 0; k < many.size(); ++k) many[k]["thickness_mm"] = k + 1;
  EXPECT_TRUE(trouble(text_of(many))
                  .ends_with("; entry 20: kerf_mm is missing: the width of the cut in mm; and 3 more"))
      << trouble(text_of(many));
}

}  // namespace
}  // namespace lekalo::io::io_process_file_test

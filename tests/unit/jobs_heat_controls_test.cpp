// Corrected programs of every control, in millimetres and in inches: they keep their dialect and their unit.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "lekalo/jobs/heat_result.hpp"
#include "lekalo/jobs/pocket.hpp"
#include "lekalo/nc/dialect.hpp"
#include "support/cases.hpp"
#include "support/corrected_heat.hpp"

namespace lekalo::jobs::jobs_heat_controls_test {
namespace {

const std::string kPocket =
    R"({"units":"mm","outer":[{"line":{"from":[0,0],"to":[18,0]}},{"line":{"from":[18,0],"to":[18,14]}},)"
    R"({"line":{"from":[18,14],"to":[0,14]}},{"line":{"from":[0,14],"to":[0,0]}}]})";

/// The upper wall is cut colder than the lower one, so that a scaling leaves much.
HeatJob job_of(const char* post, LengthUnit unit) {
  PocketJob pocketing;
  pocketing.pocket = {"pocket.json", kPocket};
  pocketing.options.path.tool_diameter = 6;
  pocketing.options.path.depth = 8, pocketing.options.path.step_down = 4;
  pocketing.options.program.post = *nc::post_named(post);
  pocketing.options.program.unit = unit;
  const Result<Pocketed> made = pocket(pocketing);
  if (!made) ADD_FAILURE() << made.error().message;
  HeatJob job = cases::heat_job(made ? made->program : "", kPocket, "38x34x16", 0.6, 4);
  job.source.machining.control = nc::post_named(post)->language;
  return job;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The digits behind the point of each length in a line.
std::vector<std::size_t> decimals_in(const std::string& line) {
  std::vector<std::size_t> found;
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (std::string("XYZIJ").find(line[at]) == std::string::npos) continue;
    const std::size_t end = std::min(line.find(' ', at), line.size()), point = line.find('.', at);
    found.push_back(point < end ? end - point - 1 : 0);
  }
  return found;
}

/// Corrects a program of a pocket of ours, and has the checker judge it as `lekalo heat` does.
void expect_corrected(const char* post, LengthUnit unit, std::size_t decimals) {
  const std::string what = fmt::format("{} {}", post, unit == LengthUnit::inch ? "inch" : "mm");
  HeatResultJob asked;
  asked.heat = job_of(post, unit);
  asked.correction = CorrectionWish{}, asked.corrected_as = "corrected.ngc";
  const auto made = heat_result(asked);
  ASSERT_TRUE(made) << what << ": " << made.error().message;
  cases::expect_better(made->found, *made->correction);
  // Fanuc and Haas read four decimals of an inch, and pockets of ours have five.
  const bool said = std::ranges::any_of(made->warnings, [](const std::string& warning) {
    return warning.find("increment system IS-B") != std::string::npos;
  });
  const bool drops = std::string(post) == "fanuc" || std::string(post) == "haas";
  EXPECT_EQ(said, drops && unit == LengthUnit::inch) << what;
  const std::vector<std::string> before = lines_of(asked.heat.source.program.bytes),
                                 after = lines_of(made->correction->program);
  // What comes before the first cut and after the last one is the program's own, and so is all that is not
  // moved.
  ASSERT_GT(after.size(), 20U) << what;
  const std::size_t first = static_cast<std::size_t>(
      std::ranges::find_if(before, [](const std::string& line) { return line.starts_with("G1 "); }) -
      before.begin());
  for (std::size_t i = 0; i <= first; ++i) EXPECT_EQ(after[i], before[i]) << what;
  for (std::size_t i = 1; i <= 2; ++i) EXPECT_EQ(after[after.size() - i], before[before.size() - i]) << what;
  EXPECT_NE(made->correction->program.find(unit == LengthUnit::inch ? "G20 G17" : "G21 G17"),
            std::string::npos)
      << what;
  for (const std::string& line : after) {
    if (line.starts_with("(") || std::ranges::find(before, line) != before.end()) continue;
    for (const std::size_t written : decimals_in(line)) EXPECT_EQ(written, decimals) << what << ": " << line;
  }
}

TEST(JobsHeatControls, DialectAndUnitStay) {
  struct Kind {
    const char* post;
    LengthUnit unit;
    std::size_t decimals;
  };
  constexpr Kind kKinds[] = {{"fanuc", LengthUnit::inch, 5},      {"grbl", LengthUnit::millimetre, 4},
                             {"linuxcnc", LengthUnit::inch, 5},   {"haas", LengthUnit::millimetre, 3},
                             {"grbl", LengthUnit::inch, 5},       {"haas", LengthUnit::inch, 5},
                             {"fanuc", LengthUnit::millimetre, 3}};
  for (std::size_t i = 0; i < std::min(std::size(kKinds), cases::case_count(2)); ++i)
    expect_corrected(kKinds[i].post, kKinds[i].unit, kKinds[i].decimals);
}

TEST(JobsHeatControls, WhatAControlReadsOtherwiseIsToldWithItsLine) {
  HeatJob job = job_of("haas", LengthUnit::millimetre);
  std::string& program = job.source.program.bytes;
  const std::size_t cut = program.rfind("G1 X");
  program.insert(cut, "G1 X9 Y7\n");
  const Result<HeatFound> found = heat(job);
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("part.ngc:"), std::string::npos) << found.error().message;
  EXPECT_NE(found.error().message.find("decimal point"), std::string::npos) << found.error().message;
}

TEST(JobsHeatControls, VoxelsThatAreTooLargeForTheMaterialAreNamed) {
  const auto says = [](double conductivity, double pitch) {
    HeatResultJob asked;
    asked.heat = job_of("linuxcnc", LengthUnit::millimetre);
    asked.heat.pitch = pitch;
    asked.heat.material.values[static_cast<std::size_t>(heat::Property::conductivity)] = {conductivity,
                                                                                          conductivity};
    const auto made = heat_result(asked);
    if (!made) return made.error().message;
    for (const std::string& warning : made->warnings)
      if (warning.find("ahead of the tool") != std::string::npos) return warning;
    return std::string();
  };
  const std::string slow = says(80, 4);
  EXPECT_NE(slow.find("and voxels of 4 mm are larger"), std::string::npos) << slow;
  EXPECT_EQ(says(450, 4), "") << "copper";
}

TEST(JobsHeatControls, TooFewVoxelsAcrossAThinFloorAreNamed) {
  const auto says = [](const char* stock, double pitch) {
    HeatResultJob asked;
    asked.heat = job_of("linuxcnc", LengthUnit::millimetre);
    asked.heat.source.stock.block = heat::read_stock(stock);
    asked.heat.pitch = pitch;
    const auto made = heat_result(asked);
    if (!made) return made.error().message;
    for (const std::string& warning : made->warnings)
      if (warning.find("across it") != std::string::npos) return warning;
    return std::string();
  };
  EXPECT_EQ(
      says("38x34x16", 4),
      "the floor under the deepest cut is 8 mm thick, 2 voxels of 4 mm: with fewer than 4 across it what it "
      "bends by, and the stress in it, may be a quarter off; --voxel 2 has them");
  EXPECT_EQ(says("38x34x16", 2), "");
  // The wall at X 0 of a stock that begins at X -0.5.
  const std::string wall = says("21.5x34x16@-0.5,-10", 3);
  EXPECT_TRUE(wall.starts_with("what stands behind a wall is 0.5 mm thick, 0.17 voxels of 3 mm")) << wall;
  EXPECT_TRUE(wall.ends_with("--voxel 0.12 has them") || wall.ends_with("more than 2000000 in this stock"))
      << wall;
}

}  // namespace
}  // namespace lekalo::jobs::jobs_heat_controls_test

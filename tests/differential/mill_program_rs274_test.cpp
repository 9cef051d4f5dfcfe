// LinuxCNC's own interpreter runs pocket programs: it accepts them, and the checker finds in its canonical
// motions what it finds in the program.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/mill/pocket.hpp"
#include "lekalo/mill/program.hpp"
#include "lekalo/mill/ramps.hpp"
#include "lekalo/verify/simulate.hpp"
#include "support/cases.hpp"
#include "support/judged_path.hpp"
#include "support/places.hpp"
#include "support/pockets.hpp"
#include "support/rs274.hpp"

namespace lekalo::mill::mill_program_rs274_test {
namespace {

const std::string kPocket =
    R"({"units":"mm","outer":[{"line":{"from":[0,0],"to":[34,0]}},{"line":{"from":[34,0],"to":[34,24]}},)"
    R"({"line":{"from":[34,24],"to":[0,24]}},{"line":{"from":[0,24],"to":[0,0]}}],)"
    R"("islands":[[{"arc":{"from":[24,12],"to":[24,12],"centre":[20,12],"ccw":true}}]]})";

/// The interpreter's motions as the plainest of programs, mm.
std::string program_of_calls(const std::vector<rs274::Call>& calls) {
  std::string text = "G21 G90 G17\n";
  double feed = 0, x = 0, y = 0;
  for (const rs274::Call& call : calls) {
    if (call.name == "SET_FEED_RATE" && !call.numbers.empty()) feed = call.numbers[0] * call.unit;
    if (call.straight()) {
      text +=
          fmt::format("{} X{:.9f} Y{:.9f} Z{:.9f}", call.name == "STRAIGHT_FEED" ? "G1" : "G0",
                      call.numbers[0] * call.unit, call.numbers[1] * call.unit, call.numbers[2] * call.unit);
      x = call.numbers[0] * call.unit, y = call.numbers[1] * call.unit;
    } else if (call.arc()) {
      const double cx = call.numbers[2] * call.unit, cy = call.numbers[3] * call.unit;
      text += fmt::format("{} X{:.9f} Y{:.9f} Z{:.9f} I{:.9f} J{:.9f}", call.numbers[4] > 0 ? "G3" : "G2",
                          call.numbers[0] * call.unit, call.numbers[1] * call.unit,
                          call.numbers[5] * call.unit, cx - x, cy - y);
      x = call.numbers[0] * call.unit, y = call.numbers[1] * call.unit;
    } else {
      continue;
    }
    text += fmt::format(" F{:.6f}\n", feed > 0 ? feed : 1);
  }
  return text + "M2\n";
}

TEST(MillProgramRs274, TheInterpreterCutsWhatTheProgramSays) {
  const rs274::Oracle oracle(cases::source_dir() + "/tests/support/rs274.sh");
  const auto regions = io::parse_regions(kPocket, "pocket.json");
  ASSERT_TRUE(regions);
  PocketOptions options;
  options.tool_diameter = 6, options.depth = 5, options.step_down = 3;
  const auto path = pocket_path(regions->regions, options);
  ASSERT_TRUE(path) << path.error().message;
  verify::SimulateOptions machining;
  machining.tool_diameter = 6;
  for (const LengthUnit unit : {LengthUnit::millimetre, LengthUnit::inch}) {
    ProgramOptions how;
    how.unit = unit, how.tool_number = 3, how.spindle = 12000, how.coolant = Coolant::flood;
    how.comments = {"a pocket (with brackets; and more)"};
    const std::string program = program_of(*path, how);
    const rs274::Run run = oracle.run(program);
    ASSERT_TRUE(run.accepted) << run.errors;
    std::size_t starts = 0, stops = 0, changes = 0, arcs = 0;
    for (const rs274::Call& call : run.calls) {
      starts += call.name == "START_SPINDLE_CLOCKWISE" ? 1 : 0;
      stops += call.name == "STOP_SPINDLE_TURNING" ? 1 : 0;
      changes += call.name == "CHANGE_TOOL" ? 1 : 0;
      arcs += call.arc() ? 1 : 0;
    }
    EXPECT_EQ(starts, 1U);
    EXPECT_GE(stops, 1U);
    EXPECT_EQ(changes, 1U);
    EXPECT_GT(arcs, 20U);
    const auto ours = verify::simulate({"ours.ngc", program}, {"pocket.json", kPocket}, machining);
    const auto theirs =
        verify::simulate({"canon.ngc", program_of_calls(run.calls)}, {"pocket.json", kPocket}, machining);
    ASSERT_TRUE(ours) << ours.error().message;
    ASSERT_TRUE(theirs) << theirs.error().message;
    // It prints four decimals of the program's unit.
    const double grain = unit == LengthUnit::inch ? 2.6e-3 : 1.1e-4;
    EXPECT_NEAR(ours->length_mm, theirs->length_mm, 1e-3 * ours->length_mm);
    EXPECT_NEAR(ours->gouge_mm, theirs->gouge_mm, grain);
    EXPECT_NEAR(ours->coverage_percent, theirs->coverage_percent, 100 * grain);
    EXPECT_NEAR(ours->uncut_width_mm, theirs->uncut_width_mm, 2 * grain + 1e-3);
    EXPECT_NEAR(ours->engagement_p95_deg, theirs->engagement_p95_deg, 1);
    EXPECT_NEAR(ours->engagement_max_deg, theirs->engagement_max_deg, 4);
    EXPECT_NEAR(ours->air_percent, theirs->air_percent, 1);
    EXPECT_NEAR(ours->seconds, theirs->seconds, 0.01 * ours->seconds);
    EXPECT_EQ(ours->retracts, theirs->retracts);
  }
}

TEST(MillProgramRs274, TheRestOfALargerToolIsCutAsTheProgramSays) {
  const rs274::Oracle oracle(cases::source_dir() + "/tests/support/rs274.sh");
  const auto regions = io::parse_regions(kPocket, "pocket.json");
  ASSERT_TRUE(regions);
  PocketOptions options;
  options.tool_diameter = 9, options.depth = 5, options.step_down = 3, options.stock_to_leave = 0.2;
  const auto first = pocket_path(regions->regions, options);
  ASSERT_TRUE(first) << first.error().message;
  options.tool_diameter = 5, options.stock_to_leave = 0;
  const auto rest = pocket_path(regions->regions, options, cuts_of(*first, 9));
  ASSERT_TRUE(rest) << rest.error().message;
  const std::string program = program_of(*rest, {}), earlier = program_of(*first, {});
  const rs274::Run run = oracle.run(program);
  ASSERT_TRUE(run.accepted) << run.errors;
  verify::SimulateOptions machining;
  machining.tool_diameter = 5;
  const auto judged = [&](const std::string& text) {
    return verify::simulate({"rest.ngc", text}, {"pocket.json", kPocket}, machining,
                            {{{"first.ngc", earlier}, 9}});
  };
  const auto ours = judged(program), theirs = judged(program_of_calls(run.calls));
  ASSERT_TRUE(ours) << ours.error().message;
  ASSERT_TRUE(theirs) << theirs.error().message;
  EXPECT_GE(ours->coverage_percent, 99.99);
  EXPECT_EQ(ours->entry_mm, 0);
  EXPECT_EQ(theirs->entry_mm, 0);
  EXPECT_NEAR(ours->length_mm, theirs->length_mm, 1e-3 * ours->length_mm);
  EXPECT_NEAR(ours->gouge_mm, theirs->gouge_mm, 2e-4);
  EXPECT_NEAR(ours->coverage_percent, theirs->coverage_percent, 0.01);
  EXPECT_NEAR(ours->engagement_max_deg, theirs->engagement_max_deg, 4);
  // The interpreter comes from the origin.
  EXPECT_NEAR(ours->seconds, theirs->seconds, 0.01 * ours->seconds + 0.5);
  EXPECT_EQ(ours->retracts, theirs->retracts);
}

TEST(MillProgramRs274, RampsAreEntriesForTheInterpreterToo) {
  const rs274::Oracle oracle(cases::source_dir() + "/tests/support/rs274.sh");
  // Two rooms, and between them a bent way as wide as the tool and 0.1 mm.
  const std::string pocket = pockets::document(
      pockets::line({0, 0}, {14, 0}) + "," + pockets::line({14, 0}, {14, 4}) + "," +
      pockets::bulge({14, 4}, {30, 4}, -2) + "," + pockets::line({30, 4}, {30, 0}) + "," +
      pockets::line({30, 0}, {44, 0}) + "," + pockets::line({44, 0}, {44, 16}) + "," +
      pockets::line({44, 16}, {30, 16}) + "," + pockets::line({30, 16}, {30, 10.2}) + "," +
      pockets::bulge({30, 10.2}, {14, 10.2}, 2) + "," + pockets::line({14, 10.2}, {14, 16}) + "," +
      pockets::line({14, 16}, {0, 16}) + "," + pockets::line({0, 16}, {0, 0}));
  const auto regions = io::parse_regions(pocket, "pocket.json");
  ASSERT_TRUE(regions) << regions.error().message;
  PocketOptions options;
  options.depth = 4, options.step_down = 2;
  const auto path = pocket_path(regions->regions, options);
  ASSERT_TRUE(path) << path.error().message;
  const JudgedPath planned = judged(*path, pocket);
  EXPECT_GT(planned.report.engagement_max_deg, 150);
  const RampedPath ramped = with_ramps(*path, loads_of(planned), options);
  EXPECT_GE(ramped.ramps.size(), 2U);
  const JudgedPath ours = judged(ramped.path, pocket);
  const rs274::Run run = oracle.run(program_of(ramped.path, {}));
  ASSERT_TRUE(run.accepted) << run.errors;
  verify::SimulateOptions machining;
  machining.tool_diameter = 6;
  const auto theirs =
      verify::simulate({"canon.ngc", program_of_calls(run.calls)}, {"pocket.json", pocket}, machining);
  ASSERT_TRUE(theirs) << theirs.error().message;
  for (const verify::SimulateReport* report : {&ours.report, &*theirs}) {
    EXPECT_LE(report->engagement_max_deg, 101);
    EXPECT_LE(report->entry_layer_mm, 0.75);
    EXPECT_GE(report->coverage_percent, 99.99);
    EXPECT_LE(report->gouge_mm, 0.002);
    EXPECT_EQ(report->rapid_cut_mm, 0);
    EXPECT_EQ(report->retracts, planned.report.retracts);
  }
  EXPECT_NEAR(ours.report.entry_mm, theirs->entry_mm, 0.02 * ours.report.entry_mm);
  EXPECT_NEAR(ours.report.entry_layer_mm, theirs->entry_layer_mm, 0.01);
}

}  // namespace
}  // namespace lekalo::mill::mill_program_rs274_test

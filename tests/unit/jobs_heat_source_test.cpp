#include "lekalo/jobs/heat_source.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lekalo/jobs/pocket.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::jobs::jobs_heat_source_test {
namespace {

std::string rectangle(double width, double height, const char* last_edge = "") {
  return fmt::format(
      R"({{"units":"mm","outer":[{{"line":{{"from":[0,0],"to":[{0},0]}}}},{{"line":{{"from":[{0},0],"to":[{0},{1}]}}}},)"
      R"({{"line":{{"from":[{0},{1}],"to":[0,{1}]}}}},{{"line":{{"from":[0,{1}],"to":[0,0]}}{2}}}]}})",
      width, height, last_edge);
}

const std::string kSlot = "G21 G90 G17\nG0 X10 Y10 Z5\nG1 Z-1 F300\nG1 X30 F1200\nG0 Z5\n";

HeatSourceJob job_of(std::string program, const char* stock = "120x100x20") {
  HeatSourceJob job;
  job.program = {"part.ngc", std::move(program)};
  job.pocket = {"pocket.json", rectangle(40, 30)};
  job.machining.tool_diameter = 6;
  job.cutting.teeth = 3, job.cutting.spindle_rpm = 8000;
  job.cutting.cutting_force = {700, 700}, job.cutting.force_exponent = {0.25, 0.25};
  job.cutting.share = {0.05, 0.2};
  job.stock.block = heat::read_stock(stock);
  return job;
}

HeatSource run(const HeatSourceJob& job) {
  Result<HeatSource> made = heat_source(job);
  if (!made) {
    ADD_FAILURE() << made.error().message;
    return {};
  }
  return std::move(*made);
}

std::string complaint_of(const HeatSourceJob& job) {
  const Result<HeatSource> made = heat_source(job);
  if (made) return "";
  EXPECT_EQ(made.error().code, ErrorCode::bad_input);
  return made.error().message;
}

TEST(JobsHeatSource, TheEnergyOfASlotIsForceTimesVolume) {
  HeatSourceJob job = job_of(kSlot);
  job.machining.acceleration = 1e9;  // the whole slot at its feed
  const HeatSource source = run(job);
  double work = 0, volume = 0;
  for (const heat::CutStep& step : source.work.steps) {
    if (step.line != 4) continue;
    work += step.work_j.middle(), volume += step.volume_mm3;
    // 20 mm/s, 400 teeth a second.
    EXPECT_NEAR(step.chip_mm, 0.05 * 2 / 3.141592653589793, 1e-6);
    EXPECT_NEAR(step.seconds, 0.75 / 20, 0.01);
  }
  EXPECT_NEAR(volume, 6 * 20, 1e-5);
  EXPECT_NEAR(work, 700 * std::pow(0.05 * 2 / 3.141592653589793, -0.25) * 120e-3, 1e-5);
  EXPECT_EQ(source.stock.box.low_x, -40);
  EXPECT_EQ(source.stock.box.high_y, 65);
}

TEST(JobsHeatSource, APocketOfOursTakesOffTheVolumeThatTheCheckerFinds) {
  PocketJob pocketing;
  pocketing.pocket = {"pocket.json", rectangle(40, 30)};
  pocketing.options.path.tool_diameter = 6;
  pocketing.options.path.depth = 4, pocketing.options.path.step_down = 2;
  const Result<Pocketed> made = pocket(pocketing);
  ASSERT_TRUE(made) << made.error().message;
  const HeatSource source = run(job_of(made->program));
  const double volume = 4 * (made->report.reachable_mm2 - made->report.uncut_mm2);
  // Pieces of 0.75 mm, and the staircases of two ramps.
  EXPECT_NEAR(source.work.volume_mm3, volume, 0.003 * volume);
  EXPECT_NEAR(source.work.seconds, made->report.seconds, 1e-6);
  EXPECT_GT(source.work.greatest_power_w.least, 20);
  EXPECT_LT(source.work.greatest_power_w.greatest, 1000);
}

/// A program in the manner of FreeCAD's: levels, helices, rapids down to a clearance, a dwell.
std::string foreign(double sign) {
  std::string program =
      "(Exported by FreeCAD)\nG17 G54 G40 G49 G80 G90\nG21\nM6 T1\nM3 S8000\nG4 P1\nG0 Z5\n";
  const auto x = [&](double at) { return sign * at; };
  const char* arc = sign > 0 ? "G3" : "G2";
  for (const double z : {-2.0, -4.0}) {
    program += fmt::format("G0 X{} Y0\nG0 Z{}\n", x(4), z + 2.5);
    program += fmt::format("G1 Z{} F200\n", z + 2);
    for (int k = 1; k <= 4; ++k)
      program += fmt::format("{} X{} Y0 Z{} I{} J0 F400\n", arc, x(4), z + 2 - 0.5 * k, x(-4));
    for (const double at : {4.0, 7.0, 10.0})
      program += fmt::format("G1 X{} Y0 F1000\n{} X{} Y0 I{} J0\n", x(at), arc, x(at), x(-at));
    program += "G0 Z5\n";
  }
  return program + "M5\nM2\n";
}

HeatSourceJob round_job(double sign) {
  HeatSourceJob job = job_of(foreign(sign));
  job.pocket.bytes =
      R"({"units":"mm","outer":[{"arc":{"from":[13,0],"to":[-13,0],"centre":[0,0],"ccw":true}},)"
      R"({"arc":{"from":[-13,0],"to":[13,0],"centre":[0,0],"ccw":true}}]})";
  return job;
}

TEST(JobsHeatSource, AProgramOfFreeCadIsFollowedThroughHelicesAndLevels) {
  const HeatSource source = run(round_job(1));
  const double volume = 3.141592653589793 * 169 * 4;
  EXPECT_NEAR(source.work.volume_mm3, volume, 0.002 * volume);
  EXPECT_NEAR(source.pieces.front().seconds, 1, 1e-9);  // the dwell
}

TEST(JobsHeatSource, AMirroredProgramNeedsTheSameWork) {
  const HeatSource source = run(round_job(1)), mirrored = run(round_job(-1));
  EXPECT_NEAR(source.work.volume_mm3, mirrored.work.volume_mm3, 1e-6 * source.work.volume_mm3);
  EXPECT_NEAR(source.work.work_j.middle(), mirrored.work.work_j.middle(), 1e-6 * source.work.work_j.middle());
}

TEST(JobsHeatSource, AReversedSlotNeedsTheSameWork) {
  const HeatSource there = run(job_of(kSlot)),
                   back = run(job_of("G21 G90 G17\nG0 X30 Y10 Z5\nG1 Z-1 F300\nG1 X10 F1200\nG0 Z5\n"));
  EXPECT_NEAR(there.work.work_j.middle(), back.work.work_j.middle(), 1e-9 * there.work.work_j.middle());
}

TEST(JobsHeatSource, AStockThatIsCutThroughEndsAtItsLowerFace) {
  const std::string through = "G21 G90 G17\nG0 X10 Y10 Z5\nG1 Z-3 F300\nG1 X30 F1200\nG0 Z5\n";
  const HeatSource source = run(job_of(through, "120x100x2"));
  EXPECT_NEAR(source.work.volume_mm3, 2 * (120 + 9 * 3.141592653589793), 1e-3);
}

TEST(JobsHeatSource, BeyondAnOpenEdgeTheStockEnds) {
  HeatSourceJob job = job_of("G21 G90\nG0 X-8 Y15 Z5\nG1 Z-1 F300\nG1 X20 F1200\n", "60x60x20@0,-15");
  job.pocket.bytes = rectangle(40, 30, R"(,"open":true)");
  EXPECT_NEAR(run(job).work.volume_mm3, 20 * 6 + 4.5 * 3.141592653589793, 0.3);
}

TEST(JobsHeatSource, AProgramOutsideOfItsStockIsRefused) {
  EXPECT_EQ(
      complaint_of(job_of(kSlot, "50x50x20@100,0")),
      "part.ngc: the program lies outside of the stock, which goes from X 100 Y 0 to X 150 Y 50; say where "
      "its lower left corner is, as in 120x100x20@-10,5");
  EXPECT_EQ(complaint_of(job_of(kSlot, "60x60x20@0,9")).substr(0, 60),
            "part.ngc:4: the tool cuts 2.000 mm beyond the stock's border");
}

TEST(JobsHeatSource, AStockMayBeAnOutline) {
  HeatSourceJob job = job_of(kSlot);
  job.stock.block.reset();
  EXPECT_EQ(complaint_of(job).substr(0, 19), "no stock is stated;");
  job.stock.outline = File{"blank.json", rectangle(60, 50)};
  EXPECT_EQ(complaint_of(job), "blank.json: the stock is 0 mm thick; state a thickness above 0");
  job.stock.thickness = 20;
  const HeatSource source = run(job);
  EXPECT_EQ(source.stock.read->outline.regions.size(), 1U);
  EXPECT_NEAR(source.stock.box.high_x, 60, 1e-9);
  EXPECT_NEAR(source.work.volume_mm3, run(job_of(kSlot)).work.volume_mm3, 1e-9);
  job.stock.outline = File{"blank.json", rectangle(60, 12)};
  EXPECT_EQ(complaint_of(job).substr(0, 60), "part.ngc:4: the tool cuts 1.000 mm beyond the stock's border");
}

TEST(JobsHeatSource, WithoutTeethThereAreNoChips) {
  HeatSourceJob job = job_of(kSlot);
  job.cutting.teeth = 0;
  EXPECT_EQ(complaint_of(job),
            "the tool has 0 teeth; state how many there are, since chips have no thickness without");
}

}  // namespace
}  // namespace lekalo::jobs::jobs_heat_source_test

// Corrected programs: what they leave when they are followed again, and what is said where there is none.

#include "lekalo/jobs/heat_correction.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lekalo/jobs/pocket.hpp"
#include "support/heat_programs.hpp"

namespace lekalo::jobs::jobs_heat_correction_test {
namespace {

using cases::heated_program;
using cases::kHeatedPocket;
using heat::Property;

/// A round pocket with a round island.
const std::string kRing =
    R"({"units":"mm","outer":[{"arc":{"from":[20,0],"to":[20,0],"centre":[0,0],"ccw":true}}],)"
    R"("islands":[[{"arc":{"from":[10,0],"to":[-10,0],"centre":[0,0],"ccw":true}},)"
    R"({"arc":{"from":[-10,0],"to":[10,0],"centre":[0,0],"ccw":true}}]]})";

/// In the manner of FreeCAD: helices down, circles outwards and inwards, and one about each wall.
std::string ring_program() {
  std::string program = "(Exported by FreeCAD)\nG17 G54 G40 G49 G80 G90\nG21\nM6 T1\nM3 S8000\nG0 Z5\n";
  for (const double z : {-2.0, -4.0}) {
    program += "G0 X15 Y0\nG0 Z0.5\n" + fmt::format("G1 Z{:g} F200\n", z + 2);
    for (int k = 1; k <= 4; ++k) program += fmt::format("G3 X15 Y0 Z{:g} I-15 J0 F400\n", z + 2 - 0.5 * k);
    for (const double at : {15.0, 16.7, 13.3, 17.0, 13.0})
      program += fmt::format("G1 X{0:g} Y0 F1000\nG3 X{0:g} Y0 I-{0:g} J0\n", at);
    program += "G0 Z5\n";
  }
  return program + "M5\nM2\n";
}

/// Coarse voxels do where the figures do not matter.
HeatJob job_of(std::string program, const std::string& pocket, double share, double pitch = 4) {
  HeatJob job;
  job.source.program = {"part.ngc", std::move(program)};
  job.source.pocket = {"pocket.json", pocket};
  job.source.machining.tool_diameter = 6;
  job.source.cutting.teeth = 3, job.source.cutting.spindle_rpm = 8000;
  job.source.stock.block = heat::read_stock("60x50x12");
  heat::MaterialWords words{"6061-T6", {}};
  const auto state = [&](Property p, heat::Interval value) {
    words.stated[static_cast<std::size_t>(p)] = value;
  };
  state(Property::share, {share, share});
  state(Property::cutting_force, {700, 700});
  state(Property::force_exponent, {0.25, 0.25});
  job.material = *heat::material_of(words);
  job.film = {20, 20};
  job.pitch = pitch;
  return job;
}

struct Made {
  HeatFound found;
  HeatCorrection correction;
};
Made made_of(const HeatJob& job, const CorrectionWish& wish = {}) {
  Result<HeatFound> found = heat(job);
  if (!found) {
    ADD_FAILURE() << found.error().message;
    return {};
  }
  Result<HeatCorrection> correction = heat_correction(job, *found, wish);
  if (!correction) {
    ADD_FAILURE() << correction.error().message;
    return {};
  }
  return {std::move(*found), std::move(*correction)};
}

std::string complaint_of(const HeatJob& job, const CorrectionWish& wish = {}) {
  const Result<HeatFound> found = heat(job);
  if (!found) return found.error().message;
  const Result<HeatCorrection> correction = heat_correction(job, *found, wish);
  return correction ? std::string() : correction.error().message;
}

/// What every corrected program holds.
void expect_better(const Made& made) {
  const HeatCorrection& c = made.correction;
  EXPECT_EQ(c.why_not, "");
  EXPECT_FALSE(c.program.empty());
  EXPECT_LE(c.after.largest(), kMostLeft * made.found.errors.largest());
  EXPECT_LT(c.after.largest(), made.found.scaling.left.largest());
  EXPECT_LE(c.after_over.most.greatest, kMostOvercut);
  EXPECT_LE(c.after_over.largest.greatest, made.found.largest_um.greatest);
  EXPECT_GE(c.rounds, 1);
  EXPECT_LE(c.rounds, 3);
}

TEST(JobsHeatCorrection, TheFinishingPassesOfARectangleAreMoved) {
  const Made made = made_of(job_of(heated_program(0.3, "24"), kHeatedPocket, 0.3, 3));
  EXPECT_GT(made.found.errors.largest(), 2);
  expect_better(made);
}

// Places stand where the tool turns a corner: both walls count there, and neither's displacement alone.
TEST(JobsHeatCorrection, CornersAreLeftNoWorseThanTheRest) {
  const Made made = made_of(job_of(heated_program(0.3, "4"), kHeatedPocket, 0.3, 2));
  EXPECT_GT(made.found.errors.largest(), 5);
  EXPECT_LT(made.correction.after.largest(), 0.5);
}

TEST(JobsHeatCorrection, WallsAndIslandsAreMovedToOppositeSides) {
  const Made made = made_of(job_of(ring_program(), kRing, 0.3, 3));
  double walls = 0, islands = 0;
  for (const WallPoint& w : made.found.walls) {
    double& side = w.x * w.outward[0] + w.y * w.outward[1] > 0 ? walls : islands;
    side = std::abs(w.error_um) > std::abs(side) ? w.error_um : side;
  }
  EXPECT_LT(walls, 0);
  EXPECT_GT(islands, 0);
  expect_better(made);
}

// Their way along the walls ends where it began, and takes next to nothing there.
TEST(JobsHeatCorrection, ThePassesOfAPocketOfOursAreMoved) {
  PocketJob pocketing;
  pocketing.pocket = {"pocket.json", kHeatedPocket};
  pocketing.options.path.tool_diameter = 6;
  pocketing.options.path.depth = 4, pocketing.options.path.step_down = 2;
  const Result<Pocketed> made = pocket(pocketing);
  ASSERT_TRUE(made) << made.error().message;
  expect_better(made_of(job_of(made->program, kHeatedPocket, 0.3, 3)));
}

TEST(JobsHeatCorrection, WithoutHeatTheProgramIsItsOwn) {
  const HeatJob job = job_of(heated_program(0.3, "4"), kHeatedPocket, 0);
  const Made made = made_of(job);
  EXPECT_EQ(made.correction.program, job.source.program.bytes);
  EXPECT_EQ(made.correction.after.largest(), 0);
}

TEST(JobsHeatCorrection, WhereTheIntervalsDoNotSupportItThereIsNoProgram) {
  HeatJob job = job_of(heated_program(0.3, "24"), kHeatedPocket, 0.3);
  job.material.values[static_cast<std::size_t>(Property::share)] = {0.05, 0.55};
  const Made made = made_of(job);
  EXPECT_EQ(made.correction.program, "");
  EXPECT_NE(made.correction.why_not.find("no corrected program is written"), std::string::npos)
      << made.correction.why_not;
}

TEST(JobsHeatCorrection, WhatCannotBeMovedIsToldInOneSentence) {
  const HeatJob coarse = job_of(heated_program(2, "4"), kHeatedPocket, 0.3);
  EXPECT_NE(
      complaint_of(coarse).find("part.ngc: no finishing pass to move: its passes along the walls take "),
      std::string::npos)
      << complaint_of(coarse);
  EXPECT_EQ(complaint_of(coarse, {2.5}), "");
  const HeatJob thin = job_of(heated_program(0.002, "4"), kHeatedPocket, 0.3);
  EXPECT_NE(complaint_of(thin, {0.01}).find("leave more stock for it"), std::string::npos)
      << complaint_of(thin, {0.01});
  HeatJob steps = job_of(heated_program(0.3, "4"), kHeatedPocket, 0.3);
  steps.source.program.bytes.insert(steps.source.program.bytes.find("G1 X37 Y3"), "G91 G1 X0 Y0\nG90\n");
  EXPECT_NE(complaint_of(steps).find("a motion under G91 belongs to the path"), std::string::npos)
      << complaint_of(steps);
}

TEST(JobsHeatCorrection, ThreadsChangeNoByte) {
  HeatJob job = job_of(heated_program(0.3, "4"), kHeatedPocket, 0.3);
  const Made two = made_of(job);
  job.threads = 1;
  EXPECT_EQ(made_of(job).correction.program, two.correction.program);
}

}  // namespace
}  // namespace lekalo::jobs::jobs_heat_correction_test

// Corrected programs: what they leave when they are followed again, and what is said where there is none.

#include "lekalo/jobs/heat_correction.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "lekalo/jobs/heat_result.hpp"
#include "support/corrected_heat.hpp"
#include "support/prepared.hpp"

namespace lekalo::jobs::jobs_heat_correction_test {
namespace {

using heat::Property;

const std::string kPocket =
    R"({"units":"mm","outer":[{"line":{"from":[0,0],"to":[24,0]}},{"line":{"from":[24,0],"to":[24,18]}},)"
    R"({"line":{"from":[24,18],"to":[0,18]}},{"line":{"from":[0,18],"to":[0,0]}}]})";

/// Clears the pocket but for `stock`, and takes that off the walls in one pass, level by level.
std::string rectangle_program(double stock, const std::string& levels) {
  std::string program = "G21 G90 G17 G54 G94\nM3 S8000\n";
  for (const char level : levels) {
    const double a = 3 + stock;
    program += "G0 X6 Y6 Z5\nG1 Z-" + std::string(1, level) + " F200\n";
    for (const double y : {6, 10})
      program += fmt::format("G1 X{:g} Y{:g} F900\nG1 X{:g}\nG1 Y{:g}\n", a, y, 24 - a, y + 2);
    program +=
        fmt::format("G1 X{0:g} Y{0:g}\nG1 X{1:g}\nG1 Y{2:g}\nG1 X{0:g}\nG1 Y{0:g}\n", a, 24 - a, 18 - a);
    program +=
        "G1 X8 Y10\nG1 X12 Y4\nG3 X13 Y3 I1 J0\nG1 X21 Y3\nG1 Y15\nG1 X3\nG1 Y3\nG1 X13\nG3 X14 Y4 I0 "
        "J1\nG0 Z5\n";
  }
  return program + "M5\nM2\n";
}

/// Coarse voxels do where the figures do not matter. Little material about a little pocket takes a large
/// share to be as warm as the rest.
HeatJob small_job(double stock, double share) {
  return cases::heat_job(rectangle_program(stock, "48"), kPocket, "44x38x16", share, 4);
}

std::string complaint_of(const HeatJob& job, const CorrectionWish& wish = {}) {
  const Result<HeatFound> found = heat(job);
  if (!found) return found.error().message;
  const Result<HeatCorrection> correction = heat_correction(job, *found, wish);
  return correction ? std::string() : correction.error().message;
}

HeatResultJob usual_job() {
  HeatResultJob job;
  job.heat = small_job(0.3, 0.45);
  job.correction = CorrectionWish{}, job.corrected_as = "corrected.ngc";
  return job;
}

/// A result with its corrected program, which more than one test looks at.
const cases::Prepared<Result<HeatResult>> usual([] { return heat_result(usual_job()); });

TEST(JobsHeatCorrection, AtNoCornerOfTheIntervalsIsTooMuchCutAway) {
  HeatJob job = small_job(0.3, 0.45);
  job.material.values[static_cast<std::size_t>(Property::share)] = {0.43, 0.47};
  job.film = {15, 25};
  const auto [found, made] = cases::corrected_heat(job);
  EXPECT_EQ(found.cases.size(), 3U) << "films";
  EXPECT_GT(found.largest_um.greatest, found.largest_um.least + 0.1);
  EXPECT_GT(made.after_over.most.greatest, made.after.most);
  cases::expect_better(found, made);
}

// Places stand where the tool turns a corner: both walls count there, and neither's displacement alone.
TEST(JobsHeatCorrection, CornersAreLeftNoWorseThanTheRest) {
  const HeatJob job = cases::heat_job(rectangle_program(0.3, "4"), kPocket, "44x38x12", 0.5, 2);
  const auto [found, made] = cases::corrected_heat(job);
  EXPECT_GT(found.errors.largest(), 3);
  EXPECT_LT(made.after.largest(), 0.7);
}

TEST(JobsHeatCorrection, WithoutHeatTheProgramIsItsOwn) {
  const HeatJob job = small_job(0.3, 0);
  const auto [found, made] = cases::corrected_heat(job);
  EXPECT_EQ(made.program, job.source.program.bytes);
  EXPECT_EQ(made.after.largest(), 0);
}

TEST(JobsHeatCorrection, WhereTheIntervalsDoNotSupportItThereIsNoProgram) {
  HeatJob job = small_job(0.3, 0.3);
  job.material.values[static_cast<std::size_t>(Property::share)] = {0.05, 0.55};
  const auto [found, made] = cases::corrected_heat(job);
  EXPECT_EQ(made.program, "");
  EXPECT_NE(made.why_not.find("no corrected program is written"), std::string::npos) << made.why_not;
}

TEST(JobsHeatCorrection, WhatCannotBeMovedIsToldInOneSentence) {
  const HeatJob coarse = small_job(2, 0.45);
  EXPECT_NE(
      complaint_of(coarse).find("part.ngc: no finishing pass to move: its passes along the walls take "),
      std::string::npos)
      << complaint_of(coarse);
  const HeatJob thin = small_job(0.002, 0.45);
  EXPECT_NE(complaint_of(thin, {0.01}).find("leave more stock for it"), std::string::npos)
      << complaint_of(thin, {0.01});
  HeatJob steps = small_job(0.3, 0.45);
  steps.source.program.bytes.insert(steps.source.program.bytes.find("G1 X21 Y3"), "G91 G1 X0 Y0\nG90\n");
  EXPECT_NE(complaint_of(steps).find("a motion under G91 belongs to the path"), std::string::npos)
      << complaint_of(steps);
}

/// Its path is off the pocket on purpose. Whoever takes the errors of heat alone for those of the walls would
/// correct it once more.
TEST(JobsHeatCorrection, ACorrectedProgramIsToldFromOneThatFollowsTheWalls) {
  ASSERT_TRUE(*usual) << usual->error().message;
  const auto told = [](const HeatResult& made) {
    for (const std::string& warning : made.warnings)
      if (warning.find("in a cold workpiece") != std::string::npos) return warning;
    return std::string();
  };
  EXPECT_EQ(told(**usual), "");
  HeatResultJob again;
  again.heat = usual_job().heat;
  again.heat.source.program.bytes = (*usual)->correction->program;
  const auto made = heat_result(again);
  ASSERT_TRUE(made) << made.error().message;
  const std::string said = told(*made), words = "from the walls as they are drawn they are ";
  ASSERT_NE(said.find(words), std::string::npos) << said;
  double least = 0, most = 0;
  ASSERT_EQ(std::sscanf(said.c_str() + said.find(words) + words.size(), "%lf to %lf um", &least, &most), 2)
      << said;
  EXPECT_LT(std::max(std::abs(least), std::abs(most)), 0.3 * made->found.errors.largest()) << said;
}

TEST(JobsHeatCorrection, ThreadsChangeNoByte) {
  ASSERT_TRUE(*usual) << usual->error().message;
  HeatJob job = usual_job().heat;
  job.threads = 1;
  EXPECT_EQ(cases::corrected_heat(job).correction.program, (*usual)->correction->program);
}

}  // namespace
}  // namespace lekalo::jobs::jobs_heat_correction_test

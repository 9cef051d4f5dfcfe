// Programs that FreeCAD made (data/freecad/make.py): heat moves their walls, and a corrected program of each
// brings them back. Their finishing pass goes straight down onto the wall, and begins and ends there.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lekalo/disk/files.hpp"
#include "support/corrected_heat.hpp"
#include "support/places.hpp"

namespace lekalo::jobs::jobs_heat_freecad_test {
namespace {

std::string bytes_of(const std::string& name) {
  return *disk::read_file(cases::source_dir() + "/tests/corpus/data/freecad/" + name);
}

HeatJob job_of(const std::string& program, const std::string& pocket) {
  return cases::heat_job(bytes_of(program), bytes_of(pocket), "60x50x12", 0.3, 4);
}

/// The lines of a program before its finishing pass, which stay as they are.
std::string before_finishing(const std::string& program) {
  return program.substr(0, program.find("(begin operation: Finish)"));
}

TEST(JobsHeatFreecad, TheFinishingPassOfARectangleIsMoved) {
  const HeatJob job = job_of("rectangle.ngc", "rectangle.json");
  const auto [found, made] = cases::corrected_heat(job);
  EXPECT_LT(found.errors.least, -10);
  cases::expect_better(found, made);
  EXPECT_LT(made.after.largest(), 0.5);
  EXPECT_EQ(before_finishing(made.program), before_finishing(job.source.program.bytes));
}

TEST(JobsHeatFreecad, WallsAndIslandsAreMovedToOppositeSides) {
  const HeatJob job = job_of("ring.ngc", "ring.json");
  const auto [found, made] = cases::corrected_heat(job);
  const cases::OppositeWalls walls = cases::opposite_walls(found);
  EXPECT_LT(walls.outer, -5);
  EXPECT_GT(walls.island, 3);
  cases::expect_better(found, made);
  EXPECT_LT(made.after.largest(), 0.5);
}

TEST(JobsHeatFreecad, AProgramInInchesStaysInInches) {
  // In a vice the workpiece grows along Y alone, which no scaling mends.
  HeatJob job = job_of("rectangle_inch.ngc", "rectangle.json");
  job.holding.held[heat::of(heat::Side::x_low)] = job.holding.held[heat::of(heat::Side::x_high)] = true;
  const auto [found, made] = cases::corrected_heat(job);
  EXPECT_GT(found.scaling.left.largest(), 1);
  cases::expect_better(found, made);
  EXPECT_NE(made.program.find("\nG20\n"), std::string::npos);
  EXPECT_EQ(made.program.find("G21"), std::string::npos);
  EXPECT_EQ(before_finishing(made.program), before_finishing(job.source.program.bytes));
}

// A Fanuc control reads four decimals of an inch, 2.54 um, and a line may be off by 0.71 of that.
TEST(JobsHeatFreecad, DecimalsThatAreTooCoarseAreNamed) {
  HeatJob job = job_of("rectangle_inch.ngc", "rectangle.json");
  job.source.machining.control = words::Control::fanuc;
  const auto [found, made] = cases::corrected_heat(job);
  EXPECT_EQ(made.program, "");
  EXPECT_NE(made.why_not.find("of which 1.80 um may be the decimals of the program"), std::string::npos)
      << made.why_not;
}

}  // namespace
}  // namespace lekalo::jobs::jobs_heat_freecad_test

#include "lekalo/verify/simulate.hpp"

#include <gtest/gtest.h>

#include <string>

#include "lekalo/disk/files.hpp"
#include "support/places.hpp"

// Programs that were judged as if a word of theirs were not there, beside sound ones of the same pocket.

namespace lekalo::verify::verify_simulate_test {
namespace {

Result<SimulateReport> judged(const std::string& name) {
  const std::string folder = cases::source_dir() + "/tests/corpus/data/attack/simulate/";
  const auto program = disk::read_file(folder + name), pocket = disk::read_file(folder + "p.json");
  EXPECT_TRUE(program && pocket) << name;
  SimulateOptions options;
  options.tool_diameter = 6, options.step_over = 0.4;
  return simulate({name, *program}, {"p.json", *pocket}, options);
}

TEST(VerifySimulateAttack, EachProgramIsRefusedByLineAndWord) {
  const struct {
    const char *name, *says;
  } cases[] = {
      {"a_g4move.ngc", "296: a dwell beside a motion; give it a block of its own"},
      {"a_g55mid.ngc", "149: G55 after the first motion changes where the program's places are"},
      {"a_g58.9.ngc", "149: G58.9 is not understood here"},
      {"a_m101.ngc", "149: M101 is not understood here"},
      {"a_m97.ngc", "149: M97 is no word of this control"},
      {"a_percent_before_M30.ngc", "63: words after the end of the program"},
      {"a_toolchange.ngc", "149: a change of the tool after the first cut"},
      {"rapid_plunge.ngc", "3: G0 below Z 0 from a place that no block has said"},
  };
  for (const auto& one : cases) {
    const auto report = judged(one.name);
    ASSERT_FALSE(report) << one.name;
    EXPECT_EQ(report.error().message, std::string(one.name) + ":" + one.says);
    EXPECT_EQ(report.error().code, ErrorCode::bad_input);
  }
}

TEST(VerifySimulateAttack, SoundProgramsAreStillJudged) {
  for (const char* name : {"plain_good.ngc", "cut_good.ngc"}) {
    const auto report = judged(name);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_GT(report->coverage_percent, 30) << name;
    EXPECT_EQ(report->gouge_mm > 100, std::string(name) == "plain_good.ngc") << report->gouge_mm;
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_simulate_test

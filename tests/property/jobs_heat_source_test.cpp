// A program takes off what the pocket holds, whatever the pocket, the tool and the levels.

#include "lekalo/jobs/heat_source.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "lekalo/jobs/pocket.hpp"

namespace lekalo::jobs::jobs_heat_source_test {
namespace {

std::string edges(std::initializer_list<std::array<double, 2>> corners) {
  std::string text;
  for (auto at = corners.begin(); at != corners.end(); ++at) {
    const auto& to = at + 1 == corners.end() ? *corners.begin() : *(at + 1);
    text += fmt::format(R"({}{{"line":{{"from":[{},{}],"to":[{},{}]}}}})", text.empty() ? "" : ",", (*at)[0],
                        (*at)[1], to[0], to[1]);
  }
  return "[" + text + "]";
}

struct Case {
  const char* name;
  std::string pocket;
  double tool, depth, step_down;
};

TEST(JobsHeatSource, TheVolumesOfCutsAddUpToWhatTheCheckerFindsCut) {
  const std::string ell = edges({{0, 0}, {40, 0}, {40, 15}, {15, 15}, {15, 35}, {0, 35}});
  const std::string round = R"([{"arc":{"from":[16,0],"to":[-16,0],"centre":[0,0],"ccw":true}},)"
                            R"({"arc":{"from":[-16,0],"to":[16,0],"centre":[0,0],"ccw":true}}])";
  const std::string post = R"([{"arc":{"from":[4,0],"to":[-4,0],"centre":[0,0],"ccw":true}},)"
                           R"({"arc":{"from":[-4,0],"to":[4,0],"centre":[0,0],"ccw":true}}])";
  for (const Case& c :
       {Case{"L in three levels", R"({"units":"mm","outer":)" + ell + "}", 6, 5, 2},
        Case{"round with a post", R"({"units":"mm","outer":)" + round + R"(,"islands":[)" + post + "]}", 5, 3,
             3}}) {
    SCOPED_TRACE(c.name);
    PocketJob pocketing;
    pocketing.pocket = {"pocket.json", c.pocket};
    pocketing.options.path.tool_diameter = c.tool;
    pocketing.options.path.depth = c.depth, pocketing.options.path.step_down = c.step_down;
    const Result<Pocketed> made = pocket(pocketing);
    ASSERT_TRUE(made) << made.error().message;
    HeatSourceJob job;
    job.program = {"part.ngc", made->program};
    job.pocket = pocketing.pocket;
    job.machining.tool_diameter = c.tool;
    job.cutting.teeth = 2, job.cutting.spindle_rpm = 10000;
    job.cutting.cutting_force = {600, 900}, job.cutting.force_exponent = {0.2, 0.3};
    job.cutting.share = {0.1, 0.2};
    job.stock.block = heat::read_stock("60x60x10");
    const Result<HeatSource> source = heat_source(job);
    ASSERT_TRUE(source) << source.error().message;
    const double volume = c.depth * (made->report.reachable_mm2 - made->report.uncut_mm2);
    // Pieces of an eighth of the tool's diameter, and ramps that leave staircases.
    EXPECT_NEAR(source->work.volume_mm3, volume, 0.006 * volume);
    heat::Interval work;
    double steps = 0;
    for (const heat::CutStep& step : source->work.steps) {
      work.least += step.work_j.least, work.greatest += step.work_j.greatest;
      steps += step.volume_mm3;
      EXPECT_GE(step.low_z, -c.depth - 1e-9);
      EXPECT_LE(step.high_z, 1e-9);
      EXPECT_LE(step.end - step.begin, 3.1416);
    }
    EXPECT_NEAR(steps, source->work.volume_mm3, 1e-9 * volume);
    EXPECT_NEAR(work.least, source->work.work_j.least, 1e-9 * work.least);
    EXPECT_NEAR(work.greatest, source->work.work_j.greatest, 1e-9 * work.greatest);
  }
}

}  // namespace
}  // namespace lekalo::jobs::jobs_heat_source_test

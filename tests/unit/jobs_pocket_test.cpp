#include "lekalo/jobs/pocket.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "lekalo/jobs/simulate.hpp"
#include "support/io_contours.hpp"
#include "support/json.hpp"

namespace lekalo::jobs::jobs_pocket_test {
namespace {

const std::string kPlate =
    R"({"units":"mm","outer":[{"line":{"from":[0,0],"to":[30,0]}},{"line":{"from":[30,0],"to":[30,20]}},)"
    R"({"line":{"from":[30,20],"to":[0,20]}},{"line":{"from":[0,20],"to":[0,0]}}]})";

/// The plate as a drawing, its upper edge on the layer OPEN.
const std::string kDrawnPlate =
    io_cases::dxf_entities(io_cases::line({0, 0}, {30, 0}, 0) + io_cases::line({30, 0}, {30, 20}, 0) +
                           io_cases::line({30, 20}, {0, 20}, 0, "OPEN") + io_cases::line({0, 20}, {0, 0}, 0));

PocketJob plate_job() {
  PocketJob job;
  job.pocket = {"folder/plate.dxf", kDrawnPlate};
  job.options.path.tool_diameter = 6;
  job.options.path.depth = 2;
  return job;
}

TEST(JobsPocket, TheReportIsThatOfTheProgramHandedOut) {
  const Result<Pocketed> made = pocket(plate_job());
  ASSERT_TRUE(made) << made.error().message;
  SimulateJob again;
  again.program = {"p.ngc", made->program};
  again.pocket = {"plate.json", kPlate};
  again.machining.tool_diameter = 6;
  const Result<Simulated> judged = simulate(again);
  ASSERT_TRUE(judged) << judged.error().message;
  EXPECT_EQ(judged->report.coverage_percent, made->report.coverage_percent);
  EXPECT_EQ(judged->report.seconds, made->report.seconds);
  EXPECT_LE(judged->report.gouge_mm, 0.005);
  EXPECT_EQ(cases::Json::parse(made->json)["coverage_percent"], made->report.coverage_percent);
}

TEST(JobsPocket, WhatWasNotAskedForIsNotMade) {
  PocketJob job = plate_job();
  const Result<Pocketed> plain = pocket(job);
  ASSERT_TRUE(plain);
  EXPECT_TRUE(plain->picture.empty() && plain->animation.empty() && plain->images.empty());
  job.picture = PictureForm::svg, job.animation = true;
  const Result<Pocketed> drawn = pocket(job);
  ASSERT_TRUE(drawn);
  EXPECT_NE(drawn->picture.find("<svg"), std::string::npos);
  EXPECT_NE(drawn->picture.find(">plate.dxf<"), std::string::npos);
  EXPECT_NE(drawn->animation.find("<html"), std::string::npos);
  EXPECT_EQ(drawn->program, plain->program);
}

TEST(JobsPocket, PhasesAreToldAsTheyBeginAndLetGoAsTheyEnd) {
  std::vector<std::string> begun;
  std::weak_ptr<int> open;
  const PhaseListener listener = [&](const char* phase) -> ProgressListener {
    EXPECT_TRUE(open.expired()) << phase << " begins before the phase before it has ended";
    begun.emplace_back(phase);
    const auto held = std::make_shared<int>();
    open = held;
    return [held](const Progress& p) { EXPECT_LE(p.fraction, 1); };
  };
  PocketJob job = plate_job();
  job.options.rest_of = 12;
  ASSERT_TRUE(pocket(job, listener));
  EXPECT_TRUE(open.expired());
  ASSERT_GE(begun.size(), 3U);
  EXPECT_EQ(begun[0], "planning the tool before");
  EXPECT_EQ(begun[1], "planning the path");
  EXPECT_EQ(begun[2], "checking the program");
}

TEST(JobsPocket, BeyondAnOpenEdgeTheToolMayStand) {
  PocketJob job = plate_job();
  const Result<Pocketed> closed = pocket(job);
  job.options.open_layers = {"OPEN"};
  const Result<Pocketed> open = pocket(job);
  ASSERT_TRUE(closed && open);
  EXPECT_GT(open->report.reachable_mm2, closed->report.reachable_mm2);
  EXPECT_LE(open->report.gouge_mm, 0.005);
}

TEST(JobsPocket, LayersOfIslandsAndOpenEdgesAreReadToo) {
  PocketJob job = plate_job();
  job.options.open_layers = {"OPEN"};
  const Result<Pocketed> all = pocket(job);
  job.options.outline.layers = {"CUT"};
  const Result<Pocketed> some = pocket(job);
  ASSERT_TRUE(all && some);
  EXPECT_EQ(some->program, all->program);
}

TEST(JobsPocket, WhatCannotBeIsRefused) {
  const auto message = [](const PocketJob& job) {
    const Result<Pocketed> made = pocket(job);
    return made ? "made" : made.error().message;
  };
  PocketJob job = plate_job();
  job.pocket = {"folder/plate.json", kPlate.substr(0, 60)};
  EXPECT_NE(message(job).find("folder/plate.json"), std::string::npos);
  job = plate_job();
  job.options.island_layers = {"ISLAND"};
  EXPECT_NE(message(job).find("no outline has an edge on the layer \"ISLAND\""), std::string::npos);
  job.options.island_layers = {"OPEN"};
  EXPECT_NE(message(job).find("lies in no pocket"), std::string::npos);
  job = plate_job();
  job.options.rest_of = 5;
  EXPECT_NE(message(job).find("is to be larger than this one"), std::string::npos);
  job = plate_job();
  job.picture = PictureForm::pdf;
  EXPECT_NE(message(job).find("SVG or PNG"), std::string::npos);
  job.options.path.tool_diameter = 50;
  EXPECT_NE(message(job).find("folder/plate.dxf: "), std::string::npos);
}

}  // namespace
}  // namespace lekalo::jobs::jobs_pocket_test

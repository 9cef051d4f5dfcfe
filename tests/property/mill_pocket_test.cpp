#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "lekalo/io/region_json.hpp"
#include "lekalo/mill/pocket.hpp"
#include "lekalo/mill/program.hpp"
#include "lekalo/verify/simulate.hpp"

// The path, judged by the independent checker. Bounds stated here are those the path keeps today; what it is
// to keep in the end stands in docs/design/pocket.md.

namespace lekalo::mill {
namespace {

struct Judged {
  verify::SimulateReport report;
  std::string program;
};

Judged judge(const std::string& pocket, const PocketOptions& options = {}) {
  const auto regions = io::parse_regions(pocket, "pocket.json");
  if (!regions) {
    ADD_FAILURE() << regions.error().message;
    return {};
  }
  const auto path = pocket_path(regions->regions, options);
  if (!path) {
    ADD_FAILURE() << path.error().message;
    return {};
  }
  Judged judged;
  judged.program = program_of(*path, {});
  verify::SimulateOptions simulation;
  simulation.tool_diameter = options.tool_diameter;
  simulation.stock_to_leave = options.stock_to_leave;
  simulation.spacing = 0.2;
  const auto report = verify::simulate({"part.ngc", judged.program}, {"pocket.json", pocket}, simulation);
  if (!report) ADD_FAILURE() << report.error().message;
  if (report) judged.report = *report;
  return judged;
}

const std::string kDisc =
    R"({"units":"mm","outer":[{"arc":{"from":[16,0],"to":[-16,0],"centre":[0,0],"ccw":true}},)"
    R"({"arc":{"from":[-16,0],"to":[16,0],"centre":[0,0],"ccw":true}}],)";

const std::string kRectangle =
    R"({"units":"mm","outer":[{"line":{"from":[0,0],"to":[40,0]}},{"line":{"from":[40,0],"to":[40,24]}},)"
    R"({"line":{"from":[40,24],"to":[0,24]}},{"line":{"from":[0,24],"to":[0,0]}}]})";

void expect_cleared(const Judged& judged, std::size_t retracts = 0) {
  EXPECT_GE(judged.report.coverage_percent, 99.99);
  EXPECT_LE(judged.report.uncut_width_mm, 0.02);
  EXPECT_LE(judged.report.gouge_mm, 0.005);
  EXPECT_EQ(judged.report.retracts, retracts);
  EXPECT_EQ(judged.report.rapid_cut_mm, 0);
}

TEST(PocketPath, ADiscIsClearedByRingsThatHoldTheAngle) {
  const Judged judged = judge(kDisc + R"("islands":[]})");
  expect_cleared(judged);
  EXPECT_LE(judged.report.engagement_max_deg, 98);
}

TEST(PocketPath, ARectangleIsCleared) {
  const Judged judged = judge(kRectangle);
  expect_cleared(judged);
  EXPECT_LE(judged.report.engagement_max_deg, 125);
  EXPECT_EQ(judge(kRectangle).program, judged.program);
}

TEST(PocketPath, AnIslandIsLeftStanding) {
  expect_cleared(
      judge(kDisc + R"("islands":[[{"arc":{"from":[7,0],"to":[7,0],"centre":[4,0],"ccw":true}}]]})"));
}

TEST(PocketPath, StockIsLeftOnTheWalls) {
  PocketOptions options;
  options.stock_to_leave = 0.5;
  expect_cleared(judge(kRectangle, options));
}

TEST(PocketPath, RefusesWhatCannotBe) {
  const auto regions = io::parse_regions(kRectangle, "pocket.json");
  ASSERT_TRUE(regions);
  const auto says = [&](PocketOptions options, const std::string& words) {
    const auto path = pocket_path(regions->regions, options);
    ASSERT_FALSE(path);
    EXPECT_NE(path.error().message.find(words), std::string::npos) << path.error().message;
  };
  PocketOptions options;
  options.tool_diameter = 30;
  says(options, "fits nowhere");
  options = {}, options.step_over = 0;
  says(options, "step-over");
  options = {}, options.depth = -1;
  says(options, "depth");
  options = {}, options.tool_diameter = std::numeric_limits<double>::quiet_NaN();
  says(options, "tool diameter");
}

}  // namespace
}  // namespace lekalo::mill

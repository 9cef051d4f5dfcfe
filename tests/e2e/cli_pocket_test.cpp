#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "e2e/cli_run.hpp"
#include "lekalo/base/joined_text.hpp"
#include "support/cases.hpp"
#include "support/places.hpp"
#include "support/pockets.hpp"

/// `lekalo pocket` and `lekalo simulate` as a person runs them. How good a path is: tests/property/mill_*.
namespace lekalo::test::cli_pocket_test {
namespace {

const std::string kPlate =
    R"({"units":"mm","outer":[{"line":{"from":[0,0],"to":[30,0]}},{"line":{"from":[30,0],"to":[30,20]}},)"
    R"({"line":{"from":[30,20],"to":[0,20]}},{"line":{"from":[0,20],"to":[0,0]}}]})";

std::string dxf_line(const std::string& layer, double x0, double y0, double x1, double y1) {
  return fmt::format("0\nLINE\n8\n{}\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n", layer, x0, y0, x1, y1);
}
std::string dxf_rectangle(const std::string& layer, double x, double y, double w, double h) {
  return dxf_line(layer, x, y, x + w, y) + dxf_line(layer, x + w, y, x + w, y + h) +
         dxf_line(layer, x + w, y + h, x, y + h) + dxf_line(layer, x, y + h, x, y);
}
std::string dxf(const std::string& entities) {
  return "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

TEST(CliPocket, AProgramWithAWordThatIsNotKnownIsRefusedWithItsLine) {
  const TemporaryFolder folder;
  write_bytes(folder / "plate.json", kPlate);
  write_bytes(folder / "p.ngc", "G21 G90 F100\nG0 X9 Y9 Z5\nG1 Z-1\nM101\nG1 X20\nM2\n");
  const Ran ran = run(folder.path(), {"simulate", "p.ngc", "--pocket", "plate.json", "--tool", "6"});
  EXPECT_EQ(ran.status, 3);
  EXPECT_EQ(ran.out, "");
  EXPECT_NE(ran.err.find("p.ngc:4: M101 is not understood here"), std::string::npos) << ran.err;
}

TEST(CliPocket, AProgramForEveryPostIsJudgedAlike) {
  const TemporaryFolder folder;
  write_bytes(folder / "plate.json", kPlate);
  Json first;
  for (const std::string post : {"linuxcnc", "fanuc", "grbl"}) {
    const Ran made =
        run(folder.path(),
            {"pocket",     "plate.json", "--tool", "6",     "--stepover", "40%",   "--depth",       "4",
             "--stepdown", "2",          "--post", post,    "--spindle",  "12000", "--tool-number", "2",
             "--coolant",  "flood",      "-o",     "p.ngc", "--json"});
    ASSERT_EQ(made.status, 0) << made.err;
    const Json report = made.json();
    EXPECT_GE(report["coverage_percent"].get<double>(), 99.99);
    EXPECT_LE(report["gouge_mm"].get<double>(), 0.005);
    EXPECT_EQ(report["retracts"].get<int>(), 0);
    const std::string program = read_bytes(folder / "p.ngc");
    EXPECT_EQ(program.find("%") == 0, post == "fanuc");
    EXPECT_EQ(program.find("M6") != std::string::npos, post != "grbl");
    EXPECT_NE(program.find("S12000 M3"), std::string::npos);
    EXPECT_NE(program.find("M8"), std::string::npos);
    EXPECT_NE(program.find("M30"), std::string::npos);
    EXPECT_NE(program.find("Z-4."), std::string::npos);
    const Ran judged = run(folder.path(), {"simulate", "p.ngc", "--pocket", "plate.json", "--tool", "6",
                                           "--stepover", "40%", "--json"});
    ASSERT_EQ(judged.status, 0) << judged.err;
    for (const char* figure :
         {"coverage_percent", "gouge_mm", "engagement_max_deg", "seconds", "air_percent"})
      EXPECT_EQ(judged.json()[figure], report[figure]) << figure;
    if (first.is_null()) first = report;
    EXPECT_NEAR(report["length_mm"].get<double>(), first["length_mm"].get<double>(), 0.5);
    EXPECT_NEAR(report["seconds"].get<double>(), first["seconds"].get<double>(), 1);
  }
}

TEST(CliPocket, ACorridorWithNoRoomForALoopIsCutInRampsAndSaidWithItsPlace) {
  const TemporaryFolder folder;
  const auto rooms = [&](double low, double high) {
    return fmt::format(
        R"({{"units":"mm","outer":[{{"line":{{"from":[0,0],"to":[14,0]}}}},{{"line":{{"from":[14,0],"to":[14,{0}]}}}},)"
        R"({{"line":{{"from":[14,{0}],"to":[24,{0}]}}}},{{"line":{{"from":[24,{0}],"to":[24,0]}}}},)"
        R"({{"line":{{"from":[24,0],"to":[38,0]}}}},{{"line":{{"from":[38,0],"to":[38,14]}}}},)"
        R"({{"line":{{"from":[38,14],"to":[24,14]}}}},{{"line":{{"from":[24,14],"to":[24,{1}]}}}},)"
        R"({{"line":{{"from":[24,{1}],"to":[14,{1}]}}}},{{"line":{{"from":[14,{1}],"to":[14,14]}}}},)"
        R"({{"line":{{"from":[14,14],"to":[0,14]}}}},{{"line":{{"from":[0,14],"to":[0,0]}}}}]}})",
        low, high);
  };
  write_bytes(folder / "tight.json", rooms(3.95, 10.05));
  write_bytes(folder / "wider.json", rooms(3.6, 10.4));
  const Words words{"--tool", "6", "--depth", "1", "-o", "p.ngc", "--json"};
  const Ran tight = run(folder.path(), Words{"pocket", "tight.json"} + words);
  ASSERT_EQ(tight.status, 0) << tight.err;
  const Json report = tight.json(), ramps = report["ramps"];
  ASSERT_GE(ramps.size(), 1U) << ramps;
  EXPECT_NEAR(ramps[0]["length_mm"].get<double>(), 17, 1.5);
  EXPECT_NEAR(ramps[0]["from"][1].get<double>(), 7, 0.5);
  EXPECT_GT(ramps[0]["engagement_deg"].get<double>(), 170);
  EXPECT_NE(tight.err.find("Cut in ramps"), std::string::npos) << tight.err;
  EXPECT_TRUE(report["hot_cuts"].empty()) << report["hot_cuts"];
  EXPECT_LE(report["engagement_max_deg"].get<double>(), 98.1);
  EXPECT_LE(report["entry_layer_mm"].get<double>(), 0.75);
  EXPECT_GE(report["coverage_percent"].get<double>(), 99.99);
  EXPECT_NE(read_bytes(folder / "p.ngc").find("F750.0"), std::string::npos);
  const Ran wider = run(folder.path(), Words{"pocket", "wider.json"} + words);
  ASSERT_EQ(wider.status, 0) << wider.err;
  EXPECT_TRUE(wider.json()["ramps"].empty()) << wider.json()["ramps"];
  EXPECT_EQ(wider.err.find("Cut in ramps"), std::string::npos) << wider.err;
}

/// 1.25 straight passes over 0.2 mm, everywhere but on entries, which are thin, whatever is asked.
TEST(CliPocket, RandomPocketsHoldTheAngleWhateverIsAsked) {
  const TemporaryFolder folder;
  for (std::size_t i = 0; i < cases::case_count(8); ++i) {
    Random random(cases::seed(), 2700 + i);
    const double tool = 2 + 6 * random.uniform(), step_over = 10 + 40 * random.uniform();
    write_bytes(folder / "p.json", pockets::random_pocket(random, i, tool * (2 + 3 * random.uniform())));
    constexpr std::array kCuts{"any", "climb", "conventional"};
    const Words words{"pocket",
                      "p.json",
                      "--tool",
                      fmt::format("{:.2f}", tool),
                      "--stepover",
                      fmt::format("{:.1f}%", step_over),
                      "--cut",
                      kCuts[random.below(3)],
                      "--stock-to-leave",
                      fmt::format("{:.2f}", random.uniform() < 0.5 ? 0 : 0.5 * random.uniform()),
                      "--depth",
                      fmt::format("{:.2f}", 1 + 3 * random.uniform()),
                      "--stepdown",
                      "2",
                      "-o",
                      "p.ngc",
                      "--json"};
    const Ran ran = run(folder.path(), words);
    SCOPED_TRACE(fmt::format("{}\n{}\n{}", joined_text(words, " "), read_bytes(folder / "p.json"), ran.err));
    if (ran.status == 3 && (ran.err.find("fits nowhere") != std::string::npos ||
                            ran.err.find("must not meet") != std::string::npos))
      continue;
    ASSERT_EQ(ran.status, 0);
    const Json report = ran.json();
    const double straight = std::acos(1 - 2 * step_over / 100) * 57.29577951308232;
    EXPECT_LE(report["engagement_max_deg"].get<double>(), 1.25 * straight + 0.2);
    EXPECT_TRUE(report["hot_cuts"].empty()) << report["hot_cuts"];
    EXPECT_LE(report["entry_layer_mm"].get<double>(), 0.15 * tool);
    EXPECT_GE(report["coverage_percent"].get<double>(), 99.98);
    EXPECT_LE(report["gouge_mm"].get<double>(), 0.005);
  }
}

TEST(CliPocket, DrawingsHoldSeveralPocketsIslandsAndOpenEdgesByLayer) {
  const TemporaryFolder folder;
  const std::string entities = dxf_rectangle("POCKET", 0, 0, 30, 20) + dxf_rectangle("ISLAND", 12, 8, 5, 4) +
                               dxf_line("POCKET", 40, 0, 60, 0) + dxf_line("OPEN", 60, 0, 60, 20) +
                               dxf_line("POCKET", 60, 20, 40, 20) + dxf_line("POCKET", 40, 20, 40, 0);
  write_bytes(folder / "part.dxf", dxf(entities));
  const Words words{"pocket", "part.dxf", "--tool",    "4",     "--depth",     "2",     "-o",
                    "p.ngc",  "--json",   "--picture", "p.svg", "--animation", "p.html"};
  const Ran closed = run(folder.path(), words);
  ASSERT_EQ(closed.status, 0) << closed.err;
  const Ran open = run(folder.path(), words + Words{"--island-layer", "ISLAND", "--open-layer", "OPEN"});
  ASSERT_EQ(open.status, 0) << open.err;
  EXPECT_EQ(closed.json()["unreachable"].size(), 8U);
  // At the open side there are no corners; the tool goes out to its middle.
  EXPECT_EQ(open.json()["unreachable"].size(), 6U);
  EXPECT_NEAR(open.json()["reachable_mm2"].get<double>() - closed.json()["reachable_mm2"].get<double>(),
              2 * (1 - 3.14159265 / 4) * 4, 0.1);
  EXPECT_GE(open.json()["coverage_percent"].get<double>(), 99.99);
  EXPECT_LE(open.json()["gouge_mm"].get<double>(), 0.005);
  EXPECT_NE(read_bytes(folder / "p.svg").find("the tool does not fit in here"), std::string::npos);
  EXPECT_NE(read_bytes(folder / "p.html").find("<canvas"), std::string::npos);
}

TEST(CliPocket, SpotsOutOfReachThatNobodySeesAreCountedInOneRow) {
  const TemporaryFolder folder;
  // Four corners of about 90 degrees, and one of 171 whose tip is 0.003 mm from a node of the raster.
  write_bytes(
      folder / "roof.json",
      R"({"outer":[{"line":{"from":[0,0],"to":[39.331,0]}},{"line":{"from":[39.331,0],"to":[40.128,10.125]}},)"
      R"({"line":{"from":[40.128,10.125],"to":[39.331,20.25]}},{"line":{"from":[39.331,20.25],"to":[0,20.25]}},)"
      R"({"line":{"from":[0,20.25],"to":[0,0]}}]})");
  write_bytes(folder / "p.ngc", "G0 X10 Y10 Z5\nG1 Z-1 F300\nG1 X15 F1500\n");
  const Words words{"simulate", "p.ngc", "--pocket", "roof.json", "--tool", "6"};
  const Ran told = run(folder.path(), words);
  ASSERT_EQ(told.status, 0) << told.err;
  std::size_t rows = 0;
  for (std::size_t at = 0; (at = told.err.find("out of reach", at)) != std::string::npos; ++at) ++rows;
  EXPECT_EQ(rows, 5U) << told.err;
  EXPECT_NE(told.err.find("smaller spots: 1, up to 0.006 mm from what can be cut\n"), std::string::npos)
      << told.err;
  EXPECT_EQ(run(folder.path(), words + Words{"--json"}).json()["unreachable"].size(), 5U);
}

TEST(CliPocket, OpenEdgesOfARegionFileAreKnownToPathAndChecker) {
  const TemporaryFolder folder;
  Json plate = Json::parse(kPlate);
  plate["outer"][1]["open"] = true;
  write_bytes(folder / "open.json", plate.dump());
  for (const std::string stock : {"0", "0.5"}) {
    const Ran made = run(folder.path(), {"pocket", "open.json", "--tool", "6", "--depth", "2",
                                         "--stock-to-leave", stock, "-o", "p.ngc", "--json"});
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_GE(made.json()["coverage_percent"].get<double>(), 99.99);
    EXPECT_LE(made.json()["uncut_width_mm"].get<double>(), 0.02);
    EXPECT_LE(made.json()["gouge_mm"].get<double>(), 0.005);
    EXPECT_EQ(made.json()["unreachable"].size(), stock == "0" ? 2U : made.json()["unreachable"].size());
    const Ran judged = run(folder.path(), {"simulate", "p.ngc", "--pocket", "open.json", "--tool", "6",
                                           "--stock-to-leave", stock, "--json", "--picture", "p.svg"});
    ASSERT_EQ(judged.status, 0) << judged.err;
    for (const char* figure : {"coverage_percent", "gouge_mm", "engagement_max_deg", "reachable_mm2"})
      EXPECT_EQ(judged.json()[figure], made.json()[figure]) << figure;
    // With a wall there the same program goes 3 mm into it.
    write_bytes(folder / "plate.json", kPlate);
    const Ran closed = run(folder.path(), {"simulate", "p.ngc", "--pocket", "plate.json", "--tool", "6",
                                           "--stock-to-leave", stock, "--json"});
    EXPECT_GT(closed.json()["gouge_mm"].get<double>(), 2.9);
  }
}

/// The pair is proved: what the first program left is cut by the second, entered where nothing stands.
TEST(CliPocket, WhatAProgramBeforeLeftIsCutAndThePairIsJudged) {
  const TemporaryFolder folder;
  write_bytes(folder / "plate.json", kPlate);
  const Words levels{"--depth", "4", "--stepdown", "2"};
  const Ran first = run(
      folder.path(),
      Words{"pocket", "plate.json", "--tool", "10", "--stock-to-leave", "0.2", "-o", "first.ngc"} + levels);
  ASSERT_EQ(first.status, 0) << first.err;
  const Ran rest = run(folder.path(), Words{"pocket", "plate.json", "--tool", "4", "--after", "first.ngc:10",
                                            "-o", "rest.ngc", "--json", "--picture", "rest.svg"} +
                                          levels);
  ASSERT_EQ(rest.status, 0) << rest.err;
  const Json made = rest.json();
  EXPECT_GE(made["coverage_percent"].get<double>(), 99.99);
  EXPECT_LE(made["gouge_mm"].get<double>(), 0.005);
  EXPECT_LE(made["engagement_max_deg"].get<double>(), 98);
  EXPECT_EQ(made["entry_mm"].get<double>(), 0);
  EXPECT_EQ(made["rapid_cut_mm"].get<double>(), 0);
  EXPECT_EQ(made["retracts"].get<int>(), 0);
  EXPECT_LT(made["left_before_mm2"].get<double>(), 0.1 * made["reachable_mm2"].get<double>());
  ASSERT_EQ(made["inputs"].size(), 2U);
  EXPECT_EQ(made["inputs"][1]["role"], "after");
  EXPECT_EQ(made["inputs"][1]["tool_mm"], 10);
  const Ran pair = run(folder.path(), {"simulate", "rest.ngc", "--pocket", "plate.json", "--tool", "4",
                                       "--after", "first.ngc:10", "--json"});
  ASSERT_EQ(pair.status, 0) << pair.err;
  for (const char* figure : {"coverage_percent", "gouge_mm", "engagement_max_deg", "entry_mm", "seconds",
                             "air_percent", "left_before_mm2"})
    EXPECT_EQ(pair.json()[figure], made[figure]) << figure;
  // The same program in full material.
  const Ran alone =
      run(folder.path(), {"simulate", "rest.ngc", "--pocket", "plate.json", "--tool", "4", "--json"});
  EXPECT_LT(alone.json()["coverage_percent"].get<double>(), 70);
  EXPECT_NEAR(alone.json()["engagement_max_deg"].get<double>(), 180, 1);
}

TEST(CliPocket, ALargerToolBeforeMayBeSupposed) {
  const TemporaryFolder folder;
  write_bytes(folder / "plate.json", kPlate);
  const Ran rest = run(folder.path(), {"pocket", "plate.json", "--tool", "3", "--depth", "2", "--rest", "10",
                                       "-o", "b.ngc", "--json"});
  ASSERT_EQ(rest.status, 0) << rest.err;
  EXPECT_NE(rest.err.find("Supposed: a tool of 10 mm"), std::string::npos) << rest.err;
  EXPECT_EQ(rest.json()["rest_of_mm"], 10);
  EXPECT_GE(rest.json()["coverage_percent"].get<double>(), 99.99);
  EXPECT_EQ(rest.json()["entry_mm"].get<double>(), 0);
  EXPECT_LT(rest.json()["length_mm"].get<double>(), 250);
}

TEST(CliPocket, FeedsFollowTheEngagementInFewSteps) {
  const TemporaryFolder folder;
  write_bytes(folder / "plate.json", kPlate);
  const Words words{"pocket", "plate.json", "--tool", "6", "--depth", "2", "-o", "p.ngc", "--json"};
  const Ran plain = run(folder.path(), words + Words{"--feed", "1200"});
  const Ran quick = run(folder.path(), words + Words{"--feed-per-tooth", "0.05", "--teeth", "2", "--spindle",
                                                     "12000", "--feed-max", "3600"});
  ASSERT_EQ(quick.status, 0) << quick.err;
  EXPECT_LT(quick.json()["seconds"].get<double>(), plain.json()["seconds"].get<double>());
  EXPECT_NEAR(quick.json()["length_mm"].get<double>(), plain.json()["length_mm"].get<double>(), 0.1);
  const std::string program = read_bytes(folder / "p.ngc");
  std::map<std::string, int> feeds;
  for (std::size_t at = program.find(" F"); at != std::string::npos; at = program.find(" F", at + 1))
    ++feeds[program.substr(at, program.find('\n', at) - at)];
  EXPECT_LE(feeds.size(), 9U);  // six steps, plunge, link, helix
  EXPECT_TRUE(feeds.count(" F1200.0")) << program.substr(0, 400);
}

TEST(CliPocket, TheSourcesSpiralsCanBeCompared) {
  const TemporaryFolder folder;
  write_bytes(folder / "plate.json", kPlate);
  for (const std::string method : {"floz-linear", "floz-quadratic"}) {
    const Ran ran = run(folder.path(), {"pocket", "plate.json", "--tool", "6", "--depth", "2", "--method",
                                        method, "-o", "p.ngc", "--json"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_LT(ran.json()["coverage_percent"].get<double>(), 99.9);
    EXPECT_GT(ran.json()["coverage_percent"].get<double>(), 50);
  }
}

TEST(CliPocket, ASpiralBeginsAtTheChosenStart) {
  const TemporaryFolder folder;
  write_bytes(folder / "plate.json", kPlate);
  const Words words{"pocket", "plate.json", "--tool", "6", "--depth", "2", "--method", "floz-quadratic"};
  const Ran peak = run(folder.path(), words);
  const Ran chosen = run(folder.path(), words + Words{"--start", "9.25,11.5"});
  ASSERT_EQ(chosen.status, 0) << chosen.err;
  const std::string there = "X9.2500 Y11.5000";
  EXPECT_EQ(peak.out.find(there), std::string::npos);
  EXPECT_NE(chosen.out.find(there), std::string::npos) << chosen.out.substr(0, 400);
  write_bytes(
      folder / "left.json",
      R"({"units":"mm","outer":[{"line":{"from":[-30,0],"to":[0,0]}},{"line":{"from":[0,0],"to":[0,20]}},)"
      R"({"line":{"from":[0,20],"to":[-30,20]}},{"line":{"from":[-30,20],"to":[-30,0]}}]})");
  const Ran left = run(folder.path(), Words{"pocket", "--start", "-20.75,11.5", "left.json"} +
                                          Words(words.begin() + 2, words.end()));
  EXPECT_EQ(left.status, 0) << left.err;
  EXPECT_NE(left.out.find("X-20.7500 Y11.5000"), std::string::npos);
}

TEST(CliPocket, ALocatedPartHasItsPocketCutWhereItLies) {
  const TemporaryFolder folder;
  write_bytes(folder / "plate.json", kPlate);
  write_bytes(folder / "part.csv", "-10 -10\n40 -10\n40 30\n-10 30\n");
  write_bytes(folder / "blank.csv", "100.3 100\n153 104.5\n148.2 150\n97 146.2\n");
  const Ran made = run(folder.path(), {"pocket", "plate.json", "--tool", "6", "--depth", "2", "--tool-number",
                                       "1", "--spindle", "9000", "-o", "p.ngc", "--json"});
  ASSERT_EQ(made.status, 0) << made.err;
  const Ran located = run(folder.path(), {"locate", "--part", "part.csv", "--blank", "blank.csv", "--nc",
                                          "p.ngc", "--nc-out", "q.ngc", "--json", "-o", "r.json"});
  ASSERT_EQ(located.status, 0) << located.err;
  const Json result = located.json();
  const double x = result["x"], y = result["y"], theta = result["theta"];
  EXPECT_GT(std::abs(theta), 0.01);
  Json corners = Json::array();
  for (const auto& [px, py] : {std::pair(0, 0), std::pair(30, 0), std::pair(30, 20), std::pair(0, 20)})
    corners.push_back(
        {std::cos(theta) * px - std::sin(theta) * py + x, std::sin(theta) * px + std::cos(theta) * py + y});
  Json outer = Json::array();
  for (std::size_t k = 0; k < 4; ++k)
    outer.push_back({{"line", {{"from", corners[k]}, {"to", corners[(k + 1) % 4]}}}});
  write_bytes(folder / "there.json", Json{{"units", "mm"}, {"outer", outer}}.dump());
  const Ran there =
      run(folder.path(), {"simulate", "q.ngc", "--pocket", "there.json", "--tool", "6", "--json"});
  ASSERT_EQ(there.status, 0) << there.err;
  const Json before = made.json(), after = there.json();
  EXPECT_NEAR(after["coverage_percent"].get<double>(), before["coverage_percent"].get<double>(), 1e-3);
  EXPECT_NEAR(after["gouge_mm"].get<double>(), before["gouge_mm"].get<double>(), 1e-4);
  EXPECT_NEAR(after["length_mm"].get<double>(), before["length_mm"].get<double>(), 0.01);
  EXPECT_NEAR(after["engagement_max_deg"].get<double>(), before["engagement_max_deg"].get<double>(), 1);
  EXPECT_EQ(after["retracts"], before["retracts"]);
}

TEST(CliPocket, BadInputIsOneSentence) {
  const TemporaryFolder folder;
  write_bytes(folder / "plate.json", kPlate);
  write_bytes(folder / "open.dxf", dxf(dxf_line("0", 0, 0, 30, 0) + dxf_line("0", 30, 0, 30, 20)));
  write_bytes(folder / "bow.dxf", dxf(dxf_line("0", 0, 0, 30, 25) + dxf_line("0", 30, 25, 30, 0) +
                                      dxf_line("0", 30, 0, 0, 20) + dxf_line("0", 0, 20, 0, 0)));
  write_bytes(folder / "out.dxf", dxf(dxf_rectangle("P", 0, 0, 30, 20) + dxf_rectangle("I", 40, 0, 5, 5)));
  std::string outside = kPlate;
  outside.pop_back();
  write_bytes(folder / "outside.json",
              outside + R"(,"islands":[[{"arc":{"from":[50,5],"to":[50,5],"centre":[45,5],"ccw":true}}]]})");
  const auto says = [&](const Words& words, int status, const std::string& what) {
    const Ran ran = run(folder.path(), Words{"pocket"} + words);
    EXPECT_EQ(ran.status, status) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_NE(ran.err.find(what), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  };
  const Words tool{"--tool", "6", "--depth", "2"};
  says(Words{"open.dxf"} + tool, 3, "close");
  says(Words{"bow.dxf"} + tool, 3, "outlines must not meet");
  says(Words{"plate.json", "--tool", "21", "--depth", "2"}, 3, "fits nowhere");
  says(Words{"outside.json"} + tool, 3, "outside");
  says(Words{"out.dxf", "--island-layer", "I"} + tool, 3, "lies in no pocket");
  says(Words{"out.dxf", "--open-layer", "X"} + tool, 3, "no outline has an edge on the layer");
  says(Words{"none.json"} + tool, 3, "none.json");
  says(Words{"plate.json", "--stepover", "0"} + tool, 2, "--stepover");
  says(Words{"plate.json", "--stepover", "%"} + tool, 2, "--stepover");
  says(Words{"plate.json", "--post", "siemens"} + tool, 2, "--post");
  says(Words{"plate.json", "--feed-per-tooth", "0.1"} + tool, 2, "--teeth");
  says(Words{"plate.json", "--feed-max", "10"} + tool, 2, "--feed-max");
  says(Words{"plate.json", "--picture", "p.gif"} + tool, 2, ".svg");
  says(Words{"plate.json", "--json"} + tool, 2, "-o");
  says(Words{"plate.json", "--rest", "4"} + tool, 3, "larger");
  says(Words{"plate.json", "--rest", "25"} + tool, 3, "fits nowhere");
  says(Words{"plate.json", "--rest", "8", "--after", "a.ngc:8"} + tool, 2, "--after");
  says(Words{"plate.json", "--after", "a.ngc"} + tool, 2, "rough.ngc:10");
  says(Words{"plate.json", "--after", "a.ngc:x"} + tool, 2, "diameter");
  says(Words{"plate.json", "--after", "none.ngc:8"} + tool, 3, "none.ngc");
  write_bytes(folder / "a.ngc", "G21 G90\nG41 D1\n");
  says(Words{"plate.json", "--after", "a.ngc:8"} + tool, 3, "a.ngc:2: G41");
  says(Words{"plate.json", "--after", "a.ngc:8", "-o", "a.ngc"} + tool, 2, "--after");
  const Words source = tool + Words{"--method", "floz-linear"};
  says(Words{"plate.json", "--start", "15;10"} + source, 2, "not two lengths");
  says(Words{"plate.json", "--start", "15,"} + source, 2, "not two lengths");
  says(Words{"plate.json", "--start", "15,ten"} + source, 2, "\"ten\" is not a length");
  says(Words{"plate.json", "--start", "15,nan"} + source, 2, "\"nan\" is not a length");
  says(Words{"plate.json", "--start", "15,10"} + tool, 2, "--method");
  says(Words{"plate.json", "--start", "2,10"} + source, 3, "no place to cut");
  says(Words{"plate.json", "--start", "15,10", "--start", "12,10"} + source, 3, "leave one of them out");
  says(Words{"plate.json", "--start", "3,10"} + source, 3, "has no step");
}

}  // namespace
}  // namespace lekalo::test::cli_pocket_test

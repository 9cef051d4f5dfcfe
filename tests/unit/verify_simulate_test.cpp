#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lekalo/verify/simulate.hpp"

namespace lekalo::verify::verify_simulate_test {
namespace {

constexpr double kPi = 3.141592653589793;

std::string rectangle(double width, double height) {
  return fmt::format(
      R"({{"units":"mm","outer":[{{"line":{{"from":[0,0],"to":[{0},0]}}}},{{"line":{{"from":[{0},0],"to":[{0},{1}]}}}},)"
      R"({{"line":{{"from":[{0},{1}],"to":[0,{1}]}}}},{{"line":{{"from":[0,{1}],"to":[0,0]}}}}]}})",
      width, height);
}

std::string disc(double radius) {
  return fmt::format(
      R"({{"units":"mm","outer":[{{"arc":{{"from":[{0},0],"to":[-{0},0],"centre":[0,0],"ccw":true}}}},)"
      R"({{"arc":{{"from":[-{0},0],"to":[{0},0],"centre":[0,0],"ccw":true}}}}]}})",
      radius);
}

SimulateOptions tool(double diameter) {
  SimulateOptions options;
  options.tool_diameter = diameter;
  return options;
}

SimulateReport run(const std::string& program, const std::string& pocket,
                   const SimulateOptions& options = tool(6)) {
  const auto report = simulate({"part.ngc", program}, {"pocket.json", pocket}, options);
  if (!report) {
    ADD_FAILURE() << report.error().message;
    return {};
  }
  return *report;
}

std::string complaint_of(const std::string& program, const std::string& pocket,
                         const SimulateOptions& options = tool(6)) {
  const auto report = simulate({"part.ngc", program}, {"pocket.json", pocket}, options);
  return report ? "" : report.error().message;
}

const std::string kBegin = "G21 G90 G17\nG0 X10 Y10 Z5\nG1 Z-1 F300\n";

TEST(VerifySimulate, AFullSlotEngagesHalfTheRim) {
  const auto report = run(kBegin + "G1 X50 F1500\n", rectangle(70, 40));
  EXPECT_NEAR(report.engagement_max_deg, 180, 1e-4);
  EXPECT_NEAR(report.engagement_p95_deg, 180, 1e-4);
  EXPECT_EQ(report.retracts, 0U);
  EXPECT_NEAR(report.length_mm, 40, 1e-9);
}

TEST(VerifySimulate, ASecondPassEngagesTheArcOfItsStepOver) {
  for (const double step : {0.3, 2.4, 4.5}) {
    const auto report =
        run(kBegin + fmt::format("G1 X60 F1500\nG0 Z5\nG0 X10 Y{0}\nG1 Z-1 F300\nG1 X60 F1500\n", 10 + step),
            rectangle(70, 40));
    const double expected = std::acos(1 - step / 3) * 180 / kPi;
    double found = 0;
    for (const auto& sample : report.samples)
      if (sample.line == 8 && std::abs(sample.x - 35) < 0.03) found = sample.engagement;
    EXPECT_NEAR(found, expected, 1e-4) << step;
    EXPECT_EQ(report.retracts, 1U);
  }
}

TEST(VerifySimulate, ACircleOutsideACircleFollowsTheLawOfCosines) {
  // (R0 + r)^2 = R1^2 + r^2 + 2 R1 r cos(alpha)
  for (const double inner : {1.0, 5.0, 10.0}) {
    for (const double step : {1.6}) {
      const double outer = inner + step, r = 3;
      const auto report = run(fmt::format("G21 G90\nG0 X{0} Y0 Z5\nG1 Z-1 F300\nG3 X{0} Y0 I-{0} J0 F1500\n"
                                          "G3 X{0} Y0 I-{0} J0\nG1 X{1}\nG3 X{1} Y0 I-{1} J0\n",
                                          inner, outer),
                              disc(16));
      const double cosine = ((inner + r) * (inner + r) - outer * outer - r * r) / (2 * outer * r);
      double found = 0;
      for (const auto& sample : report.samples)
        if (sample.line == 7 && sample.x < -0.999 * outer) found = sample.engagement;
      EXPECT_NEAR(found, std::acos(cosine) * 180 / kPi, 2e-3) << inner << " " << step;
    }
  }
}

TEST(VerifySimulate, AGougeIsMeasuredExactly) {
  EXPECT_NEAR(run("G0 X10 Y3 Z5\nG1 Z-1 F300\nG1 X60 F1500\n", rectangle(70, 40)).gouge_mm, 0, 1e-12);
  EXPECT_NEAR(run("G0 X10 Y2.9 Z5\nG1 Z-1 F300\nG1 X60 F1500\n", rectangle(70, 40)).gouge_mm, 0.1, 1e-9);
  EXPECT_NEAR(run("G0 X20 Y0 Z5\nG1 Z-1 F300\nG3 X-20 Y0 I-20 J0 F1500\n", disc(22.75)).gouge_mm, 0.25, 1e-9);
  // Out through the wall: 7 mm past it with the middle, 10 with the rim.
  EXPECT_NEAR(run("G0 X50 Y20 Z5\nG1 Z-1 F300\nG1 Y-7 F1500\n", rectangle(70, 40)).gouge_mm, 10, 2e-3);
  auto options = tool(6);
  options.stock_to_leave = 0.5;
  EXPECT_NEAR(run("G0 X10 Y3 Z5\nG1 Z-1 F300\nG1 X60 F1500\n", rectangle(70, 40), options).gouge_mm, 0.5,
              1e-9);
}

TEST(VerifySimulate, CoverageIsTheSweptShareOfWhatIsReachable) {
  const auto report = run(kBegin + "G1 X60 F1500\n", rectangle(70, 40));
  const double reachable = 2800 - (4 - kPi) * 9, swept = 50 * 6 + kPi * 9;
  EXPECT_NEAR(report.reachable_mm2, reachable, 0.05);
  EXPECT_NEAR(report.coverage_percent, 100 * swept / reachable, 1e-3);
  EXPECT_LE(report.coverage_low_percent, report.coverage_percent);
  EXPECT_EQ(report.unreachable.size(), 4U);
  for (const auto& corner : report.unreachable) {
    EXPECT_NEAR(corner.distance_mm, 3 * (std::sqrt(2) - 1), 0.2);
    EXPECT_NEAR(corner.area_mm2, 9 * (1 - kPi / 4), 0.4);
  }
}

TEST(VerifySimulate, AStripThatIsLeftShowsItsWidth) {
  // Two passes 6.1 mm apart in a slot 12.1 mm wide leave 0.1 mm between them.
  const std::string program = "G0 X3 Y3 Z5\nG1 Z-1 F300\nG1 X37 F1500\nG1 Y9.1\nG1 X3\nG1 Y3\n";
  const auto report = run(program, rectangle(40, 12.1));
  EXPECT_GE(report.uncut_width_mm, 0.1);
  EXPECT_LE(report.uncut_width_mm, 0.1 + 0.012);
  const auto closed =
      run("G0 X3 Y3 Z5\nG1 Z-1 F300\nG1 X37 F1500\nG1 Y8.9\nG1 X3\nG1 Y3\n", rectangle(40, 11.9));
  EXPECT_LE(closed.uncut_width_mm, 0.006);
  EXPECT_NEAR(closed.coverage_percent, 100, 1e-4);
}

TEST(VerifySimulate, EveryWayOfWritingAnArcIsTheSameArc) {
  const std::string pocket = rectangle(70, 40);
  const auto plain = run(kBegin + "G1 X40 Y10 F1500\nG3 X50 Y20 I0 J10\nG2 X60 Y30 I10 J0\n", pocket);
  const auto radius = run(kBegin + "G1 X40 Y10 F1500\nG3 X50 Y20 R10 \nG2 X60 Y30 R10\n", pocket);
  const auto absolute =
      run("G90.1\n" + kBegin + "G1 X40 Y10 F1500\nG3 X50 Y20 I40 J20\nG2 X60 Y30 I60 J20\n", pocket);
  const auto steps = run(kBegin + "G91\nG1 X30 Y0 F1500\nG3 X10 Y10 I0 J10\nG2 X10 Y10 I10 J0\n", pocket);
  EXPECT_NEAR(plain.length_mm, 30 + 10 * kPi, 1e-6);
  for (const auto& other : {radius, absolute, steps}) {
    EXPECT_NEAR(other.length_mm, plain.length_mm, 1e-6);
    EXPECT_NEAR(other.seconds, plain.seconds, 1e-6);
    EXPECT_NEAR(other.coverage_percent, plain.coverage_percent, 1e-4);
    EXPECT_NEAR(other.engagement_max_deg, plain.engagement_max_deg, 1e-3);
  }
  const auto inches = run("G20 G90 G0 X0.5 Y0.5 Z0.2\nG1 Z-0.04 F10\nG1 X1.5 F60\n", pocket);
  EXPECT_NEAR(inches.length_mm, 25.4, 1e-9);
}

TEST(VerifySimulate, TimeIsThatOfTheTrapezoids) {
  // Length, feed, speeds at the ends; 500 mm/s2, long enough to reach the feed.
  const auto trapezoid = [](double mm, double feed, double begin, double end) {
    const double ramps = (2 * feed * feed - begin * begin - end * end) / 1000;
    return (2 * feed - begin - end) / 500 + (mm - ramps) / feed;
  };
  // At a quarter turn the junction's radius is 0.01 * s / (1 - s), s the sine of 45 degrees.
  const double s = std::sqrt(0.5), corner = std::sqrt(500 * 0.01 * s / (1 - s));
  const double down = trapezoid(6, 5, 0, corner);
  EXPECT_NEAR(run(kBegin + "G1 X60 F1500\n", rectangle(70, 40)).seconds, down + trapezoid(50, 25, corner, 0),
              1e-9);
  EXPECT_NEAR(run(kBegin + "G1 X30 F1500\nG1 Y30\n", rectangle(70, 40)).seconds,
              down + trapezoid(20, 25, corner, corner) + trapezoid(20, 25, corner, 0), 1e-9);
}

TEST(VerifySimulate, AHelixAndTheTurnThatLevelsItsFloorAreEntry) {
  const auto report =
      run("G0 X52 Y30 Z1\nG1 Z0 F300\nG3 X52 Y30 Z-1 I-2 J0 P2\nG3 X52 Y30 I-2 J0\nG1 X53 F1500\nG3 X53 Y30 "
          "I-3 J0\n",
          rectangle(70, 40));
  EXPECT_NEAR(report.entry_mm, 3 * 4 * kPi, 0.3);
  EXPECT_NEAR(report.samples.back().engagement, 0, 1e-3);  // back where the circle began
  for (const auto& sample : report.samples) {
    if (sample.line == 6 && sample.x < 47.01) {
      EXPECT_NEAR(sample.engagement, std::acos(7.0 / 18) * 180 / kPi, 0.01);
    }
  }
  EXPECT_EQ(report.retracts, 0U);
}

TEST(VerifySimulate, ALevelIsJudgedByWhatWasCutAsDeep) {
  const std::string pass = "G1 X60 F1500\nG1 X10\n";
  const auto report = run(kBegin + pass + "G1 Z-2 F300\n" + pass, rectangle(70, 40));
  std::size_t slots = 0;
  for (const auto& sample : report.samples) slots += sample.engagement > 179.9 ? 1 : 0;
  EXPECT_EQ(slots, report.samples.size() / 2);  // out at each depth; back cuts nothing
  EXPECT_NEAR(report.air_percent, 50, 0.2);
}

TEST(VerifySimulate, ARapidThroughMaterialIsFound) {
  EXPECT_NEAR(run(kBegin + "G0 X20\n", rectangle(70, 40)).rapid_cut_mm, 10, 1e-9);
}

// ---- after another tool

/// A slot of a 10 mm tool along y = 20 from x = 10 to 60.
std::string wide_slot(double z) {
  return fmt::format("G21 G90 G17\nG0 X10 Y20 Z5\nG1 Z{} F300\nG1 X60 F1500\nG0 Z5\n", z);
}

SimulateReport run_after(const std::string& earlier, const std::string& program, const std::string& pocket,
                         double earlier_diameter = 10) {
  const auto report = simulate({"part.ngc", program}, {"pocket.json", pocket}, tool(6),
                               {{{"first.ngc", earlier}, earlier_diameter}});
  if (!report) {
    ADD_FAILURE() << report.error().message;
    return {};
  }
  return *report;
}

double engagement_near(const SimulateReport& report, std::size_t line, double x) {
  for (const auto& sample : report.samples)
    if (sample.line == line && std::abs(sample.x - x) < 0.026) return sample.engagement;
  ADD_FAILURE() << "no sample on line " << line << " at x " << x;
  return -1;
}

TEST(VerifySimulateAfter, BesideTheSlotOfAWiderToolTheArcIsThatOfTheStepOver) {
  for (const double step : {0.5, 2.0, 4.0}) {
    const auto report = run_after(
        wide_slot(-1), fmt::format("G21 G90\nG0 X20 Y{} Z5\nG1 Z-1 F300\nG1 X50 F1500\n", 20 + 5 - 3 + step),
        rectangle(70, 40));
    EXPECT_NEAR(engagement_near(report, 4, 35), std::acos(1 - step / 3) * 180 / kPi, 1e-4) << step;
    EXPECT_NEAR(report.entry_mm, 1, 1e-6);  // straight down, half in material
  }
}

TEST(VerifySimulateAfter, RoundACircleOfAnotherToolTheLawOfCosinesHolds) {
  // (R0 + R)^2 = R1^2 + r^2 + 2 R1 r cos(alpha)
  const std::string circle = "G21 G90\nG0 X{0} Y0 Z5\nG1 Z-1 F300\nG3 X{0} Y0 I-{0} J0 F1500\n";
  for (const double other : {2.0, 5.0}) {
    const auto report =
        run_after("G21 G90\nG0 X5 Y0 Z5\nG1 Z-1 F300\nG3 X5 Y0 I-5 J0 F1500\nG0 Z5\n",
                  "G21 G90\nG0 X8 Y0 Z5\nG1 Z-1 F300\nG3 X8 Y0 I-8 J0 F1500\n", disc(16), 2 * other);
    const double cosine = ((5 + other) * (5 + other) - 64 - 9) / (2 * 8 * 3);
    for (const auto& sample : report.samples)
      if (sample.x < -7.999) {
        EXPECT_NEAR(sample.engagement, std::acos(cosine) * 180 / kPi, 2e-3) << other;
      }
  }
}

TEST(VerifySimulateAfter, TheFloorOfAnotherProgramsRampIsNoEntry) {
  // The first ramps down from X10 to X60; the second cuts the wedge it left, in a full slot.
  const auto report =
      run_after("G21 G90\nG0 X10 Y20 Z5\nG1 Z0 F300\nG1 X60 Z-1 F1500\nG0 Z5\n",
                "G21 G90\nG0 X60 Y20 Z5\nG1 Z-1 F300\nG1 X10 F1500\nG0 Z5\n", rectangle(70, 40), 6);
  EXPECT_NEAR(engagement_near(report, 4, 30), 180, 1e-4);
  EXPECT_NEAR(report.engagement_max_deg, 180, 1e-4);
  EXPECT_LT(report.entry_mm, 0.1);  // straight down, on what the ramp's end left
}

TEST(VerifySimulate, BelowTheRampOfALevelAboveIsNoEntry) {
  // A ramp to Z-1 along the slot, back at Z-1, straight down in the room at its end, and the slot again at
  // Z-2: without a lift, all of the second level is full.
  const auto report =
      run("G21 G90\nG0 X10 Y20 Z5\nG1 Z0 F300\nG1 X60 Z-1 F1500\nG1 X10\nG1 Z-2 F300\nG1 X60 F1500\nG0 Z5\n",
          rectangle(70, 40));
  EXPECT_NEAR(engagement_near(report, 7, 35), 180, 1e-4);
  EXPECT_NEAR(report.engagement_max_deg, 180, 1e-4);
  for (const auto& sample : report.samples)
    if (sample.z < -1.999 && sample.x > 20) {
      EXPECT_FALSE(sample.entry) << sample.x;
    }
}

/// Lines too short for their descent to be written once ended the ramp: what it left before them was no
/// floor.
TEST(VerifySimulate, ALineTooShortToSinkIsPartOfItsRamp) {
  const std::string down = "G21 G90\nG0 X10 Y20 Z5\nG1 Z0 F300\nG1 X40 Z-0.5 F1500\n",
                    rest = "G1 X60 Z-1\nG1 X10\nG0 Z5\n";
  const auto along = [&](const std::string& between) {
    const auto report = run(down + between + rest, rectangle(70, 40));
    EXPECT_EQ(report.engagement_max_deg, 0) << between;
    return report.entry_mm;
  };
  const double plain = along("");
  EXPECT_GT(plain, 99);
  EXPECT_NEAR(along("G1 X40.0002\nG1 X40.005\n"), plain, 0.1);
  // One long enough is a cut of its own.
  EXPECT_GT(run(down + "G1 X45\n" + rest, rectangle(70, 40)).engagement_max_deg, 170);
}

TEST(VerifySimulate, TheLayerOfAnEntryIsWhatStandsAboveTheTip) {
  // Half a radius of a stroke sinks 0.03 mm of 50 : 1, 0.012 of 50 : 0.4.
  const std::string begin = "G21 G90\nG0 X10 Y20 Z5\nG1 Z0 F300\n";
  const std::string pocket = rectangle(70, 40);
  EXPECT_NEAR(run(begin + "G1 X60 Z-1 F1500\n", pocket).entry_layer_mm, 1, 0.032);
  EXPECT_NEAR(run(begin + "G1 X60 Z-0.4 F1500\n", pocket).entry_layer_mm, 0.4, 0.014);
  // Back at the floor of each way: the wedge it left is thickest where the way began.
  EXPECT_NEAR(run(begin + "G1 X60 Z-0.4 F1500\nG1 X10\nG1 X60 Z-0.8\nG1 X10\n", pocket).entry_layer_mm, 0.4,
              0.014);
  // There and back: at the beginning nothing was cut on the way there.
  EXPECT_NEAR(run(begin + "G1 X60 Z-0.4 F1500\nG1 X10 Z-0.8\n", pocket).entry_layer_mm, 0.8, 0.026);
  EXPECT_EQ(run(kBegin + "G1 X60 F1500\n", pocket).entry_layer_mm, 0);  // straight down
}

TEST(VerifySimulateAfter, WithinTheSlotOfAWiderToolAllIsAir) {
  const auto report =
      run_after(wide_slot(-2), "G21 G90\nG0 X10 Y20 Z5\nG0 Z-2\nG1 X60 F1500\nG1 Y18\nG1 X10\nG0 Z5\n",
                rectangle(70, 40));
  EXPECT_NEAR(report.air_percent, 100, 1e-9);
  EXPECT_EQ(report.engagement_peak_deg, 0);
  EXPECT_EQ(report.entry_mm, 0);
  EXPECT_EQ(report.rapid_cut_mm, 0);  // down in rapid motion, where nothing is left
  EXPECT_EQ(report.lower_bound_seconds, 0);
}

TEST(VerifySimulateAfter, BelowTheDepthOfTheOtherToolNothingIsGone) {
  const std::string program = "G21 G90\nG0 X10 Y20 Z5\nG1 Z-3 F300\nG1 X60 F1500\n";
  const auto report = run_after(wide_slot(-1), program, rectangle(70, 40));
  EXPECT_NEAR(engagement_near(report, 4, 35), 180, 1e-4);
  EXPECT_NEAR(report.entry_mm, 2, 1e-6);  // from the floor of the slot on
  EXPECT_NEAR(report.coverage_percent, run(program, rectangle(70, 40)).coverage_percent, 1e-9);
  EXPECT_NEAR(report.left_before_mm2, report.reachable_mm2, 1e-6);
  // As deep, but for a rounding no machine tells, is cut.
  EXPECT_NEAR(run_after(wide_slot(-3 + 1e-7), program, rectangle(70, 40)).air_percent, 100, 1e-9);
}

TEST(VerifySimulateAfter, TheEndOfASlotIsRound) {
  const auto report =
      run_after(wide_slot(-1), "G21 G90\nG0 X50 Y20 Z5\nG1 Z-1 F300\nG1 X64 F1500\n", rectangle(70, 40));
  EXPECT_EQ(engagement_near(report, 4, 61.9), 0);
  for (const double past : {2.5, 3.0, 3.5})  // the rim at angle a from ahead: past^2 + 9 + 6 past cos a > 25
    EXPECT_NEAR(engagement_near(report, 4, 60 + past),
                2 * std::acos((16 - past * past) / (6 * past)) * 180 / kPi, 1e-3)
        << past;
}

TEST(VerifySimulateAfter, CoverageIsOfWhatTheToolReachesCutByEither) {
  const auto report =
      run_after(wide_slot(-1), "G21 G90\nG0 X10 Y8 Z5\nG1 Z-1 F300\nG1 X60 F1500\n", rectangle(70, 40));
  const double reachable = 2800 - (4 - kPi) * 9, first = 50 * 10 + kPi * 25, second = 50 * 6 + kPi * 9;
  EXPECT_NEAR(report.reachable_mm2, reachable, 0.05);
  EXPECT_NEAR(report.coverage_percent, 100 * (first + second) / reachable, 2e-3);
  EXPECT_NEAR(report.left_before_mm2, reachable - first, 0.05);
  // The strip between the slots: 15 - 11.
  EXPECT_GE(report.uncut_width_mm, 4);
}

TEST(VerifySimulateAfter, AFaultOfAnEarlierProgramIsNamed) {
  const auto report = simulate({"part.ngc", kBegin + "G1 X20 F100\n"}, {"pocket.json", rectangle(70, 40)},
                               tool(6), {{{"first.ngc", "G41 D1\n"}, 10}});
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().message.find("first.ngc:1: G41"), std::string::npos) << report.error().message;
  const auto zero = simulate({"part.ngc", kBegin + "G1 X20 F100\n"}, {"pocket.json", rectangle(70, 40)},
                             tool(6), {{{"first.ngc", wide_slot(-1)}, 0}});
  ASSERT_FALSE(zero);
  EXPECT_NE(zero.error().message.find("earlier tool's diameter"), std::string::npos);
}

/// A program in inches for a pocket in mm: spots ten times as wide as the pocket were told, after a long
/// search.
TEST(VerifySimulate, NoUncutSpotIsWiderThanThePocket) {
  const auto report =
      run("G20 G90\nG0 X5 Y5 Z5\nG1 Z-1 F300\nG1 X25 F1500\nG3 X25 Y10 I0 J2.5\n", rectangle(30, 20));
  EXPECT_EQ(report.coverage_percent, 0);
  EXPECT_NEAR(report.uncut_width_mm, std::hypot(30, 20), 1e-9);
  ASSERT_FALSE(report.uncut.empty());
  EXPECT_LE(report.uncut.front().width_mm, std::hypot(30, 20) + 1e-9);
}

/// Straight down there is no length along which engagement could be seen.
TEST(VerifySimulate, ARapidStraightDownIntoMaterialIsFound) {
  const std::string pocket = rectangle(70, 40);
  EXPECT_NEAR(run("G21 G90\nG0 X10 Y10 Z5\nG0 Z-2\nG1 X20 F100\n", pocket).rapid_cut_mm, 2, 1e-9);
  const auto plunge = run("G21 G90\nG0 X10 Y10 Z5\nG1 Z-2 F100\nG1 X20\n", pocket);
  EXPECT_EQ(plunge.rapid_cut_mm, 0);
  EXPECT_NEAR(plunge.entry_mm, 2, 1e-9);
  // Into the slot cut before: all of the disc is air at X15, a tenth of a millimetre of it not at X20.1.
  const std::string slot = kBegin + "G1 X20 F100\nG0 Z5\n";
  EXPECT_EQ(run(slot + "G0 X15\nG0 Z-1\n", pocket).rapid_cut_mm, 0);
  EXPECT_NEAR(run(slot + "G0 X20.1\nG0 Z-1\n", pocket).rapid_cut_mm, 1, 1e-9);
}

TEST(VerifySimulate, ThePostInARingIsMaterialUnderAPlungingTool) {
  // A ring leaves a post of 0.5 mm in the middle; the rim of the tool over it meets nothing.
  const auto report =
      run("G21 G90\nG0 X3.25 Y0 Z5\nG1 Z-1 F100\nG3 X3.25 Y0 I-3.25 J0 F1500\nG0 Z5\nG0 X0 Y0\nG0 Z-1\n",
          disc(16));
  EXPECT_NEAR(report.rapid_cut_mm, 1, 1e-9);
}

TEST(VerifySimulate, TheBoundOnTheTimeCountsEveryLevel) {
  const std::string pass = "G1 X60 F1500\n";
  const double one = 50 * 6 / (0.4 * 6 * 25);
  EXPECT_NEAR(run(kBegin + pass, rectangle(70, 40)).lower_bound_seconds, one, 1e-6);
  EXPECT_NEAR(
      run(kBegin + pass + "G0 Z5\nG0 X10\nG1 Z-2 F300\n" + pass, rectangle(70, 40)).lower_bound_seconds,
      2 * one, 1e-6);
  // What an earlier tool cut needs no time: 1 mm stays beside the slot.
  EXPECT_NEAR(
      run_after(wide_slot(-1), "G21 G90\nG0 X20 Y23 Z5\nG1 Z-1 F300\nG1 X50 F1500\n", rectangle(70, 40))
          .lower_bound_seconds,
      30 / (0.4 * 6 * 25), 1e-3);
}

// ---- open edges

/// 70 x 40 without a wall at x = 70.
const std::string kOpenSide =
    R"({"units":"mm","outer":[{"line":{"from":[0,0],"to":[70,0]}},{"line":{"from":[70,0],"to":[70,40]},"open":true},)"
    R"({"line":{"from":[70,40],"to":[0,40]}},{"line":{"from":[0,40],"to":[0,0]}}]})";

TEST(VerifySimulateOpen, TheToolMayLeaveOverAnOpenEdgeAndMeetsNothingThere) {
  const std::string program = "G0 X60 Y20 Z5\nG1 Z-1 F300\nG1 X79 F1500\n";
  const auto open = run(program, kOpenSide);
  EXPECT_NEAR(open.gouge_mm, 0, 1e-9);
  EXPECT_NEAR(run(program, rectangle(70, 40)).gouge_mm, 12, 2e-3);
  EXPECT_NEAR(engagement_near(open, 3, 65), 180, 1e-4);
  // Of the rim what is short of x = 70: 3 cos(a) < 70 - x.
  std::size_t looked = 0;
  for (const auto& sample : open.samples) {
    if (!(sample.x > 67.1 && sample.x < 69.9)) continue;
    EXPECT_NEAR(sample.engagement, 180 - 2 * std::acos((70 - sample.x) / 3) * 180 / kPi, 1e-4) << sample.x;
    ++looked;
  }
  EXPECT_GT(looked, 50U);
  EXPECT_EQ(engagement_near(open, 3, 72), 0);
}

TEST(VerifySimulateOpen, BeyondTheEndsOfTheEdgeAndFarOutItIsAGouge) {
  // The walls go on straight: 0.1 mm too near to the one at y = 0.
  EXPECT_NEAR(run("G0 X60 Y2.9 Z5\nG1 Z-1 F300\nG1 X75 F1500\n", kOpenSide).gouge_mm, 0.1, 1e-9);
  // Four radii are known to be air: to x = 82.
  EXPECT_NEAR(run("G0 X60 Y20 Z5\nG1 Z-1 F300\nG1 X80 F1500\n", kOpenSide).gouge_mm, 1, 2e-3);
  EXPECT_NEAR(run("G0 X10 Y2.9 Z5\nG1 Z-1 F300\nG1 X20 F1500\n", kOpenSide).gouge_mm, 0.1, 1e-9);
}

TEST(VerifySimulateOpen, CornersAtAnOpenEdgeCanBeReachedAndAirIsNotCounted) {
  const auto report = run(kBegin + "G1 X76 F1500\n", kOpenSide);
  const double reachable = 2800 - (2 - kPi / 2) * 9, swept = 60 * 6 + kPi * 4.5;
  EXPECT_NEAR(report.reachable_mm2, reachable, 0.05);
  EXPECT_NEAR(report.coverage_percent, 100 * swept / reachable, 1e-3);
  EXPECT_EQ(report.unreachable.size(), 2U);
}

TEST(VerifySimulateOpen, AWallThatGoesOnFromAnOpenEdgesEndHasAirBehindIt) {
  // Open at x = 30: the strip of air before it, to x = 42, lies on the wall y = 30, which ends in an arc
  // at 38.3. There a thorn of material begins, between the arc and the strip. Turned, ends and tangents are
  // rounded.
  for (const double turn : {0.0, 0.1}) {
    const auto at = [&](double x, double y) {
      return fmt::format("[{},{}]", std::cos(turn) * x - std::sin(turn) * y,
                         std::sin(turn) * x + std::cos(turn) * y);
    };
    const auto line = [&](const std::string& from, const std::string& to, const char* more = "") {
      return fmt::format(R"({{"line":{{"from":{},"to":{}}}{}}})", from, to, more);
    };
    const std::string pocket = fmt::format(
        R"({{"units":"mm","outer":[{},{},{{"arc":{{"from":{},"to":{},"centre":{},"ccw":true}}}},{},{},{},{}]}})",
        line(at(0, 0), at(46, 0)), line(at(46, 0), at(46, 22.3)), at(46, 22.3), at(38.3, 30), at(38.3, 22.3),
        line(at(38.3, 30), at(30, 30)), line(at(30, 30), at(30, 60), R"(,"open":true)"),
        line(at(30, 60), at(0, 60)), line(at(0, 60), at(0, 0)));
    const double corner = 1 - kPi / 4, drawn = 46 * 30 + 30 * 30 - 7.7 * 7.7 * corner;
    const auto report = run("G0 X10 Y10 Z5\nG1 Z-1 F300\nG1 X20 F1500\n", pocket);
    EXPECT_NEAR(report.reachable_mm2, drawn - 3 * 9 * corner, 0.05) << turn;
    // All three corners, and nothing beside the thorn.
    for (const auto& spot : report.unreachable) {
      const double x = std::cos(turn) * spot.x + std::sin(turn) * spot.y;
      const double y = std::cos(turn) * spot.y - std::sin(turn) * spot.x;
      EXPECT_TRUE((x < 3 || x > 43) && (y < 3 || y > 57)) << turn << ": " << x << ", " << y;
    }
  }
}

TEST(VerifySimulateOpen, AnOpenArcIsAsOpen) {
  const std::string pocket =
      R"({"outer":[{"arc":{"from":[16,0],"to":[-16,0],"centre":[0,0],"ccw":true},"open":true},)"
      R"({"arc":{"from":[-16,0],"to":[16,0],"centre":[0,0],"ccw":true}}]})";
  const auto report = run("G0 X0 Y0 Z5\nG1 Z-1 F300\nG1 Y24 F1500\n", pocket);
  EXPECT_NEAR(report.gouge_mm, 0, 1e-9);
  for (const auto& sample : report.samples) {
    if (std::abs(sample.y - 14) < 0.026) {
      const double cosine = (256 - sample.y * sample.y - 9) / (6 * sample.y);
      EXPECT_NEAR(sample.engagement, 180 - 2 * std::acos(cosine) * 180 / kPi, 1e-3);
    }
  }
  EXPECT_NEAR(run("G0 X0 Y0 Z5\nG1 Z-1 F300\nG1 Y-14 F1500\n", pocket).gouge_mm, 1, 2e-3);
}

TEST(VerifySimulateOpen, DownBesideAnOpenEdgeIsNoEntry) {
  EXPECT_EQ(run("G0 X74 Y20 Z5\nG0 Z-1\nG1 X60 F1500\n", kOpenSide).rapid_cut_mm, 0);
  EXPECT_NEAR(run("G0 X72 Y20 Z5\nG0 Z-1\nG1 X60 F1500\n", kOpenSide).rapid_cut_mm, 1, 1e-9);
  std::string wrong = kOpenSide;
  wrong.replace(wrong.find("true"), 4, "\"so\"");
  EXPECT_NE(complaint_of(kBegin + "G1 X20 F100\n", wrong).find("open is neither true nor false"),
            std::string::npos);
}

TEST(VerifySimulate, WhatItCannotJudgeIsRefusedByName) {
  const std::string pocket = rectangle(70, 40);
  const auto says = [&](const std::string& program, const std::string& words) {
    EXPECT_NE(complaint_of(program, pocket).find(words), std::string::npos)
        << program << complaint_of(program, pocket);
  };
  says(kBegin + "G41 D1\n", "part.ngc:4: G41 makes the control compute path or feed");
  says(kBegin + "G1 X#1 F100\n", "variable #1 is read and was not set");
  says(kBegin + "G3 X20 Y20 I1 J1 F100\n", "mm from its centre");
  says(kBegin + "G3 X20 Y20 F100\n", "without I, J or R");
  says(kBegin + "G3 X40 Y20 R2 F100\n", "no arc of radius");
  says("G1 X1 Y1 Z-1\n", "before any F");
  says("G91 G0 X1\n", "no block has said");
  says(kBegin + "G1 X1e9 F100\n", "no word of the block takes E");
  says(kBegin + "G1 X9999999 F100\n", "farther than");
  says("(open\n", "not closed");
  says("", "never goes below");
  says("G0 X1 Y1 Z1\n", "never goes below");
  EXPECT_NE(complaint_of(kBegin, rectangle(5, 40)).find("fits nowhere"), std::string::npos);
  EXPECT_NE(complaint_of(kBegin, "{}").find("pocket"), std::string::npos);
  EXPECT_NE(complaint_of(kBegin, pocket, tool(0)).find("tool diameter"), std::string::npos);
  EXPECT_NE(complaint_of(kBegin, pocket, tool(std::nan(""))).find("tool diameter"), std::string::npos);
}

/// Zigzag, two levels: some thousand stretches.
TEST(VerifySimulate, SaysHowFarItIsAndFindsTheSameWithOneThread) {
  std::string program = kBegin;
  for (const int z : {-1, -2}) {
    program += fmt::format("G1 Z{} F300\n", z);
    for (int row = 0; row < 30; ++row)
      program += fmt::format("G1 Y{} F1500\nX{}\n", 10 + 0.5 * row, row % 2 == 0 ? 60 : 10);
    program += "G0 Z5\nG0 X10 Y10\n";
  }
  SimulateOptions one = tool(6);
  one.threads = 1;
  std::vector<double> told;
  const auto alone = simulate({"part.ngc", program}, {"pocket.json", rectangle(70, 40)}, one, {},
                              [&](const Progress& progress) { told.push_back(progress.fraction); });
  ASSERT_TRUE(alone) << alone.error().message;
  ASSERT_GE(told.size(), 2U);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_GE(told.front(), 0);
  EXPECT_LE(told.back(), 1);
  const SimulateReport both = run(program, rectangle(70, 40));
  EXPECT_EQ(alone->coverage_percent, both.coverage_percent);
  EXPECT_EQ(alone->uncut_width_mm, both.uncut_width_mm);
  EXPECT_EQ(alone->gouge_mm, both.gouge_mm);
  EXPECT_EQ(alone->unreachable.size(), both.unreachable.size());
  EXPECT_EQ(alone->engagement_p95_deg, both.engagement_p95_deg);
  EXPECT_EQ(alone->samples.size(), both.samples.size());
}

TEST(VerifySimulate, SaysOnWhichSideTheMaterialIs) {
  // A slot, then a pass 2 mm to its left: the material is on the left going on, on the right coming back.
  const std::string slot = kBegin + "G1 X50 F1500\nY12\n";
  const auto right = run(slot + "X10\n", rectangle(70, 40));
  const auto left = run(kBegin + "G1 X50 F1500\nX10 Y10\nY12\nX50\n", rectangle(70, 40));
  const auto middle = [](const SimulateReport& report) {
    for (const EngagementSample& sample : report.samples)
      if (sample.y > 11.99 && std::abs(sample.x - 30) < 0.1) return sample;
    return EngagementSample{};
  };
  const double angle = std::acos(1 - 2 / 3.0) * 180 / kPi;
  EXPECT_NEAR(middle(right).engagement, angle, 1e-3);
  EXPECT_NEAR(middle(right).left, 0, 1e-3);
  EXPECT_NEAR(middle(left).engagement, angle, 1e-3);
  EXPECT_NEAR(middle(left).left, angle, 1e-3);
  EXPECT_NEAR(left.samples[100].left, 90, 1e-3);  // of 180 in the slot
}

TEST(VerifySimulate, SomeLinesAloneGiveTheSameSamples) {
  std::string program = kBegin;
  for (int row = 1; row < 12; ++row)
    program += fmt::format("G1 Y{} F1500\nX{}\n", 10 + 1.5 * row, row % 2 == 0 ? 60 : 10);
  const auto whole = run(program, rectangle(70, 40));
  const std::vector<LineRange> lines{{6, 6}, {9, 12}, {20, 21}};
  const auto some =
      engagement_on({"part.ngc", program}, {"pocket.json", rectangle(70, 40)}, tool(6), {}, lines);
  ASSERT_TRUE(some) << some.error().message;
  std::vector<EngagementSample> wanted;
  for (const EngagementSample& sample : whole.samples)
    if (std::any_of(lines.begin(), lines.end(),
                    [&](const LineRange& r) { return sample.line >= r.first && sample.line <= r.last; }))
      wanted.push_back(sample);
  ASSERT_EQ(some->size(), wanted.size());
  ASSERT_GT(wanted.size(), 1000U);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_EQ((*some)[i].x, wanted[i].x);
    EXPECT_NEAR((*some)[i].engagement, wanted[i].engagement, 1e-9);
    EXPECT_EQ((*some)[i].line, wanted[i].line);
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_simulate_test

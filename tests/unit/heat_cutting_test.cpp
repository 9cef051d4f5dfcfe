#include "lekalo/heat/cutting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace lekalo::heat::heat_cutting_test {
namespace {

constexpr double kPi = 3.141592653589793;

CuttingConditions conditions() {
  CuttingConditions c;
  c.tool_diameter = 6, c.teeth = 3, c.spindle_rpm = 8000;
  c.cutting_force = {600, 800}, c.force_exponent = {0.25, 0.25}, c.share = {0.05, 0.2};
  return c;
}

/// A slot along X, 1 mm deep, at 20 mm/s: 0.05 mm a tooth.
std::vector<ToolPiece> slot(int pieces = 40) {
  std::vector<ToolPiece> way;
  for (int i = 0; i < pieces; ++i) {
    ToolPiece piece;
    piece.start = i * 0.05, piece.seconds = 0.05, piece.length = 1, piece.line = 4;
    piece.from = {static_cast<double>(i), 0, -1}, piece.to = {i + 1.0, 0, -1};
    piece.rim = {{-1, 0, -kPi / 2, kPi / 2, 6}};
    way.push_back(piece);
  }
  return way;
}

TEST(HeatCutting, TheEnergyOfASlotIsItsForceTimesItsVolume) {
  const auto work = cutting_work(slot(), conditions(), -20);
  ASSERT_TRUE(work);
  EXPECT_DOUBLE_EQ(work->volume_mm3, 240);
  // The mean chip of half a turn is 2 f_z / pi.
  const double chip = 0.05 * 2 / kPi;
  EXPECT_NEAR(work->steps.front().chip_mm, chip, 1e-15);
  EXPECT_NEAR(work->work_j.least, 600 * std::pow(chip, -0.25) * 240e-3, 1e-9);
  EXPECT_NEAR(work->work_j.greatest, 800 * std::pow(chip, -0.25) * 240e-3, 1e-9);
  EXPECT_NEAR(work->seconds, 2, 1e-12);
  EXPECT_NEAR(work->cutting_seconds, 2, 1e-12);
  // P = k_c a_e a_p v_f
  EXPECT_NEAR(work->greatest_power_w.greatest, 800 * std::pow(chip, -0.25) * 6 * 1 * 20e-3, 1e-9);
}

TEST(HeatCutting, HeatIsBookedWithTheWorkpieceOrCarriedOff) {
  const auto work = cutting_work(slot(), conditions(), -20);
  ASSERT_TRUE(work);
  EXPECT_NEAR(work->into_workpiece_j.least, 0.05 * work->work_j.least, 1e-12);
  EXPECT_NEAR(work->into_workpiece_j.greatest, 0.2 * work->work_j.greatest, 1e-12);
  EXPECT_NEAR(work->carried_off_j.least, 0.8 * work->work_j.least, 1e-12);
  EXPECT_NEAR(work->carried_off_j.greatest, 0.95 * work->work_j.greatest, 1e-12);
}

TEST(HeatCutting, TheMeanChipIsThatOfTheArc) {
  for (const double phi : {0.2, 1.0, kPi / 2, 3.0}) {
    const double width = 3 * (1 - std::cos(phi));
    EXPECT_NEAR(mean_chip(0.05, 3, width, phi), 0.05 * (1 - std::cos(phi)) / phi, 1e-16);
  }
  EXPECT_EQ(mean_chip(0.05, 3, 0, 0), 0);
}

TEST(HeatCutting, TheForceIsThatOfKienzleWithItsIntervals) {
  CuttingConditions c = conditions();
  EXPECT_NEAR(specific_force(c, 1).least, 600, 1e-12);
  EXPECT_NEAR(specific_force(c, 1).greatest, 800, 1e-12);
  EXPECT_NEAR(specific_force(c, 0.0625).least, 1200, 1e-9);
  c.force_exponent = {0.2, 0.3}, c.wear = {1, 1.5};
  EXPECT_NEAR(specific_force(c, 0.1).least, 600 * std::pow(0.1, -0.2), 1e-9);
  EXPECT_NEAR(specific_force(c, 0.1).greatest, 1.5 * 800 * std::pow(0.1, -0.3), 1e-9);
  EXPECT_NEAR(specific_force(c, 10).least, 600 * std::pow(10, -0.3), 1e-9);
}

TEST(HeatCutting, TheFloorUnderAPlungeIsCutWithTheFeedDownwards) {
  ToolPiece piece;
  piece.seconds = 0.5, piece.line = 3, piece.floor_area = 9 * kPi;
  piece.from = {0, 0, 0}, piece.to = {0, 0, -2};
  const auto work = cutting_work({piece}, conditions(), -20);
  ASSERT_TRUE(work);
  ASSERT_EQ(work->steps.size(), 1U);
  const CutStep& step = work->steps.front();
  EXPECT_TRUE(step.floor);
  EXPECT_NEAR(step.volume_mm3, 18 * kPi, 1e-12);
  EXPECT_NEAR(step.chip_mm, 2 / 0.5 / 400, 1e-15);
}

TEST(HeatCutting, BelowTheStockThereIsNoMaterial) {
  auto way = slot();
  for (ToolPiece& piece : way) piece.rim[0].low_z = -3;
  ToolPiece plunge;
  plunge.start = 2, plunge.seconds = 1, plunge.floor_area = 10, plunge.from = {0, 0, -1},
  plunge.to = {0, 0, -3};
  way.push_back(plunge);
  const auto work = cutting_work(way, conditions(), -2);
  ASSERT_TRUE(work);
  EXPECT_NEAR(work->volume_mm3, 240 * 2 + 10, 1e-9);
  EXPECT_EQ(work->steps.front().low_z, -2);
  EXPECT_EQ(work->steps.back().low_z, -2);
}

TEST(HeatCutting, PiecesInAirAndDwellsTakeTimeAndNoWork) {
  auto way = slot();
  ToolPiece dwell;
  dwell.start = 2, dwell.seconds = 10;
  way.push_back(dwell);
  const auto work = cutting_work(way, conditions(), -20);
  ASSERT_TRUE(work);
  EXPECT_NEAR(work->seconds, 12, 1e-12);
  EXPECT_NEAR(work->cutting_seconds, 2, 1e-12);
  EXPECT_EQ(work->steps.size(), 40U);
}

std::string complaint_of(const std::vector<ToolPiece>& way, const CuttingConditions& c) {
  const auto work = cutting_work(way, c, -20);
  if (work) return "";
  EXPECT_EQ(work.error().code, ErrorCode::bad_input);
  return work.error().message;
}

TEST(HeatCutting, BadInputIsToldInOneSentence) {
  CuttingConditions c = conditions();
  c.teeth = 0;
  EXPECT_EQ(complaint_of(slot(), c),
            "the tool has 0 teeth; state how many there are, since chips have no thickness without");
  c = conditions(), c.spindle_rpm = 0;
  EXPECT_EQ(complaint_of(slot(), c),
            "the spindle turns 0 times a minute; state its speed, since chips have no thickness without");
  c = conditions(), c.tool_diameter = std::nan("");
  EXPECT_EQ(complaint_of(slot(), c), "the tool's diameter is nan mm; it has to be above 0");
  c = conditions(), c.cutting_force = {0, 0};
  EXPECT_EQ(complaint_of(slot(), c), "the cutting force k_c1.1 is 0 to 0 N/mm2; it has to be above 0");
  c = conditions(), c.wear = {0.5, 1};
  EXPECT_EQ(
      complaint_of(slot(), c),
      "wear makes the cutting force 0.5 to 1 times as large; it has to be from 1, for a sharp edge, to 5");
  c = conditions(), c.share = {0.2, 1.5};
  EXPECT_EQ(complaint_of(slot(), c),
            "the share of the power that heats the workpiece is 0.2 to 1.5; it has to be from 0 to 1");
  EXPECT_EQ(complaint_of({}, conditions()), "the program cuts nothing of the stock");
  auto way = slot();
  way[3].rapid = true;
  EXPECT_EQ(complaint_of(way, conditions()),
            "line 4: G0 cuts material, which no feed per tooth is known of; move with G1 there");
}

}  // namespace
}  // namespace lekalo::heat::heat_cutting_test

// Programs of solids are shifted along Z as well: which numbers change, and what is refused.

#include <gtest/gtest.h>

#include <string>

#include "lekalo/nc/rewrite.hpp"

namespace lekalo::nc::nc_height_test {
namespace {

Rewritten moved(const std::string& program, double z, RewriteOptions options = {}) {
  options.z = z;
  auto result = rewrite_program(program, "p.nc", 10, 20, 0, options);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? *std::move(result) : Rewritten{};
}

std::string refusal(const std::string& program, RewriteOptions options = {}) {
  options.z = 1;
  const auto result = rewrite_program(program, "p.nc", 10, 20, 0, options);
  if (result) return "rewritten:\n" + result->program;
  EXPECT_EQ(result.error().code, ErrorCode::program_refused);
  return result.error().message;
}

TEST(NcHeight, EveryHeightIsShiftedAndNoStepIs) {
  EXPECT_EQ(
      moved(
          "G21 G90 G17\nG0 X1. Y2.\nG43 H1 Z5.\nG1 Z-1.25 F100.\nG91 X1. Z-.5\nG90 G2 X4. Y2. I1. Z0.\nM2\n",
          30.5)
          .program,
      "G21 G90 G17\nG0 X11.00000 Y22.00000\nG43 H1 Z35.50000\nG1 Z29.25000 F100.\nG91 X1. Z-.5\n"
      "G90 G2 X14.00000 Y22.00000 I1. Z30.50000\nM2\n");
}

TEST(NcHeight, ZAndROfACycleAreHeightsAndItsPecksAreNot) {
  EXPECT_EQ(
      moved("G21 G90\nG0 X0. Y0.\nZ5.\nG98 G83 X1. Y1. Z-3. R1. Q.5 F9.\nX2.\nG80\n"
            "G91 G81 X1. Z-2. R-4. L2\nG80\nM2\n",
            -2)
          .program,
      "G21 G90\nG0 X10.00000 Y20.00000\nZ3.00000\nG98 G83 X11.00000 Y21.00000 Z-5.00000 R-1.00000 Q.5 F9.\n"
      "X12.00000\nG80\nG91 G81 X1. Z-2. R-4. L2\nG80\nM2\n");
}

TEST(NcHeight, PlacesOfTheMachineStay) {
  EXPECT_EQ(
      moved("G21 G90\nG0 X1. Y2. Z5.\nG53 G0 Z0\nG0 X3.\nG0 Z5.\nG28 Z6.\nG91 G28 Z0.\nG90 M2\n", 1).program,
      "G21 G90\nG0 X11.00000 Y22.00000 Z6.00000\nG53 G0 Z0\nG0 X13.00000\nG0 Z6.00000\nG28 Z7.00000\n"
      "G91 G28 Z0.\nG90 M2\n");
}

TEST(NcHeight, ArcsOfUprightPlanesKeepTheirShapeOrBecomeChordsAtTheNewHeight) {
  EXPECT_EQ(moved("G21 G90 F9.\nG0 X0. Y0. Z5.\nG18 G2 X2. Z5. I1. K0.\nM2\n", 1).program,
            "G21 G90 F9.\nG0 X10.00000 Y20.00000 Z6.00000\nG18 G2 X12.00000 Z6.00000 I1. K0.\nM2\n");
  RewriteOptions options{.chord_tolerance = 0.5};
  options.z = 1;
  const auto turned =
      rewrite_program("G21 G90 F9.\nG0 X0. Y0. Z5.\nG18 G2 X2. Z5. I1. K0.\nM2\n", "p.nc", 0, 0, 1, options);
  ASSERT_TRUE(turned);
  EXPECT_NE(turned->program.find("Z5.000000"), std::string::npos) << turned->program;
  EXPECT_EQ(turned->program.find("G18"), std::string::npos) << turned->program;
}

TEST(NcHeight, OneRoundedShiftIsInTheBound) {
  const Rewritten made = moved("G21 G90 F9.\nG0 X1. Y2. Z5.\nG1 Z-1.1234567\nM2\n", 1.0000042);
  EXPECT_NE(made.program.find("Z6.00000\n"), std::string::npos) << made.program;
  EXPECT_NE(made.program.find("Z-0.1234567\n"), std::string::npos) << made.program;
  EXPECT_NEAR(made.rounding_mm, 4.2e-6, 1e-9);
  EXPECT_GE(made.rounding_mm, 4.2e-6 - 1e-16);
  // A program of inches rounds the shift to 1e-5 inch, in its millimetres too.
  const Rewritten inches = moved("G20 G90 F9.\nG0 X1. Y2. Z1.\nG21 G1 Z5.\nM2\n", 1);
  EXPECT_NE(inches.program.find("Z1.03937\n"), std::string::npos) << inches.program;
  EXPECT_NE(inches.program.find("Z5.999998\n"), std::string::npos) << inches.program;
  EXPECT_GE(inches.rounding_mm, 1 - 0.999998);
}

TEST(NcHeight, WithoutAShiftNoByteChanges) {
  const std::string program = "G21 G90 F9\nG0 X1 Y2 Z5\nG81 X1 Z-1 R2\nG80\nM2\n";
  RewriteOptions options;
  options.z = 0;
  const auto same = rewrite_program(program, "p.nc", 0, 0, 0, options);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->program, program);
  EXPECT_NE(same->notes.front().find("zero in X, Y and Z"), std::string::npos) << same->notes.front();
}

TEST(NcHeight, WhatCutsAtAnUnknownHeightIsRefused) {
  for (const auto& [program, sentence] :
       {std::pair{"G21 G90 F9\nG0 X1. Y2.\nG1 X5.\n", "p.nc:3: it cuts at a Z that the program has not said"},
        {"G21 G90 F9\nG0 X1. Y2. Z5.\nG53 G0 Z0\nG2 X5. I2.\n", "p.nc:4: it cuts at a Z"},
        {"G21 G90 F9\nG0 X1. Y2. Z5.\nG43 H2\nG1 X5.\n", "p.nc:4: it cuts at a Z"},
        {"G21 G90 F9\nG0 X1. Y2. Z5.\nG81 X1. Z-1. R1.\nG80\nG1 X5.\n", "p.nc:5: it cuts at a Z"},
        {"G21 G91 F9\nG0 Z5.\n", "p.nc:2: a step along Z from a Z that the program has not said"},
        {"G21 G90 F9\nG0 X1. Y2.\nG91 G28 Z-1.\n", "p.nc:3: a step along Z"},
        {"G21 G90 F9\nG0 X1. Y2.\nG81 X1. Z-1. R1.\n", "p.nc:3: a canned cycle from a Z"},
        {"G21 G90 F9\nG0 X1. Y2. Z5.\nG81 X1. Z-1. R1.\nG91 X1.\n", "p.nc:4: a canned cycle goes on under"}})
    EXPECT_EQ(refusal(program).rfind(sentence, 0), 0U) << refusal(program);
  EXPECT_EQ(refusal("G21 G90\nG28 Z9.\nG0 X1. Y2. Z5.\n", {.mode = RewriteMode::offset})
                .rfind("p.nc:2: G28 by a height of the program", 0),
            0U);
  // In the plane nothing is said of heights.
  EXPECT_TRUE(rewrite_program("G21 G90 F9\nG0 X1. Y2.\nG1 X5.\n", "p.nc", 10, 20, 0, {}));
}

TEST(NcHeight, TheFramesOfControlsHaveTheHeightToo) {
  const std::string program = "G21 G90 G17 G54 F9\nG0 X1. Y2.\nG1 Z5.\nM30\n";
  EXPECT_EQ(
      moved(program, 3.25, {.mode = RewriteMode::offset}).program,
      "G21 G90 G17 G54 F9\nG10 L2 P1 X10.00000 Y20.00000 Z3.25000 R0.000000000\nG0 X1. Y2.\nG1 Z5.\nM30\n");
  EXPECT_EQ(moved(program, 3.25, {.mode = RewriteMode::g68}).program,
            "G21 G90 G17 G54 F9\nG52 X10.00000 Y20.00000 Z3.25000\nG68 X0 Y0 R0.000\nG0 X1. Y2.\nG1 Z5.\n"
            "G69\nG52 X0 Y0 Z0\nM30\n");
  EXPECT_EQ(moved("G21 G90 G54 F9\nG1 Z5.\nM30\n", 3.25, {.mode = RewriteMode::offset}).program,
            "G21 G90 G54 F9\nG10 L2 P1 X10.00000 Y20.00000 Z3.25000 R0.000000000\nG1 Z5.\nM30\n");
}

}  // namespace
}  // namespace lekalo::nc::nc_height_test

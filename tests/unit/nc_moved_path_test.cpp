// Stretches of a path that are moved: which words are written anew, and which programs are refused.

#include "lekalo/nc/moved_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace lekalo::nc::nc_moved_path_test {
namespace {

using words::Control;

const std::string kHead = "G21 G90 G17 G94 G54\nG0 X0 Y0 Z5\nG1 Z-2 F200\n";

std::string move(const std::string& program, const std::vector<MovedMotion>& motions) {
  const Result<std::string> made = move_path(program, "p.ngc", Control::linuxcnc, motions);
  return made ? *made : made.error().message;
}

TEST(NcMovedPath, NothingMovedIsTheProgramItself) {
  const std::string program = kHead + "N40 g1x10 (on) y0\nG2 X0 Y10 I-10 J0 F900 ; round\nG0 Z5\nM2";
  EXPECT_EQ(move(program, {}), program);
  EXPECT_EQ(move(program, {{4, {{1, -2, {0, 0}}}}}), program);
}

TEST(NcMovedPath, ALineGoesToItsMovedEndAndTheNextToItsOwn) {
  EXPECT_EQ(move(kHead + "G1 X10 (on) F900\nG1 X20\nM2\n", {{4, {{1, -2, {0.01, -0.02}}}}}),
            kHead + "G1 X10.0100 Y-0.0200 (on) F900\nG1 X20.0000 Y0.0000\nM2\n");
}

TEST(NcMovedPath, ALineThatBendsBecomesLines) {
  EXPECT_EQ(move(kHead + "G1 X10 F900\nM2\n", {{4, {{0.5, -2, {0, 0.1}}, {1, -2, {0, 0}}}}}),
            kHead + "G1 X5.0000 Y0.1000 F900\nX10.0000 Y0.0000\nM2\n");
  // Nodes on one line are left out.
  EXPECT_EQ(move(kHead + "G1 X10 F900\nM2\n", {{4, {{0.5, -2, {0, 0.1}}, {1, -2, {0, 0.2}}}}}),
            kHead + "G1 X10.0000 Y0.2000 F900\nM2\n");
}

TEST(NcMovedPath, AnArcThatIsShiftedKeepsItsRadius) {
  const std::string made = move(kHead + "G1 X10 F900\nG3 X0 Y10 I-10 J0\nM2\n",
                                {{4, {{1, -2, {0.5, 0.25}}}}, {5, {{1, -2, {0.5, 0.25}}}}});
  EXPECT_NE(made.find("G3 X0.5000 Y10.2500 I-10.0000 J0.0000\n"), std::string::npos) << made;
}

TEST(NcMovedPath, AFullCircleIsWrittenByQuarters) {
  const std::string made =
      move(kHead + "G1 X10 F900\nG3 X10 Y0 I-10 J0\nM2\n",
           {{4, {{1, -2, {0.1, 0}}}},
            {5, {{0.25, -2, {0, 0.1}}, {0.5, -2, {-0.1, 0}}, {0.75, -2, {0, -0.1}}, {1, -2, {0.1, 0}}}}});
  // Between the nodes the moved way is no circle, by less than it is moved.
  EXPECT_NE(made.find("G3 X0.0000 Y10.1000 I"), std::string::npos) << made;
  EXPECT_NE(made.find("\nX-10.1000 Y0.0000 I"), std::string::npos) << made;
  EXPECT_NE(made.find("\nX0.0000 Y-10.1000 I"), std::string::npos) << made;
  EXPECT_NE(made.find("\nX10.1000 Y0.0000 I"), std::string::npos) << made;
}

TEST(NcMovedPath, WhatIsNotMovedIsRefusedWithItsLine) {
  const auto says = [](const std::string& lines, std::size_t line, const std::string& words) {
    const std::string made = move(kHead + lines + "M2\n", {{line, {{0.5, -2, {0, 0.1}}, {1, -2, {0, 0}}}}});
    EXPECT_NE(made.find(words), std::string::npos) << made;
  };
  says("G91 G1 X10\n", 4, "p.ngc:4: a motion under G91 belongs to the path that has to be moved");
  says("G1 X10 F900\nG18 G2 X0 Z-2 I-5 K0\n", 5, "p.ngc:5: an arc of G18 or G19");
  says("G1 X10 F900\nG2 X10 Y0 I-5 J0 P3\n", 5, "p.ngc:5: an arc of several turns");
  says("G93 G1 X10 F2\n", 4, "p.ngc:4: a motion under G93");
  says("G1 X10 F900 M0\n", 4, "p.ngc:4: a motion beside M0, M1, M2 or M30");
  says("#1=3\nG1 X10 F900\n", 5, "is not moved; write it out before");
}

TEST(NcMovedPath, WordsAreRoundedToTheDecimalsOfTheControl) {
  EXPECT_NE(move(kHead + "G1 X10 F900\nM2\n", {{4, {{1, -2, {0.00012345, 0}}}}}).find("X10.0001 "),
            std::string::npos);
}

TEST(NcMovedPath, RoundingIsThatOfTheUnitAndOfTheDecimalsThatAreWritten) {
  const auto rounding = [](const std::string& program, Control control) {
    const Result<MovedRounding> found = moved_path_rounding(program, "p.ngc", control);
    return found ? found->most : -1;
  };
  const double half = std::sqrt(2.0) / 2, arc = 1.3 * half;
  EXPECT_DOUBLE_EQ(rounding(kHead, Control::linuxcnc), half * 1e-4);
  EXPECT_DOUBLE_EQ(rounding(kHead, Control::fanuc), half * 1e-3);
  EXPECT_DOUBLE_EQ(rounding(kHead + "G2 X0. Y10. I0. J5.\n", Control::haas), arc * 1e-3);
  const std::string inches = "G20 G90 G17 G94 G54\nG0 X0. Y0. Z5.\nG1 Z-2. F200.\n";
  EXPECT_DOUBLE_EQ(rounding(inches, Control::grbl), half * 25.4e-5);
  EXPECT_DOUBLE_EQ(rounding(inches, Control::fanuc), half * 25.4e-4);
  // Words of its own have more decimals, of which some controls drop the last.
  const std::string finely = "G20 G90 G17 G94 G54\nG1 X0.00000 Y0.0 F9.\n";
  EXPECT_DOUBLE_EQ(rounding(finely, Control::fanuc), half * 25.4e-5);
  EXPECT_DOUBLE_EQ(moved_path_rounding(finely, "p.ngc", Control::haas)->dropped, 25.4e-4);
  EXPECT_EQ(moved_path_rounding(inches, "p.ngc", Control::haas)->dropped, 0);
  EXPECT_EQ(moved_path_rounding(finely, "p.ngc", Control::linuxcnc)->dropped, 0);
  EXPECT_FALSE(moved_path_rounding("#1=3\nG1 X#1\n", "p.ngc", Control::linuxcnc));
  // What is written is no further off.
  const Result<std::string> moved =
      move_path(inches + "G1 X1. F9.\n", "p.ngc", Control::fanuc, {{4, {{1, -2, {0.0013, 0}}}}});
  ASSERT_TRUE(moved);
  EXPECT_NE(moved->find("X1.0001 Y0.0000"), std::string::npos) << *moved;
}

}  // namespace
}  // namespace lekalo::nc::nc_moved_path_test

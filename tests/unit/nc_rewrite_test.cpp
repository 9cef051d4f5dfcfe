// Small programs with the exact bytes that come out. Turned by 90 degrees where it helps to see the numbers
// at a glance: (x, y) becomes (10 - y, 20 + x).

#include "lekalo/nc/rewrite.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>
#include <limits>

#include "support/rs274_reader.hpp"

namespace lekalo::nc_rewrite_test {
namespace {

using namespace nc;

constexpr double kRight = 1.5707963267948966;
constexpr double kDegree = 0.017453292519943295;

Rewritten rewritten(const std::string& program, double x, double y, double theta,
                    RewriteOptions options = {}) {
  auto result = rewrite_program(program, "part.ngc", x, y, theta, options);
  if (!result) ADD_FAILURE() << result.error().message;
  return result ? *result : Rewritten{};
}

std::string turned(const std::string& program) { return rewritten(program, 10, 20, kRight).program; }
std::string shifted(const std::string& program) { return rewritten(program, 10, -20, 0).program; }

/// The body under the words that every program here begins with.
std::string body(const std::string& program, std::string (*rewrite)(const std::string&)) {
  const std::string head = "G21 G90 G17\n";
  const std::string result = rewrite(head + program);
  EXPECT_EQ(result.substr(0, head.size()), head);
  return result.substr(head.size());
}

TEST(NcRewrite, TurnsAndShiftsXAndY) {
  EXPECT_EQ(body("G0 X1 Y2\n", turned), "G0 X8.00000 Y21.00000\n");
  EXPECT_EQ(body("G0 X1 Y2\nG1 X3 Y-4 Z-5 F100\n", turned),
            "G0 X8.00000 Y21.00000\nG1 X14.00000 Y23.00000 Z-5 F100\n");
}

TEST(NcRewrite, SuppliesTheMissingAxisBesideItsSister) {
  EXPECT_EQ(body("G0 X1 Y2\nX5\n", turned), "G0 X8.00000 Y21.00000\nX8.00000 Y25.00000\n");
  EXPECT_EQ(body("G0 X1 Y2\nY5\n", turned), "G0 X8.00000 Y21.00000\nX5.00000 Y21.00000\n");
  EXPECT_EQ(body("G0 X1 Y2\nN7 G1 Y5 Z1\n", turned), "G0 X8.00000 Y21.00000\nN7 G1 X5.00000 Y21.00000 Z1\n");
}

TEST(NcRewrite, SuppliesTwoWordsAtOnePlaceInOrder) {
  EXPECT_EQ(body("G0X0Y0\nG2I2Y0\n", turned), "G0X10.00000Y20.00000\nG2I0.00000J2.00000X10.00000Y20.00000\n");
}

TEST(NcRewrite, KeepsCaseAndSpacing) {
  EXPECT_EQ(body("g0x1y2z3\ng1y5z1(c)\n\tx 1.5 ; tail X9\n", turned),
            "g0x8.00000y21.00000z3\ng1x5.00000y21.00000z1(c)\n\tx 5.00000 y21.50000 ; tail X9\n");
}

TEST(NcRewrite, KeepsCommentsBlockNumbersTapeMarksAndLineEnds) {
  const std::string program =
      "%\r\nO0012\r\n(X1 Y1)\r\nN1 G21 (MSG,X9)\r\n\r\n/M8\r\nN2 G0 X0 Y0\r\nM30\r\n%";
  EXPECT_EQ(turned(program),
            "%\r\nO0012\r\n(X1 Y1)\r\nN1 G21 (MSG,X9)\r\n\r\n/M8\r\nN2 G0 X10.00000 Y20.00000\r\nM30\r\n%");
}

TEST(NcRewrite, KeepsBytesOutsideAsciiInComments) {
  const std::string program = "G21 (\xD0\xB4\xD0\xB5\xD1\x82\xD0\xB0\xD0\xBB\xD1\x8C)\nG0 X0 Y0 ; \xE9\n";
  EXPECT_EQ(turned(program),
            "G21 (\xD0\xB4\xD0\xB5\xD1\x82\xD0\xB0\xD0\xBB\xD1\x8C)\nG0 X10.00000 Y20.00000 ; \xE9\n");
}

TEST(NcRewrite, WritesAsManyDecimalsAsTheWordAndAtLeastFive) {
  EXPECT_EQ(body("G0 X1.1234567 Y2\n", shifted), "G0 X11.1234567 Y-18.0000000\n");
  EXPECT_EQ(body("G0 X1.12345678901234567 Y0\n", shifted).substr(0, 23), "G0 X11.1234567890123456");
  EXPECT_EQ(body("G20 G0 X1 Y2\n", shifted), "G20 G0 X1.39370 Y1.21260\n");
}

TEST(NcRewrite, NeverWritesANegativeZero) {
  EXPECT_EQ(body("G0 X-10.000001 Y20.000001\n", shifted), "G0 X-0.000001 Y0.000001\n");
  EXPECT_EQ(rewritten("G21\nG0 X-1.000001 Y1\n", 1, -1.000001, 0).program, "G21\nG0 X-0.000001 Y-0.000001\n");
  EXPECT_EQ(rewritten("G21\nG0 X0 Y0\n", -0.000001, -0.000004, 0).program, "G21\nG0 X0.00000 Y0.00000\n");
}

TEST(NcRewrite, APureShiftLeavesWhatItDoesNotChange) {
  EXPECT_EQ(body("G0 X1 Y2\nX5\nG2 X7 I1\nG91 G1 X1\nG3 I.5\n", shifted),
            "G0 X11.00000 Y-18.00000\nX15.00000\nG2 X17.00000 I1\nG91 G1 X1\nG3 I.5\n");
  EXPECT_EQ(rewritten("G21\nG0 X1 Y2\n", 10, 0, 0).program, "G21\nG0 X11.00000 Y2\n");
}

TEST(NcRewrite, TurnsArcsByCentre) {
  EXPECT_EQ(body("G0 X0 Y0\nG2 X2 I1\nG3 X4 Y0 I1. J0\n", turned),
            "G0 X10.00000 Y20.00000\nG2 X10.00000 Y22.00000 I0.00000 J1.00000\n"
            "G3 X10.00000 Y24.00000 I0.00000 J1.00000\n");
  EXPECT_EQ(body("G0 X0 Y0\nG2 X1 Y-1 J-1\n", turned),
            "G0 X10.00000 Y20.00000\nG2 X11.00000 Y21.00000 I1.00000 J0.00000\n");
}

TEST(NcRewrite, TurnsFullCirclesAndHelices) {
  EXPECT_EQ(body("G0 X0 Y0\nG2 I1\nG3 J2 Z-3 P4\nG2 X0 Y0 I1.\n", turned),
            "G0 X10.00000 Y20.00000\nG2 I0.00000 J1.00000\nG3 I-2.00000 J0.00000 Z-3 P4\n"
            "G2 X10.00000 Y20.00000 I0.00000 J1.00000\n");
}

TEST(NcRewrite, PassesRadiiThatDifferByWhatCamSystemsRound) {
  const auto passes = [](const std::string& program) {
    return rewrite_program(program, "p", 1, 2, 0.5, {}).has_value();
  };
  EXPECT_TRUE(passes("G21\nG0 X0 Y0\nG2 X20.028 I10\n"));  // 0.02 sqrt(2) mm is 0.02828
  EXPECT_FALSE(passes("G21\nG0 X0 Y0\nG2 X20.029 I10\n"));
  EXPECT_TRUE(passes("G21\nG0 X0 Y0\nG2 X200.1 I100\n"));  // 0.1 % of the radius
  EXPECT_FALSE(passes("G21\nG0 X0 Y0\nG2 X200.11 I100\n"));
  EXPECT_TRUE(passes("G20\nG0 X0 Y0\nG2 X2.0028 I1\n"));  // 0.002 sqrt(2) inch
  EXPECT_FALSE(passes("G20\nG0 X0 Y0\nG2 X2.0029 I1\n"));
}

TEST(NcRewrite, TurnsAbsoluteArcCentres) {
  EXPECT_EQ(body("G0 X1 Y0\nG90.1 G2 X3 Y0 I2 J0\n", turned),
            "G0 X10.00000 Y21.00000\nG90.1 G2 X10.00000 Y23.00000 I10.00000 J22.00000\n");
  EXPECT_EQ(body("G0 X1 Y0\nG90.1 G2 X3 I2 J0\nG91.1 G2 X5 I1\n", shifted),
            "G0 X11.00000 Y-20.00000\nG90.1 G2 X13.00000 I12.00000 J-20.00000\nG91.1 G2 X15.00000 I1\n");
}

TEST(NcRewrite, KeepsArcsByRadius) {
  EXPECT_EQ(body("G0 X0 Y0\nG2 X2 R1.\nG3 Y3 R-4\n", turned),
            "G0 X10.00000 Y20.00000\nG2 X10.00000 Y22.00000 R1.\nG3 X7.00000 Y22.00000 R-4\n");
}

TEST(NcRewrite, GivesShortArcsByRadiusTheDecimalsThatHoldTheirCentre) {
  // 0.1 mm of chord under R 100: one unit of the fifth decimal would turn the chord by 1e-4 and move the
  // centre 0.01.
  const auto result = rewritten("G21\nG0 X0 Y0\nG2 X0.1 Y0 R100\n", 0.1234567, 0.7654321, 0.3);
  EXPECT_EQ(result.program, "G21\nG0 X0.1234567 Y0.7654321\nG2 X0.2189903 Y0.7949841 R100\n");
  EXPECT_LT(result.rounding_mm, 1e-4);
}

TEST(NcRewrite, MoreDecimalsGoToTheBlockThatDecidedWhereTheArcStarts) {
  // A full circle in between ends where it starts; so does, under a pure shift, an incremental move keep its
  // bytes.
  const auto after_circle =
      rewritten("G21\nG0 X0 Y0\nG2 X0 Y0 I1\nG2 X0.1 Y0 R100\n", 0.1234567, 0.7654321, 0.3);
  EXPECT_EQ(after_circle.program.substr(0, 34), "G21\nG0 X0.1234567 Y0.7654321\nG2 X0");
  EXPECT_LT(after_circle.rounding_mm, 1e-4);
  const auto after_step =
      rewritten("G21\nG0 X0 Y0\nG91 G1 X1\nG90 G2 X1.100004 Y0 R100\n", 0.1234567, 0.7654321, 0);
  EXPECT_EQ(after_step.program,
            "G21\nG0 X0.1234567 Y0.7654321\nG91 G1 X1\nG90 G2 X1.22346070 Y0.76543210 R100\n");
}

TEST(NcRewrite, AVeryShortArcDoesNotBecomeAFullTurnNorAFullTurnLessAHairAShortArc) {
  for (const char* way : {"G2", "G3"})
    for (int k = 0; k < 100; ++k) {
      const std::string program = std::string("G21\nG0 X1.5 Y0.\n") + way + " X1.5 Y-0.000005 I-1.5\n";
      const auto written = rs274::Reader().read(rewritten(program, 0.3, 0.7, 0.06 * k).program).back();
      const auto original = rs274::Reader().read(program).back();
      EXPECT_NEAR(static_cast<double>(written.sweep), static_cast<double>(original.sweep), 1e-4)
          << k << program;
    }
}

TEST(NcRewrite, KeepsTheHalfCircleByRadiusAHalfCircle) {
  for (int k = 0; k < 50; ++k) {
    const auto result = rewritten("G21\nG0 X-7 Y3\nG3 X13 Y3 R10\n", 0.1 * k, 0.2, 0.13 * k);
    EXPECT_LT(result.rounding_mm, 1e-4) << k;
    EXPECT_EQ(result.notes.at(1).rfind("rewritten numbers have 5 decimals", 0), 0U) << result.notes.at(1);
  }
}

TEST(NcRewrite, AnEndThatIsTheStartStaysItToTheLastDigit) {
  // Written with other decimals the end would miss the start, and the full circle become an arc of no length.
  EXPECT_EQ(rewritten("G21\nG0 X0.1234567 Y0\nG2 X0.1234567 Y0 I1\n", 0, 0, 0.3).program,
            "G21\nG0 X0.1179427 Y0.0364839\nG2 X0.1179427 Y0.0364839 I0.95534 J0.29552\n");
  EXPECT_EQ(rewritten("G21\nG0 X0.1234567 Y0\nG91 G2 X0 Y0 I1\n", 0, 0, 0.3).program,
            "G21\nG0 X0.1179427 Y0.0364839\nG91 G2 X0.00000 Y0.00000 I0.95534 J0.29552\n");
}

TEST(NcRewrite, AnEndThatIsTheStartStaysItWhenItsWordHasMoreDecimals) {
  EXPECT_EQ(rewritten("G21\nG0 X0.5 Y0.25\nG2 X0.5000000 Y0.25 I1\n", 0, 0, 0.3).program,
            "G21\nG0 X0.40379 Y0.38659\nG2 X0.4037900 Y0.3865900 I0.95533 J0.29552\n");
}

TEST(NcRewrite, CountsTheCentreFromTheWrittenStart) {
  // From the exact start the rounding of start and centre would add up.
  const std::string program = "G21\nG0 X1.7 Y2.3\nG2 I3.1 J4.7\n";
  const rs274::Step original = rs274::Reader().read(program).back();
  for (int k = 1; k < 200; ++k) {
    const rs274::Step written = rs274::Reader().read(rewritten(program, 0.1, 0.2, 0.031 * k).program).back();
    const rs274::Point exact = rs274::Motion::turned(0.1, 0.2, 0.031 * k)(original.centre);
    EXPECT_LE(rs274::distance(exact, written.centre), 7.0711e-6L) << k;
  }
}

TEST(NcRewrite, IncrementalMovesDoNotAddUpTheirRounding) {
  std::string program = "G21\nG0 X0 Y0\nG91\n";
  for (int k = 0; k < 1000; ++k) program += "G1 X.1\n";
  const auto result = rewritten(program, 0, 0, 30 * kDegree);
  EXPECT_LT(result.rounding_mm, 7.1e-6);
  EXPECT_GT(result.rounding_mm, 1e-6);
}

TEST(NcRewrite, RepeatsOfACycleGetTheDecimalsThatKeepTheLastHole) {
  const auto result = rewritten("G21\nG0 X0 Y0\nG91 G81 X1 Y1 Z-1 R-1 L100\n", 0, 0, 0.3);
  EXPECT_EQ(result.program, "G21\nG0 X0.00000 Y0.00000\nG91 G81 X0.6598163 Y1.2508567 Z-1 R-1 L100\n");
  EXPECT_LT(result.rounding_mm, 1e-5);
}

TEST(NcRewrite, TurnsCyclesAndLeavesTheirOtherWords) {
  EXPECT_EQ(body("G0 X0 Y0 Z9\nG98 G81 X1 Y1 Z-3 R2\nX2\nG80\nG83 Y5 Z-3 R2 Q1\nG80 G0 X0\n", turned),
            "G0 X10.00000 Y20.00000 Z9\nG98 G81 X9.00000 Y21.00000 Z-3 R2\nX9.00000 Y22.00000\nG80\n"
            "G83 X5.00000 Y22.00000 Z-3 R2 Q1\nG80 G0 X5.00000 Y20.00000\n");
}

TEST(NcRewrite, ReadsInchesAs25Point4Mm) {
  EXPECT_EQ(rewritten("G20\nG0 X1 Y2\nG21 X25.4\n", 25.4, 0, 0).program,
            "G20\nG0 X2.00000 Y2\nG21 X50.80000\n");
  EXPECT_EQ(rewritten("G0 X1 Y2\n", 25.4, 0, 0, {.start_unit = lekalo::LengthUnit::inch}).program,
            "G0 X2.00000 Y2\n");
}

TEST(NcRewrite, LeavesZAndMachineWordsBeforeTheFirstPointAlone) {
  const std::string head = "G17 G40 G49 G64 P0.01\nT1 M6\nG43 H1\nS900 M3 M8\nG0 Z5.\nG4 P.5\n";
  EXPECT_EQ(turned("G21\n" + head + "G0 X0 Y0\n"), "G21\n" + head + "G0 X10.00000 Y20.00000\n");
}

TEST(NcRewrite, CountsTheBlocksAndStatesTheBound) {
  const auto result = rewritten("G21\nG0 X0 Y0\nG1 X1 F9\nG1 Z1\n", 0, 0, 30 * kDegree);
  EXPECT_EQ(result.motions, 2U);
  EXPECT_NEAR(result.rounding_mm, std::abs(std::cos(30 * kDegree) - 0.86603), 1e-15);
}

TEST(NcRewrite, LeavesACallOfABlockThatIsNotThereAndSaysSo) {
  const auto result = rewrite_program("G21 G90\nG0 X1. Y2.\nM97 P900\nX3.\n", "p", 10, 20, 0, {});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->program, "G21 G90\nG0 X11.00000 Y22.00000\nM97 P900\nX13.00000\n");
  EXPECT_EQ(result->control, lekalo::words::Control::haas);
  EXPECT_NE(
      std::ranges::find(result->notes,
                        "line 3: N900, which M97 calls, is not in this program: the control stops there, "
                        "as it does with the original"),
      result->notes.end());
}

TEST(NcRewrite, LeavesTheByteOrderMarkOut) {
  const auto result = rewrite_program("\xEF\xBB\xBFG21\n(\xC3\xA9)\nG0 X1 Y2\n", "p", 10, 20, 0, {});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->program, "G21\n(\xC3\xA9)\nG0 X11.00000 Y22.00000\n");
}

/// Posts for a fourth axis write A0 beside each hole. LinuxCNC refuses that, and Fanuc and Haas do not.
TEST(NcRewrite, KeepsARotaryAxisAtRestBesideAHole) {
  const std::string program = "G21 G90\nG0 X1. Y2. Z9. A0.\nG98 G81 X1. Y2. A0. Z-1. R1. F9.\nX3. A0.\nG80\n";
  const auto guessed = rewrite_program(program, "p", 10, 20, 0, {});
  ASSERT_TRUE(guessed) << guessed.error().message;
  EXPECT_EQ(guessed->control, lekalo::words::Control::fanuc);
  EXPECT_NE(guessed->program.find("\nX13.00000 A0.\n"), std::string::npos) << guessed->program;
  EXPECT_TRUE(rewrite_program(program, "p", 10, 20, 0, {.control = lekalo::words::Control::haas}));
  const auto refused =
      rewrite_program(program, "p", 10, 20, 0, {.control = lekalo::words::Control::linuxcnc});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("A without a line, an arc or a canned cycle of Haas or Fanuc"),
            std::string::npos)
      << refused.error().message;
}

TEST(NcRewrite, ReadsTheLettersOfACycleAsItsControlDoes) {
  const std::string begin = "G21 G90\nG0 X0. Y0. Z9.\n";
  const auto places = [&](const std::string& cycle, lekalo::words::Control control) {
    const auto result = rewrite_program(begin + cycle, "p", 10, 20, 0, {.control = control});
    return result ? result->program.substr(result->program.rfind("G90 G1")) : result.error().message;
  };
  // Three steps of 2 on Fanuc; on Haas K is the least peck, and there is one.
  EXPECT_EQ(places("G91 G83 X2. Z-1. R-1. Q.3 K3\nG80\nG90 G1 Y1.\nG91 X1.\n", lekalo::words::Control::fanuc),
            "G90 G1 Y21.00000\nG91 X1.\n");
  const auto three = rewrite_program(begin + "G91 G83 X.3333333 Z-1. R-1. Q.3 K3\n", "p", 0, 0, 1,
                                     {.control = lekalo::words::Control::fanuc});
  const auto one = rewrite_program(begin + "G91 G83 X.3333333 Z-1. R-1. I.3 J.1 K3.\n", "p", 0, 0, 1,
                                   {.control = lekalo::words::Control::haas});
  ASSERT_TRUE(three && one);
  EXPECT_NE(three->program.find("X0.18010075"), std::string::npos) << three->program;  // a decimal more
  EXPECT_NE(one->program.find("X0.1801008 "), std::string::npos) << one->program;
  EXPECT_NE(one->program.find("I.3 J.1 K3."), std::string::npos) << one->program;
}

TEST(NcRewrite, SaysInWhichFrameTheProgramMustRun) {
  const auto note_of = [](RewriteMode mode, ScanFrame frame) {
    return rewritten("G21\nG90 G17\nG55\nG0 X0. Y0.\nM2\n", 1, 2, 0.5,
                     {.mode = mode, .scan_frame = frame, .work_offset = 2})
        .notes.at(0);
  };
  EXPECT_EQ(
      note_of(RewriteMode::coordinates, ScanFrame::machine),
      "the scan was taken in machine coordinates: G55 must be zero in X and Y and without rotation when the "
      "program runs, and no G52 or G92 shift may be active");
  EXPECT_EQ(note_of(RewriteMode::coordinates, ScanFrame::wcs),
            "the scan was taken in G55: the program must run in the same G55, unchanged since the scan");
  EXPECT_EQ(
      note_of(RewriteMode::offset, ScanFrame::machine),
      "the scan was taken in machine coordinates: the program sets X, Y and rotation of G55 itself, whatever "
      "they were; its Z stays, and no G92 shift may be active");
  EXPECT_EQ(note_of(RewriteMode::g68, ScanFrame::machine),
            "the scan was taken in machine coordinates: G55 must be zero in X and Y when the program runs, "
            "and no other "
            "G52 shift or G68 rotation may be active");
  EXPECT_EQ(note_of(RewriteMode::g68, ScanFrame::wcs),
            "the scan was taken in G55: the program must run in the same G55, unchanged since the scan, and "
            "no other G52 "
            "shift or G68 rotation may be active");
}

TEST(NcRewrite, SaysWhatItHadToAssume) {
  const auto notes = rewritten("G1 Z5 F100\nG0 X1 Y2.\nG41 D1 X5.\n", 1, 2, 0.5).notes;
  ASSERT_EQ(notes.size(), 7U);
  EXPECT_EQ(notes[1], "rewritten numbers have 5 decimals; a control that reads fewer adds its own rounding");
  EXPECT_EQ(notes[2].rfind("line 1: feeds from wherever the machine stands", 0), 0U) << notes[2];
  EXPECT_EQ(notes[3].rfind("the program names no unit before line 2: millimetres are assumed", 0), 0U)
      << notes[3];
  EXPECT_EQ(notes[4].rfind("line 2: X1 has no decimal point", 0), 0U) << notes[4];
  EXPECT_EQ(notes[5].rfind("line 3: with G41/G42 the bound", 0), 0U) << notes[5];
  EXPECT_EQ(notes[6], "read as a program for LinuxCNC controls; --control names another");
}

// --------------------------------------------------------------------------------------------------------------
// mode offset

std::string with_offset(const std::string& program, double theta = 30 * kDegree,
                        RewriteOptions options = {}) {
  options.mode = RewriteMode::offset;
  return rewritten(program, 12.5, -7.25, theta, options).program;
}

TEST(NcOffset, WritesOneLineBeforeTheFirstMotion) {
  EXPECT_EQ(with_offset("%\n(c)\nG21 G54\nT1 M6\nG0 Z5\nG0 X0 Y0\nM2\n%\n"),
            "%\n(c)\nG21 G54\nT1 M6\nG10 L2 P1 X12.50000 Y-7.25000 R30.000000000\nG0 Z5\nG0 X0 Y0\nM2\n%\n");
  EXPECT_EQ(with_offset("G21 G55\r\nG0 X0 Y0\r\n", 0, {.work_offset = 2}),
            "G21 G55\r\nG10 L2 P2 X12.50000 Y-7.25000 R0.000000000\r\nG0 X0 Y0\r\n");
}

TEST(NcOffset, SaysUnitAndWorkOffsetItselfWhenTheProgramDoesNotYet) {
  EXPECT_EQ(with_offset("G20 G0 X0 Y0\n"),
            "G20 G54 G10 L2 P1 X0.49213 Y-0.28543 R30.000000000\nG20 G0 X0 Y0\n");
  EXPECT_EQ(with_offset("G0 X0 Y0\n"), "G21 G54 G10 L2 P1 X12.50000 Y-7.25000 R30.000000000\nG0 X0 Y0\n");
}

TEST(NcOffset, IsWrittenInTheUnitInForceBeforeTheFirstMotion) {
  EXPECT_EQ(with_offset("G21 G54\nG20 G0 X0 Y0\n"),
            "G21 G54\nG10 L2 P1 X12.50000 Y-7.25000 R30.000000000\nG20 G0 X0 Y0\n");
}

TEST(NcOffset, StandsBeforeCutterCompensation) {
  EXPECT_EQ(with_offset("G21 G54\nG41 D1\nG0 X0 Y0\n"),
            "G21 G54\nG10 L2 P1 X12.50000 Y-7.25000 R30.000000000\nG41 D1\nG0 X0 Y0\n");
}

TEST(NcOffset, WritesTheAngleWithinHalfATurn) {
  EXPECT_NE(with_offset("G21 G54\nG0 X0 Y0\n", -170 * kDegree).find(" R-170.000000000\n"), std::string::npos);
  EXPECT_NE(with_offset("G21 G54\nG0 X0 Y0\n", 350 * kDegree).find(" R-10.000000000\n"), std::string::npos);
  EXPECT_NE(with_offset("G21 G54\nG0 X0 Y0\n", 740 * kDegree).find(" R20.000000000\n"), std::string::npos);
}

TEST(NcOffset, LeavesAProgramWithoutMotionAlone) {
  const auto result = rewritten("G21\nM3 S100\nM2\n", 1, 2, 3, {.mode = RewriteMode::offset});
  EXPECT_EQ(result.program, "G21\nM3 S100\nM2\n");
  EXPECT_EQ(result.motions, 0U);
  EXPECT_EQ(result.rounding_mm, 0);
}

TEST(NcOffset, BoundsWhatRoundingTheAngleDoesFarFromTheOrigin) {
  const auto result =
      rewritten("G21 G54\nG0 X100000. Y0\nX99000. Y5\n", 0, 0, 1.0, {.mode = RewriteMode::offset});
  EXPECT_GT(result.rounding_mm, 0);
  EXPECT_LT(result.rounding_mm, 2e-5);
}

// --------------------------------------------------------------------------------------------------------------
// mode g68

std::string with_g68(const std::string& program, RewriteOptions options = {}) {
  options.mode = RewriteMode::g68;
  options.scan_frame = ScanFrame::wcs;
  return rewritten(program, 12.5, -7.25, 30 * kDegree, options).program;
}

TEST(NcG68, StandsRoundTheProgram) {
  EXPECT_EQ(with_g68("%\nO1\nG21 G90 G17 G54\nG0 X0 Y0\nG1 X10. F100\nM30\n%\n"),
            "%\nO1\nG21 G90 G17 G54\nG52 X12.50000 Y-7.25000\nG68 X0 Y0 R30.000\nG0 X0 Y0\nG1 X10. F100\n"
            "G69\nG52 X0 Y0\nM30\n%\n");
}

TEST(NcG68, SaysTheModesItNeeds) {
  EXPECT_EQ(with_g68("G0 X0 Y0\nM30\n"),
            "G21 G17 G90 G52 X12.50000 Y-7.25000\nG68 X0 Y0 R30.000\nG0 X0 Y0\nG69\nG52 X0 Y0\nM30\n");
}

TEST(NcG68, IsGivenInG90BeforeABlockThatSaysG91) {
  EXPECT_EQ(
      with_g68("G21 G17\nG91 G0 Z5\nG90 X0 Y0\nM2\n"),
      "G21 G17\nG90 G52 X12.50000 Y-7.25000\nG68 X0 Y0 R30.000\nG91 G0 Z5\nG90 X0 Y0\nG69\nG52 X0 Y0\nM2\n");
}

TEST(NcG68, IsCancelledWhereTheTextEnds) {
  const std::string head = "G21 G90 G17\nG52 X12.50000 Y-7.25000\nG68 X0 Y0 R30.000\n";
  EXPECT_EQ(with_g68("G21 G90 G17\nG0 X0 Y0\n"), head + "G0 X0 Y0\nG69\nG52 X0 Y0\n");
  EXPECT_EQ(with_g68("G21 G90 G17\nG0 X0 Y0"), head + "G0 X0 Y0\nG69\nG52 X0 Y0");
  EXPECT_EQ(with_g68("G21 G90 G17\nG0 X0 Y0\n%\n"), head + "G0 X0 Y0\nG69\nG52 X0 Y0\n%\n");
  EXPECT_EQ(with_g68("G21 G90 G17\nG0 X0 Y0\nG81 X1 Y1 Z-1 R1\nM2\n"),
            head + "G0 X0 Y0\nG81 X1 Y1 Z-1 R1\nG80 G69\nG52 X0 Y0\nM2\n");
}

TEST(NcG68, RoundsTheAngleAboutTheMiddleOfTheProgram) {
  // 0.0004 degrees lost are 7e-6 rad: 0.7 mm at the origin's distance of 100 m, 70 nm within the part.
  const RewriteOptions options{.mode = RewriteMode::g68, .scan_frame = ScanFrame::wcs};
  const auto result = rewritten("G21 G90 G17\nG0 X100000. Y0.\nX100020.\n", 0, 0, 30.0004 * kDegree, options);
  EXPECT_NE(result.program.find("R30.000\n"), std::string::npos);
  EXPECT_NEAR(result.rounding_mm, 0.0004 * kDegree * 10, 1e-5);
  const auto finer =
      rewritten("G21 G90 G17\nG0 X100000. Y0.\nX100020.\n", 0, 0, 30.0004 * kDegree,
                {.mode = RewriteMode::g68, .scan_frame = ScanFrame::wcs, .g68_angle_decimals = 4});
  EXPECT_NE(finer.program.find("R30.0004\n"), std::string::npos);
}

// --------------------------------------------------------------------------------------------------------------
// requests that make no sense

TEST(NcRequest, IsChecked) {
  const auto code_of = [](double x, double y, double theta, RewriteOptions options) {
    const auto result = rewrite_program("G21\nG0 X0 Y0\n", "p", x, y, theta, options);
    return result ? std::string("accepted")
                  : std::to_string(exit_status(result.error().code)) + " " + result.error().message;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code_of(nan, 0, 0, {}), "2 p: the shift (nan, 0) is not within 1000000 mm");
  EXPECT_EQ(code_of(0, 2e6, 0, {}), "2 p: the shift (0, 2000000) is not within 1000000 mm");
  EXPECT_EQ(code_of(0, 0, nan, {}), "2 p: the angle nan is not within 65536 rad");
  EXPECT_EQ(code_of(0, 0, 0, {.work_offset = 10}), "2 p: work offset 10 is none of 1 (G54) to 9 (G59.3)");
  EXPECT_EQ(code_of(0, 0, 0, {.g68_angle_decimals = -1}), "2 p: -1 decimals of a degree are not 0 to 9");
  EXPECT_EQ(
      code_of(0, 0, 0, {.mode = RewriteMode::offset, .scan_frame = ScanFrame::wcs}),
      "2 p: mode offset replaces G54, whose present value is not known here, so it needs a scan in machine "
      "coordinates; for a scan in the work coordinate system use mode coordinates");
}

}  // namespace
}  // namespace lekalo::nc_rewrite_test

// The words of programs that the checker knows, what it refuses, and what both readers of programs accept.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "lekalo/base/nc_words.hpp"
#include "lekalo/nc/rewrite.hpp"
#include "verify/pocket/nc_moves.hpp"

namespace lekalo::verify::verify_words_test {
namespace {

using words::Control;

const std::string kBegin = "G21 G90 G17\nG0 Z5.\nG0 X10. Y10.\n";  // a word after it stands on line 4

std::string complaint_of(const std::string& program) {
  const auto moves = read_moves({"p.ngc", program}, 0);
  return moves ? "" : moves.error().message;
}

/// The moves of a program that is read, as `line` or `line*` for a rapid.
std::string lines_of(const std::string& program) {
  const auto moves = read_moves({"p.ngc", program}, 0);
  if (!moves) return moves.error().message;
  std::string lines;
  for (const Move& move : *moves) lines += fmt::format("{}{} ", move.line, move.rapid ? "*" : "");
  return lines;
}

constexpr std::array kControls{Control::linuxcnc, Control::haas, Control::fanuc, Control::grbl};

/// A block in which this word can stand, behind kBegin.
std::string block_with(const words::Word& word) {
  std::string text = fmt::format("{}{:g}", word.letter, word.tenths / 10.0);
  const auto takes = [&](char letter) { return word.takes.find(letter) != std::string_view::npos; };
  if (word.group == words::Group::motion && word.tenths > words::kCounterClockwise)
    return text + " X12. Y13. Z-1. R1. F100." + (takes('Q') ? " Q1." : "") + (takes('P') ? " P1" : "");
  if (word.letter == 'M') return text + (takes('P') ? " P1" : "");
  if (word.tenths == words::kClockwise || word.tenths == words::kCounterClockwise) return text + " I5. F100.";
  if (word.group == words::Group::once && word.tenths == words::kMachineFrame) return "G0 " + text + " Z0";
  if (word.group == words::Group::once && word.tenths != words::kDwell) return text + " Z3.";
  if (word.group == words::Group::motion) return text + " X12. F100.";
  if (takes('P') && word.group != words::Group::look_ahead) text += " P1";
  if (takes('H')) text += " H1";
  if (takes('D')) text += " D1";
  return text;
}

std::string checker_says(const std::string& program, Control control) {
  const auto moves = read_moves({"p.ngc", program}, 0, control);
  return moves ? "" : moves.error().message;
}

std::string rewriter_says(const std::string& program, Control control) {
  const auto moved = nc::rewrite_program(program, "p.ngc", 1, 2, 0.5, {.control = control});
  return moved ? "" : moved.error().message;
}

TEST(VerifyWords, EveryCodeThatIsNotKnownIsRefusedByNameByBothReaders) {
  std::size_t known = 0, refused = 0;
  for (const Control control : kControls)
    for (const char letter : {'G', 'M'})
      for (int tenths = 0; tenths <= 1999; tenths += letter == 'G' ? 1 : 10) {
        const std::string word = fmt::format("{}{:g}", letter, tenths / 10.0);
        if (words::word_at(letter, tenths, control) != nullptr) {
          ++known;
          continue;
        }
        ++refused;
        const std::string program = kBegin + word + "\nM2\n";
        if (tenths >= 970 && tenths <= 990 && letter == 'M') continue;  // subprograms are another matter
        EXPECT_EQ(checker_says(program, control), "p.ngc:4: " + word + " is not understood here");
        EXPECT_TRUE(rewriter_says(program, control).starts_with("p.ngc:4: " + word)) << word;
      }
  std::size_t rows = 0;
  for (const words::Word& word : words::kWords)
    for (const Control control : kControls) rows += words::knows(word, control) ? 1 : 0;
  EXPECT_EQ(known, rows);
  EXPECT_GT(refused, 7000U);
  for (const char* word : {"G0.05", "G-1", "G1000", "M3.5", "M-2", "G59.15"})
    EXPECT_NE(complaint_of(kBegin + word + "\nM2\n").find("is not understood here"), std::string::npos)
        << word;
}

/// The rewriter (src/nc) and the checker share no code, only the table of words.
TEST(VerifyWords, BothReadersOfProgramsTakeEveryWordOfTheTableForEachControl) {
  std::size_t taken = 0, not_judged = 0;
  for (const Control control : kControls)
    for (const words::Word& word : words::kWords) {
      if (!words::knows(word, control)) continue;
      if (word.group == words::Group::work_offset || word.group == words::Group::tool_length) continue;
      const bool taps =
          word.letter == 'G' && (word.tenths == 740 || word.tenths == 840 || word.tenths == 860);
      const std::string spindle = taps ? (word.tenths == 740 ? "S500 M4\n" : "S500 M3\n") : "";
      const std::string retract = control == Control::grbl ? "" : "G98\n";
      const std::string program = kBegin + retract + spindle + block_with(word) + "\n";
      SCOPED_TRACE(fmt::format("{}: {}", words::word_of(control), program));
      EXPECT_EQ(rewriter_says(program, control), "");
      if (word.judged) {
        ++taken;
        EXPECT_EQ(checker_says(program, control), "");
      } else {
        ++not_judged;
        EXPECT_NE(checker_says(program, control).find("which is not judged"), std::string::npos);
      }
    }
  EXPECT_GT(taken, 180U);
  EXPECT_GT(not_judged, 10U);
}

TEST(VerifyWords, ALetterAloneIsReadOnlyWhereItMovesOrNeedsNoCode) {
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if (letter == 'G' || letter == 'M') continue;
    const std::string complaint = complaint_of(kBegin + letter + "1\nM2\n");
    const std::string_view read = "FNSTXYZ", needy = "DEHIJKLPQRU", rotary = "ABC";
    if (read.find(letter) != std::string_view::npos)
      EXPECT_EQ(complaint, "") << letter;
    else if (letter == 'O')
      EXPECT_EQ(complaint, "p.ngc:4: subprograms are not understood");
    else if (rotary.find(letter) != std::string_view::npos)
      EXPECT_NE(complaint.find("turns the part"), std::string::npos) << complaint;
    else if (needy.find(letter) != std::string_view::npos)
      EXPECT_EQ(complaint, fmt::format("p.ngc:4: no word of the block takes {}", letter));
    else
      EXPECT_EQ(complaint, fmt::format("p.ngc:4: the word {} is not understood", letter));
  }
}

/// Else the rewriter writes a program that nobody confirms.
TEST(VerifyWords, BothReadersTakeARotaryWordInTheSameBlocks) {
  std::size_t taken = 0, refused = 0;
  for (const Control control : kControls)
    for (const char* before :
         {"", "G1 X12. F90.\n", "G2 I5. F90.\n", "G80\n", "G98 G81 X12. Z-1. R1. F90.\n"})
      for (const char* block : {"B0.", "A0. C0.", "M8 B0.", "X13. B0.", "G0 B0.", "G1 A0. F90.", "G3 B0.",
                                "G80 B0.", "G4 P1. B0."}) {
        const bool cycle = std::string_view(before).find("G81") != std::string_view::npos;
        if (cycle && (control == Control::grbl || *block == 'X')) continue;
        const std::string program = kBegin + before + block + "\nM2\n";
        SCOPED_TRACE(fmt::format("{}: {}", words::word_of(control), program));
        const bool takes = checker_says(program, control).empty();
        EXPECT_EQ(rewriter_says(program, control).empty(), takes);
        ++(takes ? taken : refused);
      }
  EXPECT_GT(taken, 40U);
  EXPECT_GT(refused, 40U);
}

TEST(VerifyWords, EachControlReadsItsOwnForms) {
  const std::string z_home = kBegin + "G1 Z-1. F99.\nG0 Z5.\nG28 G91 Z0\nG90\nG53 G0 Z0\nM30\n";
  for (const Control control : kControls) EXPECT_EQ(checker_says(z_home, control), "");
  for (const char* line : {"(a (b) c)", "G4 X1.", "D1", "G0 G28 Z9.", "G80 G0"}) {
    EXPECT_EQ(checker_says(kBegin + line + "\nM2\n", Control::fanuc), "") << line;
    EXPECT_NE(checker_says(kBegin + line + "\nM2\n", Control::linuxcnc), "") << line;
  }
  EXPECT_EQ(checker_says(kBegin + "/M8\nM2\n", Control::linuxcnc), "");
}

TEST(VerifyWords, LettersOfCyclesAreThoseOfTheControl) {
  struct Cycle {
    Control control;
    const char *block, *says;
  };
  const Cycle cases[] = {
      {Control::linuxcnc, "G98 G81 X12. Z-1. R1. F9. P1.", "no word of the block takes P"},
      {Control::linuxcnc, "G98 G73 X12. Z-1. R1. F9. Q1. P1.", "no word of the block takes P"},
      {Control::linuxcnc, "G98 G83 X12. Z-1. R1. F9. Q1. P1.", "no word of the block takes P"},
      {Control::linuxcnc, "G98 G85 X12. Z-1. R1. F9. P1.", "no word of the block takes P"},
      {Control::linuxcnc, "G98 G82 X12. Z-1. R1. F9. P1. Q1.", "no word of the block takes Q"},
      {Control::linuxcnc, "G98 G81 X12. Z-1. R1. F9. K2", "no word of the block takes K"},
      {Control::linuxcnc, "G98 G82 X12. Z-1. R1. F9. P1. L2", ""},
      {Control::haas, "G98 G81 X12. Z-1. R1. F9. P1. L2", ""},
      {Control::haas, "G98 G81 X12. Z-1. R1. F9. K2", "no word of the block takes K"},
      {Control::haas, "G98 G83 X12. Z-1. R1. F9. I1. J.2 K.2 Q1.", "pecks shaped by I, J and K"},
      {Control::fanuc, "G98 G81 X12. Z-1. R1. F9. P1. K2", ""},
      {Control::fanuc, "G98 G81 X12. Z-1. R1. F9. L2", "L beside a canned cycle, which not every Fanuc"},
      {Control::grbl, "G81 X12. Z-1. R1. F9.", "G81 is not understood here"},
  };
  for (const Cycle& one : cases) {
    const std::string said = checker_says(kBegin + one.block + "\nM2\n", one.control);
    if (*one.says == '\0')
      EXPECT_EQ(said, "") << one.block;
    else
      EXPECT_EQ(said.find(fmt::format("p.ngc:4: {}", one.says)), 0U) << one.block << " " << said;
  }
}

TEST(VerifyWords, AWholeNumberIsRefusedWhereTheControlMayCountIt) {
  for (const Control control : {Control::haas, Control::fanuc}) {
    EXPECT_NE(checker_says(kBegin + "G1 X20 F9.\n", control).find("X has no decimal point"),
              std::string::npos);
    EXPECT_NE(checker_says(kBegin + "G2 I5 F9.\n", control).find("I has no decimal point"),
              std::string::npos);
    EXPECT_EQ(checker_says(kBegin + "G1 X0 Z-1.5 F90.\n", control), "");
  }
  for (const Control control : {Control::linuxcnc, Control::grbl})
    EXPECT_EQ(checker_says(kBegin + "G1 X20 F9\n", control), "");
}

TEST(VerifyWords, SubprogramsAndVariablesAreThoseOfTheControl) {
  const std::string m97 = kBegin + "M97 P7\nM30\nN7 G1 X12. F9.\nM99\n",
                    m98 = kBegin + "M98 P7\nM30\nO7\nM99\n",
                    named = kBegin + "o<a> sub\no<a> endsub\no<a> call\nM2\n",
                    variable = kBegin + "#1=2\nG0 X#1\n", name = kBegin + "#<_wide>=2\nG0 X#<_wide>\n";
  struct Form {
    const std::string& program;
    unsigned controls;
  };
  for (const Form& form : {Form{m97, 2}, Form{m98, 7}, Form{named, 1}, Form{variable, 7}, Form{name, 1}})
    for (const Control control : kControls) {
      const std::string said = checker_says(form.program, control);
      if ((form.controls >> static_cast<unsigned>(control) & 1U) != 0)
        EXPECT_EQ(said, "") << form.program;
      else
        EXPECT_NE(said.find("is no word of this control"), std::string::npos) << form.program << said;
    }
  EXPECT_NE(checker_says(kBegin + "M97 P8\nM30\n", Control::haas).find("M97"), std::string::npos);
}

TEST(VerifyWords, CyclesAreReadAsTheMovesTheyMake) {
  EXPECT_EQ(lines_of(kBegin + "G99 G81 X20 Y20 Z-3 R1 F9\nX30\nG80\nG0 Z5\nM2\n"), "4* 4* 4 4* 5* 5 5* 7* ");
  EXPECT_EQ(complaint_of(kBegin + "G98 G81 X20 Y20 Z-3 F9\n"),
            "p.ngc:4: G81 without Z and R in its first block");
  EXPECT_EQ(complaint_of(kBegin + "G98 G83 X20 Z-3 R1 F9\n"), "p.ngc:4: G83 without Q in its first block");
  EXPECT_EQ(complaint_of(kBegin + "G98 G81 X20 Z-3 R-4 F9\n"), "p.ngc:4: R of a cycle is below its Z");
  EXPECT_EQ(complaint_of(kBegin + "G0 Z1\nG98 G81 X20 Z-3 R3 F9\nY1 R2\n"),
            "p.ngc:6: R of a cycle changed above the plane that it began at");
  EXPECT_EQ(complaint_of(kBegin + "G18 G81 X20 Z-3 R1 F9\n"), "p.ngc:4: a canned cycle outside the XY plane");
  EXPECT_EQ(complaint_of("G21 G90\nG81 X20 Y2 Z-3 R1 F9\n"),
            "p.ngc:2: a canned cycle from a place that no block has said");
}

TEST(VerifyWords, AnArcInAnotherPlaneIsReadAsChords) {
  const auto moves = read_moves({"p.ngc", kBegin + "G18 G2 X11 Z4 I1 K0 F9\nM2\n"}, 0);
  ASSERT_TRUE(moves) << moves.error().message;
  EXPECT_GT(moves->size(), 20U);
  for (const Move& move : *moves) {
    EXPECT_FALSE(move.arc);
    EXPECT_NEAR(std::hypot(move.to.x - 11, move.to_z - 5), 1, 1e-9);
  }
  EXPECT_EQ(moves->back().to_z, 4);
}

struct Refused {
  const char* program;  ///< after kBegin
  const char* says;
};

TEST(VerifyWords, WordsThatDoNotFitTogetherAreRefusedWithTheLine) {
  const Refused cases[] = {
      {"G0 G1 X1 F9\n", "4: G0 and G1 exclude each other"},
      {"G1 G1 X1 F9\n", "4: G1 and G1 exclude"},
      {"G80 G0 X1\n", "4: G80 and G0 exclude"},
      {"G90 G91\n", "4: G90 and G91 exclude"},
      {"M3 M5\n", "4: M3 and M5 exclude"},
      {"M7 M8\n", "4: M7 and M8 exclude"},
      {"M0 M30\n", "4: M0 and M30 exclude"},
      {"M0 M3 M8 M48 M64 P1\n", "4: more than 4 M words"},
      {"G4 P0 G1 X200 F9\n", "4: a dwell beside a motion"},
      {"G4 X1\n", "4: G4 without P"},
      {"G4 P0 G1\n", "4: a dwell beside a motion"},
      {"G4\n", "4: G4 without P"},
      {"G4 P-1\n", "4: P is below 0"},
      {"M62\n", "4: M62 without P"},
      {"M62 P1.5\n", "4: P is not a whole number"},
      {"G4 P1 M62\n", "4: two words of the block take P"},
      {"G1 X20 P1 F9\n", "4: no word of the block takes P"},
      {"G1 X20 I1 F9\n", "4: no word of the block takes I"},
      {"G1 X20 R1 F9\n", "4: no word of the block takes R"},
      {"G1 X20 H1 F9\n", "4: no word of the block takes H"},
      {"G1 X20 Q1 F9\n", "4: no word of the block takes Q"},
      {"G2 X20 I5 F9\nI5\n", "5: no word of the block takes I"},
      {"G2 X20 I5 F9\nR5\n", "5: no word of the block takes R"},
      {"G2 R5 F9\n", "4: an arc given by R ends where it begins"},
      {"G2 F9\n", "4: an arc without I, J or R"},
      {"G80\nX1\n", "5: a motion before any of G0, G1, G2, G3"},
      {"G80 X1\n", "4: a motion before any of G0, G1, G2, G3"},
      {"G43 H1\n", "4: G43 after the first motion"},
      {"G0 X1\nG54\n", "5: G54 after the first motion"},
      {"G0 X1\nG49\n", "5: G49 after the first motion"},
      {"G1 X1 F9\nT2\n", "5: a change of the tool after the first cut"},
      {"G1 X1 F9\nM6\n", "5: a change of the tool after the first cut"},
      {"G0 Z-1\nM6\n", "5: a change of the tool after the first cut"},
      {"M6\nG1 X1 F9\n", "5: a motion with feed from a place that no block has said"},
      {"M6\nG0 X1 Y1\nG0 Z-1\n", "6: G0 below Z 0 from a place that no block has said"},
      {"M6\nG91 G0 X1\n", "5: a step of X from a place that no block has said"},
      {"F9 G20\n", "4: a feed beside a change of its unit"},
      {"F9\nG94\nG1 X1\n", "6: a motion with feed before any F"},
      {"F-1\n", "4: a feed that is not above 0"},
      {"S-1 M3\n", "4: S is below 0"},
      {"T1.5\n", "4: T is not a whole number"},
      {"X1 X2\n", "4: X is given twice"},
      {"G0 X+-1\n", "4: X is not followed by a plain number"},
      {"G0 X1 2\n", "4: the character \"2\" is not understood"},
      {"G0 X[1\n", "4: an expression that is not understood"},
      {"#5220=2\n", "4: variable #5220 is not one of a program's own"},
      {"G0 X#7\n", "4: variable #7 is read and was not set"},
      {"#<_feed>=2\n", "4: the control alone sets <_FEED>"},
      {"#1=2 X1\n", "4: a variable that is neither set alone"},
      {"M98 P7\nG0 X1\nO7\nG0 X2\nM99\n", "6: the program runs into a subprogram"},
      {"M98 P7\n", "4: a subprogram that is not in this file"},
      {"/G0 X1\n", "4: a block that may be skipped"},
      {"/P1\n", "4: a block that may be skipped"},
      {"/M8 P1\n", "4: a block that may be skipped"},
      {"/F100\n", "4: a block that may be skipped"},
      {"G0 N10 X1\n", "4: N does not begin its block"},
      {"N10 N20\n", "4: N does not begin its block"},
      {"N1.5 X1\n", "4: N is not followed by a plain number"},
      {"N-1\n", "4: N is not followed by a plain number"},
      {"N1234567890\n", "4: N has more than 9 digits"},
      {"O100\n", "4: subprograms are not understood"},
      {"G0 X1\rY2\n", "4: a carriage return inside a line"},
      {"; note\rG1 X200\n", "4: a carriage return inside a line"},
      {"(py, x=1)\n", "4: a comment that acts on the control"},
      {"; abort, now\n", "4: a comment that acts on the control"},
      {"(a (b) c)\n", "4: a comment inside a comment"},
      {"%\n", "4: % after a beginning without %"},
      {"% G0\n", "4: % does not stand alone"},
      {"M2\nG1 X200 F9\n", "5: words after the end"},
      {"M30\nG1 X200 F9\n", "5: words after the end"},
      {"G3 X10.00001 I5 F9\n", "4: an arc of nearly no turn or a full one"},
      {"G3 X10.000001 Y10.000001 R20 F9\n", "4: an arc of nearly no turn or a full one"},
      {"G3 I0.001 F9\n", "4: the arc's ends are"},
      {"G3 X20.003 R5 F9\n", "4: no arc of radius 5"},
  };
  for (const Refused& one : cases)
    EXPECT_EQ(complaint_of(kBegin + one.program).find(fmt::format("p.ngc:{}", one.says)), 0U)
        << one.program << complaint_of(kBegin + one.program);
  EXPECT_NE(complaint_of(kBegin + std::string("(a\0b)\n", 6)).find("a control character"), std::string::npos);
  EXPECT_NE(complaint_of(kBegin + "(" + std::string(252, 'a') + ")\n").find("longer than 252"),
            std::string::npos);
}

TEST(VerifyWords, ThePlaceBeforeTheFirstMotionCutsNothing) {
  EXPECT_EQ(complaint_of("G21 G90\nG1 X1 Y1 Z5 F9\n"),
            "p.ngc:2: a motion with feed from a place that no block has said");
  EXPECT_EQ(complaint_of("G21 G90\nG0 X1 Y1\nG0 Z-1\n"),
            "p.ngc:3: G0 below Z 0 from a place that no block has said");
  EXPECT_EQ(complaint_of("G21 G90\nG0 Z-1\nG0 Z5\nG0 X1 Y1\n"),
            "p.ngc:2: G0 below Z 0 from a place that no block has said");
  EXPECT_EQ(lines_of("G21 G90\nG0 Z5\nG0 X1 Y1\nG0 Z1\nM2\n"), "4* ");
  EXPECT_TRUE(read_moves({"p.ngc", "G0 X1 Y1 Z-1\nG1 X2 F9\n"}, -1));
  for (const char* program : {"G0 X1 Y1\nG55\nG0 Z5\nG1 X2 F9\n", "G0 Z5\nG43 H1\nG0 X1 Y1\nG1 X2 F9\n"})
    EXPECT_EQ(complaint_of(program), "p.ngc:4: a motion with feed from a place that no block has said");
  // The length of the tool and the place of the part are chosen on the way to the first place.
  EXPECT_EQ(lines_of("G21 G90\nT1 M6\nG0 X1 Y1\nG54\nG0 X1 Y1\nG43 H1 Z5\nG43 H1 G54 G0 Z1\nM2\n"), "7* ");
}

TEST(VerifyWords, WhatLinuxcncReadsWithoutHarmIsRead) {
  EXPECT_EQ(lines_of("%\n(a; b) ; c (d\nN10 g21 G90\r\nN20G0Z5.\n\nN30 G00 X+1.Y-.5 S1000 M03 M8\nG4 P0.5\n"
                     "G64 P0.01 Q.01 G1 X2 F9\nG03 X2 I1 P2 Z4\nM64 P1\nG61.1 G97 G98 G94 F9\nM0\nX3 I.5\nM9 "
                     "M5\nM30\n%\n"),
            "8 9 13 ");
  // % ends a program that begins with it.
  EXPECT_EQ(lines_of("\n %\nG0 X1 Y1 Z1\nX2\n%\n(nothing)\n"), "4* ");
  EXPECT_NE(lines_of("%\nG0 X1 Y1 Z1\nX2\n%\nX3\n").find("5: words after the end"), std::string::npos);
  EXPECT_EQ(lines_of("%\nO0001 (A)\nG0 X1 Y1 Z1\nX2\nM30\n%\n"), "4* ");
}

TEST(VerifyWords, AHalfCircleByRadiusHasItsCentreInTheMiddle) {
  const auto moves = read_moves({"p.ngc", kBegin + "G2 X2009.999999999 R1000 F9\n"}, 0);
  ASSERT_TRUE(moves) << moves.error().message;
  EXPECT_EQ(moves->back().centre.y, 10);
}

}  // namespace
}  // namespace lekalo::verify::verify_words_test

// What does not pass, each with its line and reason; and nothing is returned.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <vector>

#include "lekalo/nc/rewrite.hpp"

namespace lekalo::nc_refusal_test {
namespace {

using namespace nc;

struct Case {
  const char* program;
  const char* message;
  RewriteMode mode = RewriteMode::coordinates;
};

void expect_refusals(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    RewriteOptions options;
    options.mode = c.mode;
    if (c.mode == RewriteMode::g68) options.scan_frame = ScanFrame::wcs;
    const auto result = rewrite_program(c.program, "p.nc", 1, 2, 0.5, options);
    ASSERT_FALSE(result.has_value()) << c.program << "\n" << result->program;
    EXPECT_EQ(result.error().code, lekalo::ErrorCode::program_refused) << c.program;
    EXPECT_EQ(result.error().message, std::string("p.nc:") + c.message) << c.program;
  }
}

TEST(NcRefusal, OfWordsThatMeanAnotherFrame) {
  expect_refusals({
      {"G21\nG53 G0 X0 Y0\n",
       "2: G53: it moves X and Y to a point of the machine while Z stands where the program left it; send Z "
       "home in a block before (G28 G91 Z0 or G53 G0 Z0)"},
      {"G28\n",
       "1: G28: it moves X and Y to a point of the machine while Z stands where the program left it; send Z "
       "home in a block before (G28 G91 Z0 or G53 G0 Z0)"},
      {"G21 G0\nG28 G91 Z0\nG43 H1 Z3\nG28 G91 X0 Y0\n",
       "4: G28: it moves X and Y to a point of the machine while Z stands where the program left it; send Z "
       "home in a block before (G28 G91 Z0 or G53 G0 Z0)"},
      {"G21\nG28 G91 Z0\nG90 G28 X0 Y0\n",
       "3: G28: it goes by a point of the program; write G91 X0 Y0, which goes by none"},
      {"G21\nG91 G0\nG53 Z0\n", "3: G53 under G91, where controls differ; write G90"},
      {"G28.1\n", "1: G28.1: it sets a point of the machine inside the program"},
      {"G30 X0\n",
       "1: G30: it moves X and Y to a point of the machine while Z stands where the program left it; send Z "
       "home in a block before (G28 G91 Z0 or G53 G0 Z0)"},
      {"G52 X1\n", "1: G52: it shifts the coordinate system inside the program"},
      {"G92 X0 Y0\n", "1: G92: it shifts the coordinate system inside the program"},
      {"G92.1\n", "1: G92.1: it shifts the coordinate system inside the program"},
      {"G10 L2 P1 X0\n", "1: G10: it sets offsets inside the program; set them on the control before"},
      {"G68 X0 Y0 R30\n", "1: G68: the program turns its own coordinates already"},
      {"G16\n", "1: G16: polar coordinates cannot be rewritten; give X and Y"},
      {"G51 X1 Y1\n", "1: G51: scaling and mirroring would change under the rotation"},
      {"G54.1 P3\n", "1: G54.1: extended work offsets are not rewritten; use G54 to G59.3"},
      {"G54\nG0 X0 Y0\nG55\n",
       "3: G55 is selected, but the motion is computed for G54: several work offsets cannot be rewritten; if "
       "G55 is the only one, choose it (work offset 2: --wcs 2)",
       RewriteMode::offset},
      {"G59.3\n",
       "1: G59.3 is selected, but the motion is computed for G54: several work offsets cannot be rewritten; "
       "if G59.3 is the only one, choose it (work offset 9: --wcs 9)",
       RewriteMode::offset},
      {"G54\nG0 X0 Y0\nG55\nX5\n",
       "4: moves in X while Y is not known; give both X and Y in the first move, and in the first one after "
       "a "
       "tool change"},
  });
}

TEST(NcRefusal, OfWhatIsNoPlainNumber) {
  expect_refusals({
      {"G0 X[1+2 Y0\n",
       "1: an expression that is not understood: a bracket ] is missing, or a word before it"},
      {"G0 X#1 Y0\n", "1: variable #1 is read and was not set in this program"},
      {"#<_x>=5\n", "1: #<_X> is set by the control alone"},
      {"#5221=5\n", "1: variable #5221: only #1 to #999 and named ones are a program's own"},
      {"#1=5 G1 X#1\n",
       "1: an assignment that is not understood, or beside other words; give it a block of its own"},
      {"#1=1\nG0 X[#1/0] Y0\n", "2: a division by 0"},
      {"#1=1\nM98 P2\nM30\nO2\nG0 X#1 Y0\nM99\n",
       "5: variable #1 in a subprogram, where controls differ whether it is the caller's; #100 to #999 and "
       "#<_name> are"},
      {"#1=-4\nG0 X[SQRT[#1]] Y0\n", "2: SQRT of a number below 0"},
      {"#1=1\nIF [#1 GT 0] GOTO 5\n",
       "2: IF, GOTO and WHILE cannot be rewritten; let the CAM system write them out"},
      {"G21\nG0 @5 ^30\n", "2: polar words (@ ^) cannot be rewritten; give X and Y"},
      {"G0 X1.2.3 Y0\n", "1: X1.2.3 is not a number"},
      {"G0 X-- Y0\n", "1: X-- is not a number"},
      {"G0 X Y0\n", "1: the letter X has no number"},
      {"G0 X1e5 Y0\n", "1: E without a word that takes it in its block"},
      {"G0 X1 2 Y0\n", "1: a blank inside the number after X1"},
      {"G0 X1 .5 Y0\n", "1: a blank inside the number after X1"},
      {"G0 X1234567890.1234567890 Y0\n", "1: the number of X1234567890.1234567890 has more than 18 digits"},
      {"G0 X.000000000000000001 Y0\n", "1: X has more than 17 decimals"},
      {"G0 X1000000.1 Y0\n", "1: X1000000.1 is beyond 1000000"},
  });
}

TEST(NcRefusal, OfSubprogramsAndHiddenState) {
  const std::string subprograms =
      "O words (subprograms, branches) cannot be rewritten; let the CAM system write them out";
  const std::string named = "1: " + subprograms, later = "2: " + subprograms;
  expect_refusals({
      {"o<drill> sub\n", "1: the subprogram O<DRILL> has no end in this file"},
      {"O100 sub\n", "1: the subprogram O100 has no end in this file"},
      {"O100 call [1]\n", "1: a call with arguments cannot be rewritten; let the CAM system write it out"},
      {"G21\nO200\n", later.c_str()},
      {"O1.5\n", named.c_str()},
      {"N1 O5\n", named.c_str()},
      {"M98 P100\n",
       "1: the subprogram O100 is not in this file; put it there, or let the CAM system write it out"},
      {"G21\nM98 P7\nO7\nM99\n", "3: the program runs into a subprogram; put M2 or M30 before it"},
      {"M97 P100\nN100 G0 X1\n", "1: the subprogram N100 has no M99"},
      {"o5 sub\no5 endsub\nM97 P1\no5 call\nM30\nN1 M99\n",
       "4: an O word beside SUB or CALL is a word of linuxcnc controls alone, and line 3 has one of others"},
      {"M99\n", "1: M99 in the main program, which then never ends"},
      {"G65 P9010\n",
       "1: G65: subprograms and macros cannot be rewritten; let the CAM system write them out"},
      {"M70\n", "1: M70: it saves or restores modal words, which are then not known here"},
      {"M110\n",
       "1: M110 is not on the list of words that can be rewritten; if it moves no axis, --allow FILE with "
       "the "
       "line M110 lets it pass"},
      {"M60\n", "1: M60: another pallet is another part"},
      {"M3.5\n", "1: M3.5 is not on the list of words that can be rewritten"},
      {"G21\n(PY,x=1)\n", "2: the comment (PY,...) acts on the control; remove it"},
      {";py,import os\n", "1: the comment (PY,...) acts on the control; remove it"},
      {"( probe open , f.txt)\n", "1: the comment (PROBEOPEN,...) acts on the control; remove it"},
      {"(LOGOPEN,f)\n", "1: the comment (LOGOPEN,...) acts on the control; remove it"},
      {"(abort,stop)\n", "1: the comment (ABORT,...) acts on the control; remove it"},
      {"(debug,x is #5420)\n",
       "1: the comment (DEBUG,...) reads variables, which may hold positions; remove it"},
      {"(LOG,#1)\n", "1: the comment (LOG,...) reads variables, which may hold positions; remove it"},
      {"(PRINT,#<_x>)\n", "1: the comment (PRINT,...) reads variables, which may hold positions; remove it"},
  });
}

TEST(NcRefusal, OfWordsOffTheList) {
  expect_refusals({
      {"G5 X1 Y1 I0 J0\n", "1: G5: splines are not rewritten; let the CAM system write lines and arcs"},
      {"G5.2\n", "1: G5.2: splines are not rewritten; let the CAM system write lines and arcs"},
      {"G7\n", "1: G7: lathe diameter and radius modes do not belong to a mill program"},
      {"G33 Z1 K1\n", "1: G33: thread cutting is not rewritten"},
      {"G38.2 Z-1\n", "1: G38.2: probing moves are not rewritten"},
      {"G41.1 D3\n", "1: G41.1: compensation by a radius in the program is not rewritten; use G41 with D"},
      {"G42.1 D3\n", "1: G42.1: compensation by a radius in the program is not rewritten; use G42 with D"},
      {"G96 S100\n", "1: G96: constant surface speed follows X, which would change under the rotation"},
      {"G12 I5\n",
       "1: G12: its circle begins in a direction of the machine; let the CAM system write it out"},
      {"G1.25\n", "1: G1.25 is not on the list of words that can be rewritten"},
      {"G-1\n", "1: G-1 is not on the list of words that can be rewritten"},
      {"G0 X0 Y0 A90\n", "1: rotary axis A: only X Y Z programs can be rewritten"},
      {"G0 B1\n", "1: rotary axis B: only X Y Z programs can be rewritten"},
      {"G0 C1\n", "1: rotary axis C: only X Y Z programs can be rewritten"},
      {"G21\nB0\nG0 X0 Y0\n", "2: a rotary axis alone while neither G0 nor G1 is active: write G0 before it"},
      {"G0 X0 Y0\nG2 I1\nA0\n",
       "3: a rotary axis alone while neither G0 nor G1 is active: write G0 before it"},
      {"G0 U1\n", "1: U without G4 in its block"},
      {"G0 W1\n", "1: axis W: only X Y Z programs can be rewritten"},
  });
}

TEST(NcRefusal, NamesAllUnknownWordsAtOnceWithTheirLinesAndTheWayOut) {
  expect_refusals({
      {"G21\nG187 P1\nM130\nG59.1\nG92 X0\nM130\n",
       "3: 4 words cannot be rewritten: lines 3, 6: M130 is not on the list of words that can be rewritten; "
       "if "
       "it moves no axis, --allow FILE with the line M130 lets it pass / line 4: G59.1 is not on the list of "
       "words that can be rewritten; LinuxCNC controls know it: --control linuxcnc / line 5: G92: it shifts "
       "the coordinate system inside the program"},
  });
  expect_refusals({
      {"G21\nIF [#1 GT 0] GOTO 5\nM130\n#1=2\nG51\nG0 X@1\nWHILE [1] DO1\n",
       "2: 4 words cannot be rewritten: line 2: IF, GOTO and WHILE cannot be rewritten; let the CAM system "
       "write them out; so in line 7 / line 3: M130 is not on the list of words that can be rewritten; if it "
       "moves no axis, --allow FILE with the line M130 lets it pass / line 5: G51: scaling and mirroring "
       "would "
       "change under the rotation / line 6: polar words (@ ^) cannot be rewritten; give X and Y"},
      {"G21\nM98 P5\nM130\nG0 X1..2\n",
       "2: 3 words cannot be rewritten: line 2: the subprogram O5 is not in this file; put it there, or let "
       "the "
       "CAM system write it out / line 3: M130 is not on the list of words that can be rewritten; if it "
       "moves "
       "no axis, --allow FILE with the line M130 lets it pass / line 4: X1..2 is not a number"},
  });
  RewriteOptions options{.control = lekalo::words::Control::haas, .allowed_m = {130}};
  EXPECT_TRUE(rewrite_program("G21\nG187 P1 E0.01\nM130 P2\nM19 R90\n", "p.nc", 1, 2, 0.5, options));
  options.control = lekalo::words::Control::linuxcnc;
  for (const char* bores : {"G76 P1\n", "G87 X1\n"})
    EXPECT_FALSE(rewrite_program(bores, "p.nc", 1, 2, 0.5, options)) << bores;
  options.control = lekalo::words::Control::grbl;
  EXPECT_FALSE(rewrite_program("G21\nG43 H1\n", "p.nc", 1, 2, 0.5, options));
}

TEST(NcRefusal, OfWordsThatAnotherControlHas) {
  using lekalo::words::Control;
  struct Foreign {
    Control control;
    const char *program, *message;
  };
  const Foreign cases[] = {
      {Control::linuxcnc, "G21\nM97 P1\nM30\nN1 M99\n",
       "p.nc:2: M97 is no word of LinuxCNC controls; --control haas has it"},
      {Control::fanuc, "G21\no1 sub\no1 endsub\no1 call\n",
       "p.nc:4: an O word beside SUB or CALL is no word of Fanuc controls; --control linuxcnc has it"},
      {Control::haas, "#<_wide>=3\nG0 X#<_wide> Y1.\n",
       "p.nc:1: a variable with a name is no word of Haas controls; --control linuxcnc has it"},
      {Control::grbl, "#1=3\nG0 X#1 Y1\n",
       "p.nc:1: a variable or expression is no word of GRBL controls; --control linuxcnc|haas|fanuc has it"},
      {Control::haas, "G0 X1. Y1.\nG81 X2. Z-1. R1. K2\n",
       "p.nc:2: K without G2, G3 or X, Y or Z of a canned cycle in its block"},
      {Control::linuxcnc, "G21\nG0 G80 X0 Y0\n",
       "p.nc:2: G80 beside G0 to G3; Haas, Fanuc and GRBL controls read it: --control haas"},
      {Control::linuxcnc, "G0 X0 Y0 D2\n", "p.nc:1: D without G41 or G42 in its block"},
      {Control::linuxcnc, "G0 X1 Y1\nG81 X2 Z-1 R1 P2\n",
       "p.nc:2: P without G2, G3, G4, G64, a canned cycle or M62 to M65 in its block"},
  };
  for (const Foreign& one : cases) {
    const auto result = rewrite_program(one.program, "p.nc", 1, 2, 0.5, {.control = one.control});
    ASSERT_FALSE(result) << one.program;
    EXPECT_EQ(result.error().message, one.message);
  }
}

TEST(NcRefusal, OfMotionThatIsNotKnown) {
  const char* x_first =
      "2: moves in X while Y is not known; give both X and Y in the first move, and in the first one after a "
      "tool change";
  const char* incremental =
      "an incremental move while X and Y are not known; begin, and go on after a tool change, with G90 and "
      "both X and Y";
  expect_refusals({
      {"G21\nG0 X1\n", x_first},
      {"G21\nG0 Y1\n",
       "2: moves in Y while X is not known; give both X and Y in the first move, and in the first one after "
       "a tool change"},
      {"G21\nG91 G0 X1 Y1\n", fmt::format("2: {}", incremental).c_str()},
      {"G21\nG0 X0 Y0\nT1 M6\nX5\n",
       "4: moves in X while Y is not known; give both X and Y in the first move, and in the first one after "
       "a tool change"},
      {"G21\nG0 X0 Y0\nM6\nG91 X5 Y5\n", fmt::format("4: {}", incremental).c_str()},
      {"G21\nG2 X1 Y1 R5\n", "2: an arc from a point that is not known; give both X and Y before it"},
      {"G21\nG81 Z-1 R1\n", "2: a canned cycle while X and Y are not known; give both"},
      {"G21\nX1 Y1\n", "2: axis words before any motion word: write G0 or G1 first"},
      {"G21\nG0 X0 Y0\nG80\nX1\n", "4: axis words while G80 is active: write G0 or G1"},
      {"G21\nG80 X1 Y1\n", "2: axis words while G80 is active: write G0 or G1"},
      {"G21\nG0 X0 Y0\n/X5\n",
       "3: X in a block that the / switch may skip: where the tool then stands is not known"},
      {"/G91\n", "1: G in a block that the / switch may skip: where the tool then stands is not known"},
      {"/M6\n", "1: M in a block that the / switch may skip: where the tool then stands is not known"},
      {"/M30\n", "1: M in a block that the / switch may skip: where the tool then stands is not known"},
      {"/M8 P1\n", "1: P without G2, G3, G4, G64, a canned cycle or M62 to M65 in its block"},
      {"/2 M8\n", "1: numbered block delete (/2) is not on the list of what can be rewritten"},
      {"G21\nM2\nG0 X1 Y1\n", "3: words after the end of the program (M2, M30)"},
  });
}

TEST(NcRefusal, OfArcsAndCyclesThatCannotBeKept) {
  expect_refusals({
      {"G0 X0 Y0\nG18 G2 X1 I5\n",
       "2: an arc outside the XY plane from a Z that is not known; give Z before it"},
      {"G0 X0 Y0 Z0\nG18 G2 X1 J5\n", "2: J beside an arc of G18, which has no such centre"},
      {"G0 X0 Y0 Z0\nG18 G2 X10 I5 M30\n",
       "2: an arc of G18 or G19 beside M0, M1, M2 or M30; give them a block of their own"},
      {"G0 X0 Y0 Z0\nG93\nG18 G2 X10 I5\n", "3: an arc of G18 or G19 under G93 without F in its block"},
      {"G0 X0 Y0\nG19 G3 Y1 J5\n",
       "2: an arc outside the XY plane from a Z that is not known; give Z before it"},
      {"G0 X0 Y0\nG18 G81 X1 Z1 R1\n", "2: a canned cycle outside the XY plane (G18, G19)"},
      {"G0 X0 Y0\nG18 G41 D1 X1\n", "2: G41 and G42 are rewritten in the XY plane (G17) only"},
      {"G0 X0 Y0\nG2 X1 Y1\n", "2: an arc without centre (I J) or radius (R)"},
      {"G0 X0 Y0\nG2 X1 Y1 I1 R1\n", "2: an arc with both a centre (I J) and a radius (R)"},
      {"G0 X0 Y0\nG2 R1\n", "2: R without an end point"},
      {"G0 X0 Y0\nG2 Z1 R1\n", "2: an arc by radius without an end point in X or Y"},
      {"G0 X0 Y0\nG2 X0 Y0 R1\n", "2: an arc by radius that ends where it starts"},
      {"G0 X0 Y0\nG2 X10 R4.99\n", "2: the radius R is too small to reach the end point"},
      {"G0 X0 Y0\nG2 X10 R0\n", "2: the radius R is too small to reach the end point"},
      {"G0 X0 Y0\nG2 X10 I4\n",
       "2: the centre is 4.00000 mm from the start but 6.00000 mm from the end of the arc"},
      {"G0 X0 Y0\nG2 I0\n",
       "2: the centre is 0.00000 mm from the start but 0.00000 mm from the end of the arc"},
      {"G0 X0 Y0\nG3 X100 Y.0001 I100 \n",
       "2: the centre is 100.00000 mm from the start but 0.00010 mm from the end of the arc"},
      {"G0 X100 Y0\nG3 X100 Y.0001 I-100 \n",
       "2: the ends of the arc differ, but seen from its centre by 1.0e-06 rad only: a control may run a "
       "full circle or "
       "nothing; give a full circle the same end as start"},
      {"G0 X100 Y0\nG3 X100.01 Y0 I-100 \n",
       "2: the ends of the arc differ, but seen from its centre by 0.0e+00 rad only: a control may run a "
       "full circle or "
       "nothing; give a full circle the same end as start"},
      {"G0 X0 Y0\nG90.1 G2 X2 I1\n", "2: G90.1 needs both I and J"},
      {"G0 X0 Y0\nG2 X2 I1 P1.5\n", "2: P of an arc must be a whole number of turns, at least 1"},
      {"G0 X0 Y0\nG2 X2 I1 P0\n", "2: P of an arc must be a whole number of turns, at least 1"},
      {"G0 X0 Y0\nG81 X1 Z1 R1 L0\n", "2: L of a canned cycle must be a whole number from 1 to 10000"},
      {"G0 X0 Y0\nG41 D1 X5\nG81 X1 Z1 R1\n", "3: a canned cycle while G41 or G42 is active"},
      {"G0 X0 Y0\nG91 G81 X900000 L9999\n", "2: leads further than 1000000 inches from the origin"},
  });
}

TEST(NcRefusal, OfBlocksThatSayTwoThings) {
  expect_refusals({
      {"G0 X0 X1 Y0\n", "1: two X words in one block"},
      {"N1 N2 M3\n", "1: two N words in one block"},
      {"G0 G1 X0 Y0\n", "1: G1 and another G word of the same modal group"},
      {"G20 G21\n", "1: G21 and another G word of the same modal group"},
      {"G80 G81 X0 Y0 Z0 R0\n", "1: G80 and a canned cycle in one block"},
      {"G0 X0 Y0 I1\n", "1: I without G2 or G3 in its block"},
      {"G0 X0 Y0 R1\n", "1: R without G2, G3 or X, Y or Z of a canned cycle in its block"},
      {"G0 X0 Y0 L2\n", "1: L without X, Y or Z of a canned cycle in its block"},
      {"G0 X0 Y0 P2\n", "1: P without G2, G3, G4, G64, a canned cycle or M62 to M65 in its block"},
      {"G0 X0 Y0 Q2\n", "1: Q without G64 or a canned cycle in its block"},
      {"G0 X0 Y0 H2\n", "1: H without G43 or G44 in its block"},
      {"G0 X0 Y0\nG4 X2\n",
       "2: G4 beside axis words: some controls read X as seconds; give the dwell a block of its own"},
  });
}

TEST(NcRefusal, OfBytesThatDoNotBelongThere) {
  const std::string long_line = "G21 (" + std::string(251, 'x') + ")\n";
  const std::string grows = "G21\nG0 X0 Y0 Z1 (" + std::string(238, 'x') + ")\n";
  expect_refusals({
      {"(open\n", "1: a comment is opened and not closed"},
      {"G21\n(a (b) c\n", "2: a comment is opened and not closed"},
      {"G21 )\n", "1: a comment is closed that was not opened"},
      {"G0 X1 Y0 \xC3\xA9\n", "1: byte 0xC3 outside a comment is not ASCII"},
      {"G21 \xEF\xBB\xBF\n", "1: byte 0xEF outside a comment is not ASCII"},
      {"G21 \x01\n", "1: control character byte 0x01"},
      {"G21\rG0 X0\r", "1: a carriage return inside a line; line ends must be LF or CR LF"},
      {"G21 =\n", "1: '=' does not belong in a program"},
      {":1234\n", "1: ':' does not belong in a program"},
      {"G21 %\n", "1: % must stand alone on its line"},
      {"% start\n", "1: % must stand alone on its line"},
      {"G21 /M8\n", "1: / may only begin a line"},
      {"%\nG21\n%\nG0 X0 Y0\n", "4: words after the final %"},
      {"G21\n%\n%\n", "3: words after the final %"},
      {long_line.c_str(), "1: the line has 257 bytes, more than the 255 a control reads"},
      {grows.c_str(), "2: the rewritten line would have more than 255 bytes; split the block"},
  });
}

TEST(NcRefusal, OfWhatOneModeCannotDo) {
  const RewriteMode g68 = RewriteMode::g68, offset = RewriteMode::offset;
  expect_refusals({
      {"O1\nG0 X0 Y0\n", "1: LinuxCNC, for which mode offset is, has no program numbers (O)", offset},
      {"G69\nG0 X0 Y0\n", "1: LinuxCNC, for which mode offset is, has no G69", offset},
      {"G21 G69\nG0 X0 Y0\n", "1: G69 would cancel the rotation of mode g68; remove it", g68},
      {"G0 X0 Y0\nG55\n",
       "2: G55 is selected, but the motion is computed for G54: several work offsets cannot be rewritten; if "
       "G55 is the only one, choose it (work offset 2: --wcs 2)",
       g68},
      {"%\nO1\nG0 X0 Y0\nG76 X1 Y1 Z-1 R1 Q.1\nM30\n%\n",
       "4: G76 and G87 shift the tool sideways, and whether G68 turns that way is up to the control; use "
       "mode "
       "coordinates",
       g68},
      {"G91\nG0 Z5\nG90 X0 Y0\n",
       "2: the first motion is in G91, but G68 must be given in G90: write G90 before it", g68},
      {"G0 X0 Y0\nG0 Z5 M30\n",
       "2: the block that ends the program moves too, but the rotation must be cancelled in between: split "
       "it",
       g68},
      {"G0 X0 Y0\nG41 D1 X5\nM30\n",
       "3: G41 or G42 is active at the end, but the rotation can be cancelled only after G40: add G40", g68},
  });
}

}  // namespace
}  // namespace lekalo::nc_refusal_test

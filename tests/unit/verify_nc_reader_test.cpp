// How the checker's reader of programs takes blocks that are compared, and the bounds of what it takes.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "verify/pocket/nc_program.hpp"

namespace lekalo::verify::verify_nc_reader_test {
namespace {

using words::Control;

/// A number without what is left of rounding.
std::string plain(double value) { return fmt::format("{:g}", std::round(value * 1e9) / 1e9 + 0.0); }
std::string place(Place p, double z) { return plain(p.x) + "," + plain(p.y) + "," + plain(z); }

/// A move as `from>to`, with `R` for a rapid, its feed, and the centre and turns of an arc.
std::string told(const Move& move) {
  std::string text = place(move.from, move.from_z) + ">" + place(move.to, move.to_z);
  if (move.arc)
    text += (move.ccw ? "+" : "-") + plain(move.centre.x) + "," + plain(move.centre.y) +
            fmt::format("*{}", move.turns);
  return text + (move.rapid && move.feed == 0 ? "R" : "F" + plain(move.feed));
}

/// The moves of a program that is judged.
std::string judged(const std::string& program, Control control = Control::linuxcnc, double top = 0) {
  const auto read = read_moves({"p", program}, top, control);
  if (!read) return read.error().message;
  std::string text;
  for (const Move& move : *read) text += told(move) + " ";
  return text;
}

/// The events of a program that is compared: the words that its moves do not show, and its moves.
std::string compared(const std::string& program, Control control = Control::linuxcnc,
                     const std::vector<int>& allowed = {}) {
  const auto read = read_program({"p", program}, {.control = control, .judged = false, .allowed_m = allowed});
  if (!read) return read.error().message;
  std::string text;
  for (const NcEvent& event : read->events) {
    text += fmt::format("{}:{}", event.line, event.words);
    for (std::size_t k = event.first_move; k < event.end_move && !event.upright; ++k)
      text += told(read->moves[k]) + " ";
    if (event.upright)
      text += fmt::format("{} chords to {} ", event.end_move - event.first_move,
                          place(read->moves[event.end_move - 1].to, read->moves[event.end_move - 1].to_z));
    if (event.offset != 0) text += fmt::format("@{} ", event.offset);
    if (event.by_time) text += "by time ";
    text.back() = '\n';
  }
  return text;
}

struct Case {
  const char* program;
  const char* says;
  Control control = Control::linuxcnc;
};

TEST(VerifyNcReader, BlocksThatAreComparedSayWhatTheirMovesDoNot) {
  const Case cases[] = {
      // Heights that are not known are words; known ones are places.
      {"G0 X1 Y2\nZ3\nG1 Z1 F9\nX4 S5\n",
       "1:1,2,0>1,2,0R\n2:1,2,0>1,2,3R\n3:F9 1,2,3>1,2,1F9\n4:S5 1,2,1>4,2,1F9\n"},
      {"G0 Z3\nX1 Y2\nX2\n", "1:G0 Z3\n2:1,2,3>1,2,3R\n3:1,2,3>2,2,3R\n"},
      {"G0 Z3\nG1 Z1 F9\n", "1:G0 Z3\n2:G1 F9 Z1\n"},
      {"G20 G0 Z1\nG1 Z2 F3\n", "1:G0 Z25.4\n2:G1 F76.19999999999999 Z50.8\n"},
      {"G0 X1 Y2 Z3\nG2 X3 I1 F9\nG3 X1 R1\nG2 I1 P2\n",
       "1:1,2,3>1,2,3R\n2:F9 1,2,3>3,2,3-2,2*1F9\n3:3,2,3>1,2,3+2,2*1F9\n4:1,2,3>1,2,3-2,2*2F9\n"},
      {"G0 X1 Y2 Z3\nG18 G2 X3 Z3 I1 K0 F9\nG17 G1 X5\n",
       "1:1,2,3>1,2,3R\n2:F9 112 chords to 3,2,3\n3:3,2,3>5,2,3F9\n"},
      {"G98 G0 X1 Y2 Z3\nG81 X3 Y4 Z-1 R1 F9\nX5 L2\nG80\nG0 X6\nZ7\n",
       "1:G98 1,2,3>1,2,3R\n2:G81 F9 R1 Z-1 3,4,3>3,4,3R\n3:L2 5,4,3>5,4,3R "
       "5,4,3>5,4,3R\n5:5,4,3>6,4,3R\n6:6,4,3>6,4,7R\n"},
      {"G0 X1 Y2 Z3\nG20\nG81 X1 Z-1 R1 F9\n",
       "1:1,2,3>1,2,3R\n3:G81 F228.6 R25.4 Z-25.4 25.4,2,3>25.4,2,3R\n"},
      {"G0 X1 Y2 Z3\nG4 P1\nM3 S9\nT1 M6\nG43 H1\nG0 X2\nZ5\n",
       "1:1,2,3>1,2,3R\n2:G4 P1\n3:M3 S9\n4:M6 T1\n5:G43 H1\n6:G0\n7:G0 Z5\n"},
      {"G54 G0 X1 Y2 Z3\nG55\nG0 X1 Y2 Z3\nX4\nG59.3 X1\n",
       "1:1,2,3>1,2,3R @540\n3:1,2,3>1,2,3R @550\n4:1,2,3>4,2,3R @550\n5:G0 @593\n"},
      {"G0 X1 Y2 Z3\nG28 Z5\nX2\nZ3\n",
       "1:1,2,3>1,2,3R\n2:G28 Z5 1,2,3>1,2,5R\n3:1,2,5>2,2,5R\n4:2,2,5>2,2,3R\n"},
      {"G0 X1 Y2 Z3\nG28 X5\nG0 Y1\nX2\nX3\n",
       "1:1,2,3>1,2,3R\n2:G28 X5\n3:G0\n4:2,1,3>2,1,3R\n5:2,1,3>3,1,3R\n"},
      {"G0 X1 Y2 Z3\nG28\nG0 X1\nY1\nX2\n", "1:1,2,3>1,2,3R\n2:G28\n3:G0\n4:1,1,3>1,1,3R\n5:1,1,3>2,1,3R\n"},
      {"G0 X1 Y2 Z3\nG53 G0 Z0\nG53 G0 X0 Y0\nX1 Y1\nX2\n",
       "1:1,2,3>1,2,3R\n2:G53 Z0\n3:G53 X0 Y0\n4:1,1,3>1,1,3R\n5:1,1,3>2,1,3R\n"},
      {"G0 X1 Y2 Z3\nG91 X1\nG28 Z0\nX1\n", "1:1,2,3>1,2,3R\n2:1,2,3>2,2,3R\n3:G28 Z0\n4:2,2,3>3,2,3R\n"},
      {"G93 G0 X1 Y2 Z3\nG1 X2 F9\nG94 X3 F9\n",
       "1:G93 1,2,3>1,2,3R by time\n2:F9 1,2,3>2,2,3F9 by time\n3:G94 F9 2,2,3>3,2,3F9\n"},
      {"G91 G0 Z1\nG90 X1 Y1\n", "1:G0 Z1\n2:1,1,1>1,1,1R\n"},
      {"G91 G0 X1\n", "p:1: a step of X from a place that no block has said"},
      {"G1 X1 Y1\nX2 F9\nX3\n", "1:1,1,0>1,1,0F0\n2:F9 1,1,0>2,1,0F9\n3:2,1,0>3,1,0F9\n"},
      {"G2 X1 Y1 I1\n", "p:1: an arc from a place that no block has said"},
      {"G0 X1 Y1\nG18 G2 X3 Z0 I1 K0 F9\n", "1:1,1,0>1,1,0R\n2:F9 112 chords to 3,1,0\n"},
      {"M2\nG0 X1\n", "p:2: words after the end of the program"},
      {"G41 D1 G1 X1 Y1 Z1 F9\nX2\nG40 X3\n",
       "1:G41 D1 F9 1,1,1>1,1,1F9\n2:1,1,1>2,1,1F9\n3:G40 2,1,1>3,1,1F9\n"},
      {"G80\nN5 M8 M9\n", "p:2: M8 and M9 exclude each other"},
      {"G0 X0 Y0 Z5\nG18 G2 I1 K0 F9\n", "1:0,0,5>0,0,5R\n2:F9 223 chords to 0,0,5\n"},
      {"G0 X0 Y0 Z5\nG18 G3 I1 K0 F9 P2\n", "1:0,0,5>0,0,5R\n2:F9 445 chords to 0,0,5\n"},
      {"G0 X0 Y0 Z5\nG18 G2 X2 I1 K0 F9 P2\n", "1:0,0,5>0,0,5R\n2:F9 334 chords to 2,0,5\n"},
      {"G0 X0 Y0 Z5\nG19 G3 Y2 X3 J1 K0 F9\n", "1:0,0,5>0,0,5R\n2:F9 112 chords to 3,2,5\n"},
      {"G0 X1 Y1\nG18 G2 X3 I1 K0 F9\n", "p:2: an arc from a Z that no block has said"},
      {"G0 X0 Y0 Z5\nG2 X12 I1 F9\n", "1:0,0,5>0,0,5R\n2:F9 0,0,5>12,0,5-1,0*1F9\n"},
      // Of a spiral the larger end decides how long chords are.
      {"G0 X0 Y0 Z5\nG18 G2 X5 I1 K0 F9\n", "1:0,0,5>0,0,5R\n2:F9 223 chords to 5,0,5\n"},
      {"G0 X1 Y2 Z3\nG2 I1 F9\nG28 X5\n", "1:1,2,3>1,2,3R\n2:F9 1,2,3>1,2,3-2,2*1F9\n3:G28 X5\n"},
      {"G0 X1 Y1 Z1\nG1 X2 F9\nT2 M6\n", "1:1,1,1>1,1,1R\n2:F9 1,1,1>2,1,1F9\n3:M6 T2\n"},
      {"G53\n", "p:1: G53 without G0 and G90"},
      {"G0 X1 Y2 Z3\nG28 X5 Z5\n", "1:1,2,3>1,2,3R\n2:G28 X5 Z5\n"},
      {"G0 X1 Y2 Z3\nG28 Y5 Z5\n", "1:1,2,3>1,2,3R\n2:G28 Y5 Z5\n"},
      {"G0 X1\nG81 X2 Z-1 R1 F9\n", "p:2: a canned cycle at a place that no block has said"},
      {"G0 Y1\nG81 Y2 Z-1 R1 F9\n", "p:2: a canned cycle at a place that no block has said"},
      {"G0 X1 Y2 Z3\nG81 X3 Z-1 R1\n", "1:1,2,3>1,2,3R\n2:G81 R1 Z-1 3,2,3>3,2,3R\n"},
      {"G0 X1 Y1\nG1 X2 F9\n", "1:1,1,0>1,1,0R\n2:F9 1,1,0>2,1,0F9\n", Control::haas},
      {"G0 X1. Y1. Z1.\nG98 G81 X2. Z-1. R1. L2 F9.\n",
       "1:1,1,1>1,1,1R\n2:G98 G81 F9 L2 R1 Z-1 2,1,1>2,1,1R 2,1,1>2,1,1R\n", Control::fanuc},
      {"G0 X1. Y1. Z1.\nG98 G83 X2. Z-1. R1. Q1. I1. F9.\n",
       "1:1,1,1>1,1,1R\n2:G98 G83 F9 I1 Q1 R1 Z-1 2,1,1>2,1,1R\n", Control::haas},
  };
  for (const Case& one : cases) EXPECT_EQ(compared(one.program, one.control), one.says) << one.program;
}

TEST(VerifyNcReader, WordsThatAShopAllowsAreKeptInTheirOrder) {
  EXPECT_EQ(compared("M200\n", Control::linuxcnc, {200}), "1:M200\n");
  EXPECT_EQ(compared("M200 M33 P1 Q2\n", Control::linuxcnc, {33, 200}), "1:M200 M33 P1 Q2\n");
  EXPECT_EQ(compared("M201\n", Control::linuxcnc, {33, 200}), "p:1: M201 is not understood here");
  EXPECT_EQ(compared("M200 R1\n", Control::linuxcnc, {33, 200}), "p:1: no word of the block takes R");
  EXPECT_EQ(compared("G33\n", Control::linuxcnc, {33, 200}), "p:1: G33 is not understood here");
}

// ---- bounds -----------------------------------------------------------------------------------------------

TEST(VerifyNcReader, CountsAndDistancesHaveTheirBounds) {
  const std::string begin = "G0 X0 Y0 Z5.\n";
  const Case cases[] = {
      {"G1 X1000000 F9\n", "0,0,5>1e+06,0,5F9 "},
      {"G1 X-1000000 F9\n", "0,0,5>-1e+06,0,5F9 "},
      {"G1 X1000000.1 F9\n", "p:2: X is farther than 1000000 mm from the origin"},
      {"G1 Y-1000000.1 F9\n", "p:2: Y is farther than 1000000 mm from the origin"},
      {"G91 G1 Z1000000 F9\n", "p:2: Z is farther than 1000000 mm from the origin"},
      {"G2 I1 P1 F9\n", "0,0,5>0,0,5-1,0*1F9 "},
      {"G2 I1 P10000 F9\n", "0,0,5>0,0,5-1,0*10000F9 "},
      {"G2 I1 P10001 F9\n", "p:2: P of an arc is not a number of turns"},
      {"G2 I1 P0 F9\n", "p:2: P of an arc is not a number of turns"},
      {"G2 I1 P1.5 F9\n", "p:2: P of an arc is not a number of turns"},
      {"G1 X1 F0\n", "p:2: a feed that is not above 0"},
      {"G80\nG1 X1 F0\n", "p:3: a feed that is not above 0"},
      {"G1 X1\n", "p:2: a motion with feed before any F"},
      {"G98 G81 X1 Z5 R5 F9\n", "0,0,5>1,0,5R "},
      {"G98 G81 X1 Z5.1 R5 F9\n", "p:2: R of a cycle is below its Z"},
      {"G98 G81 X1 Z-1000000 R5 F9\n", "0,0,5>1,0,5R 1,0,5>1,0,-1e+06F9 1,0,-1e+06>1,0,5R "},
      {"G98 G81 X1 Z-1000001 R5 F9\n", "p:2: Z is farther than 1000000 mm from the origin"},
      {"G98 G81 X1 Z-1 R1000001 F9\n", "p:2: Z is farther than 1000000 mm from the origin"},
      {"G98 G81 X1 Z-1 R1 L0 F9\n", "p:2: L of a canned cycle is not a number of holes"},
      {"G98 G81 X1 Z-1 R1 L1.5 F9\n", "p:2: L of a canned cycle is not a number of holes"},
      {"G98 G81 X1 Z-1 R1 L10001 F9\n", "p:2: L of a canned cycle is not a number of holes"},
      {"G98 G83 X1 Z-1 R1 Q0 F9\n", "p:2: Q of a cycle is not above 0"},
      {"G98 G83 X1 Z-1 R1 Q0.0001 F9\n", "p:2: Q of a cycle makes more than 10000 steps"},
      {"G98 G82 X1 Z-1 R1 F9\n", "p:2: G82 without P in its first block"},
      {"G98 G81 X1 Z-1 F9\n", "p:2: G81 without Z and R in its first block"},
      {"G98 G81 X1 R1 F9\n", "p:2: G81 without Z and R in its first block"},
      {"G81 X1 Z-1 R1 F9\n", "p:2: a canned cycle before G98 or G99"},
      {"G98 G81 X1 Z-1 R1\n", "p:2: a motion with feed before any F"},
      {"G98 G81\n", "p:2: G81 without X, Y or Z"},
      {"G98 G81 X1. Z-1. R1. L0 F9.\n", "", Control::haas},
  };
  for (const Case& one : cases) EXPECT_EQ(judged(begin + one.program, one.control), one.says) << one.program;
  EXPECT_EQ(judged("G1 X1 F0\n"), "p:1: a feed that is not above 0");
  EXPECT_TRUE(read_moves({"p", begin + "G98 G83 X1 Z-5000 R5000 Q1 F9\n"}, 0));
  EXPECT_FALSE(read_moves({"p", begin + "G98 G83 X1 Z-5000.1 R5000 Q1 F9\n"}, 0));
}

TEST(VerifyNcReader, CyclesAreTheMovesThatTheControlMakes) {
  const std::string begin = "G0 X0 Y0 Z5.\nF9. ";
  const Case cases[] = {
      {"G98 G81 X1 Z-1 R2\n", "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R "},
      {"G99 G81 X1 Z-1 R2\nX2\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,2R 1,0,2>2,0,2R 2,0,2>2,0,-1F9 2,0,-1>2,0,2R "},
      {"G98 G81 X1 Z-1 R7\nX2\n",
       "0,0,5>0,0,7R 0,0,7>1,0,7R 1,0,7>1,0,-1F9 1,0,-1>1,0,7R 1,0,7>2,0,7R 2,0,7>2,0,-1F9 2,0,-1>2,0,7R "},
      {"G98 G81 X1 Z-1 R2 L2\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R "},
      {"G91 G98 G81 X1 Z-3 R-3 L2\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R 1,0,5>2,0,5R 2,0,5>2,0,2R 2,0,2>2,0,-1F9 "
       "2,0,-1>2,0,5R "},
      {"G91 G99 G81 X1 Z-3 R-3 L2\nX1\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,2R 1,0,2>2,0,2R 2,0,2>2,0,-1F9 2,0,-1>2,0,2R "
       "2,0,2>3,0,2R 3,0,2>3,0,-1F9 3,0,-1>3,0,2R "},
      {"G98 G73 X1 Z-1 R2 Q1.5\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,0.5F9 1,0,0.5>1,0,0.754R 1,0,0.754>1,0,-1F9 1,0,-1>1,0,5R "},
      {"G98 G83 X1 Z-1 R2 Q1.5\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,0.5F9 1,0,0.5>1,0,2R 1,0,2>1,0,0.754R 1,0,0.754>1,0,-1F9 "
       "1,0,-1>1,0,5R "},
      {"G98 G83 X1 Z-1 R2 Q3\n", "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R "},
      {"G98 G85 X1 Z-1 R2\n", "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,2F9 1,0,2>1,0,5R "},
      {"G98 G89 X1 Z-1 R2 P1\n", "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5F9 "},
      {"M3 S9\nG98 G86 X1 Z-1 R2 P1\n", "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R "},
      {"M3 S9\nG98 G84 X1 Z-1 R2\n", "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5F9 "},
      {"M4 S9\nG98 G74 X1 Z-1 R2\n", "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5F9 "},
      {"M4 S9\nG98 G84 X1 Z-1 R2\n", "p:3: G84 while the spindle does not turn so"},
      {"M3 S9\nG98 G74 X1 Z-1 R2\n", "p:3: G74 while the spindle does not turn so"},
      {"G98 G84 X1 Z-1 R2\n", "p:2: G84 while the spindle does not turn so"},
      {"G98 G86 X1 Z-1 R2 P1\n", "p:2: G86 while the spindle does not turn so"},
      {"M3 S9\nM5\nG98 G86 X1 Z-1 R2 P1\n", "p:4: G86 while the spindle does not turn so"},
      {"G99 G81 X1 Z-1 R2\nX2 R3\n", "p:3: R of a cycle changed under G99"},
      {"G99 G81 X1 Z-1 R2\nX2 R2\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,2R 1,0,2>2,0,2R 2,0,2>2,0,-1F9 2,0,-1>2,0,2R "},
      {"G91 G99 G81 X1 Z-3 R-3\nX1 Z-2\n", "p:3: Z or R of a cycle changed under G91 and G99"},
      {"G91 G98 G81 X1 Z-3 R-3\nX1 R-2\n", "p:3: R of a cycle without Z under G91"},
      {"G91 G98 G81 X1 Z-3 R-3\nX1 R-2 Z-1\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R 1,0,5>2,0,5R 2,0,5>2,0,3R 2,0,3>2,0,2F9 "
       "2,0,2>2,0,5R "},
      {"G98 G81 X1 Z-1 R2\nG91 X1\n", "p:3: G81 without Z and R in its first block"},
      {"G98 G81 X1 Z-1 R2\nG91 X1 Z-1 R-1\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R 1,0,5>2,0,5R 2,0,5>2,0,4R 2,0,4>2,0,3F9 "
       "2,0,3>2,0,5R "},
      {"G98 G81 X1 Z-1 R2\nG82 X2 P1\n", "p:3: G82 without Z and R in its first block"},
      {"G98 G81 X1 Z-1 R2\nG82 X2 P1 Z-1 R2\nG80\nG0 X3\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R 1,0,5>2,0,5R 2,0,5>2,0,2R 2,0,2>2,0,-1F9 "
       "2,0,-1>2,0,5R 2,0,5>3,0,5R "},
      {"G98 G81 X1 Z-1 R2\nG98 X2 Z-2\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R 1,0,5>2,0,5R 2,0,5>2,0,2R 2,0,2>2,0,-2F9 "
       "2,0,-2>2,0,5R "},
      {"G99 G81 X1 Z-1 R2\nG98 X2\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,2R 1,0,2>2,0,5R 2,0,5>2,0,2R 2,0,2>2,0,-1F9 "
       "2,0,-1>2,0,5R "},
      {"G98 G81 X1 Z-1 R2 K3\n",
       "p:2: X has no decimal point, and Fanuc controls may count it in thousandths", Control::fanuc},
      {"G98 G81 X1. Z-1. R2. K3\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R "
       "1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R ",
       Control::fanuc},
      {"G98 G81 X1. Z-1. R2. K0\n", "", Control::fanuc},
      {"G98 G81 X1. Z-1. R2. L3\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R "
       "1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R ",
       Control::haas},
      {"G98 G83 X1. Z-1. R2. Q1.5 K1.\n", "p:2: pecks shaped by I, J and K", Control::haas},
      {"G98 G83 X1. Z-1. R2. Q1.5 I1.\n", "p:2: pecks shaped by I, J and K", Control::haas},
      {"G98 G83 X1. Z-1. R2. Q1.5 J1.\n", "p:2: pecks shaped by I, J and K", Control::haas},
      {"G82 G98 X1. Z-1. R2.\n", "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R ", Control::haas},
      {"G84 G98 X1. Z-1. R2.\n", "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5F9 ", Control::haas},
      {"G98 G83 X1 Z-1 R2 Q1.5\nX2\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,0.5F9 1,0,0.5>1,0,2R 1,0,2>1,0,0.754R 1,0,0.754>1,0,-1F9 "
       "1,0,-1>1,0,5R 1,0,5>2,0,5R 2,0,5>2,0,2R 2,0,2>2,0,0.5F9 2,0,0.5>2,0,2R 2,0,2>2,0,0.754R "
       "2,0,0.754>2,0,-1F9 2,0,-1>2,0,5R "},
      {"G98 G82 X1 Z-1 R2 P1\nX2\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R 1,0,5>2,0,5R 2,0,5>2,0,2R 2,0,2>2,0,-1F9 "
       "2,0,-1>2,0,5R "},
      {"G98 G73 X1 Z-1 R2\n", "p:2: G73 without Q in its first block"},
      {"G98 G73 X1 Z-1 R2 Q0\n", "p:2: Q of a cycle is not above 0"},
      {"G98 G89 X1 Z-1 R2\n", "p:2: G89 without P in its first block"},
      {"M3 S9\nG98 G86 X1 Z-1 R2\n", "p:3: G86 without P in its first block"},
      {"G91 G99 G81 X1 Z-3 R-3\nX1 R-2\n", "p:3: Z or R of a cycle changed under G91 and G99"},
      {"G98 G81 X1 Z-1 R7\nX2 R7\n", "p:3: R of a cycle changed above the plane that it began at"},
      {"G99 G81 X1 Z-1 R7\nX2 R7\n",
       "0,0,5>0,0,7R 0,0,7>1,0,7R 1,0,7>1,0,-1F9 1,0,-1>1,0,7R 1,0,7>2,0,7R 2,0,7>2,0,-1F9 2,0,-1>2,0,7R "},
      {"G0 Z-1\nG98 G81 X1 Z-3 R-2\n",
       "0,0,5>0,0,-1R 0,0,-1>1,0,-1R 1,0,-1>1,0,-2R 1,0,-2>1,0,-3F9 1,0,-3>1,0,-1R "},
      {"G53 G0 Z0 M19 G103 P1\n", "p:2: two words of the block take P", Control::haas},
      {"G98 G81 X1 Z-1 R5\nX2 R5\n",
       "0,0,5>1,0,5R 1,0,5>1,0,-1F9 1,0,-1>1,0,5R 1,0,5>2,0,5R 2,0,5>2,0,-1F9 2,0,-1>2,0,5R "},
      {"G98 G81 X1 Z-1 R2\nX2 R3\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R 1,0,5>2,0,5R 2,0,5>2,0,3R 2,0,3>2,0,-1F9 "
       "2,0,-1>2,0,5R "},
      {"G99 G81 X1 Z-1 R2\nG98 G82 X2 P1 Z-1 R2\n",
       "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,2R 1,0,2>2,0,5R 2,0,5>2,0,2R 2,0,2>2,0,-1F9 "
       "2,0,-1>2,0,5R "},
      {"G81 X1. Z-1. R2.\n", "0,0,5>1,0,5R 1,0,5>1,0,2R 1,0,2>1,0,-1F9 1,0,-1>1,0,5R ", Control::haas},
      {"G98 G81 X1. Z-1. R2. L1.5\n", "p:2: L of a canned cycle is not a number of holes", Control::haas},
  };
  for (const Case& one : cases) EXPECT_EQ(judged(begin + one.program, one.control), one.says) << one.program;
}

TEST(VerifyNcReader, ArcsHaveTheirCentreAndBothEndsOnTheirCircle) {
  const std::string begin = "G0 X0 Y0 Z5.\nF9. ";
  const Case cases[] = {
      {"G3 X2 I1\n", "0,0,5>2,0,5+1,0*1F9 "},
      {"G2 X2 R1\n", "0,0,5>2,0,5-1,0*1F9 "},
      {"G2 X1 Y1 R1\n", "0,0,5>1,1,5-1,0*1F9 "},
      {"G2 X1 Y1 R-1\n", "0,0,5>1,1,5-0,1*1F9 "},
      {"G3 X1 Y1 R1\n", "0,0,5>1,1,5+0,1*1F9 "},
      {"G3 X1 Y1 R-1\n", "0,0,5>1,1,5+1,0*1F9 "},
      {"G2 X2 R0.9988\n", "0,0,5>2,0,5-1,0*1F9 "},
      {"G2 X2 R0.9987\n", "p:2: no arc of radius 0.9987 joins ends 2 mm apart"},
      {"G2 X2 R1000000\n", "0,0,5>2,0,5-1,-1e+06*1F9 "},
      {"G2 X2 R1000001\n", "p:2: no arc of radius 1e+06 joins ends 2 mm apart"},
      {"G2 X2 R0\n", "p:2: no arc of radius 0 joins ends 2 mm apart"},
      {"G2 X2 I1 R1\n", "p:2: an arc with a radius and a centre"},
      {"G2 X2 J1 R1\n", "p:2: an arc with a radius and a centre"},
      {"G2 X2 K1\n", "p:2: no arc in this plane takes K"},
      {"G2 X2.005 I1\n", "0,0,5>2.005,0,5-1,0*1F9 "},
      {"G2 X2.0051 I1\n", "p:2: the arc's ends are 1 and 1.0051 mm from its centre"},
      {"G2 I0.00127\n", "0,0,5>0,0,5-0.00127,0*1F9 "},
      {"G2 I0.00126\n", "p:2: the arc's ends are 0.00126 and 0.00126 mm from its centre"},
      {"G2 I1000000\n", "0,0,5>0,0,5-1e+06,0*1F9 "},
      {"G2 I1000001\n", "p:2: the arc's ends are 1e+06 and 1e+06 mm from its centre"},
      {"G90.1 G2 X2 I1 J0\n", "0,0,5>2,0,5-1,0*1F9 "},
      {"G90.1 G2 X2 I1\n", "p:2: an absolute centre needs both I and J"},
      {"G90.1 G2 X2 J1\n", "p:2: an absolute centre needs both I and J"},
      {"G18 G2 X2 J1\n", "p:2: no arc in this plane takes J"},
      {"G18 G2 X2\n", "p:2: an arc without a centre or R"},
      {"G18 G90.1 G2 X2 I1\n", "p:2: an absolute centre needs both of its words"},
      {"G19 G2 Y2 I1\n", "p:2: no arc in this plane takes I"},
      {"G20\nG2 X0.2 I0.1 F1\n", "p:2: a feed beside a change of its unit; give it a block of its own"},
      {"G2\n", "p:2: an arc without I, J or R"},
      {"G2 X0.000001 I1\n",
       "p:2: an arc of nearly no turn or a full one; give a full turn the same end as start"},
      {"G2 X0.000003 Y0.000003 I1\n", "0,0,5>3e-06,3e-06,5-1,0*1F9 "},
      {"G2 Y0.000001 I1\n",
       "p:2: an arc of nearly no turn or a full one; give a full turn the same end as start"},
      {"G2 X0.0025 I0.00127\n", "p:2: the arc's ends are 0.00127 and 0.00123 mm from its centre"},
      {"G2 X0.0025 I0.00123\n", "p:2: the arc's ends are 0.00123 and 0.00127 mm from its centre"},
  };
  for (const Case& one : cases) EXPECT_EQ(judged(begin + one.program, one.control), one.says) << one.program;
}

TEST(VerifyNcReader, ArcsOfOtherPlanesRiseEvenlyAcrossThem) {
  // A quarter of a circle of 3 mm, of which one chord is within 1e-4 mm on 1/96.2; it rises by 6 mm across.
  struct Upright {
    const char* words;
    std::size_t first, second, across;
    double middle_of_first, middle_of_second;
  };
  for (const Upright& one :
       {Upright{"G18 G3 Z5 X3 Y6 K0 I3", 2, 0, 1, 2, 3}, Upright{"G19 G3 Y3 Z5 X6 J0 K3", 1, 2, 0, 0, 5}}) {
    const auto moves = read_moves({"p", std::string("G0 X0 Y0 Z2\nF9 ") + one.words + "\n"}, 0);
    ASSERT_TRUE(moves) << moves.error().message;
    EXPECT_EQ(moves->size(), 97U) << one.words;
    std::array<double, 3> end{0, 0, 2};
    for (std::size_t k = 0; k < moves->size(); ++k) {
      const Move& move = (*moves)[k];
      EXPECT_EQ((std::array{move.from.x, move.from.y, move.from_z}), end);
      end = {move.to.x, move.to.y, move.to_z};
      EXPECT_NEAR(end[one.across], 6 * static_cast<double>(k + 1) / static_cast<double>(moves->size()),
                  1e-12);
      EXPECT_NEAR(std::hypot(end[one.first] - one.middle_of_first, end[one.second] - one.middle_of_second), 3,
                  1e-12);
      const double way =
          std::hypot(move.to.x - move.from.x, move.to.y - move.from.y, move.to_z - move.from_z);
      EXPECT_NEAR(way, std::hypot(6 * std::sin(std::acos(0.0) / 2 / 97), 6.0 / 97), 1e-12);
    }
    EXPECT_EQ(end[one.across], 6);
    EXPECT_EQ(end[one.second], one.middle_of_second);
  }
}

TEST(VerifyNcReader, AnArcByRadiusReachesItsBoundsExactly) {
  const auto middle = [](double half) {
    const auto moves = read_moves({"p", fmt::format("G0 X0 Y0 Z5\nF9 G3 X{:.17g} R1\n", 2 * half)}, 0);
    return moves ? moves->back().centre.y : std::nan("");
  };
  const double largest = 1 + 5e-5 * 25.4;
  EXPECT_EQ(middle(largest), 0);
  EXPECT_TRUE(std::isnan(middle(std::nextafter(largest, 2))));
  EXPECT_NEAR(middle(1 - 1e-12), std::sqrt(2e-12), 1e-9);
  EXPECT_EQ(middle(std::nextafter(1 - 1e-12, 1)), 0);
}

TEST(VerifyNcReader, ArcsOfOtherPlanesComeToTheirEndItself) {
  for (const char* number : {"0.1", "0.3", "0.7", "1.1", "1.7", "2.3", "3.9"}) {
    const auto moves =
        read_moves({"p", fmt::format("G0 X0 Y0 Z2\nF9 G18 G3 X{0} Z[2-{0}] I0 K-{0}\n", number)}, 0);
    ASSERT_TRUE(moves) << moves.error().message;
    EXPECT_EQ(fmt::format("{}", moves->back().to.x), number);
    EXPECT_EQ(moves->back().to_z, 2 - moves->back().to.x);
  }
}

TEST(VerifyNcReader, OffsetsAndToolsAreChosenBeforeThePlaceIsKnown) {
  const Case cases[] = {
      {"G54\nG0 X1 Y1 Z1\nG54 X2\n", "1,1,1>2,1,1R "},
      {"G54\nG0 X1 Y1 Z1\nG55 X2\n",
       "p:3: G55 after the first motion changes where the program's places are"},
      {"G43 H1\nG0 X1 Y1 Z1\nG43 H1 X2\n", "1,1,1>2,1,1R "},
      {"G43 H1\nG0 X1 Y1 Z1\nG43 H2 X2\n",
       "p:3: G43 after the first motion changes where the program's places are"},
      {"G43 H1\nG0 X1 Y1 Z1\nG49 X2\n",
       "p:3: G49 after the first motion changes where the program's places are"},
      {"G0 X1 Y1\nG43 H1\nZ1\nX2\n", "1,1,1>2,1,1R "},
      {"G0 Z1\nG43 H1\nX1 Y1\nX2\nZ1\nX3\n", "2,1,1>3,1,1R "},
      {"G0 X1 Y1\nG55\nZ1\nX2 Y1\nX3\n", "2,1,1>3,1,1R "},
      {"T1 M6\nG0 X1 Y1 Z1\nT2\nX2\nM6\nG0 X1 Y1 Z1\nX2\n", "1,1,1>2,1,1R 1,1,1>2,1,1R "},
      {"G0 X1 Y1 Z1\nG1 X2 F9\nT2\n", "p:3: a change of the tool after the first cut"},
      {"G0 X1 Y1 Z1\nX2\nT2\n", "1,1,1>2,1,1R "},
      {"G0 X1 Y1 Z0\nX2\nT2\n", "1,1,0>2,1,0R "},
      {"G0 X1 Y1 Z1\nZ-1\nT2\n", "p:3: a change of the tool after the first cut"},
      {"G0 X1 Y1 Z1\nG2 I1 F9\nM6\n", "p:3: a change of the tool after the first cut"},
      {"G0 X1 Y1 Z1\nG53 G0 Z0\nX2\nZ2\nX3\n", "2,1,2>3,1,2R "},
      {"G0 X1 Y1 Z1\nG91 G53 G0 Z0\n", "p:2: G53 without G0 and G90"},
      {"G0 X1 Y1 Z1\nG53 G1 Z0 F9\n", "p:2: G53 without G0 and G90"},
      {"G0 X1 Y1 Z1\nG53 G0 X0 Z0\n", "p:2: G53 to a place of the machine in X and Y; Z alone is understood"},
      {"G0 X1 Y1 Z1\nG28 Y0 Z0\n", "p:2: G28 to a place of the machine in X and Y; Z alone is understood"},
      {"G0 X1 Y1 Z1\nG28\n", "p:2: G28 to a place of the machine in X and Y; Z alone is understood"},
      {"G0 X1 Y1 Z1\nG28 Z3\nX2\nZ2\nX3\n", "1,1,1>1,1,3R 2,1,2>3,1,2R "},
      {"G0 X1 Y1 Z1\nG1 G28 Z3\n",
       "p:1: X has no decimal point, and Haas controls may count it in thousandths", Control::haas},
      {"G0 X1. Y1. Z1.\nG1 G28 Z3. F9.\nX2.\n", "p:3: a motion with feed from a place that no block has said",
       Control::haas},
      {"G0 X1 Y1 Z0\n", ""},
      {"G0 X1 Y1 Z-0.1\n", "p:1: G0 below Z 0 from a place that no block has said"},
      {"G0 X1 Z1\nG1 X2 F9\n", "p:2: a motion with feed from a place that no block has said"},
      {"G0 Y1 Z1\nG1 Y2 F9\n", "p:2: a motion with feed from a place that no block has said"},
      {"G0 X1 Y1 Z1\nG4 P1 X2\n", "p:2: a dwell beside a motion; give it a block of its own"},
      {"G0 X1 Y1 Z1\nG53 Z0\nX2\n", ""},
      {"G80\nY1\n", "p:2: a motion before any of G0, G1, G2, G3"},
      {"G80\nZ1\n", "p:2: a motion before any of G0, G1, G2, G3"},
      {"M3 S9\nT1 M6\nG0 X0 Y0 Z5\nF9 G98 G86 X1 Z-1 R2 P1\n", "p:4: G86 while the spindle does not turn so"},
      {"G91 G0 Z1\n", "p:1: a step of Z from a place that no block has said"},
      {"G0 X1 Y1 Z1\nG1 X2 F9\nG0 X3\nT2\n", "p:4: a change of the tool after the first cut"},
  };
  for (const Case& one : cases) EXPECT_EQ(judged(one.program, one.control), one.says) << one.program;
}

TEST(VerifyNcReader, UnitsPlanesAndModesHoldUntilTheyAreChanged) {
  const Case cases[] = {
      {"G20 G0 X1 Y1 Z1\nG1 X2 F10\nG21\nX1 F10\n",
       "25.4,25.4,25.4>50.8,25.4,25.4F254 50.8,25.4,25.4>1,25.4,25.4F10 "},
      {"G20 F10\nG0 X1 Y1 Z1\nG21\nG1 X1\n",
       "p:1: a feed beside a change of its unit; give it a block of its own"},
      {"G21 F10\nG20 F10\n", "p:2: a feed beside a change of its unit; give it a block of its own"},
      {"F10 G21\n", ""},
      {"G0 X1 Y1 Z1 F10\nG94\nG1 X2\n", "p:3: a motion with feed before any F"},
      {"G0 X1 Y1 Z1\nG91 G1 X1 F9\nX1\nG90 X1\n", "1,1,1>2,1,1F9 2,1,1>3,1,1F9 3,1,1>1,1,1F9 "},
      {"G0 X1 Y1 Z1\nG1 X1 F9\n", ""},
      {"G0 X1 Y1 Z1\nG1 F9\nX2\n", "1,1,1>2,1,1F9 "},
      {"G0 X1 Y1 Z1\nM30\n", ""},
      {"G0 X1 Y1 Z1\nM1\nX2\nM0\nX3\n", "1,1,1>2,1,1R 2,1,1>3,1,1R "},
      {"G4 X1.\n", "", Control::fanuc},
      {"G0 G4 X1.\n", "", Control::fanuc},
      {"G0 G4 X1. Y1.\n", "p:1: a dwell beside a motion; give it a block of its own", Control::fanuc},
      {"G0 G4 X1. Z1.\n", "p:1: a dwell beside a motion; give it a block of its own", Control::fanuc},
      {"G80 G0 X1. Y1. Z1.\nX2.\n", "1,1,1>2,1,1R ", Control::haas},
      {"G80 G81 X1. Y1. Z1. R1.\n", "p:1: G80 and G81 exclude each other", Control::haas},
  };
  for (const Case& one : cases) EXPECT_EQ(judged(one.program, one.control), one.says) << one.program;
}

// ---- lines ------------------------------------------------------------------------------------------------

TEST(VerifyNcReader, LinesHaveTheirLettersAndBounds) {
  const std::string a251(251, 'a');
  EXPECT_EQ(judged(";" + a251 + "\n"), "");
  EXPECT_EQ(judged(";" + a251 + "a\n"), "p:1: the line is longer than 252 bytes");
  EXPECT_EQ(judged("G0 X1 Y1 Z1\x7f\n"), "p:1: a control character inside a line");
  EXPECT_EQ(judged("G0 X1 Y1 Z1\x1f\n"), "p:1: a control character inside a line");
  EXPECT_EQ(judged("G0 X1 Y1 Z1\t\n"), "");
  EXPECT_EQ(judged("N123456789 G0 X1 Y1 Z1\nX2\n"), "1,1,1>2,1,1R ");
  EXPECT_EQ(judged("N1234567890 G0 X1 Y1 Z1\n"), "p:1: N has more than 9 digits");
  EXPECT_EQ(judged("N\n"), "p:1: N is not followed by a plain number");
  EXPECT_EQ(judged("O1234567890\nG0 X1 Y1 Z1\nX2\n"), "1,1,1>2,1,1R ");
  EXPECT_EQ(judged("O1 G0 X1\n"), "p:1: words beside the number of the program");
  EXPECT_EQ(judged("N1 O1\n"), "p:1: O does not begin its block");
  EXPECT_EQ(judged("M7 M9\n"), "p:1: M7 and M9 exclude each other");
  EXPECT_EQ(judged("M0 M3 M8 M48\n"), "");
  EXPECT_EQ(judged("G999.9\n"), "p:1: G999.9 is not understood here");
  EXPECT_EQ(judged("G1000\n"), "p:1: G1000 is not understood here");
  EXPECT_EQ(judged("G-0.1\n"), "p:1: G-0.1 is not understood here");
  EXPECT_EQ(judged("S0 T0 G64 P0 Q0\n"), "");
  EXPECT_EQ(judged("T-1\n"), "p:1: T is not a whole number from 0 on");
  EXPECT_EQ(judged("A0 B0 C0 G0 X1\n"), "");
  EXPECT_EQ(judged("G0 X1 A1\n"), "p:1: A turns the part; programs of X, Y and Z are understood");
  EXPECT_EQ(judged("G0 X1 B-1\n"), "p:1: B turns the part; programs of X, Y and Z are understood");
  EXPECT_EQ(judged("M64 P0\n"), "");
  EXPECT_EQ(judged("M10 M11\n", Control::haas), "");
  EXPECT_EQ(judged("M0 M3 M8 M10 M29\n", Control::haas), "");
  EXPECT_EQ(judged("G0 X1 Y1\nZ5\nX2\n", Control::linuxcnc, 1), "1,1,5>2,1,5R ");
  EXPECT_EQ(judged("{}\n"), "p:1: the character \"{\" is not understood");
  EXPECT_EQ(judged("{\n"), "p:1: the character \"{\" is not understood");
  EXPECT_EQ(judged("@\n"), "p:1: the character \"@\" is not understood");
  EXPECT_EQ(judged("[\n"), "p:1: the character \"[\" is not understood");
}

/// A program with `B0.` on a line of its own was rewritten, and then not read.
TEST(VerifyNcReader, ARotaryWordAloneMovesUnderG0AndG1Only) {
  const std::string there = "G0 X1 Y1 Z1\n";
  for (const char* words : {"A0.", "B0.", "C0."})
    EXPECT_EQ(judged(there + words + "\nX2\n"), "1,1,1>2,1,1R ") << words;
  EXPECT_EQ(judged(there + "G1 X2 F9\nA0 B0 C0 M8\nX3\n"), "1,1,1>2,1,1F9 2,1,1>3,1,1F9 ");
  EXPECT_EQ(compared(there + "B0.\nG1 B0.\nB0.\nX2\n"),
            "1:1,1,1>1,1,1R\n2:G0 B0\n3:G1 B0\n4:G1 B0\n5:1,1,1>2,1,1F0\n");
  EXPECT_EQ(judged(there + "B1\n"), "p:2: B turns the part; programs of X, Y and Z are understood");
  EXPECT_EQ(judged("B0.\n"), "p:1: no word of the block takes B");
  EXPECT_EQ(judged(there + "G80\nC0\n"), "p:3: no word of the block takes C");
  EXPECT_EQ(judged(there + "G80 A0\n"), "p:2: no word of the block takes A");
  EXPECT_EQ(judged(there + "G2 I5 F9\nB0\n"), "p:3: no word of the block takes B");
  EXPECT_EQ(judged(there + "G98 G81 Z-1 R1 F9\nB0\n"), "p:3: no word of the block takes B");
  EXPECT_EQ(judged(there + "G98 G81 X1 A0 Z-1 R1 F9\n"), "p:2: no word of the block takes A");
  for (const Control control : {Control::fanuc, Control::haas})
    EXPECT_EQ(compared("G0 X1. Y1. Z1.\nG98 G81 X2. A0 Z-1. R1. F9.\nX3. A0\n", control),
              compared("G0 X1. Y1. Z1.\nG98 G81 X2. A0 Z-1. R1. F9.\nA0 X3.\n", control));
  for (const char* words : {"A0", "B0", "C0"})
    EXPECT_EQ(judged(there + "G4 P1 " + words + "\n"),
              "p:2: a dwell beside a motion; give it a block of its own");
  EXPECT_EQ(judged("G0 X1. Y1. Z1.\nG4 X1. B0\n", Control::fanuc),
            "p:2: a dwell beside a motion; give it a block of its own");
}

TEST(VerifyNcReader, ABlockThatMayBeSkippedDoesNothing) {
  for (const char* harmless :
       {"/\n", "/M0\n", "/M1\n", "/M7\n", "/M8\n", "/M9\n", "/S100\n", "/G4 P1\n", "/N5\n", " /(a)\n"})
    EXPECT_EQ(judged(harmless), "") << harmless;
  for (const char* acting : {"/M2\n", "/M3\n", "/M6\n", "/M30\n", "/G0\n", "/X1\n", "/A0\n", "/Z1\n", "/P1\n",
                             "/M8 P1\n", "/T1\n", "/F1\n"})
    EXPECT_EQ(judged(acting), "p:1: a block that may be skipped is not understood; take out the /") << acting;
  // What it would say counts for nothing.
  EXPECT_EQ(compared("/M8\nM9\n"), "2:M9\n");
}

TEST(VerifyNcReader, CommentsThatActOnTheControlAreRefused) {
  const std::string acts = "p:1: a comment that acts on the control is not understood";
  for (const char* word :
       {"PY", "python", "Abort", "PROBE OPEN", "probeclose", "logopen", "log\tappend", "LOGCLOSE"}) {
    EXPECT_EQ(judged(fmt::format("({},x)\n", word)), acts) << word;
    EXPECT_EQ(judged(fmt::format("G0 ;{},\n", word)), acts) << word;
    EXPECT_EQ(judged(fmt::format("({} x)\n", word)), "") << word;
    EXPECT_EQ(judged(fmt::format("(a{},x)\n", word)), "") << word;
  }
  EXPECT_EQ(judged("(py,)\n"), acts);
  EXPECT_EQ(judged("(msg, hello)\n(debug,x)\n(,)\n"), "");
  EXPECT_EQ(judged("(a(b)c)\n", Control::haas), "");
  EXPECT_EQ(judged("(a(b)c\n", Control::haas), "p:1: a comment is not closed");
  EXPECT_EQ(judged("(a)b)\n", Control::haas), "p:1: B is not followed by a plain number");
}

TEST(VerifyNcReader, TapeMarksBeginAndEndAProgram) {
  EXPECT_EQ(judged("%\nG0 X1 Y1 Z1\nX2\n%\n"), "1,1,1>2,1,1R ");
  EXPECT_EQ(judged("%\n%\n"), "");
  EXPECT_EQ(judged("%\n%\nG0 X1\n"), "p:3: words after the end of the program");
  EXPECT_EQ(judged("%\n%\n#1=2\n"), "p:3: words after the end of the program");
  EXPECT_EQ(judged("%\n%\n(nothing)\n"), "");
  EXPECT_EQ(judged("(a)\n%\n"), "p:2: % after a beginning without %");
  EXPECT_EQ(judged(" % \t\n"), "");
  EXPECT_EQ(judged("%x\n"), "p:1: % does not stand alone on its line");
}

TEST(VerifyNcReader, NumbersAreReadAsTheyAreWritten) {
  EXPECT_EQ(judged("G0 X+1.5 Y-.5 Z 1\nX#1\n"), "p:2: variable #1 is read and was not set");
  EXPECT_EQ(judged("#1=2 (a remark)\nG0 X#1 Y-#1 Z+[#1*2]\nX[#1+1]\n"), "2,-2,4>3,-2,4R ");
  EXPECT_EQ(judged("#1=2\nG0 X - #1 Y1 Z1\nX1\n"), "-2,1,1>1,1,1R ");
  EXPECT_EQ(judged("#1=2\nN#1 G0 X1\n"), "p:2: the number of a block is computed");
  EXPECT_EQ(judged("#1=2\nO#1\n"), "p:2: the number of a block is computed");
  EXPECT_EQ(judged("G0 X+-1\n"), "p:1: X is not followed by a plain number");
  EXPECT_EQ(judged("G0 X-\n"), "p:1: X is not followed by a plain number");
  EXPECT_EQ(judged("G0 X- \n"), "p:1: X is not followed by a plain number");
  for (const char* computed : {"#1=2\n", "G0 X[1]\n"})
    EXPECT_EQ(judged(computed, Control::grbl), "p:1: a variable or expression is no word of this control");
  EXPECT_EQ(judged("G0 X[-4/2] Y[-1*-2] Z[7 MOD 4]\nX[1]\n"), "-2,2,3>1,2,3R ");
  EXPECT_EQ(judged("G0 X\n"), "p:1: X is not followed by a plain number");
  // Where whole numbers may be thousandths, 0 and what is computed say no unit.
  EXPECT_EQ(judged("G0 X0 Y0. Z1.\nX2.\n", Control::fanuc), "0,0,1>2,0,1R ");
  EXPECT_EQ(judged("G0 X0 Y0. Z1\n", Control::fanuc),
            "p:1: Z has no decimal point, and Fanuc controls may count it in thousandths");
}

}  // namespace
}  // namespace lekalo::verify::verify_nc_reader_test

#include "lekalo/verify/cut_history.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace lekalo::verify::verify_cut_history_test {
namespace {

constexpr double kPi = 3.141592653589793;

std::string rectangle(double width, double height, const char* last_edge = "") {
  return fmt::format(
      R"({{"units":"mm","outer":[{{"line":{{"from":[0,0],"to":[{0},0]}}}},{{"line":{{"from":[{0},0],"to":[{0},{1}]}}}},)"
      R"({{"line":{{"from":[{0},{1}],"to":[0,{1}]}}}},{{"line":{{"from":[0,{1}],"to":[0,0]}}{2}}}]}})",
      width, height, last_edge);
}
const std::string kWide = rectangle(70, 40);
const std::string kBegin = "G21 G90 G17\nG0 X10 Y10 Z5\nG1 Z-1 F300\n";

SimulateOptions tool(double diameter) {
  SimulateOptions options;
  options.tool_diameter = diameter;
  return options;
}

CutHistory run(const std::string& program, const std::string& pocket = kWide,
               const SimulateOptions& options = tool(6), double longest = 0.25) {
  auto made = cut_history({"part.ngc", program}, {"pocket.json", pocket}, options, {}, longest);
  if (!made) {
    ADD_FAILURE() << made.error().message;
    return {};
  }
  return std::move(*made);
}

double volume_of(const CutHistory& history, std::size_t line = 0) {
  double sum = 0;
  for (const CutPiece& piece : history.pieces)
    if (line == 0 || piece.line == line) sum += piece.volume();
  return sum;
}

TEST(VerifyCutHistory, ASlotTakesOffItsWidthTimesItsDepth) {
  const CutHistory history = run(kBegin + "G1 X50 F1500\n");
  EXPECT_NEAR(volume_of(history, 3), kPi * 9, 1e-5);
  EXPECT_NEAR(volume_of(history, 4), 6 * 40, 1e-5);
  for (const CutPiece& piece : history.pieces) {
    if (piece.line != 4) continue;
    ASSERT_EQ(piece.rim.size(), 1U);
    EXPECT_EQ(piece.rim[0].low_z, -1);
    EXPECT_EQ(piece.rim[0].high_z, 0);
    EXPECT_NEAR(piece.rim[0].begin, -kPi / 2, 1e-6);
    EXPECT_NEAR(piece.rim[0].end, kPi / 2, 1e-6);
    EXPECT_EQ(piece.floor_area, 0);
    EXPECT_EQ(piece.feed, 1500);
    EXPECT_LE(piece.length, 0.25 + 1e-12);
  }
}

TEST(VerifyCutHistory, PiecesFollowOneAnotherWithoutAGap) {
  const std::string program = kBegin + "G4 P2.5\nG1 X50 F1500\nG3 X50 Y20 I0 J5\nG0 Z5\nG0 X5 Y5\n";
  const CutHistory history = run(program);
  const auto simulated = simulate({"part.ngc", program}, {"pocket.json", kWide}, tool(6));
  ASSERT_TRUE(simulated);
  EXPECT_NEAR(history.seconds, simulated->seconds + 2.5, 1e-9);
  double at = 0;
  const CutPiece* before = nullptr;
  for (const CutPiece& piece : history.pieces) {
    EXPECT_NEAR(piece.start, at, 1e-9) << piece.line;
    EXPECT_GT(piece.seconds, 0) << piece.line;
    at += piece.seconds;
    if (before != nullptr) {
      EXPECT_NEAR(std::hypot(piece.from_x - before->to_x, piece.from_y - before->to_y), 0, 1e-9)
          << piece.line;
      EXPECT_NEAR(piece.from_z, before->to_z, 1e-9) << piece.line;
    }
    before = &piece;
  }
  EXPECT_NEAR(at, history.seconds, 1e-9);
}

TEST(VerifyCutHistory, TheClockKnowsHowLongAMoveSpeedsUp) {
  // From the plunge's 5 mm/s at most to 25 mm/s at 500 mm/s2, and down to 0 at the program's end.
  const CutHistory history = run(kBegin + "G1 X50 F1500\n");
  double spent = 0, last = 0;
  for (const CutPiece& piece : history.pieces) {
    if (piece.line != 4) continue;
    if (std::abs(piece.from_x - 30) < 5) {
      EXPECT_NEAR(piece.seconds, piece.length / 25, 1e-9);
    }
    spent += piece.seconds, last = std::sqrt(2 * piece.length / 500);
  }
  EXPECT_NEAR(history.pieces.back().seconds, last, 1e-9);
  // It takes 20 to 25 mm/s less for a while at the beginning.
  EXPECT_GT(spent, 40 / 25.0 + 25 * 25 / 500.0 / 2 / 25 + 20 * 20 / 500.0 / 2 / 25 - 1e-9);
  EXPECT_LT(spent, 40 / 25.0 + 25 * 25 / 500.0 / 25 + 1e-9);
}

// A dwell is a piece of its own, where and when the tool stands.
TEST(VerifyCutHistory, DwellsStandWhereTheToolIs) {
  const CutHistory history =
      run("G21 G90 G17\nG0 X10 Y10 Z5\nG4 P1\nG1 Z-1 F300\nG1 X50 F1500\nG4 P2\nG4 P3\nG1 X20\nG4 P4\n");
  std::vector<const CutPiece*> dwells;
  for (const CutPiece& piece : history.pieces)
    if (piece.length == 0 && piece.from_z == piece.to_z) dwells.push_back(&piece);
  ASSERT_EQ(dwells.size(), 4U);
  const std::vector<std::array<double, 3>> places{{10, 10, 5}, {50, 10, -1}, {50, 10, -1}, {20, 10, -1}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(dwells[i]->seconds, static_cast<double>(i + 1));
    const CutPiece& d = *dwells[i];
    for (const auto& at : {std::array{d.from_x, d.from_y, d.from_z}, {d.to_x, d.to_y, d.to_z}})
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(at[k], places[i][k], 1e-9) << i << k;
    EXPECT_EQ(d.volume(), 0);
  }
  EXPECT_EQ(dwells.back(), &history.pieces.back());
  for (std::size_t i = 1; i < history.pieces.size(); ++i) {
    const CutPiece &before = history.pieces[i - 1], &piece = history.pieces[i];
    EXPECT_NEAR(piece.start, before.start + before.seconds, 1e-9) << i;
  }
}

// Doubles do not tell the square of such a way from 0, so that it has no piece that the clock knows.
TEST(VerifyCutHistory, DwellsBeforeAWayThatIsTooShortAreAtTheirTime) {
  const std::string begin = kBegin + "G1 X50 F1500\nG0 Z5\nG0 X0\nG4 P2\n";
  const auto tiny = [](const char* digit) { return "G0 X0." + std::string(180, '0') + digit + "\n"; };
  for (const std::string& program :
       {begin + tiny("1"), begin + tiny("1") + "G4 P3\n" + tiny("2") + "G0 X9\n"}) {
    const CutHistory history = run(program);
    ASSERT_GT(history.pieces.size(), 2U);
    double waited = 0;
    for (std::size_t i = 1; i < history.pieces.size(); ++i) {
      const CutPiece &before = history.pieces[i - 1], &piece = history.pieces[i];
      EXPECT_NEAR(piece.start, before.start + before.seconds, 1e-9) << i;
      if (piece.length == 0 && piece.from_z == piece.to_z) waited += piece.seconds;
    }
    EXPECT_NEAR(history.pieces.back().start + history.pieces.back().seconds, history.seconds, 1e-9);
    EXPECT_EQ(waited, program.ends_with("X9\n") ? 5 : 2);
  }
}

TEST(VerifyCutHistory, SaysHowFarItIs) {
  std::vector<Progress> told;
  const auto made = cut_history({"p.ngc", kBegin + "G1 X50 F1500\nG1 Y20\nG1 X20\n"}, {"pocket.json", kWide},
                                tool(6), {}, 1, [&](const Progress& p) { told.push_back(p); });
  ASSERT_TRUE(made);
  EXPECT_EQ(told.size(), 1U) << "of four cuts the first";
}

TEST(VerifyCutHistory, DwellsAreInTheUnitsOfTheControl) {
  const auto seconds = [](const char* words, words::Control control) {
    auto options = tool(6);
    options.control = control;
    const std::string begin = "G21 G90 G17\nG0 X10. Y10. Z5.\nG1 Z-1. F300.\n";
    return run(begin + words + "\nG1 X50.\n", kWide, options).seconds -
           run(begin + "G1 X50.\n", kWide, options).seconds;
  };
  using words::Control;
  EXPECT_NEAR(seconds("G4 P2", Control::linuxcnc), 2, 1e-9);
  EXPECT_NEAR(seconds("G4 P2", Control::grbl), 2, 1e-9);
  EXPECT_NEAR(seconds("G4 P2.", Control::haas), 2, 1e-9);
  EXPECT_NEAR(seconds("G4 P2000", Control::haas), 2, 1e-9);
  EXPECT_NEAR(seconds("G4 P2000", Control::fanuc), 2, 1e-9);
  EXPECT_NEAR(seconds("G4 X2.", Control::fanuc), 2, 1e-9);
  EXPECT_NEAR(seconds("G4 U2.", Control::fanuc), 2, 1e-9);
  EXPECT_NEAR(seconds("G4 U2000", Control::fanuc), 2, 1e-9);
  EXPECT_NEAR(seconds("G4 P2000.", Control::fanuc), 2, 1e-9);
}

TEST(VerifyCutHistory, AMotionToWhereTheToolIsTakesNoTime) {
  const std::string first = "G1 X50 F1500\nG4 P2\n", second = "G1 X20\nG4 P4\n";
  const CutHistory plain = run(kBegin + first + second);
  const CutHistory with_none = run(kBegin + first + "G1 X50\n" + second + "G1 X20\n");
  EXPECT_NEAR(with_none.seconds, plain.seconds, 1e-9);
  ASSERT_EQ(with_none.pieces.size(), plain.pieces.size());
  for (std::size_t i = 0; i < plain.pieces.size(); ++i) {
    EXPECT_NEAR(with_none.pieces[i].start, plain.pieces[i].start, 1e-9) << i;
    EXPECT_NEAR(with_none.pieces[i].seconds, plain.pieces[i].seconds, 1e-9) << i;
  }
}

TEST(VerifyCutHistory, ADeeperPassBesideASlotMeetsTwoLayers) {
  const CutHistory history =
      run(kBegin + "G1 X60 F1500\nG0 Z5\nG0 X10 Y13\nG1 Z-3 F300\nG1 X60 F1500\n", kWide, tool(6));
  std::size_t found = 0;
  for (const CutPiece& piece : history.pieces) {
    if (piece.line != 8 || std::abs(piece.from_x - 35) > 5) continue;
    ++found;
    ASSERT_EQ(piece.rim.size(), 2U);
    // Below the slot the whole rim cuts, beside it the half that is farther out.
    EXPECT_EQ(piece.rim[0].low_z, -3);
    EXPECT_EQ(piece.rim[0].high_z, -1);
    EXPECT_NEAR(piece.rim[0].width, 6, 1e-6);
    EXPECT_EQ(piece.rim[1].low_z, -1);
    EXPECT_EQ(piece.rim[1].high_z, 0);
    EXPECT_NEAR(piece.rim[1].width, 3, 1e-6);
    EXPECT_NEAR(piece.rim[1].begin, 0, 1e-6);
    EXPECT_NEAR(piece.rim[1].end, kPi / 2, 1e-6);
  }
  EXPECT_GT(found, 20U);
}

TEST(VerifyCutHistory, AStripThatStandsBetweenTwoSlotsIsAnArcAhead) {
  // Slots at 10 and 18 leave 2 mm between them, and a pass at 14 meets those ahead.
  const CutHistory history = run(kBegin +
                                 "G1 X60 F1500\nG0 Z5\nG0 X10 Y18\nG1 Z-1 F300\nG1 X60 F1500\n"
                                 "G0 Z5\nG0 X10 Y14\nG1 Z-1 F300\nG1 X60 F1500\n");
  for (const CutPiece& piece : history.pieces) {
    if (piece.line != 12 || std::abs(piece.from_x - 35) > 5) continue;
    ASSERT_EQ(piece.rim.size(), 1U);
    EXPECT_NEAR(piece.rim[0].width, 2, 1e-6);
    EXPECT_NEAR(piece.rim[0].begin, -std::asin(1 / 3.0), 1e-6);
    EXPECT_NEAR(piece.rim[0].end, std::asin(1 / 3.0), 1e-6);
  }
}

TEST(VerifyCutHistory, APlungeBesideASlotTakesOffWhatTheSlotLeft) {
  // Half of the disc at Y13 stands beside the slot, and all of it is below.
  const CutHistory history = run(kBegin + "G1 X60 F1500\nG0 Z5\nG0 X35 Y13\nG1 Z-3 F300\n", kWide, tool(6));
  EXPECT_NEAR(volume_of(history, 7), kPi * 9 / 2 + 2 * kPi * 9, 0.1);
  for (const CutPiece& piece : history.pieces) {
    if (piece.line != 7 || !(piece.to_z < -1 - 1e-9)) continue;
    EXPECT_NEAR(piece.floor_area, kPi * 9, 1e-5);
  }
}

TEST(VerifyCutHistory, ARampTakesOffWhatItSinksInto) {
  // Down over 30 mm and back on the level: a slot 2 mm deep with round ends.
  const CutHistory history =
      run("G21 G90\nG0 X20 Y20 Z5\nG1 Z0 F300\nG1 X50 Z-2 F600\nG1 X20\n", kWide, tool(6));
  const double slot = (30 * 6 + kPi * 9) * 2;
  // Half of what half a radius of the ramp sinks, over all its ground.
  const double twice = 0.5 * 1.5 / 30 * 2 * (30 * 6 + kPi * 9);
  EXPECT_GT(volume_of(history), slot - 0.01 * slot);
  EXPECT_LT(volume_of(history), slot + twice + 0.01 * slot);
}

TEST(VerifyCutHistory, ADrillTakesOffItsCylinder) {
  const CutHistory history = run("G21 G90\nG0 X20 Y20 Z5\nG98 G83 Z-6 R1 Q2 F100\nG80\n");
  EXPECT_NEAR(volume_of(history), kPi * 9 * 6, 1e-4);
  for (const CutPiece& piece : history.pieces) {
    EXPECT_GT(piece.seconds, 0);
    if (piece.volume() > 0) {
      EXPECT_LE(piece.from_z - piece.to_z, 0.25 + 1e-9);
    }
  }
}

TEST(VerifyCutHistory, NothingIsTakenOffBeyondAnOpenEdge) {
  const CutHistory history =
      run("G21 G90\nG0 X-8 Y20 Z5\nG1 Z-1 F300\nG1 X40 F1500\n", rectangle(70, 40, R"(,"open":true)"));
  // From the edge to the tool's foremost place, with its round front.
  EXPECT_NEAR(volume_of(history), 40 * 6 + kPi * 9 / 2, 0.1);
}

TEST(VerifyCutHistory, AMirroredOrReversedPassTakesOffAsMuch) {
  const auto pass = [](const char* y, const char* from, const char* to) {
    return volume_of(
        run(fmt::format("G21 G90\nG0 X10 Y20 Z5\nG1 Z-1 F300\nG1 X60 F1500\nG0 Z5\nG0 X{1} Y{0}\n"
                        "G1 Z-1 F300\nG1 X{2} F1500\n",
                        y, from, to)));
  };
  const double left = pass("22", "10", "60");
  // The ends are those of two discs 2 mm apart, together.
  const double ends = 2 * kPi * 9 - (18 * std::acos(1 / 3.0) - std::sqrt(32.0));
  EXPECT_NEAR(left, 50 * 8 + ends, 0.1);
  EXPECT_NEAR(pass("18", "10", "60"), left, 1e-4);
  EXPECT_NEAR(pass("22", "60", "10"), left, 1e-4);
}

TEST(VerifyCutHistory, WhatEarlierProgramsCutIsGone) {
  const std::string program = kBegin + "G1 X60 F1500\n";
  const auto made =
      cut_history({"b.ngc", program}, {"pocket.json", kWide}, tool(6), {{{"a.ngc", program}, 6.0}}, 0.25);
  ASSERT_TRUE(made);
  EXPECT_NEAR(volume_of(*made), 0, 1e-6);
}

// Two holes behind the tool divide the heights, and the slot beside it alone changes what it meets.
TEST(VerifyCutHistory, LayersOfOneArcAreOne) {
  const CutHistory history =
      run("G21 G90 G17\nG0 X5 Y15 Z5\nG1 Z-1 F300\nG1 X65 F1500\nG0 Z5\nG0 X10 Y10\nG1 Z-2 F300\nG0 Z5\nG1 "
          "Z-3\nG0 Z5\n"
          "G1 Z-4\nG1 X40 F1500\n");
  std::size_t found = 0;
  for (const CutPiece& piece : history.pieces) {
    if (piece.line != 12 || std::abs(piece.from_x - 14.5) > 1) continue;
    ++found;
    ASSERT_EQ(piece.rim.size(), 2U);
    EXPECT_EQ(piece.rim[0].low_z, -4);
    EXPECT_EQ(piece.rim[0].high_z, -1);
    EXPECT_NEAR(piece.rim[0].width, 6, 1e-6);
    EXPECT_NEAR(piece.rim[1].width, 5, 1e-6);
  }
  EXPECT_GT(found, 5U);
}

TEST(VerifyCutHistory, AWiderToolReachesFarther) {
  const std::string wide = "G21 G90 G17\nG0 X15 Y15 Z5\nG1 Z-1 F300\nG1 X55 F1500\n";
  const auto made = cut_history({"b.ngc", "G21 G90 G17\nG0 X20 Y25 Z5\nG1 Z-1 F300\nG1 X50 F1500\n"},
                                {"pocket.json", kWide}, tool(6), {{{"a.ngc", wide}, 20.0}}, 0.25);
  ASSERT_TRUE(made) << made.error().message;
  for (const CutPiece& piece : made->pieces) {
    if (piece.line != 4 || std::abs(piece.from_x - 35) > 5) continue;
    EXPECT_NEAR(piece.volume(), 3 * piece.length, 1e-6);
  }
  EXPECT_NEAR(volume_of(*made, 4), 30 * 3, 1);
}

// A plunge from the ground of a slot down meets nothing above it.
TEST(VerifyCutHistory, APlungeGoesStraightDown) {
  const CutHistory history =
      run("G21 G90 G17\nG0 X10 Y10 Z5\nG1 Z-1 F300\nG1 X50 F1500\nG1 X10\nG1 Z-2\nG1 X50\nG1 Z-3\n");
  double at = -2;
  std::size_t found = 0;
  for (const CutPiece& piece : history.pieces) {
    if (piece.line != 8) continue;
    EXPECT_NEAR(piece.from_z, at, 1e-9);
    EXPECT_LT(piece.to_z, piece.from_z);
    at = piece.to_z, ++found;
  }
  EXPECT_EQ(found, 4U);
  EXPECT_EQ(at, -3);
  EXPECT_NEAR(volume_of(history, 8), kPi * 9, 1e-4);
}

TEST(VerifyCutHistory, PiecesAreFromAThousandthToAHundredMillimetres) {
  const auto with = [](double longest) {
    return cut_history({"p.ngc", "G21 G90 G17\nG0 X10 Y10 Z5\nG1 Z-0.01 F300\n"}, {"pocket.json", kWide},
                       tool(6), {}, longest)
        .has_value();
  };
  for (const double longest : {1e-3, 0.25, 100.0}) EXPECT_TRUE(with(longest)) << longest;
  for (const double longest : {0.99e-3, 100.1, double{NAN}, -1.0}) EXPECT_FALSE(with(longest)) << longest;
}

TEST(VerifyCutHistory, PiecesOfNoLengthAreRefused) {
  const auto made = cut_history({"p.ngc", kBegin}, {"pocket.json", kWide}, tool(6), {}, 0);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::usage);
  EXPECT_EQ(made.error().message, "pieces of 0 mm: they are to be 0.001 to 100 mm long");
}

}  // namespace
}  // namespace lekalo::verify::verify_cut_history_test

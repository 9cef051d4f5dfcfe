#include <gtest/gtest.h>

#include <fmt/core.h>

#include <cmath>

#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/layout_texts.hpp"
#include "verify/profile/profile_moves.hpp"

/// What the checker reads in a profile program, and which cuts it accepts for a layout.
namespace lekalo::verify::verify_profile_test {
namespace {

std::string number(double value) { return fmt::format("{:.4g}", std::abs(value) < 1e-9 ? 0.0 : value); }
std::string point(Place p) { return number(p.x) + "," + number(p.y); }

/// Chains, each on a line: the line of its first cut, "r" where a rapid motion cuts, and its edges.
std::string told(const std::string& program) {
  const Result<ProfileProgram> read = read_profile({"p.nc", program}, words::Control::fanuc);
  if (!read) return read.error().message;
  std::string text;
  for (const CutChain& chain : read->chains) {
    text += std::to_string(chain.line) + (chain.rapid ? "r" : "") + ":";
    for (const Stroke& edge : chain.edges)
      text += (edge.arc ? " A " + point(edge.centre) + " " + number(edge.radius) + (edge.ccw ? " +" : " -")
                        : " L") +
              " " + point(edge.from) + " " + point(edge.to);
    text += "\n";
  }
  return text;
}
const std::string kModes = "G21 G17 G40 G49 G54 G90 G94\n";
/// The cuts of words behind a head of one line and before an end.
std::string cuts(const std::string& words) { return told(kModes + words + "\nM5\nM2\n"); }

TEST(VerifyProfileMoves, WhatIsOnCuts) {
  EXPECT_EQ(cuts("G0 X1 Y2\nM3 S100\nG1 X5 F200\nY6"), "4: L 1,2 5,2 L 5,2 5,6\n");
  EXPECT_EQ(cuts("G0 X1 Y2\nM4\nG1 X5\nM5\nG0 X9\nM4\nG1 X1"), "4: L 1,2 5,2\n8: L 9,2 1,2\n");
  EXPECT_EQ(cuts("G0 X1 Y2\nM3\nG0 X5"), "4r: L 1,2 5,2\n");
  EXPECT_EQ(cuts("G0 X1 Y2\nM3\nG1 X5\nG0 X6\nG1 X7"), "4r: L 1,2 5,2 L 5,2 6,2 L 6,2 7,2\n");
  EXPECT_EQ(cuts("G0 X1 Y2\nM3\nG2 X3 Y2 I1 J0\nG3 X1 Y2 I-1 J0"),
            "4: A 2,2 1 - 1,2 3,2 A 2,2 1 + 3,2 1,2\n");
  EXPECT_EQ(cuts("G0 X1 Y2"), "");
  EXPECT_EQ(told("G20 G17 G40 G49 G54 G90 G94\nG0 X1 Y2\nM3\nG1 X2\nM5\nM30\n"),
            "4: L 25.4,50.8 50.8,50.8\n");
  // Once an axis Z has been named, only what goes below 0 cuts.
  EXPECT_EQ(cuts("G0 Z5\nG0 X1 Y2\nM3\nG1 X9\nG1 Z-1\nG1 X3\nG1 X4\nG0 Z5\nG1 X8"),
            "7: L 9,2 3,2 L 3,2 4,2\n");
  EXPECT_EQ(cuts("G0 Z0\nG0 X1 Y2\nM3\nG1 X9\nG1 Z-1\nG1 X3"), "7: L 9,2 3,2\n");
  EXPECT_EQ(cuts("G0 X1 Y2\nM3\nG1 X5\nG1 Z-1\nG1 X6"), "4: L 1,2 5,2\n6: L 5,2 6,2\n");
  EXPECT_EQ(cuts("G0 X1 Y2\nM3\nG1 X5\nG4 P1\nG1 X6"), "4: L 1,2 5,2 L 5,2 6,2\n");
  EXPECT_EQ(cuts("G0 Z5\nX1 Y2\nM3\nG1 X9\nZ-1\nX3"), "7: L 9,2 3,2\n");
  EXPECT_EQ(cuts("G0 X1 Y2\nG0 Z-1\nG0 Z5"), "") << "nothing turns";
  EXPECT_EQ(cuts("G0 X1 Y2\nM3\nG1 X1 Y2\nX5"), "4: L 1,2 1,2 L 1,2 5,2\n");
}

TEST(VerifyProfileMoves, WordsAreReadAsTheyStand) {
  EXPECT_EQ(cuts("G0X1Y2\nM3\nG1X5.5 Y-.5"), "4: L 1,2 5.5,-0.5\n");
  EXPECT_EQ(cuts("G00 X1 Y2 (to the start) ; there\nM03\n\n;\n(a)\nG01 X5"), "7: L 1,2 5,2\n");
  EXPECT_EQ(told("%\nO1\n" + kModes + "G0 X1 Y2\nM3\nG1 X5\nM5\nM30\n%\n"), "6: L 1,2 5,2\n");
  EXPECT_EQ(told("O1\r\n" + kModes + "M2\r\n"), "");
  EXPECT_EQ(told("G61 G80 G91.1\n" + kModes + "G0 X1 Y2\nM2\n"), "");
}

TEST(VerifyProfileMoves, WhatIsNotWrittenThereIsRefusedWithItsLine) {
  const auto refused = [](const std::string& words, const std::string& said) {
    EXPECT_NE(cuts(words).find(said), std::string::npos) << words << "\n" << cuts(words);
  };
  const std::string no_word = "p.nc:2: lekalo writes no such word into a profile program: ";
  refused("G0 X1 X2", no_word);
  refused("G0 A1", no_word);
  refused("G0 x1", no_word);
  refused("G0 X", no_word);
  refused("G0 X+1", no_word);
  refused("G0 X1.2.3", no_word);
  refused("G-1 X1", no_word);
  refused("G-0 X1", no_word);
  refused("G0 Z5\nG0 X1 Y2\nM3\nG1 Z-1\nG1 X3\nM5\nG0 X9",
          "p.nc:8: a tool that stands still goes through the material");
  refused("G100 X1", no_word);
  refused("G1.05 X1", no_word);
  refused("M3.05", no_word);
  refused("(open", "p.nc:2: a comment is not closed");
  refused("G0.5 X1 Y1", "lekalo writes no G0.5 into a profile program");
  refused("G5 X1 Y1", "lekalo writes no G5 into a profile program");
  refused("G91", "lekalo writes no G91 into a profile program");
  refused("M7", "lekalo writes no M7 into a profile program");
  refused("M3.1", "lekalo writes no M3.1 into a profile program");
  refused("G0 X1\nG20", "the unit changes on the way");
  refused("G0 Y1\nG21", "the unit changes on the way");
  refused("G4", "a wait without its time, or a time without a wait");
  refused("G0 X1 P1", "a wait without its time, or a time without a wait");
  refused("G4 P1 X1", "a wait beside a motion");
  refused("G4 P1 G0", "a wait beside a motion");
  refused("O5 X1", "a number of a program where none is");
  refused("G0 O5", "a number of a program where none is");
  refused("\nO5", "a number of a program where none is");
  refused("X1", "a motion without G0, G1, G2 or G3");
  refused("G1 X1 I1 J1", "an arc without I and J");
  refused("G1 X1 I1", "an arc without I and J");
  refused("G1 X1 J1", "an arc without I and J");
  refused("G2 X1 I1", "an arc without I and J");
  refused("G2 X1 J1", "an arc without I and J");
  refused("G2 X1", "an arc without I and J");
  refused("G0 X1 Z1", "a motion in X or Y and Z at once");
  refused("G0 Y1 Z1", "a motion in X or Y and Z at once");
  refused("G0 X1 Y1\nM3\nG1 Z-1\nG0 Z-2", "a rapid motion down into the material");
  refused("M3\nG1 X1", "a cut from a place that is not known");
  refused("G0 X1\nM3\nG1 Y1", "a cut from a place that is not known");
  refused("G0 Y1\nM3\nG1 X1", "a cut from a place that is not known");
  refused("G0 X0 Y0\nM3\nG2 X2.011 Y0 I1 J0", "an arc whose ends do not lie on one circle");
  refused("G0 X0 Y0\nM3\nG2 X0 Y0 I0 J0", "an arc whose ends do not lie on one circle");
  refused("G0 X0 Y0\nM3\nG2 X0 Y0 I1 J0", "an arc of a whole turn");
  refused("G0 X0 Y0\nM3\nM4", "M4 where M3 is meant");
  refused("G0 X0 Y0\nM4\nM3", "M4 where M3 is meant");
  refused("G0 Z5\nM4", "M4 where M3 is meant");
  refused("%", "p.nc:2: % neither begins the program nor ends it");
  EXPECT_EQ(cuts("G0 X0 Y0\nM3\nG2 X2.004 Y0 I1 J0"), "4: A 1,0 1.002 - 0,0 2.004,0\n");
  refused("G0 X0 Y0\nM3\nG2 X2.006 Y0 I1 J0", "an arc whose ends do not lie on one circle");
  // Four decimals of an inch round more: 0.0003 of them are 0.0076 mm.
  const auto inches = [](const std::string& x) {
    return told("G20 G17 G40 G49 G54 G90 G94\nG0 X0 Y0\nM3\nG2 X" + x + " Y0 I1 J0\nM5\nM2\n");
  };
  EXPECT_EQ(inches("2.00029"), "4: A 25.4,0 25.4 - 0,0 50.81,0\n");
  EXPECT_NE(inches("2.0003").find("an arc whose ends do not lie on one circle"), std::string::npos);
  EXPECT_EQ(cuts("G0 X.01 Y0\nM3\nG2 X-.005 Y0 I-.01 J0"), "4: A 0,0 0.0075 - 0.01,0 -0.005,0\n");
  // A hole that is burnt or drilled is no cut that anything follows.
  refused("G0 X1 Y1\nM3\nG1 Z-1\nG0 Z2", "the beam or tool goes into the material where nothing is cut");
  refused("G0 X1 Y1\nM3\nM5\nG0 X5",
          "p.nc:5: before it the beam or tool goes into the material where nothing is cut");
  refused("G0 X1 Y1\nM3\nM5\nG0 Y5",
          "p.nc:5: before it the beam or tool goes into the material where nothing is cut");
  refused("G0 X1 Y1\nG0 Z-1\nM3\nG0 Z2\nG0 X5",
          "the beam or tool goes into the material where nothing is cut");
  EXPECT_EQ(cuts("G0 X1 Y1\nM3\nM5\nG0 X1 Y1\nM3\nG1 X5"), "7: L 1,1 5,1\n");
  EXPECT_EQ(cuts("G0 X0 Y0\nM3\nG2 X0 Y2 I0 J1"), "4: A 0,1 1 - 0,0 0,2\n");
}

TEST(VerifyProfileMoves, ToolsAreChangedAtRestAndLiftedBeforeTheyMove) {
  EXPECT_EQ(cuts("T3 M6\nG43 H3\nG0 Z5\nG0 X1 Y2\nM3\nG1 Z-1\nX5\nG0 Z5"), "8: L 1,2 5,2\n");
  // Nothing is known of places after a change.
  const auto refused = [](const std::string& words, const std::string& said) {
    EXPECT_NE(cuts(words).find(said), std::string::npos) << words << "\n" << cuts(words);
  };
  const std::string cut = "G0 Z5\nG0 X1 Y2\nM3\nG1 Z-1\nX5\nG0 Z5\nM5\n";
  EXPECT_EQ(cuts(cut + "T9999 M6\nG43 H9999\n" + cut), "6: L 1,2 5,2\n15: L 1,2 5,2\n");
  refused(cut + "T3 M6\nG43 H3\nG0 Z5\nM3\nG1 Z-1\nX5", "a cut from a place that is not known");
  refused(cut + "T3 M6\nG43 H3\nG0 Z5\nG0 X1\nM3\nG1 Z-1\nX5", "a cut from a place that is not known");
  refused(cut + "T3 M6\nG43 H3\nG0 Z5\nG0 Y1\nM3\nG1 Z-1\nX5", "a cut from a place that is not known");
  refused("G0 Z5\nM3\nT3 M6", "p.nc:4: a tool is changed while the spindle turns");
  const std::string early = "a changed tool moves before its length is taken and it is lifted";
  refused("T3 M6\nG0 Z5", "p.nc:3: " + early);
  refused("T3 M6\nG43 H3\nG0 X5", "p.nc:4: " + early);
  refused("T3 M6\nG43 H3\nG0 Y5", "p.nc:4: " + early);
  refused("T3 M6\nG0 Z5 G43 H3\nG0 Z5\nT3 M6\nG0 X1", early);
  EXPECT_EQ(cuts("T3 M6\nG0 G43 H3 Z5\nG0 X1 Y2\nM3\nG1 Z-1\nX5\nG0 Z5"), "7: L 1,2 5,2\n");
  const std::string other = "the length is not that of a tool that was changed to right before";
  refused("T3 M6\nG43 H4", "p.nc:3: " + other);
  refused("G43 H3", "p.nc:2: " + other);
  refused("T3 M6\nG43 H3\nG0 Z5\nG43 H3", "p.nc:5: " + other);
  const std::string dropped = "the length of the tool is dropped";
  refused("T3 M6\nG43 H3\nG49\nG0 Z5", "p.nc:4: " + dropped);
  refused("T3 M6\nG49\nG43 H3", "p.nc:3: " + dropped);
  refused("T3 M6\nG43 H3\nG0 Z5\nG49 X1", "p.nc:5: " + dropped);
  const std::string number = "a tool or its length without M6 or G43, or these without a number";
  refused("T3", "p.nc:2: " + number);
  refused("M6", "p.nc:2: " + number);
  refused("T3 M6\nH3", "p.nc:3: " + number);
  refused("T3 M6\nG43", "p.nc:3: " + number);
  for (const char* word : {"T0", "T-1", "T1.5", "T10000", "T", "H0 G43"})
    refused(std::string(word) + " M6", "lekalo writes no such word into a profile program");
  // A length that is taken is said as one that is none.
  const Result<ProfileProgram> read =
      read_profile({"p.nc", "G21 G17 G40 G54 G90 G94\nT3 M6\nG43 H3\nG0 Z5\nM2\n"}, words::Control::fanuc);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(read->unsaid.sentences().empty());
}

TEST(VerifyProfileMoves, AProgramSaysItsModesAndEnds) {
  const std::string tail = "G0 X1 Y1\nM2\n";
  EXPECT_EQ(told(kModes + tail), "");
  EXPECT_EQ(told("G17 G40 G49 G54 G90 G94\n" + tail), "p.nc:2: a motion before G20 or G21");
  EXPECT_EQ(told(kModes + "G0 X1 Y1\n"), "p.nc:2: the program does not end with M2 or M30");
  EXPECT_EQ(told(kModes + "M3\nM2\n"), "p.nc:3: the beam or spindle is on at the end");
  EXPECT_EQ(told(kModes + "M2\nG0 X1\n"), "p.nc:3: words after the end of the program");
  EXPECT_EQ(told(kModes + "M2\n%\n"), "p.nc:3: % neither begins the program nor ends it");
  EXPECT_EQ(told("%\n" + kModes + "%\nM2\n"), "p.nc:3: % neither begins the program nor ends it");
  EXPECT_EQ(told("%\n" + kModes + "M2\n%\n"), "");
  EXPECT_EQ(told("%\n" + kModes + "M2\n(that is all)\n"), "");
}

/// How many modes a program leaves to its control, and the first sentence about one.
std::pair<std::size_t, std::string> unsaid(const std::string& program, words::Control control) {
  const Result<ProfileProgram> read = read_profile({"p.nc", program}, control);
  EXPECT_TRUE(read) << read.error().message;
  if (!read) return {};
  const auto& sentences = read->unsaid.sentences();
  return {sentences.size(), sentences.empty() ? "" : sentences[0]};
}

TEST(VerifyProfileMoves, ModesThatAreNotSaidAreTheControls) {
  using words::Control;
  const std::string tail = "G0 X1 Y1\nM2\n", all = "G61 G91.1 " + kModes;
  EXPECT_EQ(unsaid(all + tail, Control::linuxcnc).first, 0U);
  for (const std::string mode : {"G17", "G40", "G49", "G54", "G90", "G94", "G61", "G91.1"}) {
    std::string less = all;
    less.erase(less.find(mode), mode.size());
    const auto [count, sentence] = unsaid(less + tail, Control::linuxcnc);
    EXPECT_EQ(count, 1U) << mode;
    EXPECT_NE(sentence.find("program: line 2 moves where the program does not say "), std::string::npos);
    EXPECT_NE(sentence.find(mode), std::string::npos) << sentence;
  }
  EXPECT_EQ(unsaid("G21\n" + tail + "", Control::linuxcnc).first, 8U);
  // Said after the first motion, it came too late.
  EXPECT_EQ(unsaid("G61 " + kModes + "G0 X1 Y1\nG91.1\nM2\n", Control::linuxcnc).first, 1U);
  for (const Control control : {Control::haas, Control::fanuc, Control::grbl})
    EXPECT_EQ(unsaid(kModes + tail, control).first, 0U) << words::word_of(control);
  EXPECT_EQ(unsaid("G21 G17 G49 G54 G90 G94\n" + tail, Control::grbl).first, 0U) << "GRBL has no G41";
  EXPECT_EQ(unsaid("%\nO1\n" + kModes + tail + "%\n", Control::linuxcnc).first, 0U) << "LinuxCNC reads no O1";
  EXPECT_EQ(unsaid("%\nO1\nG21 G17 G49 G54 G90 G94\n" + tail, Control::linuxcnc).first, 1U);
  EXPECT_EQ(unsaid("%\nO1\nG21 G17 G49 G54 G90 G94\n" + tail, Control::grbl).first, 0U);
}

// ---- against a layout -------------------------------------------------------------------------------------

/// A square part of 20 with a square hole of 8 in it, at (10, 10), and another of 10 beside it.
std::string layout_text() {
  cases::Json layout = cases::empty_layout();
  cases::add_part(layout, "ring",
                  cases::outline_json(cases::rectangle(0, 0, 20, 20), {cases::rectangle(6, 6, 8, 8)}));
  cases::add_part(layout, "plate", cases::outline_json(cases::rectangle(0, 0, 10, 10)));
  cases::place(layout, "ring", 10, 10);
  cases::place(layout, "plate", 50, 10);
  return layout.dump();
}
/// The way round a rectangle, `out` mm outside of it with round corners, from its lower left corner on.
std::string way_round(double x, double y, double width, double height, double out) {
  const double r = x + width, t = y + height;
  return fmt::format(
      "G1 X{1}\nG3 X{2} Y{3} I0 J{0}\nG1 Y{4}\nG3 X{1} Y{5} I{6} J0\nG1 X{7}\nG3 X{8} Y{4} I0 J{6}\nG1 Y{3}\n"
      "G3 X{7} Y{9} I{0} J0\n",
      out, r, r + out, y, t, t + out, -out, x, x - out, y - out);
}
std::string around(double x, double y, double width, double height, double out) {
  return fmt::format("G0 X{} Y{}\nM3\n", x, y - out) + way_round(x, y, width, height, out) + "M5\n";
}
/// The same inside of a rectangle.
std::string within(double x, double y, double width, double height, double in) {
  const double l = x + in, r = x + width - in, b = y + in, t = y + height - in;
  return fmt::format("G0 X{0} Y{1}\nM3\nG1 X{2}\nY{3}\nX{0}\nY{1}\nM5\n", l, b, r, t);
}
// From line 2 on, the cuts of these begin at lines 4, 11 and 22.
const std::string kHole = within(16, 16, 8, 8, 0.5), kRing = around(10, 10, 20, 20, 0.5),
                  kPlate = around(50, 10, 10, 10, 0.5);

std::string judged_on(const std::string& layout, const std::string& cut, double kerf = 1,
                      double tolerance = 0.01) {
  ProfileWords words;
  words.kerf_mm = kerf, words.tolerance_mm = tolerance;
  const std::string program = kModes + cut + "M2\n";
  const Result<ClaimReport> report = verify_profile({"p.nc", program}, {"l.json", layout}, words);
  if (!report) return report.error().message;
  std::string text;
  for (const std::string& finding : report->findings) text += finding + "\n";
  return text;
}

std::string judged(const std::string& cut) { return judged_on(layout_text(), cut); }
/// One part, as it is drawn.
std::string alone(const cases::Json& outline) {
  cases::Json layout = cases::empty_layout();
  cases::add_part(layout, "part", outline);
  cases::place(layout, "part", 0, 0);
  return io::write_layout(io::read_layout(layout.dump(), "layout").value().document);
}
std::string plate(const std::vector<cases::Points>& holes = {}) {
  return alone(cases::outline_json(cases::rectangle(0, 0, 30, 30), holes));
}
/// The way along these places, the first of which is gone to without a cut.
std::string along(const cases::Points& places) {
  std::string words;
  for (const auto& [x, y] : places)
    words += fmt::format("{} X{} Y{}\n", words.empty() ? "G0" : "G1", x, y) + (words.empty() ? "M3\n" : "");
  return words + "M5\n";
}
const std::string kNoContour = "the cut follows no contour of a part";

TEST(VerifyProfile, EveryContourIsCutOnItsWasteSide) {
  EXPECT_EQ(judged(kHole + kRing + kPlate), "");
  EXPECT_EQ(judged(kPlate + kHole + kRing), "");
  ProfileWords words;
  words.kerf_mm = 1;
  const std::string layout = layout_text(), program = kModes + kHole + kRing + kPlate + "M2\n";
  EXPECT_EQ(verify_profile({"p.nc", program}, {"l.json", layout}, words)->unchecked.size(), 2U);
  words.control = words::Control::haas;
  EXPECT_TRUE(verify_profile({"p.nc", program}, {"l.json", layout}, words)->unchecked.empty());
  EXPECT_EQ(judged(kHole + kRing + around(50, 10, 10, 10, 0.505) + around(50, 10, 10, 10, 0.495)), "")
      << "one contour may be cut twice";
  EXPECT_EQ(judged(kHole + kRing), "the outline of placement 2 is not cut\n");
  EXPECT_EQ(judged(kRing + kPlate), "hole 1 of placement 1 is not cut\n");
  EXPECT_EQ(judged(kHole + kPlate), "the outline of placement 1 is not cut\n");
  EXPECT_EQ(judged(kRing + kHole + kPlate),
            "line 15: hole 1 of placement 1 is cut after the outline of placement 1, which encloses it\n");
  EXPECT_EQ(judged(kHole + kRing + kPlate + around(70, 70, 10, 10, 0.5)),
            "line 33: the cut follows no contour of a part\n");
  EXPECT_EQ(judged(kHole + kRing + kPlate + "G0 X70 Y70\nM3\nG1 X80\nM5\n"),
            "line 33: the cut is not closed\n");
}

TEST(VerifyProfile, TheKerfKeepsItsDistance) {
  EXPECT_EQ(judged(kHole + kRing + around(50, 10, 10, 10, 0.4905)), "");
  EXPECT_NE(judged(kHole + kRing + around(50, 10, 10, 10, 0.4895)).find("the kerf enters a part"),
            std::string::npos);
  EXPECT_EQ(judged(kHole + kRing + around(50, 10, 10, 10, 0.509)), "");
  EXPECT_EQ(judged(kHole + kRing + around(50, 10, 10, 10, 0.7)),
            "line 22: the cut follows no contour of a part\nthe outline of placement 2 is not cut\n");
  EXPECT_NE(judged(kHole + kRing + within(50, 10, 10, 10, 0.5)).find("placement 2"), std::string::npos);
  const double least = 0.5 - 0.25 - 1e-7;
  const auto below = [&](double by) {
    return judged_on(plate(), along({{-0.3, -by}, {30.3, -by}, {30.3, 30.3}, {-0.3, 30.3}, {-0.3, -by}}), 1,
                     0.25);
  };
  EXPECT_EQ(below(least), "");
  EXPECT_NE(below(std::nextafter(least, 0)).find("the kerf enters a part"), std::string::npos);
  // Beyond the tolerance a tenth of half the kerf is let be, or 0.02 mm.
  EXPECT_EQ(judged_on(plate(), around(0, 0, 30, 30, 0.555)), "");
  EXPECT_NE(judged_on(plate(), around(0, 0, 30, 30, 0.565)), "");
  EXPECT_EQ(judged_on(plate(), around(0, 0, 30, 30, 0.115), 0.2, 0.001), "");
  EXPECT_NE(judged_on(plate(), around(0, 0, 30, 30, 0.125), 0.2, 0.001), "");
}

TEST(VerifyProfile, AHoleMayBeSmall) {
  EXPECT_EQ(judged_on(plate({cases::rectangle(5, 5, 0.6, 0.6)}),
                      within(5, 5, 0.6, 0.6, 0.1) + around(0, 0, 30, 30, 0.1), 0.2),
            "");
}

TEST(VerifyProfile, ALeadMayComeFromOutsideAlone) {
  const std::string way = way_round(50, 10, 10, 10, 0.5);
  EXPECT_EQ(judged(kHole + kRing + "G0 X50 Y5\nM3\nG1 Y9.5\n" + way + "M5\n"), "");
  const std::string said = judged(kHole + kRing + "G0 X55 Y15\nM3\nG1 X50 Y9.5\n" + way + "M5\n");
  EXPECT_NE(said.find("the kerf enters a part"), std::string::npos) << said;
  const auto enters = [&](const std::string& lead) {
    return judged(kHole + kRing + lead + "X50 Y9.5\n" + way + "M5\n").find("the kerf enters a part") !=
           std::string::npos;
  };
  EXPECT_TRUE(enters("G0 X50 Y20.3\nM3\nG1 Y25.3\nX45\nY9.5\n")) << "it begins too near";
  EXPECT_FALSE(enters("G0 X50 Y20.5\nM3\nG1 Y25.3\nX45\nY9.5\n"));
  EXPECT_TRUE(enters("G0 X47.5 Y15\nM3\nG1 X62.5\nY9.5\n")) << "it crosses the plate";
  const std::string inside = judged(kHole + kRing + within(50, 10, 10, 10, 2));
  EXPECT_NE(inside.find("line 22: the cut begins in placement 2"), std::string::npos) << inside;
  EXPECT_NE(
      judged(kHole + kRing + "G0 X50 Y9.5\nM3\nG0" + way.substr(2) + "M5\n").find("a rapid motion cuts"),
      std::string::npos);
}

TEST(VerifyProfile, NeighboursMayShareACut) {
  cases::Json layout = cases::empty_layout();
  cases::add_part(layout, "plate", cases::outline_json(cases::rectangle(0, 0, 10, 10)));
  cases::place(layout, "plate", 50, 10);
  cases::place(layout, "plate", 39, 10);
  const std::string left =
      "G0 X49.5 Y15\nM3\nG1 Y20\nG3 X49 Y20.5 I-.5 J0\nG1 X39\nG3 X38.5 Y20 I0 J-.5\nG1 Y10\n"
      "G3 X39 Y9.5 I.5 J0\nG1 X49\nG3 X49.5 Y10 I0 J.5\nG1 Y15\nM5\n";
  EXPECT_EQ(judged_on(layout.dump(), around(50, 10, 10, 10, 0.5) + left), "");
}

// ---- common lines -----------------------------------------------------------------------------------------

/// Two plates of 10, one kerf of 1 apart, at (39, 10) and (50, 10).
std::string two_plates() {
  cases::Json layout = cases::empty_layout();
  cases::add_part(layout, "plate", cases::outline_json(cases::rectangle(0, 0, 10, 10)));
  cases::place(layout, "plate", 39, 10);
  cases::place(layout, "plate", 50, 10);
  return layout.dump();
}
std::string judged_common(const std::string& cut, double pierce = 0,
                          const std::string& layout = two_plates()) {
  ProfileWords words;
  words.kerf_mm = 1, words.common_line = true, words.pierce_diameter_mm = pierce;
  const Result<ClaimReport> report =
      verify_profile({"p.nc", kModes + cut + "M2\n"}, {"l.json", layout}, words);
  if (!report) return report.error().message;
  std::string text;
  for (const std::string& finding : report->findings) text += finding + "\n";
  return text;
}
/// Cuts that begin at lines 4 and 9, where the line comes first.
const std::string kLine = "G0 X49.5 Y6\nM3\nG1 Y9.5\nY20\nM5\n",
                  kAround = "G0 X45 Y6\nM3\nG1 Y9.5\nX38.5\nY20.5\nX60.5\nY9.5\nX45\nM5\n";

TEST(VerifyCommonLine, ALineAndAnOutlineCutTwoPlates) {
  EXPECT_EQ(judged_common(kLine + kAround), "");
  EXPECT_EQ(judged_common(kLine + kAround, 2), "");
  EXPECT_NE(judged_on(two_plates(), kLine + kAround), "") << "it was not said";
  EXPECT_EQ(judged_common("G0 X10 Y10\n"), "nothing is cut\n");
}

TEST(VerifyCommonLine, EveryPlaceOfEveryContourIsAtSize) {
  EXPECT_NE(judged_common(kAround).find("mm from the middle of the nearest cut near (49.0000, 10.0"),
            std::string::npos)
      << judged_common(kAround);
  EXPECT_NE(judged_common(kLine).find("is not cut near"), std::string::npos);
  const auto moved = [](double x) {
    return judged_common(fmt::format("G0 X{0} Y6\nM3\nG1 Y9.5\nY20\nM5\n", x) + kAround);
  };
  EXPECT_EQ(moved(49.509), "");
  EXPECT_EQ(moved(49.491), "");
  EXPECT_NE(moved(49.515).find("the kerf enters a part"), std::string::npos);
  // Nearer plates and farther ones, with a line in the middle between them.
  const auto apart = [](double gap) {
    cases::Json layout = cases::empty_layout();
    cases::add_part(layout, "plate", cases::outline_json(cases::rectangle(0, 0, 10, 10)));
    cases::place(layout, "plate", 49 - gap / 2 - 9.5, 10);
    cases::place(layout, "plate", 49.5 + gap / 2, 10);
    const double left = 38.5 - gap / 2 + 0.5, right = 60.5 + gap / 2 - 0.5;
    return judged_common(
        kLine + fmt::format("G0 X45 Y6\nM3\nG1 Y9.5\nX{0}\nY20.5\nX{1}\nY9.5\nX45\nM5\n", left, right), 0,
        layout.dump());
  };
  EXPECT_EQ(apart(1), "");
  EXPECT_EQ(apart(1.02), "");
  EXPECT_NE(apart(1.03).find("from the middle of the nearest cut"), std::string::npos) << apart(1.03);
  EXPECT_NE(apart(0.97).find("the kerf enters a part"), std::string::npos);
}

TEST(VerifyCommonLine, NothingIsCutTwice) {
  EXPECT_NE(judged_common(kLine + kLine + kAround).find("is cut twice"), std::string::npos);
  EXPECT_EQ(judged_common("G0 X49.5 Y6\nM3\nG1 Y14\nM5\nG0 X49.5 Y12.4\nM3\nG1 Y20\nM5\n" + kAround), "")
      << "a kerf may go over the end of another";
  EXPECT_NE(judged_common("G0 X49.5 Y6\nM3\nG1 Y14\nM5\nG0 X49.5 Y11.6\nM3\nG1 Y20\nM5\n" + kAround)
                .find("is cut twice"),
            std::string::npos);
  EXPECT_NE(judged_common("G0 X49.5 Y6\nM3\nG1 Y20\nY12\nM5\n" + kAround).find("is cut twice"),
            std::string::npos)
      << "along itself";
  std::string in_blocks = "G0 X49.5 Y6\nM3\n";
  for (int mm = 10; mm <= 20; ++mm) in_blocks += fmt::format("G1 Y{}\n", mm);
  EXPECT_NE(judged_common(kLine + in_blocks + "M5\n" + kAround).find("is cut twice"), std::string::npos)
      << "in blocks shorter than two kerfs";
}

TEST(VerifyCommonLine, NothingIsCutOfWhatIsLoose) {
  EXPECT_EQ(judged_common(kAround + kLine).rfind("line 13: placement 1 is cut near (49.5", 0), 0U)
      << judged_common(kAround + kLine);
  // All in one cut: around both first, then between them.
  EXPECT_NE(judged_common("G0 X49.5 Y6\nM3\nG1 Y9.5\nX38.5\nY20.5\nX60.5\nY9.5\nX49.5\nY20\nM5\n")
                .find("have made it loose"),
            std::string::npos);
  EXPECT_EQ(judged_common("G0 X49.5 Y6\nM3\nG1 Y20.5\nX38.5\nY9.5\nX49.5\nX60.5\nY20.5\nX49.5\nM5\n"), "")
      << "one cut frees one after the other";
}

TEST(VerifyCommonLine, ShortStretchesOfWhatIsLooseAreNoExcuse) {
  // Bars of 10 by 2: the line between them is shorter than 2.5 kerfs.
  cases::Json layout = cases::empty_layout();
  cases::add_part(layout, "bar", cases::outline_json(cases::rectangle(0, 0, 10, 2)));
  cases::place(layout, "bar", 39, 10);
  cases::place(layout, "bar", 50, 10);
  const std::string line = "G0 X49.5 Y6\nM3\nG1 Y9.5\nY12\nM5\n",
                    around = "G0 X45 Y6\nM3\nG1 Y9.5\nX38.5\nY12.5\nX60.5\nY9.5\nX45\nM5\n";
  EXPECT_EQ(judged_common(line + around, 0, layout.dump()), "");
  EXPECT_NE(judged_common(around + line, 0, layout.dump()).find("have made it loose"), std::string::npos);
}

TEST(VerifyCommonLine, APartThatHangsOnByAHairIsLoose) {
  cases::Json layout = cases::empty_layout();
  cases::add_part(layout, "plate", cases::outline_json(cases::rectangle(0, 0, 10, 10)));
  cases::place(layout, "plate", 39, 10);
  // The plate and a strip above it hang on by `hold`, and then what is between the two is cut.
  const auto held_by = [&](double hold) {
    return judged_common(
        fmt::format("G0 X38.5 Y20.5\nM3\nG1 Y9.5\nX49.5\nY26\nX38.5\nY{}\nM5\n", 21.5 + hold) +
            "G0 X49.5 Y20.5\nM3\nG1 X38.5\nM5\n",
        0, layout.dump());
  };
  EXPECT_EQ(held_by(0.3).find("loose"), std::string::npos) << held_by(0.3);
  EXPECT_NE(held_by(0.2).find("line 12: placement 1 is cut near"), std::string::npos) << held_by(0.2);
}

TEST(VerifyCommonLine, AllAreFreeInTheEnd) {
  // A line in two pieces: what is left between them is found when it is more than the kerfs' round ends.
  const auto open = [](double gap) {
    return judged_common(
        fmt::format("G0 X49.5 Y6\nM3\nG1 Y14\nM5\nG0 X49.5 Y{}\nM3\nG1 Y20\nM5\n", 14 + gap) + kAround);
  };
  EXPECT_EQ(open(0.2), "");
  EXPECT_NE(open(0.4).find("from the middle of the nearest cut near"), std::string::npos);
  EXPECT_EQ(open(0.9).find("still hang together"), std::string::npos);
  EXPECT_NE(open(1.1).find("placement 1 and placement 2 still hang together after the last cut"),
            std::string::npos)
      << open(1.1);
  const std::string less = "G0 X45 Y6\nM3\nG1 Y9.5\nX38.5\nY20.5\nX60.5\nY9.5\nX47\nM5\n";
  EXPECT_NE(judged_common(kLine + less).find("placement 1 still hangs on after the last cut"),
            std::string::npos);
}

TEST(VerifyCommonLine, PiercesAreClearOrInAKerfThatIsThere) {
  const std::string inside = "G0 X49.5 Y20.5\nM3\nG1 Y9.5\nM5\n", near = "G0 X49.5 Y20.2\nM3\nG1 Y9.5\nM5\n",
                    rest = kAround;
  EXPECT_NE(judged_common(near + rest, 2).find("the pierce of 2 mm enters a part"), std::string::npos);
  EXPECT_NE(judged_common(inside + rest, 2).find("the pierce of 2 mm enters a part"), std::string::npos)
      << "the kerf is not there yet";
  const std::string
      half = "G0 X45 Y6\nM3\nG1 Y9.5\nX38.5\nY20.5\nX49.5\nM5\n",
      other = "G0 X55 Y24\nM3\nG1 Y20.5\nX60.5\nY9.5\nX45.2\nM5\nG0 X49.5 Y20.5\nM3\nG1 X54.8\nM5\n";
  EXPECT_EQ(judged_common(half + inside + other, 2), "");
  EXPECT_NE(judged_common(half + near + other, 2).find("meets a kerf that is there before it"),
            std::string::npos);
  EXPECT_NE(judged_common(kLine + kAround + "G0 X80 Y80\nM3\nG1 X85\nX90\nX95\nM5\n")
                .find("line 18: the cut leaves the parts"),
            std::string::npos);
  EXPECT_NE(judged_common(kLine + kAround + "G0 X80 Y80\nM3\nG1 X85\nM5\n")
                .find("line 18: the cut leaves the parts"),
            std::string::npos)
      << "a lead to nothing";
  EXPECT_NE(judged_common("G0 X45 Y6\nM3\nG1 Y9.5\nX38.5\nY20.5\nX30\nX38.5\nM5\n").find("leaves the parts"),
            std::string::npos);
}

TEST(VerifyCommonLine, APassThatIsNotDeepComesBeforeItsPartIsLoose) {
  const auto at_depth = [](double z, const std::string& way) {
    return fmt::format("G0 Z5\nG0 {}\nG1 Z{}\n{}G0 Z5\n", way.substr(0, way.find('\n')), -z,
                       way.substr(way.find('\n') + 1));
  };
  const std::string line = "X49.5 Y6\nG1 Y9.5\nY20\n",
                    around = "X45 Y6\nG1 Y9.5\nX38.5\nY20.5\nX60.5\nY9.5\nX45\n";
  const auto judged = [&](const std::string& cuts) {
    return judged_common("G0 Z5\nM3 S9000\n" + cuts + "M5\n");
  };
  const std::string good = at_depth(1, line) + at_depth(2, line) + at_depth(1, around) + at_depth(2, around);
  EXPECT_EQ(judged(good), "");
  EXPECT_NE(judged(at_depth(2, line) + at_depth(2, around) + at_depth(1, around)).find("have made it loose"),
            std::string::npos);
}

/// A plate with a notch down from its upper side.
std::string notched(double width) {
  return alone(cases::outline_json(
      {{0, 0}, {30, 0}, {30, 20}, {10 + width, 20}, {10 + width, 10}, {10, 10}, {10, 20}, {0, 20}}));
}

TEST(VerifyProfile, ACutGoesWhereItsKerfHasRoom) {
  EXPECT_EQ(judged_on(notched(0.4), around(0, 0, 30, 20, 0.5)), "");
  // All of this is near the contour, and it goes by the notch.
  std::string by = around(0, 0, 30, 20, 0.5);
  by.replace(by.find("G1 X0\n"), 6,
             "G1 X11.05\nG3 X10.55 Y20 I0 J-0.5\nG1 X10.5\nG3 X10 Y20.5 I-0.5 J0\nG1 X0\n");
  EXPECT_NE(judged_on(notched(1.05), by).find(kNoContour), std::string::npos);
}

TEST(VerifyProfile, ACutThatLeavesItsContourFollowsNone) {
  const std::string outline = around(0, 0, 30, 30, 0.5);
  const auto refused = [&](const std::string& layout, cases::Points round, const cases::Points& and_across) {
    EXPECT_EQ(judged_on(layout, along(round) + outline), "");
    round.insert(round.end(), and_across.begin(), and_across.end());
    EXPECT_NE(judged_on(layout, along(round) + outline).find("line 4: " + kNoContour), std::string::npos);
  };
  const std::pair<double, double> a{5.5, 5.5}, b{14.646446, 14.646446}, c{5.5, 23.792893};
  refused(plate({cases::rectangle(5, 5, 8, 8)}), {a, {12.5, 5.5}, {12.5, 12.5}, {5.5, 12.5}, a},
          {{12.5, 12.5}, a});
  refused(plate({{{5, 5}, {25, 5}, {5, 25}}}), {a, {23.792893, 5.5}, c, a}, {b, c, a});
}

TEST(VerifyProfile, AChordOfARoundHoleFollowsNothing) {
  const auto half = [](double from, double to) {
    return cases::Json{
        {"arc", {{"from", {from, 15}}, {"to", {to, 15}}, {"centre", {15, 15}}, {"ccw", true}}}};
  };
  cases::Json outer = cases::Json::array();
  cases::Points corners = cases::rectangle(0, 0, 30, 30);
  corners.push_back(corners[0]);
  for (std::size_t i = 0; i < 4; ++i)
    outer.push_back({{"line",
                      {{"from", {corners[i].first, corners[i].second}},
                       {"to", {corners[i + 1].first, corners[i + 1].second}}}}});
  const cases::Json hole = cases::Json::array({half(25, 5), half(5, 25)});
  const std::string layout = alone({{"curves", {{"outer", outer}, {"holes", cases::Json::array({hole})}}}});
  const std::string round = "G0 X24.5 Y15\nM3\nG3 X5.5 I-9.5 J0\nG3 X24.5 I9.5 J0\n";
  EXPECT_EQ(judged_on(layout, round + "M5\n" + around(0, 0, 30, 30, 0.5)), "");
  EXPECT_NE(judged_on(layout, round + "G1 X15 Y24.5\nX24.5 Y15\nM5\n" + around(0, 0, 30, 30, 0.5))
                .find("line 4: " + kNoContour),
            std::string::npos);
}

TEST(VerifyProfile, ACutThatLeavesAStretchOutIsNone) {
  // It runs to and fro along one side.
  EXPECT_EQ(judged(kHole + kRing + "G0 X50 Y9.5\nM3\nG1 X60\nX50\nM5\n"),
            "line 22: the cut follows no contour of a part\nthe outline of placement 2 is not cut\n");
}

std::string judged_by(const std::string& layout, const std::string& cut, const ProfileWords& words) {
  const std::string program = kModes + cut + "M2\n";
  const Result<ClaimReport> report = verify_profile({"p.nc", program}, {"l.json", layout}, words);
  if (!report) return report.error().message;
  std::string text;
  for (const std::string& finding : report->findings) text += finding + "\n";
  return text;
}
ProfileWords with_joints(double width, double pierce = 0) {
  ProfileWords words;
  words.kerf_mm = 1, words.joint_width_mm = width, words.pierce_diameter_mm = pierce;
  return words;
}

const std::string kRight = "G1 X30\nG3 X30.5 Y0 I0 J0.5\n",
                  kAbove = "G1 Y30\nG3 X30 Y30.5 I-0.5 J0\nG1 X0\nG3 X-0.5 Y30 I0 J-0.5\n",
                  kLeft = "G1 Y0\nG3 X0 Y-0.5 I0.5 J0\nG1 X14\n", kToTheJoint = kRight + kAbove + kLeft;

TEST(VerifyProfile, JointsStayAsWideAsStatedAndAllElseIsCut) {
  // About a plate of 30 mm; the kerf of 1 mm ends at X14 and goes on at X15.5.
  const std::string one = "G0 X15.5 Y-0.5\nM3\n" + kToTheJoint + "M5\n";
  EXPECT_EQ(judged_by(plate(), one, with_joints(0.5)), "");
  EXPECT_EQ(
      judged_by(plate(), one, with_joints(0.494)),
      "line 4: the cut along the outline of placement 1 ends 0.5000 mm before it goes on, and a joint of "
      "0.494 mm is stated\n");
  EXPECT_EQ(judged_by(plate(), one, with_joints(0.496)), "");
  EXPECT_EQ(judged_by(plate(), one, with_joints(0)),
            "line 4: the cut is not closed\nthe outline of placement 1 is not cut\n");
  const std::string with_lead = "G0 X15.5 Y-4\nM3\nG1 Y-0.5\n" + kToTheJoint + "M5\n";
  EXPECT_EQ(judged_by(plate(), with_lead, with_joints(0.5)), "");
  EXPECT_EQ(judged_by(plate(), with_lead, with_joints(0.5, 2)), "");
  EXPECT_NE(judged_by(plate(), one, with_joints(0.5, 2)).find("line 4: the pierce of 2 mm enters a part"),
            std::string::npos);
  // A pierce beside the joint burns it away, and so does a cut across the sheet that it hangs on.
  std::string near = with_lead;
  near.replace(near.find("Y-4"), 3, "Y-1.6");
  EXPECT_EQ(judged_by(plate(), near, with_joints(0.5, 2)),
            "line 4: what is burnt enters the joint behind line 4\n");
  std::string across = with_lead;
  across.replace(across.find("Y-4\nM3"), 6, "Y-1.7\nM3\nG1 X13");
  EXPECT_NE(judged_by(plate(), across, with_joints(0.5)), "");
  const std::string first = "G0 X15.5 Y-0.5\nM3\n" + kRight + "G1 Y14\nM5\n",
                    second = "G0 X30.5 Y15.5\nM3\n" + kAbove + "G1 Y14\nM5\n",
                    third = "G0 X-0.5 Y12.5\nM3\n" + kLeft + "M5\n";
  EXPECT_EQ(judged_by(plate(), first + second + third, with_joints(0.5)), "");
  EXPECT_NE(judged_by(plate(), first + third, with_joints(0.5)), "");
  EXPECT_NE(judged_by(plate(), first + first + second + third, with_joints(0.5)), "");
}

TEST(VerifyProfile, TabsAreWhatIsCutLessDeep) {
  const auto at = [](double z, const std::string& way) { return fmt::format("G1 Z{}\n", z) + way; };
  const std::string over = "G1 X15.5\n";
  const auto program = [&](double tab) {
    return "G0 Z5\nM3\nG0 X15.5 Y-0.5\n" + at(-2, kToTheJoint + over) + at(-6, kToTheJoint) + at(tab, over) +
           "G0 Z5\nM5\n";
  };
  EXPECT_EQ(judged_by(plate(), program(-4), with_joints(0.5)), "");
  EXPECT_NE(judged_by(plate(), program(-6), with_joints(0.5)), "") << "nothing stays";
}

TEST(VerifyProfile, AStretchGoesAlongOneContourBehindALeadOfOneEdge) {
  const auto led = [](const std::string& lead) { return "G0 X15.5 Y-4\nM3\n" + lead + kToTheJoint + "M5\n"; };
  EXPECT_EQ(judged_by(plate(), led("G1 Y-0.5\n"), with_joints(0.5)), "");
  EXPECT_EQ(judged_by(plate(), led("G1 Y-2\nG1 Y-0.5\n"), with_joints(0.5)),
            "line 4: " + kNoContour + "\nthe outline of placement 1 is not cut\n");
  // One edge alone is a stretch, too: a line that a joint of nearly all of the contour leaves.
  EXPECT_NE(judged_by(plate(), "G0 X15.5 Y-0.5\nM3\nG1 X17\nM5\n", with_joints(0.5)), "");
  // Beside the contour on the part's side, and one that leaves it.
  const std::string in_part = judged_by(plate(), "G0 X5 Y0.5\nM3\nG1 X25\nM5\n", with_joints(0.5));
  EXPECT_NE(in_part.find("line 4: " + kNoContour), std::string::npos) << in_part;
  const std::string away = judged_by(plate(), "G0 X5 Y-0.5\nM3\nG1 X25\nY-3\nM5\n", with_joints(0.5));
  EXPECT_EQ(away, "line 4: " + kNoContour + "\nthe outline of placement 1 is not cut\n");
  // What a closed cut frees needs no stretches, and may be cut again in some.
  const std::string closed = around(0, 0, 30, 30, 0.5);
  EXPECT_EQ(judged_by(plate(), closed + "G0 X5 Y-0.5\nM3\nG1 X25\nM5\n", with_joints(0.5)), "");
  EXPECT_EQ(judged_by(plate(), closed, with_joints(0.5)), "");
}

TEST(VerifyProfile, WhatIsNotCutToTheBottomIsNotCut) {
  const auto at = [](double z, const std::string& way, const std::string& start) {
    return "G0 Z5\n" + start + fmt::format("M3\nG1 Z{}\n", z) + way + "G0 Z5\nM5\n";
  };
  const auto ring = [&](double z) {
    return at(-z, "G1 X23.5\nY23.5\nX16.5\nY16.5\n", "G0 X16.5 Y16.5\n") +
           at(-z, way_round(10, 10, 20, 20, 0.5), "G0 X10 Y9.5\n");
  };
  const auto small = [&](double z) { return at(-z, way_round(50, 10, 10, 10, 0.5), "G0 X50 Y9.5\n"); };
  EXPECT_EQ(judged(ring(2) + ring(6) + small(2) + small(6)), "");
  EXPECT_EQ(judged(ring(6) + small(2)), "the outline of placement 2 is not cut\n");
  EXPECT_EQ(judged(ring(2) + small(6)),
            "the outline of placement 1 is not cut\nhole 1 of placement 1 is not cut\n");
  // A pass before the last frees nothing, whatever it surrounds.
  EXPECT_EQ(judged(at(-2, way_round(10, 10, 20, 20, 0.5), "G0 X10 Y9.5\n") + ring(6) + small(6)), "");
}

/// Each was confirmed once: a pass that does not reach the bottom, and a stretch between joints.
TEST(VerifyProfile, NothingAtAllIsCutInWhatIsLoose) {
  const auto at = [](double z, const std::string& way, const std::string& start) {
    return "G0 Z5\n" + start + fmt::format("M3\nG1 Z{}\n", z) + way + "G0 Z5\nM5\n";
  };
  const auto hole = [&](double z) { return at(-z, "G1 X23.5\nY23.5\nX16.5\nY16.5\n", "G0 X16.5 Y16.5\n"); };
  const std::string ring = at(-6, way_round(10, 10, 20, 20, 0.5), "G0 X10 Y9.5\n"),
                    small = at(-6, way_round(50, 10, 10, 10, 0.5), "G0 X50 Y9.5\n");
  EXPECT_EQ(judged(hole(6) + hole(2) + ring + small), "");
  EXPECT_EQ(judged(hole(6) + ring + hole(2) + small),
            "line 30: hole 1 of placement 1 is cut after the outline of placement 1, which encloses it\n");
  cases::Json layout = cases::empty_layout();
  cases::add_part(layout, "frame",
                  cases::outline_json(cases::rectangle(0, 0, 40, 40), {cases::rectangle(10, 10, 18, 18)}));
  cases::add_part(layout, "plate", cases::outline_json(cases::rectangle(0, 0, 10, 10)));
  cases::place(layout, "frame", 10, 10);
  cases::place(layout, "plate", 24, 24);
  const std::string
      slug = within(20, 20, 18, 18, 0.5),
      outline = around(10, 10, 40, 40, 0.5),
      held =
          "G0 X30.5 Y23.5\nM3\nG1 X34\nG3 X34.5 Y24 I0 J0.5\nG1 Y34\nG3 X34 Y34.5 I-0.5 J0\nG1 X24\n"
          "G3 X23.5 Y34 I0 J-0.5\nG1 Y24\nG3 X24 Y23.5 I0.5 J0\nG1 X29\nM5\n";
  EXPECT_EQ(judged_by(layout.dump(), held + slug + outline, with_joints(0.5)), "");
  EXPECT_EQ(judged_by(layout.dump(), slug + held + outline, with_joints(0.5)),
            "line 11: the outline of placement 2 is cut after hole 1 of placement 1, which encloses it\n");
}

TEST(VerifyProfile, NoKerfOfANeighbourEntersAJoint) {
  const auto beside = [](double x) {
    cases::Json layout = cases::empty_layout();
    cases::add_part(layout, "plate", cases::outline_json(cases::rectangle(0, 0, 30, 30)));
    cases::place(layout, "plate", 0, 0);
    cases::place(layout, "plate", x, 0);
    return io::write_layout(io::read_layout(layout.dump(), "layout").value().document);
  };
  // The joint of the first is in the middle of its right side: half a kerf and the joint's width deep.
  const std::string first =
      "G0 X30.5 Y15.5\nM3\n" + kAbove + kLeft + "G1 X30\nG3 X30.5 Y0 I0 J0.5\nG1 Y14\nM5\n";
  const auto both = [&](double x) {
    return judged_by(beside(x), first + around(x, 0, 30, 30, 0.5), with_joints(0.5));
  };
  EXPECT_EQ(both(32.6), "");
  EXPECT_EQ(both(32.4), "line 17: what is burnt enters the joint behind line 4\n");
}

TEST(VerifyProfile, PiercesAndLeadsMeetNoKerfThatIsThere) {
  ProfileWords words = with_joints(0, 2);
  const auto led = [](double x, double y, double size, double lead) {
    return fmt::format("G0 X{0} Y{1}\nM3\nG1 Y{2}\n", x, y - lead, y - 0.5) +
           way_round(x, y, size, size, 0.5) + "M5\n";
  };
  const std::string inside = "G0 X20 Y20\nM3\nG1 X20 Y16.5\nX23.5\nY23.5\nX16.5\nY16.5\nX20\nM5\n";
  EXPECT_EQ(judged_by(layout_text(), inside + led(10, 10, 20, 4) + led(50, 10, 10, 4), words), "");
  // A contour that was cut all round is there when it is cut again, which was confirmed once.
  EXPECT_EQ(
      judged_by(layout_text(), inside + led(10, 10, 20, 4) + led(50, 10, 10, 4) + led(50, 10, 10, 4), words),
      "line 37: the pierce or its lead meets a kerf that is there before it\n");
  // The kerf about the ring has a corner about (30, 10).
  const auto said = [&](double x) {
    return judged_by(layout_text(),
                     inside + led(10, 10, 20, 4) + fmt::format("G0 X{} Y9.5\nM3\nG1 X50\n", x) +
                         way_round(50, 10, 10, 10, 0.5) + "M5\n",
                     words);
  };
  EXPECT_EQ(said(32), "");
  const std::string meets = "the pierce or its lead meets a kerf that is there before it";
  EXPECT_NE(said(31.8).find(meets), std::string::npos);
  // A long lead that crosses what is there: in its middle, near its beginning, and with more behind it.
  const std::string plate_cut = led(50, 10, 10, 4);
  for (const auto& [from, before] : {std::pair(-30.0, inside + plate_cut),
                                     {-2.0, inside + plate_cut},
                                     {4.0, inside + plate_cut},
                                     {-30.0, plate_cut + inside}}) {
    const std::string long_lead = judged_by(layout_text(),
                                            before + fmt::format("G0 X{} Y9.5\nM3\nG1 X10\n", 62 - from) +
                                                way_round(10, 10, 20, 20, 0.5) + "M5\n",
                                            words);
    EXPECT_NE(long_lead.find("line 25: " + meets), std::string::npos) << long_lead;
  }
  const std::string across = judged_by(
      layout_text(),
      led(10, 10, 20, 4) + "G0 X20 Y0\nM3\nG1 X20 Y16.5\nX23.5\nY23.5\nX16.5\nY16.5\nX20\nM5\n", words);
  EXPECT_NE(across.find(meets), std::string::npos) << across;
  // Without a lead the first edge is a cut like others, and neighbours may share its kerf.
  cases::Json pair = cases::empty_layout();
  cases::add_part(pair, "plate", cases::outline_json(cases::rectangle(0, 0, 10, 10)));
  cases::place(pair, "plate", 0, 0);
  cases::place(pair, "plate", 11, 0);
  ProfileWords narrow = words;
  narrow.pierce_diameter_mm = 1;
  const std::string shared =
      around(0, 0, 10, 10, 0.5) +
      "G0 X21.5 Y10\nM3\nG3 X21 Y10.5 I-0.5 J0\nG1 X11\nG3 X10.5 "
      "Y10 I0 J-0.5\nG1 Y0\nG3 X11 Y-0.5 I0.5 J0\nG1 X21\nG3 X21.5 Y0 I0 J0.5\nG1 Y10\nM5\n";
  EXPECT_EQ(judged_by(pair.dump(), shared, narrow), "");
  // Its first edge may end there, too.
  const std::string up_to =
      around(0, 0, 10, 10, 0.5) +
      "G0 X21 Y10.5\nM3\nG1 X11\nG3 X10.5 Y10 I0 J-0.5\nG1 Y0\n"
      "G3 X11 Y-0.5 I0.5 J0\nG1 X21\nG3 X21.5 Y0 I0 J0.5\nG1 Y10\nG3 X21 Y10.5 I-0.5 J0\nM5\n";
  EXPECT_EQ(judged_by(pair.dump(), up_to, narrow), "");
  EXPECT_NE(
      judged_by(pair.dump(), around(0, 0, 10, 10, 0.5) + around(11, 0, 10, 10, 0.5), narrow).find(meets),
      std::string::npos)
      << "it begins where the kerfs meet";
  // What follows no contour has no lead.
  EXPECT_NE(
      judged_by(layout_text(), inside + "G0 X90 Y90\nM3\nG1 X95\nM5\n", words).find("the cut is not closed"),
      std::string::npos);
}

TEST(VerifyProfile, OnlyStretchesOfOneContourMayBeginBesideEachOther) {
  const std::string meets = "the pierce or its lead meets a kerf that is there before it";
  // The second one begins 1.5 mm behind the end of the first; its disc enters the joint, and nothing else.
  const std::string first = "G0 X15.5 Y-4\nM3\nG1 Y-0.5\n" + kRight + "G1 Y14\nM5\n",
                    second = "G0 X31.5 Y15.5\nM3\nG1 X30.5\n" + kAbove + "G1 Y14\nM5\n",
                    third = "G0 X-4 Y12.5\nM3\nG1 X-0.5\n" + kLeft + "M5\n";
  EXPECT_EQ(judged_by(plate(), first + second + third, with_joints(0.5, 3)),
            "line 11: what is burnt enters the joint behind line 4\n");
  const std::string closed = around(0, 0, 30, 30, 0.5), stretch = "G0 X0 Y-0.5\nM3\nG1 X25\nM5\n";
  for (const std::string& cut : {closed + stretch, stretch + closed}) {
    const std::string said = judged_by(plate(), cut, with_joints(0.5, 1));
    EXPECT_NE(said.find(meets), std::string::npos) << said;
  }
  // Stretches of two contours.
  cases::Json pair = cases::empty_layout();
  cases::add_part(pair, "plate", cases::outline_json(cases::rectangle(0, 0, 30, 30)));
  cases::place(pair, "plate", 0, 0);
  cases::place(pair, "plate", 31.2, 0);
  const std::string said = judged_by(
      pair.dump(), "G0 X30.5 Y25\nM3\nG1 Y5\nM5\nG0 X30.7 Y15\nM3\nG1 Y20\nM5\n", with_joints(0.5, 1));
  EXPECT_NE(said.find("line 8: " + meets), std::string::npos) << said;
}

TEST(VerifyProfile, WhatSeveralKerfsFreeTogetherIsLoose) {
  cases::Json layout = cases::empty_layout();
  cases::add_part(layout, "plate", cases::outline_json(cases::rectangle(0, 0, 10, 10)));
  std::vector<std::string> cuts;
  for (const double y : {10.0, 21.2, 32.4})
    for (const double x : {10.0, 21.2, 32.4}) {
      cases::place(layout, "plate", x, y);
      cuts.push_back(around(x, y, 10, 10, 0.5));
    }
  std::string outer;
  for (const std::size_t i : {0, 1, 2, 3, 5, 6, 7, 8}) outer += cuts[i];
  EXPECT_EQ(judged_on(layout.dump(), cuts[4] + outer), "");
  const std::string said = judged_on(layout.dump(), outer + cuts[4]);
  EXPECT_NE(said.find("the outline of placement 5 is cut when the kerfs before it have made it loose"),
            std::string::npos)
      << said;
  // Each of the four beside it is needed, the first of all, too.
  EXPECT_NE(judged_on(layout.dump(),
                      cuts[1] + cuts[3] + cuts[5] + cuts[7] + cuts[0] + cuts[2] + cuts[6] + cuts[8] + cuts[4])
                .find("the outline of placement 5 is cut when"),
            std::string::npos);
  // With one neighbour left the middle still hangs on it.
  EXPECT_EQ(judged_on(layout.dump(), cuts[0] + cuts[1] + cuts[2] + cuts[3] + cuts[5] + cuts[6] + cuts[8] +
                                         cuts[4] + cuts[7]),
            "");
}

TEST(VerifyProfile, OneSheetIsCutByOneProgram) {
  cases::Json layout = cases::Json::parse(layout_text());
  layout["stocks"][0]["count"] = 2;
  layout["placements"][1]["copy"] = 1;
  const std::string text = layout.dump(), program = kModes + kHole + kRing + "M2\n";
  ProfileWords words;
  words.kerf_mm = 1;
  const auto both = verify_profile({"p.nc", program}, {"l.json", text}, words);
  ASSERT_FALSE(both);
  EXPECT_EQ(both.error().message,
            "p.nc: a program cuts one sheet and 2 are in use; say which, for example --sheet s#1");
  words.sheet = "s#1";
  const auto one = verify_profile({"p.nc", program}, {"l.json", text}, words);
  ASSERT_TRUE(one);
  EXPECT_TRUE(one->findings.empty());
  words.sheet = "s";
  EXPECT_TRUE(verify_profile({"p.nc", program}, {"l.json", text}, words)->findings.empty());
  words.sheet = "s#2";
  EXPECT_FALSE(verify_profile({"p.nc", program}, {"l.json", text}, words)->findings.empty());
  words.sheet = "s#3";
  EXPECT_EQ(verify_profile({"p.nc", program}, {"l.json", text}, words).error().message,
            "l.json: nothing lies on a sheet s#3, only on s#1, s#2");
}

}  // namespace
}  // namespace lekalo::verify::verify_profile_test

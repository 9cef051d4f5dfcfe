// Programs that were moved, written by hand line by line: what the checker takes for the same and what it
// refuses.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "verify/pocket/moved_program.hpp"

namespace lekalo::verify::verify_moved_lines_test {
namespace {

constexpr double kPi = 3.141592653589793;

struct Claim {
  std::string original, written;
  const char* mode = "coordinates";
  const char* theta = "0";
  std::size_t work_offset = 1;
  const char *x = "10", *y = "20", *rounding = "0.001";
  words::Control control = words::Control::linuxcnc;
  const char* z = nullptr;  ///< of a solid, which is not turned
};

std::string said(const Claim& claim) {
  std::optional<ProgramClaim::Solid> solid;
  if (claim.z != nullptr) solid = {*parse_decimal(claim.z), {Decimal{1, 0}, Decimal{}}};
  const ProgramVerdict verdict = check_moved_program({{"p.nc", claim.original},
                                                      {"out.nc", claim.written},
                                                      *parse_decimal(claim.x),
                                                      *parse_decimal(claim.y),
                                                      *parse_decimal(claim.theta),
                                                      *parse_decimal(claim.rounding),
                                                      claim.mode,
                                                      claim.work_offset,
                                                      claim.control,
                                                      {},
                                                      solid});
  return verdict.fault ? *verdict.fault : verdict.open ? "open: " + *verdict.open : "confirmed";
}
std::string replaced(std::string text, std::string_view what, std::string_view with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

const std::string kOriginal =
    "G21 G90 G17\nG0 X0 Y0 Z5\nG1 Z-1 F100\nG1 X10\nG2 X20 Y0 I5 J0\nG3 X20 Y0 I5 J0 P2\nG0 Z5\nM30\n";
/// The same, 10 and 20 mm away.
const std::string kAway =
    "G21 G90 G17\nG0 X10 Y20 Z5\nG1 Z-1 F100\nG1 X20\nG2 X30 Y20 I5 J0\nG3 X30 Y20 I5 J0 P2\nG0 Z5\nM30\n";

std::string away(std::string_view what, std::string_view with) {
  return said({kOriginal, replaced(kAway, what, with)});
}

TEST(VerifyMovedLines, EveryMotionIsTheOriginalsMoved) {
  EXPECT_EQ(said({kOriginal, kAway}), "confirmed");
  const auto another = [](int line) {
    return fmt::format("its motion in line {} is another than the original's", line);
  };
  EXPECT_EQ(away("G1 X20", "G0 X20"), another(4));
  EXPECT_EQ(away("G1 Z-1", "G1 Z-1.5"), another(3));
  EXPECT_EQ(away("Z5\nM30", "Z6\nM30"), another(7));
  EXPECT_EQ(away("G2 X30 Y20 I5 J0", "G1 X30 Y20"), another(5));
  EXPECT_EQ(away("G2 X30", "G3 X30"), another(5));
  EXPECT_EQ(away("P2", "P3"), another(6));
  EXPECT_EQ(away("G1 X20", "G3 X20 I5 J0"), another(4));
  EXPECT_EQ(said({"G0 X0 Y0 Z5\nX5\n", "G0 X10 Y20 Z5\nG1 X15\n"}),
            "its motion in line 2 is another than the original's");
  EXPECT_EQ(away("G1 Z-1 F100", "G1 X10.0005 Z-1 F100"), "confirmed");
  // Heights are the same words.
  EXPECT_EQ(said({"G0 X0 Y0 Z5\nZ0\n", "G0 X10 Y20 Z5\nZ0.000000000001\n"}), "confirmed");
  EXPECT_EQ(said({"G0 X0 Y0 Z5\nZ0\n", "G0 X10 Y20 Z5\nZ0.0000000000015\n"}),
            "its motion in line 2 is another than the original's");
  // Nothing is stated to be rounded, and doubles of 1 mm at most are read.
  const auto exact = [](const char* x) {
    return said({"G0 X0 Y0 Z5\n", fmt::format("G0 X{} Y0 Z5\n", x), "coordinates", "0", 1, "0", "0", "0"});
  };
  EXPECT_EQ(exact("0.000000000002"), "confirmed");
  EXPECT_EQ(exact("0.000000000003"), "its motion in line 1 is 3e-12 mm off the original's, moved");
  // A full turn and an arc of nearly none end at the same place within the rounding.
  EXPECT_EQ(away("G3 X30 Y20 I5 J0 P2", "G3 X30 Y20.0005 I5 J0 P2"), another(6));
  EXPECT_EQ(away("X20\n", "X20.0005\n"), "confirmed");
  EXPECT_EQ(away("X20\n", "X20.002\n"), "its motion in line 4 is 0.002 mm off the original's, moved");
  EXPECT_EQ(away("X10 Y20", "X10 Y20.002"), "its motion in line 2 is 0.002 mm off the original's, moved");
  EXPECT_EQ(away("I5 J0\n", "I5.002 J0\n"), "its motion in line 5 is 0.002 mm off the original's, moved");
  EXPECT_EQ(away("F100", "F101"),
            "its line 3 says \"F101 \" besides places, where the original has \"F100 \"");
  EXPECT_EQ(away("G0 Z5\n", "G0 Z5 M8\n"),
            "its line 7 says \"M8 \" besides places, where the original has \"\"");
}

TEST(VerifyMovedLines, NoMotionIsMoreOrLess) {
  EXPECT_EQ(away("M30\n", ""), "it ends before line 8 of the original");
  EXPECT_EQ(said({replaced(kOriginal, "M30\n", ""), kAway}),
            "its line 8 does something that the original does not");
  EXPECT_EQ(away("G1 X20\n", "G98 G81 X20 Z-1 R1\n").find("its line 4"), 0U);
  // Another motion behind the same words.
  EXPECT_EQ(said({"G0 X0 Y0 Z5\nG0 X0\nX5\n", "G0 X10 Y20 Z5\nG0 X10\nX15\n"}), "confirmed");
  EXPECT_EQ(said({"G0 X0 Y0 Z5\nG1 X2 F100\n", "G0 X10 Y20 Z5\nG18 G2 X12 Z5 I1 K0 F100\n"}),
            "its line 2 makes other motions than the original");
  EXPECT_EQ(said({"G0 X0 Y0 Z5\nG1 X0.02 F100\n", "G0 X10 Y20 Z5\nG18 G2 X10.02 Z5 I0.01 K1 F100\n"}),
            "its line 2 makes other motions than the original");
  EXPECT_EQ(said({"G0 X0 Y0 Z5\nG28 Z5\n", "G0 X10 Y20 Z5.000000000001\nG28 Z5\n"}),
            "its line 2 makes other motions than the original");
  EXPECT_EQ(said({"G0 X0 Y0 Z5.000000000001\nG28 Z5\n", "G0 X10 Y20 Z5\nG28 Z5\n"}),
            "its line 2 makes other motions than the original");
  // Lines need no plane and have no centre.
  EXPECT_EQ(said({"G21 G90 G17 G91.1\nG0 X0 Y0 Z5\nG1 X5 F100\n", "G21 G90\nG0 X10 Y20 Z5\nG1 X15 F100\n"}),
            "confirmed");
  EXPECT_EQ(said({"", "G0 X1 Y1 Z1\n"}), "its line 1 does something that the original does not");
  EXPECT_EQ(said({"", ""}), "confirmed");
}

/// The same of a solid, 30 mm higher.
std::string raised(const std::string& original, const std::string& written, const char* z = "30",
                   const char* mode = "coordinates") {
  return said({.original = original, .written = written, .mode = mode, .z = z});
}

TEST(VerifyMovedLines, HeightsOfASolidAreThoseOfTheOriginalRaised) {
  const std::string begin = "G0 X0 Y0 Z5\n", moved = "G0 X10 Y20 Z35\n", drill = "G98 G81 X5 Y0 Z-1 R2\n",
                    drilled = "G98 G81 X15 Y20 Z29 R32\n";
  EXPECT_EQ(raised(begin + drill, moved + drilled), "confirmed");
  EXPECT_EQ(raised(begin + drill, moved + replaced(drilled, "R32", "R32.0005")), "confirmed");
  EXPECT_EQ(raised(begin + drill, moved + replaced(drilled, "R32", "R32.002")),
            "its motion in line 2 is 0.002 mm off the original's, moved");
  // A point on the way home is a height, a place of the machine is none.
  EXPECT_EQ(raised(begin + "G28 Z5\n", moved + "G28 Z35\n"), "confirmed");
  EXPECT_EQ(raised(begin + "G53 G0 Z5\n", moved + "G53 G0 Z5\n"), "confirmed");
  // Nor are the depth of a peck, the angle of a spindle, and the R of no cycle.
  EXPECT_EQ(raised(begin + "G98 G83 X5 Y0 Z-1 R2 Q1\n", moved + "G98 G83 X15 Y20 Z29 R32 Q1\n"), "confirmed");
  EXPECT_EQ(raised(begin + drill + "M19 R90\n", moved + drilled + "M19 R90\n"), "confirmed");
  EXPECT_EQ(raised(begin + "X1 M19 R90\n", moved + "X11 M19 R90\n"), "confirmed");
  EXPECT_EQ(raised(begin + drill + "G28 Z5 R3\n", moved + drilled + "G28 Z35 R3\n"), "confirmed");
}

/// Without a solid, or in a frame, the words of heights are the same.
TEST(VerifyMovedLines, HeightsAreWordsWhereNothingMovesThem) {
  const std::string begin = "G0 X0 Y0 Z5\n", moved = "G0 X10 Y20 Z5\n", drill = "G98 G81 X5 Y0 Z-1 R2\n",
                    drilled = "G98 G81 X15 Y20 Z-1 R2\n";
  EXPECT_EQ(said({begin + drill, moved + drilled}), "confirmed");
  EXPECT_EQ(said({begin + drill, moved + replaced(drilled, "Z-1", "Z-1.0005")}).find("its line 2 says"), 0U);
  const std::string frame = "G21 G90\nG10 L2 P1 X10 Y20 Z30 R0\nG54\n", same = "G21 G90\nG54\n" + begin;
  EXPECT_EQ(raised(same + drill, frame + begin + drill, "30", "offset"), "confirmed");
  EXPECT_EQ(raised(same + drill, frame + begin + replaced(drill, "Z-1", "Z-1.0005"), "30", "offset")
                .find("its line 5 says"),
            0U);
}

TEST(VerifyMovedLines, AHeightIsSaidWhereTheOriginalSaysIt) {
  const std::string begin = "G0 X0 Y0\n", moved = "G0 X10 Y20\n";
  EXPECT_EQ(raised(begin + "X1 Z5\n", moved + "X11 Z0\n", "-5"), "confirmed");
  EXPECT_EQ(raised(begin + "X1 Z5\n", moved + "X11\n", "-5"),
            "its motion in line 2 is another than the original's");
  EXPECT_EQ(raised(begin + "X1\n", moved + "X11 Z0\n", "-5"),
            "its motion in line 2 is another than the original's");
  EXPECT_EQ(raised(begin + "G1 X1 F90\n", moved + "G1 X11 F90\n"),
            "its motion in line 2 is another than the original's");
  EXPECT_EQ(raised(begin + "G91 G0 X1 Z5\n", moved + "G91 G0 X1 Z5\n"), "confirmed");
  EXPECT_EQ(raised(begin + "G91 G0 X1 Z5\n", moved + "G91 G0 X1 Z6\n").find("its line 2 says"), 0U);
}

/// A cycle may not carry numbers of G90 into G91.
TEST(VerifyMovedLines, ACycleOfASolidSaysBothHeightsAfterAnotherDistanceMode) {
  const std::string drill = "G0 X0 Y0 Z5\nG98 G81 X5 Y0 Z-1 R2\n",
                    drilled = "G0 X10 Y20 Z35\nG98 G81 X15 Y20 Z29 R32\n";
  const auto then = [&](const std::string& line) { return raised(drill + line, drilled + line); };
  EXPECT_EQ(then("G91 X1 Z-3 R1\nX1\n"), "confirmed");
  for (const char* line : {"G91 X1\n", "G91 X1 Z-3\n", "G91 X1 R1\n", "G91 X1 Z-3 R1\nG90 X30 Y40\n"})
    EXPECT_EQ(then(line).find("open: "), 0U) << line << then(line);
  const std::string flat = "G0 X10 Y20 Z5\nG98 G81 X15 Y20 Z-1 R2\nG91 X1\n";
  EXPECT_EQ(said({drill + "G91 X1\n", flat}), "confirmed");
}

TEST(VerifyMovedLines, WhatIsNotUnderstoodStaysOpen) {
  EXPECT_EQ(said({"G5.1\n", kAway}), "open: p.nc:1: G5.1 is not understood here");
  EXPECT_EQ(said({kOriginal, "G5.1\n"}), "open: out.nc:1: G5.1 is not understood here");
  EXPECT_EQ(said({"G5.1\n", "G5.2\n"}), "open: p.nc:1: G5.1 is not understood here");
  EXPECT_EQ(said({kOriginal, kAway, "other"}), "there is no mode \"other\"");
  EXPECT_EQ(said({"\xEF\xBB\xBF" + kOriginal, "\xEF\xBB\xBF" + kAway}), "confirmed");
}

TEST(VerifyMovedLines, TheWorkOffsetIsTheOriginals) {
  const std::string with54 = replaced(kOriginal, "G17\n", "G17 G54\n");
  const auto moved = [](const char* offset) {
    return replaced(kAway, "G17\n", std::string("G17 ") + offset + "\n");
  };
  const std::string other = "its line 2 runs in another work offset than the original";
  EXPECT_EQ(said({with54, moved("G54")}), "confirmed");
  EXPECT_EQ(said({with54, moved("G55")}), other);
  EXPECT_EQ(said({kOriginal, moved("G54")}), other);
}

// ---- arcs of other planes ---------------------------------------------------------------------------------

const std::string kUpright = "G21 G90 G17\nG0 X0 Y0 Z5\nG18 G2 X2 Z5 I1 K0 F100\nG17 G0 X5\n",
                  kUprightAway = "G21 G90 G17\nG0 X10 Y20 Z5\nG18 G2 X12 Z5 I1 K0 F100\nG17 G0 X15\n";

TEST(VerifyMovedLines, AnArcThatKeepsItsPlaneIsTheSameArc) {
  const auto changed = [](std::string_view what, std::string_view with) {
    return said({kUpright, replaced(kUprightAway, what, with)});
  };
  const std::string another = "its arc in line 3 is another than the original's";
  EXPECT_EQ(said({kUpright, kUprightAway}), "confirmed");
  EXPECT_EQ(changed("G18 G2", "G18 G3"), another);
  EXPECT_EQ(changed("K0", "K0 P2"), another);
  EXPECT_EQ(changed("G18 G2 X12 Z5 I1 K0", "G19 G2 Y22 Z5 J1 K0"), another);
  EXPECT_EQ(changed("X12", "X12.0005"), "confirmed");
  EXPECT_EQ(changed("X12", "X12.003").find("its motion in line 3 is "), 0U);
  EXPECT_EQ(changed("K0", "K0.003").find("its motion in line 3 is "), 0U);
  // An arc of the plane XY is none of another plane, with the words of its height among the places.
  EXPECT_NE(changed("G18 G2 X12 Z5 I1 K0", "G2 X12 I1 J0"), "confirmed");
  EXPECT_NE(said({replaced(kUpright, "G18 G2 X2 Z5 I1 K0", "G2 X2 I1 J0"), kUprightAway}), "confirmed");
  // Within the rounding it may end at another height, from which no other motion begins.
  const auto behind = [](const char* height) {
    return said({replaced(kUpright, "G17 G0 X5", "G17 G0 Z7"),
                 replaced(replaced(kUprightAway, "Z5 I1", fmt::format("Z{} I1", height)), "G17 G0 X15",
                          "G17 G0 Z7")});
  };
  EXPECT_EQ(behind("5"), "confirmed");
  EXPECT_EQ(behind("5.0004"), "its motion in line 4 is another than the original's");
}

/// The half circle of kUpright as so many lines, turned by a right angle about the origin and moved; its feed
/// is said with the first, or with all.
std::string chords(int count, const std::string& feed = "F100", bool with_all = false) {
  std::string text;
  for (int k = 1; k <= count; ++k) {
    const double angle = kPi * k / count, along = 1 - std::cos(angle), up = 5 - std::sin(angle);
    text += fmt::format("G1 X10 Y{:.9f} Z{:.9f}{}\n", 20 + along, up, k == 1 || with_all ? " " + feed : "");
  }
  return text;
}
const char* const kRight = "1.5707963267948966";
const std::string kFirst = "G21 G90 G17\nG0 X10 Y20 Z5\n", kLast = "G0 Y25\n";

TEST(VerifyMovedLines, AnArcThatWasTurnedOutOfItsPlaneIsItsChords) {
  const auto made = [](const std::string& lines) {
    return said({kUpright, kFirst + lines + kLast, "coordinates", kRight});
  };
  EXPECT_EQ(made(chords(64)), "confirmed");
  EXPECT_EQ(made(chords(40)), "confirmed");  // 0.8e-3 of its middle
  EXPECT_NE(made(chords(30)), "confirmed");  // 1.4e-3
  EXPECT_NE(made(chords(1)), "confirmed");
  std::string lines = chords(64);
  EXPECT_EQ(made(replaced(lines, "G1", "G0")), "its line 3 is no chord of an arc");
  EXPECT_NE(made(replaced(lines, "\n", " M8\n")), "confirmed");
  EXPECT_NE(made(replaced(lines, " F100", "")), "confirmed");
  EXPECT_NE(made(replaced(lines, "F100", "F101")), "confirmed");
  EXPECT_NE(made(replaced(lines, "\n", "\nM8\n")), "confirmed");
  EXPECT_NE(made(replaced(lines, "F100\n", "F100 G55\n")), "confirmed");
  EXPECT_NE(made(replaced(lines, "\nG1 X10", "\nG3 R5 X10")), "confirmed");
  const auto last = [](const std::string& in_lines, const char* rounding = "0.001") {
    return said({replaced(kUpright, "G17 G0 X5\n", ""), kFirst + in_lines, "coordinates", kRight, 1, "10",
                 "20", rounding});
  };
  EXPECT_EQ(last(lines), "confirmed");
  EXPECT_EQ(last(replaced(lines, "F100\n", "F100 G55\n"), "0.1"), "its line 3 is no chord of an arc");
  lines.erase(lines.rfind("G1"));
  EXPECT_NE(last(lines), "confirmed");
  EXPECT_NE(last(lines + "M8\n"), "confirmed");
  EXPECT_NE(made(lines), "confirmed");  // it does not come to its end
  EXPECT_NE(made(chords(64) + "G1 Y22.5\n"), "confirmed");
  // The arc, chord by chord, but the other way round and over the other side.
  EXPECT_NE(
      said({replaced(kUpright, "G18 G2", "G18 G3"), kFirst + chords(64) + kLast, "coordinates", kRight}),
      "confirmed");
  EXPECT_EQ(said({kUpright, kFirst, "coordinates", kRight}), "it ends before line 3 of the original");
}

TEST(VerifyMovedLines, ChordsShareTheTimeOfTheirArc) {
  const std::string timed = replaced(kUpright, "G18 G2 X2 Z5 I1 K0 F100", "G93 G18 G2 X2 Z5 I1 K0 F4"),
                    end = "G94\nG0 Y25\n";
  const std::string original = replaced(timed, "G17 G0 X5", "G94\nG17 G0 X5");
  const auto made = [&](const std::string& lines) {
    return said({original, kFirst + lines + end, "coordinates", kRight});
  };
  const std::string shared = "G93 " + chords(64, "F256", true);
  EXPECT_EQ(made(shared), "confirmed");
  EXPECT_NE(made("G93 " + chords(64, "F4", true)), "confirmed");
  EXPECT_NE(made("G93 " + chords(64, "F256", false)), "confirmed");
  EXPECT_NE(made(replaced(shared, "F256", "F257")), "confirmed");
  EXPECT_NE(made(replaced(shared, "F256\nG1", "F256 M8\nG1")), "confirmed");
  EXPECT_NE(made(shared.substr(4)), "confirmed");
  EXPECT_NE(said({replaced(replaced(original, "G93 G18", "G93 F4\nG18"), "K0 F4", "K0"),
                  kFirst + replaced(shared, "G93 ", "G93 F4\n") + end, "coordinates", kRight}),
            "confirmed");
  // The feed behind it is that of the arc and not that of a chord.
  EXPECT_EQ(
      said({replaced(timed, "G17 G0 X5", "G17 G1 X5"), kFirst + shared + "G1 Y25\n", "coordinates", kRight}),
      "its motion in line 67 is another than the original's");
}

TEST(VerifyMovedLines, TheLastChordMayEndAsFarOffAsAnyPlace) {
  // The largest of all numbers is 2 in both programs.
  const double limit = 0.5 + 1e-12 * (2.0 + 2.0);
  EXPECT_EQ(said({replaced(kUpright, "G17 G0 X5\n", "G17 G1 Z7\n"),
                  fmt::format("G21 G90 G17\nG0 X0 Y0 Z5\nG1 X1 Z4 F100\nX2 Y{:.17g} Z5\nG1 Z7\n", limit),
                  "coordinates", "0", 1, "0", "0", "0.5"}),
            "confirmed");
}

// ---- frames -----------------------------------------------------------------------------------------------

const std::string kBody = "G0 X0 Y0 Z5\nG1 Z-1 F100\nG1 X10\nG3 X10 Y0 I5 J0\nG0 Z5\n",
                  kHead = "G21 G90 G17\n";
const std::string kPlain = kHead + kBody + "M30\n";
const std::string kOffset = kHead + "G10 L2 P1 X10 Y20 R90\nG54\n" + kBody + "M30\n";

std::string framed(const std::string& written, std::size_t work_offset = 1,
                   const std::string& original = kPlain) {
  return said({original, written, "offset", kRight, work_offset});
}

TEST(VerifyMovedLines, AnOffsetThatIsSetMakesTheFrame) {
  EXPECT_EQ(framed(kOffset), "confirmed");
  const auto changed = [](std::string_view what, std::string_view with) {
    return framed(replaced(kOffset, what, with));
  };
  EXPECT_EQ(changed("X10 Y20 R90", "X10 R90"), "it sets no frame");
  EXPECT_EQ(changed("X10 Y20 R90", "Y20 R90"), "it sets no frame");
  EXPECT_EQ(changed("X10 Y20 R90", "X10 Y20"), "it sets no frame");
  const std::string two = "it sets its frame in two ways, or another work offset than the result says";
  EXPECT_EQ(changed("P1", "P2"), two);
  EXPECT_EQ(changed("R90\n", "R90\nG10 L2 P1 X10 Y20 R90\n"), two);
  EXPECT_EQ(changed("X10 Y20", "X10.0005 Y20"), "confirmed");
  EXPECT_EQ(changed("X10 Y20", "X10.002 Y20").find("its frame puts line "), 0U);
  EXPECT_EQ(changed("X10 Y20", "X10 Y20.002").find("its frame puts line "), 0U);
  EXPECT_EQ(changed("R90", "R91").find("its frame puts line "), 0U);
  const auto shifted = [](const char* x) {
    return said({kHead + "G0 X0 Y0 Z5\n", fmt::format("{}G10 L2 P1 X{} Y0 R0\nG54\nG0 X0 Y0 Z5\n", kHead, x),
                 "offset", "0", 1, "0", "0", "0"});
  };
  EXPECT_EQ(shifted("0.000000000002"), "confirmed");
  EXPECT_EQ(shifted("0.000000000003"), "its frame puts line 2 3e-12 mm off");
  EXPECT_EQ(framed(kPlain), "it sets no frame");
  EXPECT_EQ(changed("G1 Z-1", "G1 Z-2").find("its motion in line "), 0U);
  // Small letters, comments and the ends of lines make no difference; what stands in a comment is no frame.
  EXPECT_EQ(changed("G10 L2 P1", "g10 l2 p1"), "confirmed");
  EXPECT_EQ(changed("R90\n", "R90 (; the frame)\r\n"), "confirmed");
  EXPECT_EQ(changed("G10", "(a; b) G10"), "confirmed");
  EXPECT_EQ(changed("G54\n", "G54 (G10 L2 P1 X0 Y0 R0)\n; G10 L2 P1 X0 Y0 R0\n"), "confirmed");
  EXPECT_EQ(changed("G54\n", "G54 )\n").find("open: "), 0U);
  // In inches the frame is as well.
  EXPECT_EQ(said({kPlain, kHead + "G20\nG10 L2 P1 X1 Y2 R90\nG21\nG54\n" + kBody + "M30\n", "offset", kRight,
                  1, "25.4", "50.8"}),
            "confirmed");
}

TEST(VerifyMovedLines, NothingMovesOutsideOfItsFrame) {
  const std::string late = kHead + "G0 X0 Y0 Z5\nG1 X1 F100\nG10 L2 P1 X10 Y20 R90\nG54\n";
  const std::string original = kHead + "G0 X0 Y0 Z5\nG1 X1 F100\nG54\n";
  EXPECT_EQ(framed(late + kBody + "M30\n", 1, original + kBody + "M30\n"),
            "its line 3 moves outside its frame");
  // Only a rapid to the first place, whose beginning nobody knows, is no motion there.
  const std::string arrives = "G0 X0 Y0\n";
  EXPECT_EQ(framed(kHead + arrives + "G10 L2 P1 X10 Y20 R90\nG54\n" + kBody + "M30\n", 1,
                   kHead + arrives + "G54\n" + kBody + "M30\n"),
            "confirmed");
  EXPECT_EQ(framed(arrives + kOffset, 1, arrives + kHead + "G54\n" + kBody + "M30\n"), "confirmed");
  EXPECT_EQ(framed("M8\nM30\n", 1, "M8\nM30\n"), "confirmed");
  EXPECT_EQ(framed("G21\nG10 L2 P1 X10 Y20 R90\nM8\nM30\n", 1, "M8\nM30\n"), "confirmed");
  EXPECT_EQ(framed("G21\nG10 L2 P2 X10 Y20 R90\nM8\nM30\n", 1, "M8\nM30\n"),
            "it sets its frame in two ways, or another work offset than the result says");
  EXPECT_EQ(framed("M8\nM9\nM30\n", 1, "M8\nM30\n"),
            "its line 2 says \"M9 \" besides places, where the original has \"M30 \"");
  EXPECT_EQ(framed("G5.1\n"), "open: out.nc:1: G5.1 is not understood here");
  EXPECT_EQ(framed(kOffset, 1, "G5.1\n"), "open: p.nc:1: G5.1 is not understood here");
}

TEST(VerifyMovedLines, TheOffsetIsTheOneThatTheResultNames) {
  const auto with = [](const char* p, const char* offset, std::size_t named) {
    return framed(replaced(replaced(kOffset, "P1", p), "G54", offset), named);
  };
  EXPECT_EQ(with("P1", "G54", 1), "confirmed");
  EXPECT_EQ(with("P2", "G55", 2), "confirmed");
  EXPECT_EQ(with("P6", "G59", 6), "confirmed");
  EXPECT_EQ(with("P7", "G59.1", 7), "confirmed");
  EXPECT_EQ(with("P9", "G59.3", 9), "confirmed");
  const std::string other = "runs in another work offset than the original";
  EXPECT_NE(with("P1", "G55", 1).find(other), std::string::npos);
  EXPECT_NE(with("P7", "G59", 7).find(other), std::string::npos);
  EXPECT_NE(with("P6", "G59.1", 6).find(other), std::string::npos);
  // Where the original selects one it stays.
  EXPECT_NE(framed(kOffset, 1, replaced(kPlain, "G17\n", "G17 G55\n")).find(other), std::string::npos);
}

TEST(VerifyMovedLines, AFullTurnIsAsFarOffAsItsFarSide) {
  // It begins at the origin of the frame, about a middle 10 mm away: a frame that is turned by so much too
  // far puts the middle off by 0.75e-3 and the far side by 1.5e-3.
  const std::string body = "G0 X0 Y0 Z5\nG1 Z-1 F100\nG3 X0 Y0 I10 J0\nG0 Z5\nM30\n";
  const auto turned = [&](const char* degrees) {
    return framed(kHead + "G10 L2 P1 X10 Y20 R" + degrees + "\nG54\n" + body, 1, kHead + body);
  };
  EXPECT_EQ(turned("90.0025"), "confirmed");
  EXPECT_EQ(turned("90.0043").find("its frame puts line 4 "), 0U);
  // Out and back only the far end is off; of a spiral the wider end counts.
  const auto other = [](const char* degrees, const std::string& lines) {
    return framed(kHead + "G10 L2 P1 X10 Y20 R" + degrees + "\nG54\n" + lines, 1, kHead + lines);
  };
  EXPECT_EQ(other("90.01", "G0 X0 Y0 Z5\nG1 X10 F100\nX0\n").find("its frame puts line 3 "), 0U);
  EXPECT_EQ(other("90.004", "G0 X9 Y0 Z5\nG3 X1 Y4 I1 J0 F100\n").find("its frame puts line 3 "), 0U);
}

const std::string kTurned = kHead + "G52 X10 Y20\nG68 X0 Y0 R90\n" + kBody + "G69\nG52 X0 Y0\nM30\n";
std::string rotated(const std::string& written, const std::string& original = kPlain) {
  return said({original, written, "g68", kRight});
}

TEST(VerifyMovedLines, AShiftAndATurnMakeTheFrame) {
  EXPECT_EQ(rotated(kTurned), "confirmed");
  const auto changed = [](std::string_view what, std::string_view with) {
    return rotated(replaced(kTurned, what, with));
  };
  EXPECT_EQ(changed("G68 X0 Y0 R90\n", ""), "it sets no frame");
  EXPECT_NE(changed("G52 X10 Y20\n", ""), "confirmed");
  EXPECT_NE(changed("G52 X10 Y20", "G52 X10"), "confirmed");
  EXPECT_EQ(changed("X10 Y20", "X10.002 Y20").find("its frame puts line "), 0U);
  EXPECT_EQ(changed("R90", "R91").find("its frame puts line "), 0U);
  const std::string two = "it sets its frame in two ways, or another work offset than the result says";
  EXPECT_EQ(changed("R90\n", "R90\nG52 X10 Y20\n"), two);
  EXPECT_EQ(changed("R90\n", "R90\nG68 X0 Y0 R91\n"), two);
  EXPECT_EQ(changed("R90\n", "R90\nG68 X0 Y0 R90\n"), "confirmed");
  EXPECT_EQ(changed("G69\n", "G80 G69\n"), "confirmed");
  EXPECT_EQ(rotated("G21 G90 G17\nG68 X0 Y0 R90\nM8\n", "M8\n"), "it sets no frame");
  EXPECT_EQ(rotated("G21 G90 G17\nG52 X10 Y20\nM8\n", "M8\n"), "it sets no frame");
  EXPECT_EQ(changed("G69\n", ""), "confirmed");
  // What comes behind the end of the frame is outside of it.
  EXPECT_EQ(
      rotated(replaced(kTurned, "G69\nG52 X0 Y0\n", "G69\nG1 X20\n"), replaced(kPlain, "M30", "G1 X20\nM30")),
      "its line 10 moves outside its frame");
  EXPECT_EQ(rotated(replaced(kTurned, "G69\nG52 X0 Y0\n", "G52 X0 Y0\nG1 X20\n"),
                    replaced(kPlain, "M30", "G1 X20\nM30")),
            "its line 10 moves outside its frame");
  // The words of the other way to set a frame are none here, and the other way round.
  EXPECT_EQ(rotated(kOffset).find("open: "), 0U);
  EXPECT_EQ(framed(kTurned).find("open: "), 0U);
}

/// Whatever stood behind a frame in its line went by unseen.
TEST(VerifyMovedLines, AFrameStandsAloneInItsLine) {
  for (const char* more : {" Z-50", " A90", " M3 S900", " G1 X9", " P1", " X10", "1.5.", " R", " (a) Z1"}) {
    EXPECT_NE(framed(replaced(kOffset, "R90\n", fmt::format("R90{}\n", more))), "confirmed") << more;
    EXPECT_NE(rotated(replaced(kTurned, "R90\n", fmt::format("R90{}\n", more))), "confirmed") << more;
    EXPECT_NE(rotated(replaced(kTurned, "Y20\n", fmt::format("Y20{}\n", more))), "confirmed") << more;
  }
  EXPECT_EQ(framed(replaced(kOffset, "R90\n", "R90\nG10 L2 P1 Z-50\n")),
            "its line 3 sets a frame beside other words, or where unit, plane or G90 are not said");
  EXPECT_EQ(framed(replaced(kOffset, "G10", "/G10")), "it sets no frame");
  EXPECT_NE(rotated(replaced(kTurned, "G52 X10", "/ G52 X10")), "confirmed");
  EXPECT_EQ(rotated(replaced(kTurned, "G68", "/G68")), "it sets no frame");
  EXPECT_EQ(rotated(replaced(kTurned, "X0 Y0 R90", "X1 Y0 R90")), "it sets no frame");
  EXPECT_EQ(rotated(replaced(kTurned, "X0 Y0 R90", "X0 Y1 R90")), "it sets no frame");
  EXPECT_EQ(framed(replaced(kOffset, "G10", "N7 G21 G10")), "confirmed");
  EXPECT_EQ(framed(replaced(kOffset, "G10", "G1 X5 F100 G10")).find("its line 2 "), 0U);
}

/// Words are words however they are written and in whatever order lines run.
TEST(VerifyMovedLines, AFrameIsInTheUnitAndPlaneThatAreInForce) {
  for (const char* inches : {"G20", "G 20", "g020", "G20.0", "G2(a)0", "G[4*5]"}) {
    const std::string written =
        fmt::format("G21 G90 G17\n{}\nG10 L2 P1 X10 Y20 R90\nG21\nG54\n{}M30\n", inches, kBody);
    EXPECT_NE(said({kPlain, written, "offset", kRight}), "confirmed") << inches;
  }
  // A subprogram behind the end runs before the frame.
  EXPECT_NE(framed(kHead + "M98 P7\nG10 L2 P1 X10 Y20 R90\nG21 G54\n" + kBody + "M30\nO7\nG20\nM99\n"),
            "confirmed");
  EXPECT_EQ(said({kPlain, kHead + "M98 P7\nG10 L2 P1 X1 Y2 R90\nG21 G54\n" + kBody + "M30\nO7\nG20\nM99\n",
                  "offset", kRight, 1, "25.4", "50.8"}),
            "confirmed");
  EXPECT_EQ(
      framed(replaced(kOffset, kHead + "G10 L2 P1 X10 Y20 R90\n", "G90 G17\nG10 L2 P1 X10 Y20 R90\nG21\n")),
      "it sets no frame");
  for (const char* head : {"G90 G17", "G21 G17", "G21 G90", "G21 G90 G18", "G21 G91 G17"}) {
    const std::string written =
        fmt::format("{}\nG52 X10 Y20\nG68 X0 Y0 R90\n{}{}G69\nG52 X0 Y0\nM30\n", head, kHead, kBody);
    EXPECT_NE(said({kPlain, written, "g68", kRight}), "confirmed") << head;
    if (std::string_view(head) == "G90 G17") {
      EXPECT_EQ(said({kPlain, written, "g68", kRight}),
                "its line 2 sets a frame beside other words, or where unit, plane or G90 are not said");
    }
  }
}

TEST(VerifyMovedLines, AFrameHoldsUntilAnyWordEndsIt) {
  const auto more = [](const std::string& lines) {
    return said({replaced(kPlain, "M30", "G1 X20\nM30"), replaced(kTurned, "G69\nG52 X0 Y0\n", lines), "g68",
                 kRight, 1, "10", "20", "0.001", words::Control::fanuc});
  };
  EXPECT_EQ(more("G1 X20\nG69\nG52 X0 Y0\n"), "confirmed");
  for (const char* end :
       {"G69", "G 69", "N5 G69", "G69 G80", "G52 X0 Y0", "N5 G52 X0.0 Y0", "G69\nG52 X0 Y0"})
    EXPECT_NE(more(std::string(end) + "\nG1 X20\n"), "confirmed") << end;
  EXPECT_EQ(more("G69\nG68 X0 Y0 R90\nG1 X20\nG69\nG52 X0 Y0\n"), "confirmed");
  EXPECT_NE(more("G69\nG52 X0 Y0\nG68 X0 Y0 R90\nG1 X20\n"), "confirmed");
  // Each is said in G90.
  EXPECT_NE(rotated(replaced(replaced(kTurned, "G21 G90 G17\n", "G21 G17\n"), "Y20\n", "Y20\nG90\n")),
            "confirmed");
  EXPECT_NE(rotated(replaced(replaced(kTurned, "Y20\n", "Y20\nG91\n"), "R90\n", "R90\nG90\n")), "confirmed");
  for (const char* end : {"G52 X0", "G52 X5 Y0", "G52 X0 Y5"})
    EXPECT_NE(rotated(replaced(kTurned, "G52 X0 Y0", end)), "confirmed") << end;
  EXPECT_EQ(said({kPlain, replaced(kTurned, "X10 Y20", "X10 Y0"), "g68", kRight, 1, "10", "0"}), "confirmed");
  // A turn before its shift, or a shift within a turn, is another frame.
  EXPECT_NE(rotated(replaced(kTurned, "G52 X10 Y20\nG68 X0 Y0 R90\n", "G68 X0 Y0 R90\nG52 X10 Y20\n")),
            "confirmed");
  // No shift is a frame too.
  EXPECT_EQ(said({kPlain, replaced(kTurned, "X10 Y20", "X0.0000 Y0.0000"), "g68", kRight, 1, "0", "0"}),
            "confirmed");
}

/// A line that runs before the frame and under it moves outside of it.
TEST(VerifyMovedLines, ALineHasToBeInTheFrameWheneverItRuns) {
  const std::string begin = kHead + "G54\nG0 X0 Y0 Z5\nM98 P7\n",
                    end = "M98 P7\nM30\nO7\nG91 G1 X1 F100\nM99\n";
  EXPECT_EQ(framed(begin + "G10 L2 P1 X10 Y20 R90\n" + end, 1, begin + end),
            "its line 9 moves outside its frame");
}

/// The frame is that of one work offset.
TEST(VerifyMovedLines, NothingMovesInAnotherWorkOffsetThanItsFrame) {
  const std::string two = replaced(kBody, "G1 X10\n", "G1 X10\nG55\nG0 X0 Y0 Z5\nX1\n");
  EXPECT_EQ(
      framed(kHead + "G10 L2 P1 X10 Y20 R90\nG54\n" + two + "M30\n", 1, kHead + "G54\n" + two + "M30\n"),
      "its line 9 moves outside its frame");
  EXPECT_EQ(framed(replaced(kOffset, "G54\n", "")), "its line 4 moves outside its frame");
}

}  // namespace
}  // namespace lekalo::verify::verify_moved_lines_test

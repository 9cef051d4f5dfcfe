// A program that was written for a placement is the original, moved: what the rewriter writes is confirmed in
// every mode and form, and every change of it is refused.

#include "verify/pocket/moved_program.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "lekalo/nc/header.hpp"
#include "lekalo/nc/rewrite.hpp"

namespace lekalo::verify::verify_moved_program_test {
namespace {

using nc::RewriteMode;

constexpr double kX = 12.7, kY = -25.4;

Decimal decimal(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.17g", value);
  return *parse_decimal(text);
}

std::string name_of(RewriteMode mode) {
  return mode == RewriteMode::coordinates ? "coordinates" : mode == RewriteMode::offset ? "offset" : "g68";
}

struct Moved {
  std::string text;
  double rounding = 0;
  words::Control control = words::Control::linuxcnc;
};

Moved moved(const std::string& original, RewriteMode mode, double theta) {
  nc::RewriteOptions options{.mode = mode};
  if (mode == RewriteMode::g68) options.scan_frame = nc::ScanFrame::wcs;
  const auto made = nc::rewrite_program(original, "p.nc", kX, kY, theta, options);
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  if (!made) return {};
  return {nc::with_header(made->program, made->notes, made->control), made->rounding_mm, made->control};
}

ProgramVerdict verdict_of(const std::string& original, const std::string& written, const Moved& from,
                          RewriteMode mode, double theta) {
  return check_moved_program({{"p.nc", original},
                              {"out.nc", written},
                              decimal(kX),
                              decimal(kY),
                              decimal(theta),
                              decimal(from.rounding),
                              name_of(mode),
                              1,
                              from.control,
                              {}});
}

std::string said(const ProgramVerdict& verdict) {
  return verdict.fault ? "fault: " + *verdict.fault : verdict.open ? "open: " + *verdict.open : "confirmed";
}

const std::string kPlain =
    "G21 G90 G17\nT1 M6\nS900 M3\nG54\nG0 X1 Y2\nG43 Z5 H1\nG1 Z-1 F100\nG2 X11 Y2 I5\nG1 G41 D1 X20\nG40 "
    "Y9\n"
    "G0 Z5\nG98 G81 X3 Y4 Z-2 R1\nX5\nG80\nM30\n";
const std::string kHard =
    "%\nO12 (FORMS)\nG21 G90 G17 F90\n#1=4. (width)\nG0 X1. Y2. Z5.\nG18 G2 X3. Z4. I1. K-.5\nG17 G1 X[#1*2] "
    "Y-#1\n"
    "M98 P200 L2\nG28 G91 Z0.\nG90\nG0 X0. Y0.\nG53 G0 Z0.\nM30\nO200\nG91 G1 X1. Y.5\nG90\nM99\n%\n";

TEST(VerifyMovedProgram, ConfirmsWhatTheRewriterWritesInEveryMode) {
  for (const std::string& original : {kPlain, kHard})
    for (const RewriteMode mode : {RewriteMode::coordinates, RewriteMode::offset, RewriteMode::g68})
      for (const double theta : {0.0, 0.58, -2.0}) {
        if (mode == RewriteMode::offset && original == kHard) continue;  // program numbers are not LinuxCNC's
        const Moved made = moved(original, mode, theta);
        EXPECT_EQ(said(verdict_of(original, made.text, made, mode, theta)), "confirmed") << made.text;
      }
}

/// Every number and every word of the written program, changed by itself.
TEST(VerifyMovedProgram, RefusesEveryChangeOfANumberOrALetter) {
  std::size_t changes = 0, confirmed = 0;
  for (const std::string& original : {kPlain, kHard})
    for (const RewriteMode mode : {RewriteMode::coordinates, RewriteMode::g68}) {
      const Moved made = moved(original, mode, 0.58);
      bool comment = false;
      for (std::size_t at = 0; at < made.text.size(); ++at) {
        const char c = made.text[at];
        comment = c == '(' || (comment && c != ')');
        if (comment || c < '1' || c > '8') continue;
        const std::size_t line = made.text.rfind('\n', at) + 1;
        if (made.text[line] == 'O' || made.text[line] == '%') continue;
        std::string other = made.text;
        other[at] = static_cast<char>(c + 1);
        // A last decimal may stay within the rounding that is stated.
        const std::size_t point = made.text.rfind('.', at);
        const bool fine = point != std::string::npos && at - point > 2 &&
                          made.text.find_first_not_of("0123456789", point + 1) > at;
        // Nothing here depends on the plane of lines, or on the end of a cycle that nothing follows.
        const std::string word = made.text.substr(at > 1 ? at - 2 : 0, 3);
        const bool idle = word == "G17" || word.substr(1) == "G8";
        if (fine || idle) continue;
        ++changes;
        const std::string says = said(verdict_of(original, other, made, mode, 0.58));
        if (says == "confirmed") ++confirmed, ADD_FAILURE() << other.substr(line, 60);
      }
    }
  EXPECT_GT(changes, 300U);
  EXPECT_EQ(confirmed, 0U);
}

/// Programs of solids are shifted along Z as well.
struct MovedSolid {
  Moved made;
  double z = 30.5, theta = 0;
  RewriteMode mode = RewriteMode::coordinates;

  [[nodiscard]] std::string said_of(const std::string& original, const std::string& written) const {
    ProgramClaim claim{{"p.nc", original},     {"out.nc", written}, decimal(kX), decimal(kY),  {},
                       decimal(made.rounding), name_of(mode),       1,           made.control, {}};
    claim.solid =
        ProgramClaim::Solid{decimal(z), {decimal(2 * std::cos(theta / 2)), decimal(2 * std::sin(theta / 2))}};
    return said(check_moved_program(claim));
  }
};

MovedSolid moved_solid(const std::string& original, RewriteMode mode, double theta) {
  MovedSolid solid{{}, 30.5, theta, mode};
  nc::RewriteOptions options{.mode = mode};
  if (mode == RewriteMode::g68) options.scan_frame = nc::ScanFrame::wcs;
  options.z = solid.z;
  const auto made = nc::rewrite_program(original, "p.nc", kX, kY, theta, options);
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  if (made)
    solid.made = {nc::with_header(made->program, made->notes, made->control), made->rounding_mm,
                  made->control};
  return solid;
}

TEST(VerifyMovedProgram, ConfirmsProgramsOfSolidsInEveryMode) {
  for (const std::string& original : {kPlain, kHard})
    for (const RewriteMode mode : {RewriteMode::coordinates, RewriteMode::offset, RewriteMode::g68})
      for (const double theta : {0.0, 0.58, -2.0}) {
        if (mode == RewriteMode::offset && original == kHard) continue;
        MovedSolid solid = moved_solid(original, mode, theta);
        EXPECT_EQ(solid.said_of(original, solid.made.text), "confirmed") << solid.made.text;
        // The same program claims another height, or another turn, in vain.
        solid.z += 0.01;
        EXPECT_EQ(solid.said_of(original, solid.made.text).find("fault"), 0U);
        solid.z -= 0.01, solid.theta += 0.01;
        EXPECT_EQ(solid.said_of(original, solid.made.text).find("fault"), 0U);
      }
}

TEST(VerifyMovedProgram, RefusesEveryOtherHeightOfASolid) {
  std::size_t changes = 0;
  for (const std::string& original : {kPlain, kHard})
    for (const RewriteMode mode : {RewriteMode::coordinates, RewriteMode::g68}) {
      const MovedSolid solid = moved_solid(original, mode, 0.58);
      const std::string& text = solid.made.text;
      bool comment = false;
      for (std::size_t at = 0; at + 1 < text.size(); ++at) {
        comment = text[at] == '(' || (comment && text[at] != ')');
        if (comment || (text[at] != 'Z' && text[at] != 'R')) continue;
        std::string other = text;
        other.insert(at + (text[at + 1] == '-' ? 2 : 1), "1");
        ++changes;
        EXPECT_EQ(solid.said_of(original, other).find("fault"), 0U)
            << other.substr(at > 20 ? at - 20 : 0, 40);
      }
    }
  EXPECT_GT(changes, 60U);
}

/// A Z that the program has not said is nowhere on the part, and a cycle may not carry numbers of G90 into
/// G91.
TEST(VerifyMovedProgram, HoldsASolidToHeightsThatAreSaid) {
  const MovedSolid solid{{"", 1e-9, words::Control::linuxcnc}};
  const std::string begin = "G21 G90 G17 F90.\n";
  const std::string moved_begin = begin + "G0 X12.7 Y-25.4\n", unmoved = begin + "G0 X0. Y0.\n";
  EXPECT_EQ(solid.said_of(unmoved, moved_begin), "confirmed");
  EXPECT_EQ(solid.said_of(unmoved + "G0 Z5.\n", moved_begin + "G0 Z35.5\n"), "confirmed");
  EXPECT_EQ(solid.said_of(unmoved + "G0 Z5.\n", moved_begin + "G0 Z5.\n").find("fault"), 0U);
  EXPECT_EQ(solid.said_of(unmoved + "G1 X1.\n", moved_begin + "G1 X13.7\n").find("fault"), 0U);
  EXPECT_EQ(solid.said_of(unmoved + "G91 G28 Z0.\n", moved_begin + "G91 G28 Z0.\n"), "confirmed");
  EXPECT_EQ(solid.said_of(unmoved + "G53 G0 Z-1.\n", moved_begin + "G53 G0 Z29.5\n").find("fault"), 0U);
  const std::string cycle = unmoved + "G0 Z5.\nG99 G81 X1. Z-1. R2.\nG91 X1.\nM2\n",
                    moved_cycle = moved_begin + "G0 Z35.5\nG99 G81 X13.7 Z29.5 R32.5\nG91 X1.\nM2\n";
  EXPECT_EQ(solid.said_of(cycle, moved_cycle).find("open"), 0U);
}

/// Of a way along Z from a height that is not known no motion is seen, only its words.
TEST(VerifyMovedProgram, ARapidUpFromAnUnknownHeightStaysOne) {
  const std::string original =
      "G21 G90 G17 F90.\nG0 X1. Y2.\nG0 Z9.\nG98 G81 X3. Y4. Z-2. R1.\nG80\nG0 Z9.\nX5.\nM30\n";
  const Moved made = moved(original, RewriteMode::coordinates, 0.58);
  std::string other = made.text;
  other.replace(other.rfind("G0 Z9."), 2, "G1");
  EXPECT_EQ(said(verdict_of(original, made.text, made, RewriteMode::coordinates, 0.58)), "confirmed");
  EXPECT_EQ(said(verdict_of(original, other, made, RewriteMode::coordinates, 0.58)).find("fault"), 0U);
}

TEST(VerifyMovedProgram, ConfirmsARotaryWordThatStandsAlone) {
  const std::string original = "G21 G90 G17\nG0 X1. Y2. Z5.\nB0.\nG1 X4. F90.\nA0. C0.\nX5.\nM30\n";
  for (const RewriteMode mode : {RewriteMode::coordinates, RewriteMode::offset, RewriteMode::g68}) {
    const Moved made = moved(original, mode, 0.58);
    EXPECT_EQ(said(verdict_of(original, made.text, made, mode, 0.58)), "confirmed") << made.text;
    std::string other = made.text;
    other.replace(other.find("\nB0."), 4, "\nG1 B0");
    EXPECT_EQ(said(verdict_of(original, other, made, mode, 0.58)).find("fault"), 0U) << other;
  }
}

TEST(VerifyMovedProgram, ChordsShareTheTimeOfTheirArc) {
  const std::string original =
      "G21 G90 G17\nG0 X1. Y2. Z5.\nG93 G18 G2 X3. Z5. I1. K0. F4.\nG17 G94\nG1 X5. F90.\nM30\n";
  const Moved made = moved(original, RewriteMode::coordinates, 0.58);
  const std::size_t at = made.text.rfind(" F", made.text.find("G94"));
  std::string other = made.text;
  other.replace(at, 3, " F9");
  EXPECT_EQ(said(verdict_of(original, made.text, made, RewriteMode::coordinates, 0.58)), "confirmed");
  EXPECT_NE(other, made.text);
  EXPECT_EQ(said(verdict_of(original, other, made, RewriteMode::coordinates, 0.58)).find("fault"), 0U);
}

/// A program that says nothing of its unit moves in that of the control, which nobody knows here.
TEST(VerifyMovedProgram, UnitPlaneCentreAndG90AreSaidAsInTheOriginal) {
  const Moved made = moved(kPlain, RewriteMode::coordinates, 0.58);
  const auto verdict = [&](const std::string& original, const std::string& without) {
    std::string written = made.text;
    const std::size_t at = written.find(without);
    EXPECT_NE(at, std::string::npos) << without << made.text;
    if (at != std::string::npos) written.erase(at, without.size());
    return said(verdict_of(original, written, made, RewriteMode::coordinates, 0.58));
  };
  EXPECT_EQ(verdict(kPlain, ""), "confirmed");
  EXPECT_NE(verdict(kPlain, "G21").find("moves before a unit"), std::string::npos);
  EXPECT_NE(verdict(kPlain, "G90").find("moves before a G90 or G91"), std::string::npos);
  EXPECT_NE(verdict(kPlain, "G17").find("moves before a plane"), std::string::npos);
  const std::string centred = "G91.1\n" + kPlain;
  EXPECT_NE(verdict(centred, "").find("moves before a G90.1 or G91.1"), std::string::npos);
  // An original that says nothing of them leaves them to the control as well.
  const std::string silent = kPlain.substr(kPlain.find("T1"));
  EXPECT_EQ(verdict(silent, "G21 G90 G17"), "confirmed");
}

TEST(VerifyMovedProgram, RefusesLinesThatAreTakenOutPutInOrExchanged) {
  const Moved made = moved(kPlain, RewriteMode::coordinates, 0.58);
  const auto verdict = [&](const std::string& written) {
    return said(verdict_of(kPlain, written, made, RewriteMode::coordinates, 0.58));
  };
  EXPECT_NE(verdict(made.text + "G0 X1 Y1\n"), "confirmed");
  std::string without = made.text;
  without.replace(without.find("G80\n"), 4, "M5\n");
  EXPECT_NE(verdict(without), "confirmed");
  without = made.text;
  without.replace(without.find("S900 M3\n"), 8, "");
  EXPECT_NE(verdict(without), "confirmed");
  EXPECT_NE(verdict(kPlain), "confirmed");
  EXPECT_EQ(verdict("(another remark)\n" + made.text), "confirmed");
  EXPECT_NE(verdict("").find("fault"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::verify::verify_moved_program_test

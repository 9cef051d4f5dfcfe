// LinuxCNC's own interpreter, rs274, reads the original and the rewritten program; its canonical motions,
// moved by the pose, must agree within 2e-4 of the program's unit (it prints four decimals).

#include "support/rs274.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "lekalo/base/random.hpp"
#include "lekalo/nc/rewrite.hpp"
#include "lekalo/nc/work_offset.hpp"
#include "support/cases.hpp"
#include "support/places.hpp"
#include "support/rs274_random.hpp"
#include "support/rs274_strange.hpp"
#include "support/shared_data.hpp"

namespace lekalo::nc_rs274_test {
namespace {

using namespace nc;

constexpr double kTolerance = 2e-4;
constexpr double kDegree = 0.017453292519943295;

// Shifts and angles of four decimals, so that what rs274 announces is what was written.
const std::vector<rs274::PlaneMotion> kPoses = {
    {12.7, -25.4, 33.25 * kDegree}, {-101.6, 50.8, -118.5 * kDegree}, {0, 0, 90 * kDegree}, {3.175, 6.35, 0}};

const rs274::Oracle& oracle() {
  static const rs274::Oracle instance(lekalo::cases::source_dir() + "/tests/support/rs274.sh");
  return instance;
}

/// What is wrong with the rewritten program; empty when nothing is.
std::string disagreement(const std::string& program, const rs274::PlaneMotion& pose, RewriteMode mode,
                         const rs274::Run& original, std::size_t& motions) {
  RewriteOptions options{.mode = mode};
  if (pose.z != 0) options.z = pose.z;
  const auto result = rewrite_program(program, "program", pose.x, pose.y, pose.theta, options);
  if (!result) return "refused: " + result.error().message;
  rs274::Comparison comparison(pose, kTolerance, mode == RewriteMode::offset);
  std::string what = comparison.difference(original, oracle().run(result->program));
  motions = comparison.motions;
  return what.empty() ? "" : what + "\n" + result->program;
}

void expect_agreement(const std::string& program) {
  const rs274::Run original = oracle().run(program);
  ASSERT_TRUE(original.accepted) << original.errors << program;
  for (const auto& pose : kPoses)
    for (const RewriteMode mode : {RewriteMode::coordinates, RewriteMode::offset}) {
      std::size_t motions = 0;
      EXPECT_EQ(disagreement(program, pose, mode, original, motions), "") << "angle " << pose.theta / kDegree;
      EXPECT_GT(motions, 0U);
    }
}

TEST(NcRs274, TheOracleRefusesWhatItShould) {
  EXPECT_FALSE(oracle().run("G21 F100\nG0 X0 Y0\nG2 X10 Y0 I4 J0\nM2\n").accepted);
  EXPECT_TRUE(oracle().run("G21 F100\nG0 X0 Y0\nG2 X10 Y0 I5 J0\nM2\n").accepted);
}

TEST(NcRs274, TheComparisonNoticesASmallError) {
  const std::string program = "G21 F100\nG0 X0 Y0\nG2 X10 Y0 I5 J0\nG1 X20 Y1\nM2\n";
  const rs274::Run original = oracle().run(program);
  const auto result = rewrite_program(program, "p", 1, 2, 0.5, {});
  ASSERT_TRUE(result) << result.error().message;
  const rs274::Run written = oracle().run(result->program);
  EXPECT_EQ(rs274::Comparison({1, 2, 0.5}, kTolerance, false).difference(original, written), "");
  EXPECT_NE(rs274::Comparison({1.0003, 2, 0.5}, kTolerance, false).difference(original, written), "");
  EXPECT_NE(rs274::Comparison({1, 2, 0.5001}, kTolerance, false).difference(original, written), "");
  EXPECT_NE(rs274::Comparison({1, 2, 0.5}, kTolerance, false).difference(original, original), "");
}

TEST(NcRs274, LinesArcsAndHelicesAgree) {
  expect_agreement(R"(%
(lines, arcs both ways, both formats)
N10 G21 G90 G17 G40 G49 G80 G94
N20 G54 T1 M6
N30 S1000 M3 F200
G0 Z5.
N40 g0 x10.5 y0
X20
y5.25
G1 Z-1. F100
G2 X30. Y15.25 I10. J0. ; quarter
G3 X40 Y25.25 R10.
G2 I5.
G3 X40. Y25.25 I-3 J4 P2 Z-5
G2 X44 Y25.25 R2.
G3 X44.5 Y26 R-3
G2 X54.5 Y26.001 R250
G3 X54.5 Y26.5 R-40
G3 X50 Y20 R10 Z-7 P2
G90.1 G2 X60 Y20 I55 J20
G91.1
G64 P0.01
G1 X0 Y0
G61 G1 X1 Z5
G0 Z10 M5
M30
%
)");
}

TEST(NcRs274, ArcsPassExactlyWhenLinuxcncTakesThem) {
  for (const char* arc : {"G21 F9\nG0 X0 Y0\nG2 X20.028 I10", "G21 F9\nG0 X0 Y0\nG2 X20.029 I10",
                          "G21 F9\nG0 X0 Y0\nG2 X200.1 I100", "G21 F9\nG0 X0 Y0\nG2 X200.11 I100",
                          "G20 F9\nG0 X0 Y0\nG2 X2.0028 I1", "G20 F9\nG0 X0 Y0\nG2 X2.0029 I1",
                          "G21 F9\nG0 X0 Y0\nG2 X10.0025 R5", "G21 F9\nG0 X0 Y0\nG2 X10.0026 R5",
                          "G20 F9\nG0 X0 Y0\nG2 X10.0000999 R5", "G20 F9\nG0 X0 Y0\nG2 X10.0001001 R5",
                          "G21 F9\nG0 X0 Y0\nG2 I.0012", "G21 F9\nG0 X0 Y0\nG2 I.0013"}) {
    const std::string program = std::string(arc) + "\nM2\n";
    const auto result = rewrite_program(program, "p", 12.7, -25.4, 33.25 * kDegree, {});
    EXPECT_EQ(oracle().run(program).accepted, result.has_value()) << program;
    if (!result) continue;
    EXPECT_TRUE(oracle().run(result->program).accepted) << result->program;
  }
}

TEST(NcRs274, IncrementalMovesAndCyclesAgree) {
  expect_agreement(R"(G21 G90 G17 G40 G80 G94 F150
G0 X5 Y5 Z10
G91 G1 X1.1
X1.1 Y.3
Y-2
X1 Z-1
G2 X2 R1
G3 X2. I1.
G3 Y-3 J-1.5 Z-.5
G90 G0 Z10
G98 G81 X11.25 Y1. Z-3. R1.
X2.
Y7
G99 G82 X3 Y3 Z-2 R1 P.1
G83 X4 Y4 Z-6 R1 Q1.5
G73 X5 Y5 Z-6 R1 Q1.5
G85 X6 Y6 Z-2 R1
G86 X7 Y6 Z-2 R1 P.1 S1000 M3
G89 X8 Y6 Z-2 R1 P.1
G80 G0 Z10
G91 G81 X2.3 Y1.1 Z-1 R-2 L4
X-1 L2
Y3
G80
G90 G0 X0 Y0
M2
)");
}

TEST(NcRs274, InchesAndAChangeOfUnitAgree) {
  expect_agreement(R"(G20 G90 G17 F10
G0 Z1
G0 X1 Y1
G1 X1.5
G2 X2.5 Y2 I1 J0
G3 X3.5 Y3 R1
G2 X4.5 Y3 R.5
G91 G1 X.1
X.1
G3 I.25
G90 G81 X1 Y3 Z-.1 R.1
Y4
G80
G21 G0 X25.4
Y50.8
G1 X30
G2 X40 Y50.8 R5
G20 G1 X1 Y1
M2
)");
}

TEST(NcRs274, CutterCompensationAgrees) {
  expect_agreement(R"(G21 G90 G17 G40 F100
T1 M6
G0 X-20 Y-20 Z5
G1 Z-1
G41 D1 G1 X0 Y-10
Y30
G2 X10 Y40 I10
G1 X40
Y0
X-10
G40 G1 X-20 Y-20
G0 Z5
G42 D1 G1 X0 Y-10
X50
Y30
G3 X40 Y40 R10
G1 X0
G40 X-20
M2
)");
}

TEST(NcRs274, ArcsOfTheOtherPlanesAgreeAsChords) {
  expect_agreement(R"(G21 G90 G17 F100
G0 X1 Y2 Z5
G18 G2 X3 Z4 I1 K-.5
G3 X5 Z4 R3
X5 Z4 I2 K1 P2
G17 G2 X9 Y2 I2
X13 I2
G19 G3 Y4 Z6 J1 K1
G2 Y6 Z3 R-4 X14
G91 G18 G3 X2 Z1 I1 K.5
G17 G1 X1 Y1
G90 G19 G2 J1 K2
G17 G1 X0 Y0
G20 G1 X1 Y1 Z1
G18 G2 X2 Z1 I.5
G17 G1 X0 F20
M2
)");
}

TEST(NcRs274, SubprogramsAndComputedNumbersAgree) {
  expect_agreement(R"(o100 sub
G1 X[#<_width> + 1] Y-#<_width>
G3 X[#<_width> + 3] Y-#<_width> I1
o100 endsub
G21 G90 G17 F100
#<_width> = 4.5
#7 = [#<_width> * 2 + SIN[30] - 7 / 3]
G0 X0 Y0 Z5
G1 X#7 Z-[SQRT[2]]
o100 call
#<_width> = [#7 / 3]
o100 call
G0 Z[5 + ATAN[1]/[1]]
G1 X[[#7 - 1] * ABS[-2]] Y[FIX[3.7] + FUP[0.2] + 7 MOD 4]
M2
)");
  expect_agreement(R"(G21 G90 G17 F100
G0 X0 Y0 Z5
M98 P200 L3
G90 G1 X1 Y1
M2
O200
G91 G1 X2 Y-.5
M99
)");
}

TEST(NcRs274, WaysAlongZToPointsOfTheMachineAgree) {
  expect_agreement(R"(G21 G90 G17 F100
G0 X4 Y5 Z5
G1 Z-1
G1 X9
G0 Z5
G53 G0 Z0
G0 X1 Y1
G28 Z6
G91 G28 Z0
G90
G0 X3 Y4
G30 Z5
G95 F.1
G97 S900 M3
G1 X6
G94 F100
M19 R90
G4 P.1
G0 Z9 A0
M2
)");
}

/// Programs of solids, shifted along Z too: cycles, steps, helices, arcs of all planes, tool lengths.
TEST(NcRs274, ProgramsShiftedAlongZAgree) {
  for (const char* const program : {R"(G21 G90 G17 G40 G80 G94 F150
T1 M6
G0 X5 Y5
G43 H1 Z10
G91 G1 X1.1 Z-.5
G2 X2 R1 Z-.25
G90 G1 Z-2.125
G3 X12.1 Y5 I2 Z-4
G0 Z10
G98 G81 X11.25 Y1. Z-3. R1.
X2.
Y7 Z-4
G99 G82 X3 Y3 Z-2 R1 P.1
G83 X4 Y4 Z-6 R1 Q1.5
G80 G0 Z10
G91 G81 X2.3 Y1.1 Z-1 R-2 L4
X-1 L2
G80
G90 G0 Z20
M2
)",
                                    R"(G20 G90 G17 F10
G0 X1 Y1
G0 Z1
G1 Z-.125
G18 G2 X2 Z-.125 I.5
G17 G1 X1 Y2
G19 G3 Y3 Z-.125 J.5
G17 G0 Z1
G21 G1 Z20 F100
X30 Y31
M2
)"})
    for (rs274::PlaneMotion pose : {rs274::PlaneMotion{12.7, -25.4, 33.25 * kDegree, 6.35},
                                    rs274::PlaneMotion{3.175, 6.35, 0, -101.6}}) {
      const rs274::Run original = oracle().run(program);
      ASSERT_TRUE(original.accepted) << original.errors;
      for (const RewriteMode mode : {RewriteMode::coordinates, RewriteMode::offset}) {
        std::size_t motions = 0;
        EXPECT_EQ(disagreement(program, pose, mode, original, motions), "")
            << "angle " << pose.theta / kDegree;
        EXPECT_GT(motions, 0U);
        pose.z += 0.0254;
        EXPECT_EQ(disagreement(program, pose, mode, original, motions), "");
      }
    }
}

bool goes_home(const std::string& program) {
  return std::ranges::any_of(std::array{"G28", "g28", "G30", "g30", "G53", "g53"},
                             [&](const char* word) { return program.find(word) != std::string::npos; });
}

/// The lines of a work offset and the original program after them, and the rewritten program: the interpreter
/// has the tool at the same points of the machine, which are those of the moved original.
TEST(NcRs274, TheLinesOfAWorkOffsetMoveProgramsAsTheRewriterDoes) {
  Random random(lekalo::cases::seed(), 4400);
  const std::size_t count = std::min<std::size_t>(lekalo::cases::case_count(5), 500);
  std::size_t compared = 0;
  // Most random programs go on after a cycle without a Z, which no program for a solid may do.
  for (std::size_t k = 1; k <= 20 * count && compared < count; ++k) {
    const std::string program = rs274::RandomProgram(lekalo::cases::seed(), 3 * k).write();
    const double half = random.uniform(-1.5, 1.5);
    const OffsetForm form{.length_decimals = 4};
    const OffsetTurn turn = written_turns({std::cos(half), 0, 0, std::sin(half)}, form).front();
    std::array<long long, 3> shift{};
    for (long long& each : shift) each = std::llround(random.uniform(-5e6, 5e6));
    const rs274::PlaneMotion pose{static_cast<double>(shift[0]) / 1e4, static_cast<double>(shift[1]) / 1e4,
                                  2 * std::atan2(turn.quaternion[3], turn.quaternion[0]),
                                  static_cast<double>(shift[2]) / 1e4};
    RewriteOptions options;
    options.z = pose.z;
    const auto rewritten = rewrite_program(program, "p", pose.x, pose.y, pose.theta, options);
    if (!rewritten) continue;
    ++compared;
    const rs274::Run original = oracle().run(program);
    ASSERT_TRUE(original.accepted) << original.errors;
    const std::string framed = offset_lines(turn, shift, form, {"part.stl"}) + program;
    for (const auto& [moved, announced] : {std::pair{framed, true}, {rewritten->program, false}}) {
      rs274::Comparison comparison(pose, kTolerance, announced, goes_home(program));
      EXPECT_EQ(comparison.difference(original, oracle().run(moved)), "") << moved;
      EXPECT_GT(comparison.motions, 0U);
    }
  }
  EXPECT_EQ(compared, count);
}

/// Programs as posts write them (the shared data): where rs274 knows all words, it sees the moved original.
TEST(NcRs274, ProgramsOfPostsAgree) {
  if (lekalo::cases::shared_data().empty()) GTEST_SKIP() << "no shared data";
  std::size_t compared = 0;
  for (const char* folder : {"fusion", "variants"})
    for (const auto& entry :
         std::filesystem::directory_iterator(lekalo::cases::shared_data() + "/nc/" + folder)) {
      const std::string program = rs274::read_file(entry.path());
      const auto& pose = kPoses[compared % 2];
      const auto result = rewrite_program(program, "p", pose.x, pose.y, pose.theta, {});
      const rs274::Run original = oracle().run(program);
      if (!result || !original.accepted) continue;
      ++compared;
      rs274::Comparison comparison(pose, kTolerance, false, goes_home(program));
      EXPECT_EQ(comparison.difference(original, oracle().run(result->program)), "") << entry.path();
      EXPECT_GT(comparison.motions, 0U) << entry.path();
    }
  EXPECT_GE(compared, 90U);
}

/// Programs with words that few readers agree about: what is rewritten is the moved original, and what rs274
/// refuses is refused, or refused by it in the result too.
TEST(NcRs274, StrangeProgramsAgreeOrAreRefused) {
  const std::size_t count = std::min<std::size_t>(lekalo::cases::case_count(50), 10000);
  std::size_t rewritten = 0;
  std::array<std::size_t, rs274::kFamilies.size()> drawn{}, taken{};
  for (std::size_t k = 0; k < count; ++k) {
    rs274::StrangeProgram strange(lekalo::cases::seed(), 99000 + k);
    const std::string program = strange.write();
    const auto& pose = kPoses[k % kPoses.size()];
    const RewriteMode mode = k % 3 == 0 ? RewriteMode::offset : RewriteMode::coordinates;
    const auto result = rewrite_program(program, "p", pose.x, pose.y, pose.theta,
                                        {.mode = mode, .control = lekalo::words::Control::linuxcnc});
    for (const std::size_t family : strange.families()) ++drawn[family], taken[family] += result ? 1 : 0;
    if (!result) continue;
    ++rewritten;
    const rs274::Run original = oracle().run(program), written = oracle().run(result->program);
    rs274::Comparison comparison(pose, kTolerance, mode == RewriteMode::offset, goes_home(program));
    EXPECT_EQ(comparison.difference(original, written), "")
        << "seed " << lekalo::cases::seed() << ", case " << k << "\n"
        << program << "---\n"
        << result->program << written.errors;
  }
  EXPECT_GE(rewritten, count / 4);
  for (std::size_t family = 0; family < rs274::kFamilies.size(); ++family)
    fmt::print("{:14} {:5} drawn, {:5} rewritten\n", rs274::kFamilies[family], drawn[family], taken[family]);
}

TEST(NcRs274, AModalWordMissingAtTheTopIsSetByTheOffsetLine) {
  // The program leaves unit and work offset to the control.
  expect_agreement("G0 X1. Y2.\nG1 X30. F100\nM2\n");
  expect_agreement("G0 Z5.\nG20\nG54 G0 X1. Y2.\nG1 X3. F10\nM2\n");
}

TEST(NcRs274, RandomProgramsAgree) {
  const std::size_t count = std::min<std::size_t>(lekalo::cases::case_count(40), 1500);
  std::size_t compared = 0;
  for (std::size_t k = 1; k <= count; ++k) {
    const std::string program = rs274::RandomProgram(lekalo::cases::seed(), 2 * k).write();
    SCOPED_TRACE(testing::Message() << "seed " << lekalo::cases::seed() << ", case " << k << "\n" << program);
    const rs274::Run original = oracle().run(program);
    const auto& pose = kPoses[k % kPoses.size()];
    const RewriteMode mode = k % 3 == 0 ? RewriteMode::offset : RewriteMode::coordinates;
    const auto result = rewrite_program(program, "program", pose.x, pose.y, pose.theta, {.mode = mode});
    if (!result) continue;  // the share of these is bounded in tests/property/nc_rewrite_test.cpp
    ++compared;
    rs274::Comparison comparison(pose, kTolerance, mode == RewriteMode::offset);
    const rs274::Run written = oracle().run(result->program);
    ASSERT_TRUE(original.accepted) << original.errors;
    ASSERT_EQ(comparison.difference(original, written), "") << written.errors << result->program;
  }
  EXPECT_GE(compared, count * 9 / 10);
}

/// LinuxCNC's own samples, files nobody here wrote: each is rewritten and agrees, or is refused with line and
/// reason. The table of the verdicts is part of the documentation; LEKALO_WRITE_NC_SAMPLES=1 writes it anew.
TEST(NcRs274, SamplesOfLinuxcncAreRewrittenOrRefusedAsTheTableSays) {
  const std::filesystem::path folder = oracle().root() / "usr/share/linuxcnc/ncfiles";
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".ngc") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ASSERT_GT(files.size(), 100U);

  std::string table;
  std::size_t rewritten = 0, refused = 0;
  for (const auto& file : files) {
    const std::string name = file.lexically_relative(folder).string(), program = rs274::read_file(file);
    SCOPED_TRACE(name);
    const rs274::Run original = oracle().run(program);
    std::string verdict;
    const auto result = rewrite_program(program, name, 12.7, -25.4, 33.25 * kDegree, {});
    if (result) {
      ++rewritten;
      for (const auto& pose : kPoses)
        for (const RewriteMode mode : {RewriteMode::coordinates, RewriteMode::offset}) {
          // A program of another work offset can only be turned coordinate by coordinate.
          if (mode == RewriteMode::offset &&
              !rewrite_program(program, name, pose.x, pose.y, pose.theta, {.mode = mode}))
            continue;
          std::size_t motions = 0;
          EXPECT_EQ(disagreement(program, pose, mode, original, motions), "")
              << "angle " << pose.theta / kDegree;
          verdict = fmt::format("rewritten, {} canonical motions agree in both modes", motions);
        }
    } else {
      ++refused;
      const std::string& message = result.error().message;
      ASSERT_EQ(message.rfind(name + ":", 0), 0U) << message;
      const std::string place = message.substr(name.size() + 1);
      EXPECT_GT(std::atoi(place.c_str()), 0) << message;
      verdict = "refused, line " + place;
    }
    std::string escaped;
    for (const char c : verdict) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
    table += fmt::format("| {} | {} | {} |\n", name, original.accepted ? "accepts" : "rejects", escaped);
  }

  const std::filesystem::path page = lekalo::cases::source_dir() + "/docs/nc-samples.md";
  const std::string head =
      "# LinuxCNC's sample programs\n\n"
      "What `lekalo` makes of every `.ngc` file of the Debian package linuxcnc-uspace 2.9.0~pre1 "
      "(`usr/share/linuxcnc/ncfiles`), programs that\nnobody here wrote: mill, lathe and plasma programs, "
      "probing "
      "macros and subroutine libraries. A file is rewritten, and then LinuxCNC's\ninterpreter `rs274` gives "
      "the same "
      "canonical motions, moved by the pose, within 2e-4 of its unit (modes `coordinates` and `offset`, "
      "four\nposes), "
      "or it is refused with line and reason. The second column is what `rs274` alone makes of the file as "
      "it "
      "stands:\nmany need parameters, subroutines, tools or pins of a configured machine, or are subroutines "
      "themselves.\n\n"
      "This page is written and checked by `tests/differential/nc_rs274_test.cpp` "
      "(`LEKALO_WRITE_NC_SAMPLES=1` writes "
      "it anew).\n\n";
  const std::string expected =
      head + fmt::format("{} files: {} rewritten, {} refused.\n\n", files.size(), rewritten, refused) +
      "| file | rs274 | lekalo |\n|---|---|---|\n" + table;
  if (std::getenv("LEKALO_WRITE_NC_SAMPLES") != nullptr) std::ofstream(page, std::ios::binary) << expected;
  EXPECT_EQ(rs274::read_file(page), expected) << "the table of docs/nc-samples.md is out of date";
}

}  // namespace
}  // namespace lekalo::nc_rs274_test

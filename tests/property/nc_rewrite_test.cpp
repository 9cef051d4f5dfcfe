// Random programs and poses: what a reader that shares no code with the rewriter makes of the result, against
// the exact motion.

#include "lekalo/nc/rewrite.hpp"

#include <gtest/gtest.h>

#include <cctype>

#include "lekalo/base/random.hpp"
#include "support/cases.hpp"
#include "support/rs274_random.hpp"
#include "support/rs274_reader.hpp"

namespace lekalo::nc_rewrite_test {
namespace {

using lekalo::Random;
using namespace nc;

struct Pose {
  double x, y, theta;
  [[nodiscard]] rs274::Motion motion() const { return rs274::Motion::turned(x, y, theta); }
};

Pose random_pose(Random& random) {
  constexpr double kQuarter = 1.5707963267948966;
  switch (random.below(6)) {
    case 0:
      return {random.uniform(-10, 10), random.uniform(-10, 10), 0};
    case 1:
      return {random.uniform(-10, 10), 0, kQuarter * static_cast<double>(random.below(4))};
    case 2:
      return {0, 0, random.uniform(-1e-4, 1e-4)};
    default:
      return {random.uniform(-500, 500), random.uniform(-500, 500), random.uniform(-3.2, 3.2)};
  }
}

/// Everything but X Y I J words: digits, signs and letters, blanks left out (supplied words bring their own).
std::string rest_of(const std::string& text) {
  std::string rest;
  bool comment = false, semicolon = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '(' && !semicolon) comment = true;
    if (c == ';' && !comment) semicolon = true;
    const char upper = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (!comment && !semicolon && (upper == 'X' || upper == 'Y' || upper == 'I' || upper == 'J')) {
      while (k + 1 < text.size() && std::string("+-.0123456789 ").find(text[k + 1]) != std::string::npos) ++k;
      continue;
    }
    if (c == ')') comment = false;
    if (c == '\n') semicolon = false;
    if (comment || semicolon || c != ' ') rest += c;
  }
  return rest;
}

class NcRewrite : public testing::Test {
 protected:
  template <class Check>
  void for_each_case(std::size_t standard, Check check) {
    const std::size_t count = lekalo::cases::case_count(standard);
    std::size_t rewritten = 0;
    for (std::size_t k = 1; k <= count && !HasFatalFailure(); ++k) {
      const std::string program = rs274::RandomProgram(lekalo::cases::seed(), 2 * k).write();
      Random random(lekalo::cases::seed(), 2 * k + 1);
      SCOPED_TRACE(testing::Message() << "seed " << lekalo::cases::seed() << ", case " << k << "\n"
                                      << program);
      if (check(program, random)) ++rewritten;
    }
    EXPECT_GE(rewritten, count * 9 / 10) << "of " << count << ": the generator should stay on the white list";
  }
};

const rs274::Real kReading = 1e-10L;  // what the readers' own arithmetic can add, mm

TEST_F(NcRewrite, MovesEveryPointOfThePathByThePoseWithinTheBound) {
  for_each_case(1500, [](const std::string& program, Random& random) {
    const Pose pose = random_pose(random);
    const auto result = rewrite_program(program, "p", pose.x, pose.y, pose.theta, {});
    if (!result) return false;
    const rs274::Real off =
        rs274::deviation(rs274::Reader().read(program), rs274::Reader().read(result->program), pose.motion());
    EXPECT_GE(off, 0) << result->program;
    EXPECT_LE(off, result->rounding_mm + kReading) << result->program;
    EXPECT_LE(result->rounding_mm, 1e-2) << result->program;
    return !testing::Test::HasFailure();
  });
}

TEST_F(NcRewrite, LeavesEverythingButThePlaneWordsAlone) {
  for_each_case(500, [](const std::string& program, Random& random) {
    const Pose pose = random_pose(random);
    const auto result = rewrite_program(program, "p", pose.x, pose.y, pose.theta, {});
    if (!result) return false;
    EXPECT_EQ(rest_of(result->program), rest_of(program));
    EXPECT_EQ(result->program.find("-0.00000 "), std::string::npos);
    return !testing::Test::HasFailure();
  });
}

TEST_F(NcRewrite, ChangesNoByteUnderTheIdentity) {
  for_each_case(500, [](const std::string& program, Random&) {
    const auto result = rewrite_program(program, "p", 0, 0, 0, {});
    if (!result) return false;
    EXPECT_EQ(result->program, program);
    EXPECT_EQ(result->rounding_mm, 0);
    return !testing::Test::HasFailure();
  });
}

TEST_F(NcRewrite, ComesBackUnderTheInversePose) {
  for_each_case(500, [](const std::string& program, Random& random) {
    const Pose pose = random_pose(random);
    const auto there = rewrite_program(program, "p", pose.x, pose.y, pose.theta, {});
    if (!there) return false;
    const rs274::Motion m = pose.motion();
    const auto back_x = static_cast<double>(-(m.cosine * pose.x + m.sine * pose.y));
    const auto back_y = static_cast<double>(m.sine * pose.x - m.cosine * pose.y);
    const auto back = rewrite_program(there->program, "p", back_x, back_y, -pose.theta, {});
    EXPECT_TRUE(back.has_value()) << (back ? "" : back.error().message) << "\n" << there->program;
    if (!back) return false;
    const rs274::Real off =
        rs274::deviation(rs274::Reader().read(program), rs274::Reader().read(back->program), {});
    EXPECT_GE(off, 0);
    EXPECT_LE(off, there->rounding_mm + back->rounding_mm + 1e-9L);
    return !testing::Test::HasFailure();
  });
}

TEST_F(NcRewrite, WritesTheFrameOfModeOffsetWithinTheBound) {
  for_each_case(500, [](const std::string& program, Random& random) {
    const Pose pose = random_pose(random);
    const auto result =
        rewrite_program(program, "p", pose.x, pose.y, pose.theta, {.mode = RewriteMode::offset});
    if (!result) return false;
    const auto reader =
        rs274::Reader(rs274::Motion::turned(random.uniform(-50, 50), 3, random.uniform(-1, 1)));
    const rs274::Real off = rs274::deviation(rs274::Reader().read(program),
                                             rs274::Reader(reader).read(result->program), pose.motion());
    EXPECT_GE(off, 0) << result->program;
    EXPECT_LE(off, result->rounding_mm + kReading) << result->program;
    EXPECT_LE(result->rounding_mm, 2e-4);
    return !testing::Test::HasFailure();
  });
}

TEST_F(NcRewrite, WritesTheFrameOfModeG68WithinTheBound) {
  for_each_case(500, [](const std::string& program, Random& random) {
    const Pose pose = random_pose(random);
    const auto result = rewrite_program(program, "p", pose.x, pose.y, pose.theta,
                                        {.mode = RewriteMode::g68,
                                         .scan_frame = ScanFrame::wcs,
                                         .g68_angle_decimals = static_cast<int>(random.below(10))});
    if (!result) return false;
    const rs274::Real off =
        rs274::deviation(rs274::Reader().read(program), rs274::Reader().read(result->program), pose.motion());
    EXPECT_GE(off, 0) << result->program;
    EXPECT_LE(off, result->rounding_mm + kReading) << result->program;
    return !testing::Test::HasFailure();
  });
}

}  // namespace
}  // namespace lekalo::nc_rewrite_test

// Laws of verify_locate that hold to the last of its thirty digits, because its numbers are exact.

#include <gtest/gtest.h>

#include "support/verify_cases.hpp"

namespace lekalo::verify_laws_test {
namespace {

using namespace verify_cases;
using verify::Verdict;
using verify_cases::Random;

/// Coordinates with three decimals, as texts times 10^exponent.
std::string points_text(const std::vector<std::array<long, 2>>& thousandths, int exponent) {
  std::string text;
  for (const auto& p : thousandths) {
    text += fmt::format("{}[{}e{}, {}e{}]", text.empty() ? "" : ", ", p[0], exponent - 3, p[1], exponent - 3);
  }
  return "[" + text + "]";
}

struct Sample {
  std::vector<std::array<long, 2>> blank, part;  ///< thousandths
  long x = 0, y = 0;                             ///< thousandths
  double theta = 0;
};

Sample sample(Random& random) {
  Sample s;
  const auto around = [&random](long a, long b) {
    std::vector<std::array<long, 2>> points;
    const std::size_t corners = 3 + random.below(9);
    for (std::size_t i = 0; i < corners; ++i) {
      const double t = 2 * std::numbers::pi * (static_cast<double>(i) + random.uniform(0, 0.4)) /
                       static_cast<double>(corners);
      points.push_back({std::lround(static_cast<double>(a) * std::cos(t)),
                        std::lround(static_cast<double>(b) * std::sin(t))});
    }
    return points;
  };
  s.blank = around(100'000, 70'000);
  s.part = around(60'000, 40'000);
  s.x = std::lround(random.uniform(-30'000, 30'000));
  s.y = std::lround(random.uniform(-30'000, 30'000));
  s.theta = random.uniform(-4, 4);
  return s;
}

Files files_of(const Sample& s, int exponent = 0) {
  Files f = write({"", {{0, 0}, {1, 0}, {0, 1}}, {{0, 0}, {1, 0}, {0, 1}}, 0}, Solution{});
  f.blank = points_text(s.blank, exponent);
  f.part = points_text(s.part, exponent);
  f["inputs"] = inputs_json(s.part.size(), s.blank.size());
  set_pose(f, 0, 0, s.theta);
  f["x"] = fmt::format("{}e{}", s.x, exponent - 3);
  f["y"] = fmt::format("{}e{}", s.y, exponent - 3);
  f["clearance"] = "-1e300";
  f["shortfall"] = "1e300";
  f["upper_bound"] = f["gap"] = "null";
  f["status"] = "\"unproved\"";
  f["contacts"] = "[]";
  f.inline_certificate = f.give_certificate = false;
  return f;
}

verify::LocateReport report_of(const Files& files) {
  auto report = check(files);
  EXPECT_TRUE(report) << report.error().message;
  return report ? *report : verify::LocateReport{};
}

TEST(VerifyLaws, TheWrittenClearanceMayReachTheExactOneAndNoFurther) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    Files f = files_of(sample(random));
    const verify::LocateReport exact = report_of(f);
    const auto verdict_at = [&f](const std::string& clearance) {
      f["clearance"] = clearance;
      f["shortfall"] = clearance[0] == '-' ? clearance.substr(1) : "0";
      return report_of(f).verdict;
    };
    EXPECT_EQ(verdict_at(exact.clearance_low), Verdict::unproved) << i;
    EXPECT_EQ(verdict_at(exact.clearance_high), Verdict::refuted) << i;
  }
}

TEST(VerifyLaws, PowersOfTenScaleTheClearanceExactly) {
  Random random(2);
  for (int i = 0; i < 60; ++i) {
    const Sample s = sample(random);
    const verify::LocateReport exact = report_of(files_of(s));
    for (const int exponent : {-200, -9, 9, 200}) {
      Files f = files_of(s, exponent);
      const auto verdict_at = [&](const std::string& digits) {
        f["clearance"] = fmt::format("{}e{}", digits, exponent);
        f["shortfall"] = digits[0] == '-' ? f["clearance"].substr(1) : "0";
        return report_of(f).verdict;
      };
      if (exact.clearance_low.find('e') != std::string::npos) continue;
      EXPECT_EQ(verdict_at(exact.clearance_low), Verdict::unproved) << i << " " << exponent;
      EXPECT_EQ(verdict_at(exact.clearance_high), Verdict::refuted) << i << " " << exponent;
    }
  }
}

TEST(VerifyLaws, ABlankMovedWithThePoseKeepsTheClearance) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    Sample s = sample(random);
    const verify::LocateReport before = report_of(files_of(s));
    const long dx = std::lround(random.uniform(-1e12, 1e12)), dy = std::lround(random.uniform(-1e12, 1e12));
    for (auto& p : s.blank) p[0] += dx, p[1] += dy;
    s.x += dx;
    s.y += dy;
    const verify::LocateReport after = report_of(files_of(s));
    EXPECT_EQ(before.clearance_low, after.clearance_low) << i;
    EXPECT_EQ(before.clearance_high, after.clearance_high) << i;
  }
}

TEST(VerifyLaws, FirstPointDirectionAndRepeatedPointsDoNotMatter) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    Sample s = sample(random);
    const verify::LocateReport before = report_of(files_of(s));
    for (auto* points : {&s.blank, &s.part}) {
      std::rotate(points->begin(), points->begin() + static_cast<long>(random.below(points->size())),
                  points->end());
      if (random.below(2) == 1) std::reverse(points->begin(), points->end());
      points->push_back(points->front());
    }
    Files f = files_of(s);
    f["inputs"] = inputs_json(s.part.size(), s.blank.size(), fmt::format("[{}]", s.part.size() - 1),
                              fmt::format("[{}]", s.blank.size() - 1));
    const verify::LocateReport after = report_of(f);
    EXPECT_EQ(before.clearance_low, after.clearance_low) << i;
    EXPECT_NE(after.verdict, Verdict::refuted) << i;
  }
}

TEST(VerifyLaws, AMirroredWorldHasTheSameClearance) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    Sample s = sample(random);
    const verify::LocateReport before = report_of(files_of(s));
    for (auto* points : {&s.blank, &s.part}) {
      for (auto& p : *points) p[1] = -p[1];
    }
    s.y = -s.y;
    s.theta = -s.theta;
    EXPECT_EQ(before.clearance_low, report_of(files_of(s)).clearance_low) << i;
  }
}

TEST(VerifyLaws, ADentNeverGivesAndTakesAtMostItsDepth) {
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    Sample s = sample(random);
    const verify::LocateReport before = report_of(files_of(s));
    const std::size_t at = random.below(s.blank.size());
    const auto a = s.blank[at], b = s.blank[(at + 1) % s.blank.size()];
    // Halfway, and up to 2 thousandths further in (the outline runs counter-clockwise).
    const double ex = static_cast<double>(b[0] - a[0]), ey = static_cast<double>(b[1] - a[1]),
                 length = std::hypot(ex, ey);
    s.blank.insert(s.blank.begin() + static_cast<long>(at) + 1,
                   {std::lround(static_cast<double>(a[0]) + ex / 2 - 2 * ey / length),
                    std::lround(static_cast<double>(a[1]) + ey / 2 + 2 * ex / length)});
    const verify::LocateReport after = report_of(files_of(s));
    EXPECT_LE(std::stod(after.clearance_high), std::stod(before.clearance_high)) << i;
    EXPECT_GE(std::stod(after.clearance_low), std::stod(before.clearance_low) - 0.0032) << i;
  }
}

}  // namespace
}  // namespace lekalo::verify_laws_test

// verify against two opinions that share nothing with it: tests/support/recheck.py (80 decimal digits), and
// the definition computed in long double.

#include <gtest/gtest.h>
#include <mpfr.h>

#include <cstdio>
#include <fstream>

#include "support/json.hpp"
#include "support/places.hpp"
#include "support/verify_cases.hpp"

namespace lekalo::verify_recheck_test {
namespace {

using namespace verify_cases;
using verify_cases::Random;
using verify::Verdict;

std::string temporary(const std::string& name, const std::string& text) {
  const std::string path = testing::TempDir() + "verify_recheck_" + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

cases::Json recheck(const Files& files) {
  const std::string command =
      fmt::format("python3 {}/tests/support/recheck.py {} {} {}", cases::source_dir(),
                  temporary("result.json", files.result()), temporary(files.part_name, files.part),
                  temporary(files.blank_name, files.blank));
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  pclose(pipe);
  return text.empty() ? cases::Json() : cases::Json::parse(text);
}

/// |a - b| / max(|a|, 1e-300), in 200 bits.
double relative_difference(const std::string& a, const std::string& b) {
  mpfr_t x, y;
  mpfr_inits2(200, x, y, static_cast<mpfr_ptr>(nullptr));
  mpfr_set_str(x, a.c_str(), 10, MPFR_RNDN);
  mpfr_set_str(y, b.c_str(), 10, MPFR_RNDN);
  mpfr_reldiff(y, x, y, MPFR_RNDN);
  const double difference = mpfr_get_d(y, MPFR_RNDN);
  mpfr_clears(x, y, static_cast<mpfr_ptr>(nullptr));
  return std::abs(difference);
}

void compare_opinions(const Files& files, const std::string& what) {
  const auto report = check(files);
  ASSERT_TRUE(report) << what << ": " << report.error().message;
  const cases::Json other = recheck(files);
  ASSERT_TRUE(other.is_object()) << what << ": recheck.py said nothing; is python3 there?";
  EXPECT_EQ(report->verdict == Verdict::refuted, !other["wrong"].empty())
      << what << "\nverify: " << findings(report) << "recheck.py: " << other["wrong"].dump();
  EXPECT_LT(relative_difference(report->clearance_low, other["clearance"]), 1e-28) << what;
  EXPECT_LT(relative_difference(report->clearance_high, other["clearance"]), 1e-28) << what;
  if (other["bound"] != "None" && other["bound"] != "Infinity") {
    EXPECT_LT(relative_difference(report->bound_high, other["bound"]), 1e-28) << what;
  }
}

double rounded_to(double value, double grid) { return std::round(value / grid) * grid; }

/// Corners of an ellipse in order of angle, turned, scaled and moved; on a grid so coarse that every decimal
/// is short.
Points random_polygon(Random& random, std::size_t corners, double width, double height, double turn,
                      double offset, double grid) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < corners; ++i) angles.push_back(random.uniform(0, 2 * std::numbers::pi));
  std::sort(angles.begin(), angles.end());
  Points points;
  for (const double a : angles) {
    const double x = width * std::cos(a), y = height * std::sin(a), c = std::cos(turn), s = std::sin(turn);
    points.push_back({rounded_to(c * x - s * y + offset, grid), rounded_to(s * x + c * y - offset, grid)});
  }
  // Rounding to the grid may dent: keep strictly convex corners only.
  for (bool changed = true; changed && points.size() > 3;) {
    changed = false;
    for (std::size_t i = 0; i < points.size() && points.size() > 3; ++i) {
      const auto &a = points[(i + points.size() - 1) % points.size()], &b = points[i],
                 &c = points[(i + 1) % points.size()];
      const Real turn_here =
          (Real(b[0]) - a[0]) * (Real(c[1]) - b[1]) - (Real(b[1]) - a[1]) * (Real(c[0]) - b[0]);
      if (turn_here > 0) continue;
      points.erase(points.begin() + static_cast<long>(i));
      changed = true;
    }
  }
  return points;
}

struct Family {
  const char* name;
  double size, flatness, offset, grid;
};
// The grids are powers of two: doubles, decimals and long doubles of these numbers are the same numbers.
constexpr Family kFamilies[]{
    {"plain", 100, 0.7, 0, 0x1p-20},
    {"sliver", 100, 1e-4, 0, 0x1p-26},
    {"far from the origin", 100, 0.7, 1e9, 0x1p-20},
    {"tiny", 1e-9, 0.7, 0, 0x1p-66},
    {"huge", 1e9, 0.7, 0, 0x1p-10},
};

Case random_case(Random& random, const Family& family) {
  const double turn = random.uniform(0, 6);
  Case c;
  c.name = family.name;
  do {
    c.blank = random_polygon(random, 3 + random.below(8), family.size, family.size * family.flatness, turn,
                             family.offset, family.grid);
  } while (signed_area(c.blank) <= 0);
  do {
    c.part = random_polygon(random, 3 + random.below(8), family.size * 0.4,
                            family.size * 0.4 * family.flatness, random.uniform(0, 6), 0, family.grid);
  } while (signed_area(c.part) <= 0);
  if (random.below(2) == 1) std::reverse(c.blank.begin(), c.blank.end());
  if (random.below(2) == 1) std::reverse(c.part.begin(), c.part.end());
  return c;
}

TEST(VerifyRecheck, TheStrangerAgreesOnThePublishedExamples) {
  for (const Case& c : examples()) compare_opinions(write(c), c.name);
}

TEST(VerifyRecheck, TheStrangerAgreesOnRandomCasesTrueAndFalsified) {
  Random random(20);
  for (const Family& family : kFamilies) {
    for (int i = 0; i < 2; ++i) {
      const Case c = random_case(random, family);
      const Solution s = solve(c, 0, 6.283185307179587, 1e-3L * family.size);
      const std::string what = fmt::format("{} {}", family.name, i);
      const Files honest = write(c, s);
      compare_opinions(honest, what);
      EXPECT_NE(check(honest)->verdict, Verdict::refuted) << what << "\n" << findings(check(honest));

      Files files = honest;
      files["clearance"] = text_of(s.clearance + 1e-9 * family.size);
      files["gap"] = text_of(s.upper_bound - std::stod(files["clearance"]));
      files["shortfall"] = text_of(std::max(0.0, -std::stod(files["clearance"])));
      compare_opinions(files, what + ", clearance raised");
      files = honest;
      files.certificate.erase(files.certificate.begin() +
                              static_cast<long>(random.below(files.certificate.size())));
      compare_opinions(files, what + ", interval removed");
      files = honest;
      files["upper_bound"] = text_of(std::stod(check(honest)->bound_high) - 1e-9 * family.size);
      files["gap"] = text_of(std::stod(files["upper_bound"]) - s.clearance);
      compare_opinions(files, what + ", bound lowered");
    }
  }
}

TEST(VerifyRecheck, TheStrangerAgreesOnWindows) {
  for (const auto& [from, to] : {std::pair{10.0, 50.0}, std::pair{-30.0, 30.0}, std::pair{350.0, 370.0}}) {
    const Case c = examples()[2];
    const double low = std::nextafter(from * std::numbers::pi / 180, -100),
                 high = std::nextafter(to * std::numbers::pi / 180, 100);
    const Solution s = solve(c, low, high, 1e-4L);
    Files files = write(c, s, from, to, s.upper_bound < 0 ? 0 : s.clearance - 1);
    compare_opinions(files, "window");
    EXPECT_EQ(check(files)->verdict, Verdict::confirmed) << findings(check(files));
    files.certificate.back().to = text_of(to * 3.14159265358979 / 180 - 1e-14);
    compare_opinions(files, "window cut short");
    EXPECT_EQ(check(files)->verdict, Verdict::refuted);
  }
}

TEST(VerifyRecheck, TheDefinitionInLongDoubleAgrees) {
  Random random(7);
  for (const Family& family : kFamilies) {
    for (int i = 0; i < 200; ++i) {
      const Case c = random_case(random, family);
      Files files = write(c, Solution{});
      const double theta = random.uniform(-7, 7), x = random.uniform(-1, 1) * family.size + family.offset,
                   y = random.uniform(-1, 1) * family.size - family.offset;
      set_pose(files, x, y, theta);
      files["upper_bound"] = files["gap"] = "null";
      files["status"] = "\"unproved\"";
      files["contacts"] = "[]";
      files.inline_certificate = files.give_certificate = false;
      const Real expected = clearance_at(c.blank, c.part, x, y, theta);
      // Decimals of x, y and theta are within half a step of the doubles; the rest is long double's rounding.
      const Real tolerance = 3e-16L * (scale_of(c.blank, c.part) + std::abs(Real(x)) + std::abs(Real(y))) * 4;
      files["clearance"] = text_of(static_cast<double>(expected - 2 * tolerance));
      files["shortfall"] = text_of(std::max(0.0, -std::stod(files["clearance"])));
      auto report = check(files);
      ASSERT_TRUE(report) << family.name << ": " << report.error().message;
      EXPECT_EQ(report->verdict, Verdict::unproved) << family.name << "\n" << findings(report);
      EXPECT_LT(std::abs(std::stold(report->clearance_low) - expected), tolerance) << family.name;
      EXPECT_LT(std::abs(std::stold(report->clearance_high) - expected), tolerance) << family.name;
      files["clearance"] = text_of(static_cast<double>(expected + 2 * tolerance));
      files["shortfall"] = text_of(std::max(0.0, -std::stod(files["clearance"])));
      report = check(files);
      ASSERT_TRUE(report);
      EXPECT_EQ(report->verdict, Verdict::refuted) << family.name;
    }
  }
}

}  // namespace
}  // namespace lekalo::verify_recheck_test

// Blanks that are not quite convex, trimmed blanks, exact ties, wide intervals, results that say less.

#include <gtest/gtest.h>

#include <functional>

#include "support/verify_cases.hpp"

namespace lekalo::verify_shapes_test {
namespace {

using namespace verify_cases;
using verify::Verdict;

Points square(double low, double high) { return {{low, low}, {high, low}, {high, high}, {low, high}}; }

/// A result that claims nothing but a pose and its clearance.
Files pose_only(const std::string& blank, std::size_t blank_points, const Points& part, double x, double y,
                double theta, const std::string& clearance, const std::string& dropped = "[]") {
  Files f = write({"", {{0, 0}, {1, 0}, {0, 1}}, part, 0}, Solution{});
  f.blank = blank;
  f["inputs"] = inputs_json(part.size(), blank_points, "[]", dropped);
  set_pose(f, x, y, theta);
  f["clearance"] = clearance;
  f["upper_bound"] = f["gap"] = "null";
  f["status"] = "\"unproved\"";
  f["contacts"] = "[]";
  f["shortfall"] = text_of(std::max(0.0, -std::stod(clearance)));
  f.inline_certificate = f.give_certificate = false;
  return f;
}

Verdict verdict_of(const Files& files) {
  const auto report = check(files);
  EXPECT_TRUE(report) << report.error().message;
  return report ? report->verdict : Verdict::refuted;
}

IntervalText interval(const std::string& from, const std::string& to,
                      const std::vector<ContactText>& contacts) {
  return {from, to, contacts};
}

// ---- exact ties -------------------------------------------------------------------------------------------

/// A square of 10 in a square of 12, upright: every number is exact, nothing may be lost to rounding.
Files upright_squares() {
  Files f = write({"", square(0, 12), square(0, 10), 1}, Solution{}, 0, 0);
  set_pose(f, 1, 1, 0);
  f["clearance"] = f["upper_bound"] = "1";
  f["gap"] = "0";
  f["shortfall"] = "0";
  f["contacts"] = "[]";
  // Bottom against top; the third edge weighs nothing.
  f.certificate = {interval("0", "0", {{"0", "0", "0.5"}, {"2", "2", "0.5"}, {"0", "3", "0"}})};
  return f;
}

TEST(VerifyShapes, AnExactTieIsTrue) {
  const auto report = check(upright_squares());
  ASSERT_TRUE(report);
  EXPECT_EQ(report->verdict, Verdict::confirmed) << findings(report);
  EXPECT_EQ(report->clearance_low, "1");
  EXPECT_EQ(report->clearance_high, "1");
  EXPECT_EQ(report->bound_high, "1");
}

TEST(VerifyShapes, AnExactTieIsMissedByTheFiftiethDigit) {
  Files f = upright_squares();
  f["clearance"] = "1.0000000000000000000000000000000000000000000000001";
  EXPECT_EQ(verdict_of(f), Verdict::refuted);
  f = upright_squares();
  f["upper_bound"] = "0.9999999999999999999999999999999999999999999999999";
  EXPECT_EQ(verdict_of(f), Verdict::refuted);
}

TEST(VerifyShapes, NumbersOfAnySizeAreToldApart) {
  for (const int exponent : {-320, -150, 150, 300}) {
    const auto scaled = [exponent](const std::string& digits) {
      return fmt::format("{}e{}", digits, exponent);
    };
    const auto box = [&scaled](const char* a, const char* b) {
      const std::string low = scaled(a), high = scaled(b);
      return fmt::format("[[{0}, {0}], [{1}, {0}], [{1}, {1}], [{0}, {1}]]", low, high);
    };
    Files f = upright_squares();
    f.blank = box("0", "12");
    f.part = box("0", "10");
    f["x"] = f["y"] = f["clearance"] = f["upper_bound"] = scaled("1");
    EXPECT_EQ(verdict_of(f), Verdict::confirmed) << exponent << findings(check(f));
    f["clearance"] = scaled("1.000000000000000001");
    EXPECT_EQ(verdict_of(f), Verdict::refuted) << exponent;
    f["clearance"] = scaled("1");
    f["upper_bound"] = scaled("0.999999999999999999");
    EXPECT_EQ(verdict_of(f), Verdict::refuted) << exponent;
  }
}

// ---- wide intervals ---------------------------------------------------------------------------------------

TEST(VerifyShapes, AnIntervalOfAnyWidthIsBoundedByTheLargestValueInIt) {
  const Case c = examples()[3];
  const std::vector<Line> blank_lines = lines_of(c.blank);
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const double from = random.uniform(-7, 7), to = from + random.uniform(0, i % 3 == 0 ? 0.1 : 9.5);
    const Basis basis = best_basis(blank_lines, c.part, random.uniform(from, to));
    const Real top = sinusoid_maximum(basis, from, to);
    Files f = write(c, Solution{}, 0, 0);
    f["clearance"] = text_of(static_cast<double>(clearance_at(c.blank, c.part, 0, 0, 0)) - 1e-9);
    f["window_deg"] = fmt::format("[{}, {}]", (from + 0.4 * (to - from)) * 57.29577951308232,
                                  (from + 0.6 * (to - from)) * 57.29577951308232);
    set_pose(f, 0, 0, from + 0.5 * (to - from));
    f["clearance"] = "-1e6";
    f["shortfall"] = "1e6";
    f["contacts"] = "[]";
    f.certificate = {interval(text_of(from), text_of(to), {})};
    for (const Contact& contact : basis.contacts) f.certificate[0].contacts.push_back(contact_text(contact));
    for (const double off : {1e-12, -1e-12}) {
      f["upper_bound"] = text_of(static_cast<double>(top) + off);
      f["gap"] = text_of(std::stod(f["upper_bound"]) + 1e6);
      f["status"] = std::stod(f["upper_bound"]) < 0 ? "\"infeasible\"" : "\"optimal\"";
      EXPECT_EQ(verdict_of(f), off > 0 ? Verdict::confirmed : Verdict::refuted)
          << from << " to " << to << "\n"
          << findings(check(f));
    }
  }
}

TEST(VerifyShapes, IntervalsMayOverlapButNotLeaveAHole) {
  Files f = write(examples()[0]);
  const std::string inside = f.certificate[3].from;
  f.certificate[2].to = f.certificate[3].to;
  EXPECT_EQ(check(f)->verdict == Verdict::refuted,
            findings(check(f)).find("upper_bound") != std::string::npos);
  EXPECT_EQ(findings(check(f)).find("nothing covers"), std::string::npos) << findings(check(f));
  f.certificate[2].to = f.certificate[2].from;
  EXPECT_NE(findings(check(f)).find("nothing covers"), std::string::npos);
}

// ---- blanks that miss being convex ------------------------------------------------------------------------

/// 20 x 20 with a dent of `depth` in the middle of the lower side.
std::string dented(const std::string& depth) {
  return "[[0, 0], [10, " + depth + "], [20, 0], [20, 20], [0, 20]]";
}

TEST(VerifyShapes, ADentCountsWhereItIsAndNoFurther) {
  // The part's lower side is 1 above the blank's, so 0.99 above the tip of the dent.
  Files f = pose_only(dented("0.01"), 5, square(1, 19), 0, 0, 0, "0.99");
  EXPECT_EQ(verdict_of(f), Verdict::unproved) << findings(check(f));
  f["clearance"] = "0.99000000000000000001";
  EXPECT_EQ(verdict_of(f), Verdict::refuted);
  // A part that stands left of the dent is nearest to the slope, which passes below its corner (6, 3) at
  // 0.006.
  f = pose_only(dented("0.01"), 5, {{5, 3}, {6, 3}, {6, 15}, {5, 15}}, 0, 0, 0, "0");
  const Real slope = 2.994L / std::sqrt(1 + 1e-6L);
  for (const Real off : {-1e-14L, 1e-14L}) {
    f["clearance"] = fmt::format("{:.18f}", slope + off);
    EXPECT_EQ(verdict_of(f), off < 0 ? Verdict::unproved : Verdict::refuted) << findings(check(f));
  }
}

TEST(VerifyShapes, APartThatSticksOutOfADentedBlankIsJudgedWithTheDentCutOff) {
  // 1 below the lower side: between -1 (hull) and -1.01 (dent cut off); only what both have is confirmed.
  Files f = pose_only(dented("0.01"), 5, square(1, 10), 0, -2, 0, "-1.01");
  EXPECT_EQ(verdict_of(f), Verdict::unproved) << findings(check(f));
  EXPECT_EQ(std::stod(check(f)->clearance_high), -1);
  f["clearance"] = "-1.005";
  f["shortfall"] = "1.005";
  EXPECT_NE(findings(check(f)).find("not provably at most"), std::string::npos) << findings(check(f));
}

/// A rectangle turned by an angle, each side cut into pieces, 6 decimals: every point misses its line a
/// little.
Points noisy_rectangle(double width, double height, double turn, int pieces) {
  const Points corners{{0, 0}, {width, 0}, {width, height}, {0, height}};
  Points points;
  for (std::size_t i = 0; i < 4; ++i) {
    for (int k = 0; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      const double x = corners[i][0] + t * (corners[(i + 1) % 4][0] - corners[i][0]),
                   y = corners[i][1] + t * (corners[(i + 1) % 4][1] - corners[i][1]);
      points.push_back({x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn)});
    }
  }
  return points;
}

std::string all_but_corners(int pieces) {
  std::string list;
  for (int i = 0; i < 4 * pieces; ++i) {
    if (i % pieces != 0) list += (list.empty() ? "" : ", ") + std::to_string(i);
  }
  return "[" + list + "]";
}

/// The result for the rectangle's corners alone, held against the file with all its points.
Files noisy_result(double width, double height, double turn, int pieces, bool reversed) {
  Points corners = noisy_rectangle(width, height, turn, 1),
         all = noisy_rectangle(width, height, turn, pieces);
  std::string dropped = all_but_corners(pieces);
  if (reversed) {
    std::reverse(corners.begin(), corners.end());
    std::reverse(all.begin(), all.end());
    dropped.clear();
    for (int i = 0; i < 4 * pieces; ++i) {
      if (i % pieces != pieces - 1) dropped += (dropped.empty() ? "" : ", ") + std::to_string(i);
    }
    dropped = "[" + dropped + "]";
  }
  const Case c{"", corners, {{0, 0}, {11, 1}, {9, 6}, {3, 7}}, 0};
  Solution s = solve(c, 0, 6.283185307179587, 1e-6L);
  // What the points off their lines may take or give.
  s.clearance -= 1e-13;
  s.upper_bound += 1e-13;
  for (auto* basis : {&s.basis}) {
    for (Contact& contact : basis->contacts) {
      contact.blank_edge = contact.blank_edge * static_cast<std::size_t>(pieces) +
                           (reversed ? static_cast<std::size_t>(pieces) - 1 : 0);
    }
  }
  for (Piece& piece : s.pieces) {
    for (Contact& contact : piece.basis.contacts) {
      contact.blank_edge = contact.blank_edge * static_cast<std::size_t>(pieces) +
                           (reversed ? static_cast<std::size_t>(pieces) - 1 : 0);
    }
  }
  Files f = write(c, s);
  f.blank = points_json(all);
  f["inputs"] = inputs_json(c.part.size(), all.size(), "[]", dropped);
  return f;
}

TEST(VerifyShapes, PointsThatMissTheirLineByTheLastDigitDoNoHarm) {
  for (const bool reversed : {false, true}) {
    for (const double turn : {0.1, 0.3, 1.1, 2.0, 4.0}) {
      for (const int pieces : {2, 7}) {
        const Files f = noisy_result(15, 10, turn, pieces, reversed);
        EXPECT_EQ(verdict_of(f), Verdict::confirmed) << turn << " " << pieces << "\n" << findings(check(f));
      }
    }
  }
}

TEST(VerifyShapes, ABlankThatIsTooSmallIsProvedSoAlthoughItsPointsMissTheirLines) {
  for (const bool reversed : {false, true}) {
    Files f = noisy_result(5, 4, 0.3, 7, reversed);
    ASSERT_LT(std::stod(f["upper_bound"]), -0.5);
    EXPECT_EQ(verdict_of(f), Verdict::confirmed) << findings(check(f));
    f["upper_bound"] = text_of(std::stod(f["upper_bound"]) - 1e-11 - 1e-6);
    EXPECT_EQ(verdict_of(f), Verdict::refuted);
  }
}

TEST(VerifyShapes, AnEdgeThatCutsACornerOffIsMovedOutToIt) {
  // Point 1 listed as dropped: edge 0 is the chord from (0, 0) to (10, 10), with the corner (10, 0) beyond it
  // by 10 / sqrt 2. The bound over the chord must grow by that much.
  Files f = upright_squares();
  f["inputs"] = inputs_json(4, 4, "[]", "[1]");
  const std::string words = findings(check(f));
  EXPECT_NE(words.find("lies 8.4852813742385"), std::string::npos) << words;
  EXPECT_NE(words.find("upper_bound"), std::string::npos) << words;
}

TEST(VerifyShapes, NearlyOppositeEdgesWhoseThirdWeighsLessThanNothingStillProve) {
  // Lower and upper side miss being parallel by 1e-15, to the side where the left edge would need a negative
  // weight; the right one does not.
  for (const char* tilt : {"12.000000000000001", "11.999999999999999"}) {
    Files f = upright_squares();
    f.blank = fmt::format("[[0, 0], [12, 0], [12, {}], [0, 12]]", tilt);
    f["clearance"] = "0.99999999999999";
    f["upper_bound"] = "1.00000000000001";
    f["gap"] = "2e-14";
    EXPECT_EQ(verdict_of(f), Verdict::confirmed) << findings(check(f));
    f["upper_bound"] = "0.99999999999999";
    f["gap"] = "0";
    EXPECT_EQ(verdict_of(f), Verdict::refuted);
  }
}

TEST(VerifyShapes, AThirdEdgeAlongAnOppositePairIsNoObstacleWhileItWeighsNothing) {
  // The lower side has a corner of 1e-15 in its middle, and the written third edge is its other half: all
  // three edges are parallel but for that, and their exact weights are whatever the last digits say.
  Files f = upright_squares();
  f.blank = "[[0, 0.000000000000001], [5, 0], [12, 0.000000000000003], [12, 12], [0, 12]]";
  f["inputs"] = inputs_json(4, 5);
  f["clearance"] = "0.99999999999999";
  f["upper_bound"] = "1.00000000000001";
  f["gap"] = "2e-14";
  f.certificate = {interval("0", "0", {{"0", "0", "0.5"}, {"2", "3", "0.5"}, {"3", "1", "0"}})};
  EXPECT_EQ(verdict_of(f), Verdict::confirmed) << findings(check(f));
  f["upper_bound"] = "0.99999999999999";
  f["gap"] = "0";
  EXPECT_EQ(verdict_of(f), Verdict::refuted);
  // A multiplier that says the third edge matters is another matter.
  f["upper_bound"] = "1.00000000000001";
  f["gap"] = "2e-14";
  f.certificate = {interval("0", "0", {{"0", "0", "0.4"}, {"2", "3", "0.5"}, {"3", "1", "0.1"}})};
  EXPECT_EQ(verdict_of(f), Verdict::refuted);
}

// ---- trimmed blanks ---------------------------------------------------------------------------------------

Files trimmed(const std::string& contour) {
  Files f = upright_squares();
  f.blank = "[[0, 0], [6, 0.25], [12, 0], [12, 12], [0, 12]]";
  f["inputs"] = inputs_json(4, 5);
  f["trim"] = R"({"tolerance": 0.5, "loss": 0.25, "contour": )" + contour + "}";
  set_pose(f, 1, 1.125, 0);
  f["clearance"] = "0.875";
  f["upper_bound"] = "0.875";
  return f;
}

TEST(VerifyShapes, ATrimmedBlankIsCheckedInItsOwnNumbers) {
  const auto report = check(trimmed("[[0, 0.25], [12, 0.25], [12, 12], [0, 12]]"));
  ASSERT_TRUE(report);
  EXPECT_EQ(report->verdict, Verdict::confirmed) << findings(report);
  EXPECT_EQ(report->clearance_low, "0.875");
  EXPECT_EQ(verdict_of(trimmed("[[0, 12], [12, 12], [12, 0.25], [0, 0.25]]")), Verdict::refuted)
      << "the edges of the certificate count the other way round";
}

TEST(VerifyShapes, ATrimmedContourMustBeConvexAndInsideTheBlank) {
  const auto expect = [](const std::string& contour, const std::string& words) {
    const Files f = trimmed(contour);
    EXPECT_EQ(verdict_of(f), Verdict::refuted) << contour;
    EXPECT_NE(findings(check(f)).find(words), std::string::npos) << contour << "\n" << findings(check(f));
  };
  expect("[[0, 0.2499999999999999999], [12, 0.25], [12, 12], [0, 12]]",
         "reaches outside the blank, across its edge 0");
  expect("[[0, 0.25], [12, 0.25], [12.0000000000000000001, 12], [0, 12]]",
         "reaches outside the blank, across its edge 2");
  expect("[[0, 0.25], [12, 0.25], [12, 12], [0, 12.5]]", "reaches outside the blank");
  expect("[[100, 100.25], [112, 100.25], [112, 112], [100, 112]]", "reaches outside the blank");
  expect("[[0, 0.25], [6, 0.26], [12, 0.25], [12, 12], [0, 12]]", "the trimmed contour is not convex");
  expect("[[0, 0], [12, 0], [12, 12], [0, 12]]", "reaches outside the blank");
}

TEST(VerifyShapes, ATrimmedContourAroundTheWholeBlankIsNotInsideIt) {
  {
    const Files f = trimmed("[[-5, -5], [17, -5], [17, 17], [-5, 17]]");
    EXPECT_NE(findings(check(f)).find("reaches outside the blank"), std::string::npos) << findings(check(f));
  }
}

TEST(VerifyShapes, ATrimThatLosesMoreThanItMayIsRefuted) {
  Files f = trimmed("[[0, 0.25], [12, 0.25], [12, 12], [0, 12]]");
  f["trim"] = R"({"tolerance": 0.2, "loss": 0.25, "contour": [[0, 0.25], [12, 0.25], [12, 12], [0, 12]]})";
  EXPECT_NE(findings(check(f)).find("loss 0.25 is above its tolerance 0.2"), std::string::npos);
}

// ---- results that say less --------------------------------------------------------------------------------

TEST(VerifyShapes, AResultWithoutACertificateIsUnproved) {
  Files f = write(examples()[2]);
  f.inline_certificate = f.give_certificate = false;
  EXPECT_EQ(verdict_of(f), Verdict::unproved) << findings(check(f));
  f["upper_bound"] = f["gap"] = "null";
  EXPECT_EQ(verdict_of(f), Verdict::refuted) << "optimal without a bound";
  f["status"] = "\"unproved\"";
  EXPECT_EQ(verdict_of(f), Verdict::unproved) << findings(check(f));
  f["status"] = "\"stopped\"";
  EXPECT_EQ(verdict_of(f), Verdict::unproved) << findings(check(f));
}

TEST(VerifyShapes, AnInfeasibleDemandIsConfirmedWithItsShortfall) {
  const Case c = examples()[4];
  const Solution s = solve(c);
  Files f = write(c, s, 0, 360, 1.5);
  EXPECT_EQ(f["status"], "\"infeasible\"");
  EXPECT_EQ(verdict_of(f), Verdict::confirmed) << findings(check(f));
}

TEST(VerifyShapes, AlternativesAreCheckedLikeTheBest) {
  Files f = upright_squares();
  f["alternatives"] =
      R"([{"x": 11, "y": 1, "theta": 1.5707963267948966, "theta_deg": 90, "clearance": 0.999999999}])";
  f["window_deg"] = "[0, 90]";
  f.certificate[0].to = "1.5707963267948967";
  f["upper_bound"] = "3";
  f["gap"] = "2";
  EXPECT_EQ(verdict_of(f), Verdict::confirmed) << findings(check(f));
  f["alternatives"] =
      R"([{"x": 11, "y": 1.1, "theta": 1.5707963267948966, "theta_deg": 90, "clearance": 0.999999999}])";
  EXPECT_NE(findings(check(f)).find("alternative 0: clearance"), std::string::npos);
  f["alternatives"] =
      R"([{"x": 11, "y": 1, "theta": 1.5707963267948966, "theta_deg": 91, "clearance": 0.9}])";
  EXPECT_NE(findings(check(f)).find("alternative 0: theta_deg"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::verify_shapes_test

// Blanks that are not quite convex, trimmed blanks, exact ties, wide intervals, results that say less.

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <tuple>

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
  verify_cases::Random random(3);
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
    std::vector<ContactText> contacts;
    for (const Contact& contact : basis.contacts) contacts.push_back(contact_text(contact));
    // Of one that is no wider than its beginning the bound is not above it, and then it must be raised.
    f.certificate = {interval(text_of(from), text_of(from), contacts),
                     interval(text_of(from), text_of(to), contacts)};
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

/// Where the part sticks out over both hull edges at a corner by 1 mm, it may stick out over the diagonal
/// that is moved out to that corner by the root of 2.
TEST(VerifyShapes, ABoundBelow0OverAnEdgeThatIsMovedOutIsDividedByItsSpread) {
  Files f = upright_squares();
  f.part = "[[0, 0], [30, 0], [30, 40], [0, 40]]";
  f["inputs"] = inputs_json(4, 4, "[]", "[1]");
  f.certificate = {interval("0", "0", {{"1", "0", "0.41421"}, {"3", "2", "0.29289"}, {"0", "3", "0.29289"}})};
  const auto report = check(f);
  ASSERT_TRUE(report) << report.error().message;
  // The distances 144 - 360, -336 and 0, over the lengths of the three edges.
  EXPECT_NEAR(std::stod(report->bound_high), -552 / (12 * (2 + std::sqrt(2))) / std::sqrt(2), 1e-12);
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
    // It may be written anywhere among the three, and weigh as little as the tolerance.
    f["upper_bound"] = "1.00000000000001";
    f["gap"] = "2e-14";
    for (const char* least : {"0", "0.000001"}) {
      std::vector<ContactText>& contacts = f.certificate[0].contacts;
      for (ContactText& contact : contacts)
        if (contact.blank_edge == "3") contact.multiplier = least;
      for (int k = 0; k < 3; ++k) {
        std::rotate(contacts.begin(), contacts.begin() + 1, contacts.end());
        EXPECT_EQ(verdict_of(f), Verdict::confirmed) << tilt << ' ' << least << findings(check(f));
      }
    }
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

// ---- what is said beside the proof ------------------------------------------------------------------------

/// The report on files, with whatever else `add` gives the checker.
Result<verify::LocateReport> check_with(const Files& files,
                                        const std::function<void(verify::LocateInputs&)>& add) {
  const std::string result = files.result();
  verify::LocateInputs inputs{
      {"result.json", result}, {"part.json", files.part}, {"blank.json", files.blank}, {}};
  add(inputs);
  return verify::verify_locate(inputs);
}

bool has(const Result<verify::LocateReport>& report, const std::string& words) {
  return findings(report).find(words) != std::string::npos;
}

/// The upright squares, with a point more on the lower side, which the result drops.
Files with_dropped(const std::string& dropped, const std::string& point = "[6, 0]") {
  Files f = upright_squares();
  f.blank = "[[0, 0], " + point + ", [12, 0], [12, 12], [0, 12]]";
  f["inputs"] = inputs_json(4, 5, "[]", dropped);
  f.certificate = {interval("0", "0", {{"0", "0", "0.5"}, {"2", "3", "0.5"}, {"0", "4", "0"}})};
  return f;
}

TEST(VerifyShapes, DroppedPointsAscendAndLieOnTheirLine) {
  EXPECT_EQ(verdict_of(with_dropped("[1]")), Verdict::confirmed) << findings(check(with_dropped("[1]")));
  for (const char* list : {"[5]", "[1, 1]", "[2, 1]"})
    EXPECT_TRUE(
        has(check(with_dropped(list)), "the dropped points of the blank are not ascending indices below 5"))
        << list << findings(check(with_dropped(list)));
  EXPECT_FALSE(has(check(with_dropped("[1, 2]")), "the result drops"));
  EXPECT_TRUE(has(check(with_dropped("[1, 2, 3]")), "the result drops 3 of the 5 points of the blank"));
  // A trillionth of the largest coordinate is 1.2e-11 mm, and what is off by more is said once.
  EXPECT_FALSE(has(check(with_dropped("[1]", "[6, 0.000000000011]")), "off the straight line"));
  for (const auto& [point, told] :
       std::vector<std::pair<std::string, std::string>>{{"[6, 0.000000000013]", "lies 1.2999"},
                                                        {"[13, 0]", "lies 1 mm off"},
                                                        {"[-1, 0]", "lies 1 mm off"}}) {
    const std::string all = findings(check(with_dropped("[1]", point)));
    const std::size_t at = all.find("dropped point 1 of the blank " + told);
    ASSERT_NE(at, std::string::npos) << point << all;
    EXPECT_EQ(all.find("dropped point", at + 1), std::string::npos) << all;
  }
}

std::string contacts_of(const std::vector<ContactText>& contacts) {
  std::string list;
  for (const ContactText& c : contacts) list += (list.empty() ? "" : ", ") + c.json();
  return "[" + list + "]";
}

TEST(VerifyShapes, ContactsAreClosestAndBalance) {
  const std::string words = "the multipliers of the contacts do not balance";
  const auto report_of = [](const std::vector<ContactText>& contacts) {
    Files f = upright_squares();
    f["contacts"] = contacts_of(contacts);
    return check(f);
  };
  for (const auto& balanced : std::vector<std::vector<ContactText>>{
           {{"0", "0", "0.5"}, {"2", "2", "0.5"}},
           {{"0", "0", "0.25"}, {"2", "2", "0.25"}, {"1", "1", "0.25"}, {"3", "3", "0.25"}},
           // One of the sums is exactly the tolerance.
           {{"0", "0", "0.4999995"}, {"2", "2", "0.5"}, {"3", "3", "0.000001"}}})
    EXPECT_EQ(findings(report_of(balanced)), "");
  for (const auto& unbalanced : std::vector<std::vector<ContactText>>{
           {{"0", "0", "1"}},
           {{"0", "0", "0.25"}, {"2", "2", "0.25"}},
           {{"0", "0", "0.6"}, {"2", "2", "0.4"}},
           {{"1", "1", "0.6"}, {"3", "3", "0.4"}},
           {{"0", "0", "0.4999995"}, {"2", "2", "0.5"}, {"3", "3", "0.00000101"}},
           {{"1", "1", "-0.25"}, {"3", "3", "-0.25"}, {"0", "0", "0.75"}, {"2", "2", "0.75"}},
           {{"0", "0", "0.75"}, {"2", "2", "0.75"}, {"1", "1", "-0.25"}, {"3", "3", "-0.25"}}})
    EXPECT_TRUE(has(report_of(unbalanced), words)) << contacts_of(unbalanced);
  EXPECT_TRUE(has(report_of({{"4", "0", "0.5"}, {"2", "2", "0.5"}}),
                  "contact 0: part vertex 4 does not exist, the part has 4 points"));
  EXPECT_TRUE(has(report_of({{"0", "4", "0.5"}, {"2", "2", "0.5"}}),
                  "contact 0: blank edge 4 does not exist, the blank has 4 points"));
  // Only an optimum must balance, and beside another finding it is not asked.
  Files f = upright_squares();
  f["contacts"] = contacts_of({{"0", "0", "1"}});
  f["status"] = "\"stopped\"";
  EXPECT_EQ(findings(check(f)), "");
  f = upright_squares();
  f["contacts"] = contacts_of({{"0", "0", "1"}});
  f["theta_deg"] = "1";
  EXPECT_FALSE(has(check(f), words));
  // A contact may be a millionth of the blank's size farther than the closest one: 2.4e-5 mm.
  for (const bool far : {false, true}) {
    f = upright_squares();
    set_pose(f, 1, far ? 1.00002 : 1.00001, 0);
    f["clearance"] = "0.9999", f["gap"] = "0.0001";
    f["contacts"] = contacts_of({{"0", "0", "0.5"}, {"2", "2", "0.5"}});
    EXPECT_EQ(has(check(f), "contact 0: part vertex 0 is 3.9"), far) << findings(check(f));
  }
}

TEST(VerifyShapes, AnAngleMayBeOffTheWindowByARounding) {
  const auto report_of = [](const std::string& theta, const std::string& degrees) {
    Files f = upright_squares();
    f["theta"] = theta, f["theta_deg"] = degrees;
    f["clearance"] = "0.9999", f["gap"] = "0.0001";
    return check(f);
  };
  // The angles next to 4e-15 degrees, the double, that are rounded up to it; 1 degree more counts for a
  // window of 0.
  EXPECT_EQ(
      findings(report_of("6.981317007977318843199475836590e-17", "4.000000000000000306821599506644e-15")),
      "");
  EXPECT_EQ(
      findings(report_of("-6.981317007977318857162109852544e-17", "-4.000000000000000314821599506644e-15")),
      "");
  EXPECT_TRUE(has(report_of("1e-16", "5.7295779513082321e-15"), "outside the window from 0 to 0"));
  EXPECT_TRUE(has(report_of("-1e-16", "-5.7295779513082321e-15"), "outside the window from 0 to 0"));
  EXPECT_EQ(findings(report_of("0", "0")), "");
  EXPECT_TRUE(has(report_of("0", "1e-300"), "theta_deg is 1e-300, but theta means 0 degrees"));
}

TEST(VerifyShapes, WhatIsDerivedMayBeOffByARounding) {
  const auto report_of = [](const std::vector<std::pair<std::string, std::string>>& fields) {
    Files f = upright_squares();
    for (const auto& [key, value] : fields) f[key] = value;
    return check(f);
  };
  EXPECT_EQ(findings(report_of({{"min_allowance", "1"}})), "");
  EXPECT_TRUE(has(report_of({{"min_allowance", "1"}, {"shortfall", "1e-16"}}),
                  "shortfall is 1e-16, but min_allowance is met"));
  EXPECT_TRUE(
      has(report_of({{"upper_bound", "0.5"}, {"gap", "-0.5"}}), "upper_bound 0.5 is below clearance 1"));
  EXPECT_TRUE(
      has(report_of({{"gap", "1e-300"}, {"clearance", "0"}, {"upper_bound", "0"}}), "gap is written as"));
  EXPECT_FALSE(has(report_of({{"gap", "0"}, {"clearance", "0"}, {"upper_bound", "0"}}), "gap is written as"));
  // The larger of the two numbers counts: 4, which is off by 4e-15 at most.
  EXPECT_EQ(findings(report_of({{"clearance", "0.5"}, {"upper_bound", "4"}, {"gap", "3.500000000000003"}})),
            "");
  EXPECT_TRUE(has(report_of({{"clearance", "0.5"}, {"upper_bound", "4"}, {"gap", "3.500000000000006"}}),
                  "gap is written as 3.500000000000006, but the numbers it comes from give 3.5"));
  EXPECT_EQ(findings(report_of({{"clearance", "0.5"},
                                {"upper_bound", "8"},
                                {"gap", "7.5"},
                                {"min_allowance", "4"},
                                {"shortfall", "3.499999999999997"}})),
            "");
  // A huge shift keeps all digits of the clearance.
  EXPECT_EQ(findings(report_of({{"x", "1e100"},
                                {"clearance", "-" + std::string(99, '9') + "8"},
                                {"shortfall", std::string(99, '9') + "8"},
                                {"gap", std::string(99, '9') + "9"}})),
            "");
  const auto with_program = [](const std::string& clearance, const std::string& kept,
                               const std::string& rounding) {
    Files f = upright_squares();
    f["clearance"] = clearance, f["gap"] = text_of(1 - std::stod(clearance));
    f["nc"] = fmt::format(
        R"({{"clearance": {}, "rounding_mm": {}, "mode": "coordinates", "work_offset": 1}})", kept, rounding);
    return check_with(f, [](verify::LocateInputs& inputs) { inputs.program = {"in.nc", "M30\n"}; });
  };
  const std::string words = "nc.clearance is";
  EXPECT_EQ(findings(with_program("1", "0.99999", "0.00001")), "");
  EXPECT_EQ(with_program("1", "0.99999", "0.00001")->verdict, Verdict::incomplete);
  EXPECT_EQ(findings(with_program("0", "0", "0")), "");
  EXPECT_TRUE(has(with_program("0", "1e-300", "0"), words));
  EXPECT_TRUE(has(with_program("1", "1", "0.00001"), words));
  EXPECT_TRUE(has(with_program("1", "0.5", "-0.00001"), words));
}

TEST(VerifyShapes, DeviationsAndAnEarlierResultAreHeldAgainstTheFiles) {
  Files f = upright_squares();
  f["deviations"] =
      R"({"path": "d.csv", "sha256": "", "points": 4, "least": 1.4142135623730951, "greatest": 1.4142135623730951})";
  const std::string table =
      "index,x,y,deviation\n0,0,0,1.4142135623730951\n1,12,0,1.4142135623730951\n2,12,12,1.4142135623730951\n"
      "3,0,12,1.4142135623730951\n";
  const auto whole = check_with(f, [&](verify::LocateInputs& inputs) {
    inputs.deviations = {"d.csv", table};
  });
  EXPECT_EQ(findings(whole), "");
  EXPECT_EQ(whole->verdict, Verdict::confirmed);
  EXPECT_EQ(verdict_of(f), Verdict::incomplete);

  f = upright_squares();
  const std::string last =
      R"({"x": 1, "y": 1, "theta": 0, "clearance": 1, "inputs": [{"role": "part", "sha256": ""}]})";
  const auto with_last = [&](verify::LocateInputs& inputs) { inputs.earlier = {"last.json", last}; };
  EXPECT_EQ(findings(check_with(f, with_last)), "");
  const auto comparison = [](const std::string& clearance) {
    return R"({"same_part": true, "dx": 0, "dy": 0, "dtheta": 0, "dtheta_deg": 0, "largest_shift": 0,
               "last_clearance": 1, "last_pose_clearance": )" +
           clearance + "}";
  };
  f["comparison"] = comparison("1");
  EXPECT_EQ(findings(check_with(f, with_last)), "");
  EXPECT_TRUE(has(check(f), "there is a comparison, but the result names no earlier one"));
  f["comparison"] = comparison("1.0000000000000000000001");
  EXPECT_TRUE(has(check_with(f, with_last), "comparison.last_pose_clearance 1 mm is above 1 mm"));
}

TEST(VerifyShapes, ACertificateIsReadWhereTheResultSaysItIs) {
  Files f = upright_squares();
  f.inline_certificate = false;
  EXPECT_EQ(verdict_of(f), Verdict::confirmed);
  // A file that the result does not name proves nothing.
  std::string text = f.result();
  text.replace(text.find("{\"path\""), std::string::npos, "null}");
  const std::string document = f.certificate_document();
  const auto report = verify::verify_locate({{"result.json", text},
                                             {"part.json", f.part},
                                             {"blank.json", f.blank},
                                             verify::Document{"c.json", document}});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->verdict, Verdict::unproved) << findings(report);
  f.certificate[0].contacts.pop_back();
  EXPECT_EQ(findings(check(f)).find("certificate.json: certificate interval 0"), 0U) << findings(check(f));
  f.inline_certificate = true;
  const auto other = check_with(f, [&](verify::LocateInputs& inputs) {
    inputs.certificate = {"c.json", document};
  });
  EXPECT_EQ(findings(other).find("result.json: certificate interval 0"), 0U) << findings(other);
}

TEST(VerifyShapes, ATrimMayLoseAllOfItsToleranceButNotTheBlank) {
  Files f = trimmed("[[0, 0.25], [12, 0.25], [12, 12], [0, 12]]");
  f["trim"] = R"({"tolerance": 0.25, "loss": 0.25, "contour": [[0, 0.25], [12, 0.25], [12, 12], [0, 12]]})";
  EXPECT_EQ(verdict_of(f), Verdict::confirmed) << findings(check(f));
  f.blank = "[[0, 0], [6, 0], [12, 0], [9, 0], [3, 0]]";
  EXPECT_EQ(findings(check(f)), "blank.json: the contour has no area");
}

// ---- the order of intervals, and which of them is the worst -----------------------------------------------

/// The upright squares, with intervals from and to these angles, in a window that they cover.
Files with_intervals(const std::vector<std::pair<std::string, std::string>>& ends) {
  Files f = upright_squares();
  f["upper_bound"] = "20", f["gap"] = "19";
  const std::vector<ContactText> contacts = f.certificate[0].contacts;
  f.certificate.clear();
  for (const auto& [from, to] : ends) f.certificate.push_back(interval(from, to, contacts));
  return f;
}

TEST(VerifyShapes, TheOrderOfIntervalsIsExact) {
  using Ends = std::vector<std::pair<std::string, std::string>>;
  for (const auto& [ends, told] : std::vector<std::pair<Ends, std::string>>{
           {{{"0", "1"}, {"1", "2"}}, ""},
           {{{"0", "1"}, {"1.0", "2"}}, ""},
           {{{"0", "2"}, {"0", "1"}, {"1", "3"}}, ""},
           {{{"0", "1"}, {"0.99999999999999999999999", "2"}}, ""},
           {{{"0", "1"}, {"1.00000000000000000000001", "2"}},
            "interval 1: nothing covers the angles from 1 to 1.00000000000000000000001"},
           {{{"0", "1"}, {"0.5", "1.0"}, {"2", "3"}}, "interval 2: nothing covers the angles from 1 to 2"},
           {{{"0", "1e-350"}, {"2e-350", "1"}}, "nothing covers the angles from 1e-350 to 2e-350"},
           {{{"0", "2e-350"}, {"1e-350", "1"}}, ""},
           {{{"0", "0.5"}, {"0.5", "1"}, {"0.49999999999999999999999", "2"}},
            "interval 2: it begins at 0.49999999999999999999999, before the one in front of it at 0.5"},
           {{{"0", "1"}, {"1", "0.99999999999999999999999"}},
            "interval 1: it runs backwards, from 1 to 0.99999999999999999999999"},
           {{{"0.00000000000000000000001", "1"}},
            "covers the angles from 0.00000000000000000000001 to 1, but the window"}}) {
    const std::string all = findings(check(with_intervals(ends)));
    EXPECT_EQ(all.empty(), told.empty()) << ends[0].second << ": " << all;
    EXPECT_NE(all.find(told), std::string::npos) << told << ": " << all;
  }
  // A window has to be covered at either end.
  for (const auto& [from, to, whole] : {std::tuple{"0", "1.5707963267948967", true},
                                        {"0", "1.5707963267948966", false},
                                        {"0.0000000001", "1.5707963267948967", false}}) {
    Files f = with_intervals({{from, to}});
    f["window_deg"] = "[0, 90]";
    EXPECT_EQ(has(check(f), "but the window runs from 0 to 90"), false);
    EXPECT_EQ(has(check(f), "but the window runs from"), !whole) << from << ' ' << to;
  }
}

TEST(VerifyShapes, OfManySentencesAboutIntervalsTwentyAreSaid) {
  for (const std::size_t count : {20U, 22U}) {
    Files f = with_intervals(std::vector<std::pair<std::string, std::string>>(count, {"0", "0"}));
    for (IntervalText& i : f.certificate) i.contacts[1].part_vertex = "4";
    const auto report = check(f);
    EXPECT_TRUE(has(report, "certificate interval 19: part vertex 4 does not exist, the part has 4 points"));
    EXPECT_FALSE(has(report, "certificate interval 20:"));
    EXPECT_EQ(has(report, "certificate: 2 more such sentences about its intervals"), count == 22);
    EXPECT_EQ(has(report, "more such"), count == 22);
  }
}

TEST(VerifyShapes, AMultiplierMayBeOffByWhatTheBlanksRoundingMakesOfIt) {
  const auto of_squares = [](const std::string& third) {
    Files f = upright_squares();
    f.certificate[0].contacts[2].multiplier = third;
    return check(f);
  };
  EXPECT_EQ(findings(of_squares("0.000001")), "");
  EXPECT_TRUE(has(of_squares("0.0000015"), "multiplier 2 is written as 1.5e-06, but the edges give 0"));
  // Three edges whose directions differ in their tenth decimal: their weights are off by 1.3e-4.
  const auto of_flat = [](const std::vector<ContactText>& contacts) {
    Files f = upright_squares();
    f.blank = "[[0, 0], [6, -0.0000000001], [12, 0], [12, 12], [0, 12]]";
    f["inputs"] = inputs_json(4, 5);
    f["upper_bound"] = "2", f["gap"] = "1";
    f.certificate = {interval("0", "0", contacts)};
    return check(f);
  };
  EXPECT_FALSE(has(of_flat({{"0", "0", "0.25"}, {"1", "1", "0.25"}, {"2", "3", "0.5"}}), "multiplier"));
  EXPECT_FALSE(has(of_flat({{"0", "0", "0.2501"}, {"1", "1", "0.25"}, {"2", "3", "0.4999"}}), "multiplier"));
  EXPECT_TRUE(has(of_flat({{"0", "0", "0.250138"}, {"1", "1", "0.25"}, {"2", "3", "0.499862"}}),
                  "multiplier 0 is written as 0.250138, but the edges give 0.2"));
}

/// However it is decided which intervals are looked at closely, the bound is the largest of them.
TEST(VerifyShapes, TheBoundIsThatOfTheWorstInterval) {
  struct Scene {
    std::string blank, part, dropped;
    std::vector<std::vector<ContactText>> contacts;
  };
  const std::string triangle = "[[100, 200], [113, 200], [104, 211]]";
  const std::vector<std::vector<ContactText>> of_triangle{
      {{"0", "0", "0.43"}, {"1", "1", "0"}, {"2", "2", "0"}},
      {{"2", "0", "0.43"}, {"3", "1", "0"}, {"0", "2", "0"}},
      {{"1", "0", "0.43"}, {"1", "1", "0"}, {"3", "2", "0"}}};
  const std::vector<Scene> scenes{{triangle, "[[1, 0], [2, 0], [2, 1], [1, 1]]", "[]", of_triangle},
                                  {triangle, "[[10, 0], [50, 0], [50, 40], [10, 40]]", "[]", of_triangle},
                                  // The chord of a corner that is dropped is moved out to it.
                                  {"[[0, 0], [12, 0], [12, 12], [0, 12]]",
                                   "[[0, 0], [30, 0], [30, 40], [0, 40]]",
                                   "[1]",
                                   {{{"0", "0", "0.4"}, {"1", "2", "0.3"}, {"2", "3", "0.3"}},
                                    {{"3", "0", "0.4"}, {"2", "2", "0.3"}, {"0", "3", "0.3"}}}},
                                  {"[[0, 0], [12, 0], [12, 12], [0, 12]]",
                                   "[[0, 0], [1, 0], [1, 2], [0, 2]]",
                                   "[1]",
                                   {{{"0", "0", "0.4"}, {"1", "2", "0.3"}, {"2", "3", "0.3"}},
                                    {{"3", "0", "0.4"}, {"2", "2", "0.3"}, {"0", "3", "0.3"}}}}};
  const std::vector<std::pair<std::string, std::string>> ends{
      {"0", "0"},     {"0", "0.4"},   {"0.4", "1.1"},  {"1.1", "1.9"}, {"1.9", "2.7"},
      {"2.7", "3.4"}, {"3.4", "4.2"}, {"4.2", "5"},    {"5", "6.2"},   {"1", "4.5"},
      {"3", "6.9"},   {"0.2", "6"},   {"0", "1e-350"}, {"0", "3.8"},   {"0", "9.5"}};
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const Scene& scene = scenes[k];
    Files f = upright_squares();
    f.blank = scene.blank, f.part = scene.part;
    f["inputs"] = inputs_json(4, k < 2 ? 3 : 4, "[]", scene.dropped);
    std::vector<IntervalText> intervals;
    for (const auto& contacts : scene.contacts)
      for (const auto& [from, to] : ends) intervals.push_back(interval(from, to, contacts));
    const auto bound_of = [&f](const std::vector<IntervalText>& certificate) {
      f.certificate = certificate;
      const auto report = check(f);
      EXPECT_TRUE(report) << report.error().message;
      return report ? report->bound_high : "";
    };
    std::vector<std::string> alone;
    for (const IntervalText& one : intervals) alone.push_back(bound_of({one}));
    for (std::size_t i = 0; i < intervals.size(); ++i) {
      // The middle of one is not above it, but above its ends if it is highest within it.
      const double from = std::strtod(intervals[i].from.c_str(), nullptr),
                   to = std::strtod(intervals[i].to.c_str(), nullptr);
      const std::string middle = text_of(from + 0.45 * (to - from));
      EXPECT_EQ(bound_of({interval(middle, middle, intervals[i].contacts), intervals[i]}), alone[i])
          << k << ": " << i;
      for (const std::size_t step : {1U, 5U}) {
        const std::size_t j = (i + step) % intervals.size();
        const bool first = std::stold(alone[i]) >= std::stold(alone[j]);
        for (const auto& [a, b] : {std::pair{i, j}, {j, i}})
          EXPECT_EQ(bound_of({intervals[a], intervals[b]}), first ? alone[i] : alone[j])
              << k << ": " << i << ' ' << j;
      }
    }
  }
}

/// At 3 radians the bound is 6 - 5 (sin 3 + cos 3), which is known to more digits than are looked at first.
TEST(VerifyShapes, TheBoundIsLookedAtWithAllDigits) {
  Files f = with_intervals({{"0.5", "0.5"}, {"3", "3"}});
  f["gap"] = "9.244362442702891175854139959615755";
  f["upper_bound"] = "10.244362442702891175854139959615755112733729161816613723311017";
  EXPECT_FALSE(has(check(f), "the bound over certificate interval")) << findings(check(f));
  f["upper_bound"] = "10.244362442702891175854139959615755112733729161816613723311016";
  EXPECT_TRUE(has(check(f), "the bound over certificate interval 1")) << findings(check(f));
  // A full circle may begin anywhere.
  f = with_intervals({{"1", "7.3"}});
  f["window_deg"] = "[0, 360]";
  EXPECT_EQ(findings(check(f)), "");
}

/// Some of these fall at their beginning, or rise at their end, and are highest between; they are no narrower
/// than half a turn.
TEST(VerifyShapes, TheBoundOfMoreThanHalfATurnMayLieWithin) {
  Files f = upright_squares();
  f.blank = "[[100, 200], [113, 200], [104, 211]]", f.part = "[[10, 0], [50, 0], [50, 40], [10, 40]]";
  f["inputs"] = inputs_json(4, 3);
  const auto bound_of = [&f](const std::vector<IntervalText>& certificate) {
    f.certificate = certificate;
    const auto report = check(f);
    EXPECT_TRUE(report) << report.error().message;
    return report ? report->bound_high : "";
  };
  for (int k = 0; k < 64; ++k) {
    const std::vector<ContactText> contacts{{std::to_string(k % 4), "0", "0.43"},
                                            {std::to_string(k / 4 % 4), "1", "0"},
                                            {std::to_string(k / 16), "2", "0"}};
    const IntervalText wide = interval("0", "3.95", contacts);
    const std::string alone = bound_of({wide});
    for (const char* within : {"0.4", "0.8", "3.2", "3.6"})
      EXPECT_EQ(bound_of({interval(within, within, contacts), wide}), alone) << k << ' ' << within;
  }
}

TEST(VerifyShapes, TheWorstIntervalIsNamed) {
  Files f = with_intervals({{"0", "0"}, {"0", "0.5"}, {"0.5", "0.5"}});
  f["upper_bound"] = "0.5", f["gap"] = "-0.5";
  EXPECT_TRUE(has(check(f), "the bound over certificate interval 0")) << findings(check(f));
  f.certificate[1].contacts[0].part_vertex = "2";
  EXPECT_TRUE(has(check(f), "the bound over certificate interval 1")) << findings(check(f));
  std::swap(f.certificate[1].contacts, f.certificate[2].contacts);
  EXPECT_TRUE(has(check(f), "the bound over certificate interval 2")) << findings(check(f));
}

}  // namespace
}  // namespace lekalo::verify_shapes_test

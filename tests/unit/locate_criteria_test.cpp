// How a criterion that somebody adds is held to what it may give up, and what the checker says of it.

#include "lekalo/locate/criterion.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "extending/criterion/src/locate/region/criterion_left.cpp"  // the addition of that test, unlisted
#include "lekalo/jobs/locate.hpp"
#include "lekalo/jobs/verify.hpp"
#include "support/json.hpp"

namespace lekalo::locate_criteria_test {
namespace {

using cases::Json;
using locate::Choice;
using locate::Placement;

std::string box(int width, int height) {
  const auto line = [](int x0, int y0, int x1, int y1) {
    return Json{{"line", {{"from", {x0, y0}}, {"to", {x1, y1}}}}};
  };
  return Json{{"units", "mm"},
              {"outer",
               {line(0, 0, width, 0), line(width, 0, width, height), line(width, height, 0, height),
                line(0, height, 0, 0)}}}
      .dump();
}

/// A plate with a bore of radius 6, whose middle is 10 from the edge below.
std::string plate() {
  Json made = Json::parse(box(100, 40));
  made["holes"] =
      Json::parse(R"([[{"arc": {"from": [56, 10], "to": [56, 10], "centre": [50, 10], "ccw": true}}]])");
  return made.dump();
}

Result<void> choose_what_is_not_allowed(Choice& choice) {
  const Placement first = choice.pose().at;
  EXPECT_TRUE(choice.allows(first));
  for (const Placement& wrong :
       {Placement{first.x - 30, first.y, first.theta, 0}, Placement{first.x, first.y + 1.5, first.theta, 0},
        Placement{first.x, first.y, first.theta + 0.01, 0}})
    EXPECT_FALSE(choice.take(wrong));
  EXPECT_EQ(choice.pose().at.x, first.x);
  EXPECT_EQ(choice.pose().at.y, first.y);
  EXPECT_EQ(choice.pose().at.theta, first.theta);
  Placement lower = first;
  lower.y -= 0.5;
  EXPECT_TRUE(choice.take(lower));
  return {};
}

/// A part of 4 mm then lies in a corner of the blank, and deeper on the way to its middle.
Result<void> choose_less_than_the_smallest_largest(Choice& choice) {
  LEKALO_CHECK(choice.take_smallest_largest());
  Placement inwards = choice.pose().at;
  inwards.x += inwards.x < 18 ? 1.5 : -1.5;
  inwards.y += inwards.y < 8 ? 1.5 : -1.5;
  EXPECT_FALSE(choice.take(inwards));
  return {};
}

/// A part of 10 mm in a blank of 40 by 20, which stays as it is turned: the margin is 5 wherever x is from 5
/// to 25.
class Criteria : public testing::Test {
 protected:
  Criteria() {
    job_.options.window_to_deg = 0;
    job_.options.give_up = 1;
  }
  [[nodiscard]] Result<jobs::Verified> verified(const std::string& result) const {
    return jobs::verify(
        {"r.json", result},
        [&](const std::string& role, const std::string&) -> Result<std::optional<jobs::File>> {
          return role == "part" ? job_.part : job_.blank;
        });
  }
  jobs::LocateJob job_{.part = {"part.json", box(10, 10)}, .blank = {"blank.json", box(40, 20)}};
};

TEST_F(Criteria, AStrangersChoiceIsHandedOutAndNotCalledConfirmed) {
  job_.options.criterion = locate::criterion_left();
  const auto made = jobs::locate(job_);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_NEAR(made->document.placement.x, 4, 2e-3);
  ASSERT_FALSE(made->document.warnings.empty());
  EXPECT_NE(made->document.warnings.back().find("does not know the criterion left"), std::string::npos);

  const auto report = verified(made->result);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->report.verdict, verify::Verdict::incomplete);
  EXPECT_EQ(Json::parse(report->json)["status"], "incomplete");
  EXPECT_TRUE(
      std::any_of(report->report.notes.begin(), report->report.notes.end(), [](const std::string& note) {
        return note.find("the criterion \"left\" is none that this checker knows") != std::string::npos;
      }));
}

TEST_F(Criteria, AStrangerWhoGivesUpMoreThanTheResultSaysIsRefuted) {
  job_.options.criterion = locate::criterion_left();
  const auto made = jobs::locate(job_);
  ASSERT_TRUE(made) << made.error().message;
  for (const auto& [place, number] : {std::pair{"/demands/give_up", 0.9}, {"/demands/margin_found", 5.2}}) {
    Json lie = Json::parse(made->result);
    lie.at(place) = number;
    const auto report = verified(lie.dump());
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->report.verdict, verify::Verdict::refuted) << place;
  }
}

TEST_F(Criteria, ACriterionThatTakesNothingIsConfirmedWhereTheDemandsAreNotMet) {
  job_.options.min_allowance = 6;  // there are 5
  job_.options.criterion = locate::criterion_left();
  const auto made = jobs::locate(job_);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_LT(made->document.demands->margin, 0);
  const auto report = verified(made->result);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->report.verdict, verify::Verdict::confirmed);
}

TEST_F(Criteria, WhatIsNotAllowedIsNotTaken) {
  job_.options.criterion = {.name = "wrong", .favours = "", .choose = choose_what_is_not_allowed};
  const auto made = jobs::locate(job_);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_FALSE(made->document.demands->second.has_value());
}

TEST_F(Criteria, TheSmallestLargestAllowanceIsKeptByWhoAsksForIt) {
  job_.part.bytes = box(4, 4), job_.options.give_up = 6;
  job_.options.criterion = {.name = "wrong", .favours = "", .choose = choose_less_than_the_smallest_largest};
  const auto made = jobs::locate(job_);
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_TRUE(made->document.demands->second.has_value());
  EXPECT_NEAR(made->document.demands->second->found, 6, 0.02);
  EXPECT_EQ(verified(made->result)->report.verdict, verify::Verdict::incomplete);

  Json lie = Json::parse(made->result);
  lie["demands"]["largest"] = 7;
  EXPECT_EQ(verified(lie.dump())->report.verdict, verify::Verdict::refuted);
}

/// The digits of the bound and of the margin that follows from it once decided whether the checker saw that
/// it follows.
TEST_F(Criteria, DemandsThatCannotBeMetAreProvedWhateverTheirDigitsAre) {
  job_.options.criterion = *locate::criterion_named("even");
  for (int k = 1; k <= 40; ++k) {
    job_.options.min_allowance = 5 + 0.0137 * k;
    const auto made = jobs::locate(job_);
    ASSERT_TRUE(made) << job_.options.min_allowance << ": " << made.error().message;
    EXPECT_EQ(made->document.status, "infeasible");
  }
}

/// The minimum of 15 about the bore reaches 11 beyond the edge below it.
TEST_F(Criteria, AMinimumLargerThanTheWallBesideItIsMet) {
  job_.part.bytes = plate(), job_.blank.bytes = box(120, 60);
  job_.features = jobs::File{
      "f.json",
      R"({"units": "mm", "minimum": 1, "features": [{"name": "bore", "contour": 1, "minimum": 15}]})"};
  const auto made = jobs::locate(job_);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->document.status, "optimal");
  EXPECT_NEAR(made->document.demands->margin, 4, 1e-3);
  EXPECT_NEAR(made->document.placement.y, 15, 1e-3);

  // What is missing counts beyond the wall too, and the checker agrees.
  for (const char* const minimum : {"40", "100", "3600", "10000", "100000"}) {
    job_.features->bytes =
        std::string(
            R"({"units": "mm", "minimum": 1, "features": [{"name": "bore", "contour": 1, "minimum": )") +
        minimum + "}]}";
    const auto missing = jobs::locate(job_);
    ASSERT_TRUE(missing) << minimum << ": " << missing.error().message;
    EXPECT_EQ(missing->document.status, "infeasible") << minimum;
  }
}

/// A finished feature takes its rim off the part, and what is left bounds no margin by itself.
TEST_F(Criteria, FinishedFeaturesHaveAProofEvenWhereTheWorkEndsAtOnce) {
  job_.part.bytes = plate(), job_.blank.bytes = box(120, 60);
  job_.features = jobs::File{
      "f.json",
      R"({"units": "mm", "minimum": 0, "features": [{"name": "bore", "contour": 1, "finished": 1}]})"};
  RunControl run;
  run.work_limit = 1;
  const auto made = jobs::locate(job_, run);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->document.status, "stopped");
  EXPECT_GE(made->document.demands->margin_bound, 30);
}

/// The rim of a finished edge takes the ends of the edges beside it off what is searched, and they were
/// forgotten where more was missing at them.
TEST_F(Criteria, WhatIsMissingAtTheEndsOfEdgesBesideAFinishedOneCounts) {
  job_.part.bytes = box(30, 30), job_.blank.bytes = box(28, 60);
  job_.features = jobs::File{
      "f.json", R"({"units": "mm", "features": [{"name": "right", "edges": [1], "finished": 0.5}]})"};
  const auto made = jobs::locate(job_);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->document.status, "infeasible");
  EXPECT_GE(made->document.shortfall, 1);
}

/// Steps that nothing says anything about led to an angle that was no number.
TEST_F(Criteria, APartThatIsAllFinishedLiesAsEvenlyAsItLies) {
  job_.part.bytes = job_.blank.bytes = box(10, 10);
  job_.features =
      jobs::File{"f.json", R"({"features": [{"name": "all", "edges": [0, 1, 2, 3], "finished": 1}]})"};
  job_.options.criterion = *locate::criterion_named("even");
  job_.options.window_to_deg = 1;
  const auto made = jobs::locate(job_);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_GE(made->document.demands->margin, 0);
}

/// The part's origin, about which it turns then, lies in the rims of two edges, and no placement is near
/// enough to be searched. The checker looked for the material behind one rim at a time.
TEST_F(Criteria, ALockedPartMayTurnAboutACornerThatIsFinished) {
  job_.features = jobs::File{
      "f.json",
      R"({"features": [{"name": "corner", "edges": [0], "finished": 2}, {"name": "left", "edges": [3], "finished": 1}]})"};
  job_.options.locked.x = 15;
  const auto made = jobs::locate(job_);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->document.status, "infeasible");
}

/// Beside its blank, which it touches, a part was taken to lie inside: the one point that was asked lies on
/// the outline.
TEST_F(Criteria, APartThatTouchesItsBlankFromOutsideDoesNotLieInIt) {
  job_.part.bytes =
      R"({"outer": [{"line": {"from": [0, 0], "to": [99.5, 0]}}, {"line": {"from": [99.5, 0], "to": [99.5, 9.25]}},
      {"line": {"from": [99.5, 9.25], "to": [24.875, 9.25]}}, {"line": {"from": [24.875, 9.25], "to": [24.875, 18.5]}},
      {"line": {"from": [24.875, 18.5], "to": [0, 18.5]}}, {"line": {"from": [0, 18.5], "to": [0, 0]}}]})";
  job_.blank.bytes =
      R"({"outer": [{"line": {"from": [0, 0], "to": [99.5, 0]}}, {"line": {"from": [99.5, 0], "to": [99.5, 58.5]}},
      {"line": {"from": [99.5, 58.5], "to": [0, 58.5]}}, {"line": {"from": [0, 58.5], "to": [0, 0]}}]})";
  job_.features = jobs::File{
      "f.json",
      R"({"features": [{"name": "thin", "edges": [0, 1, 2, 3], "maximum": 0.001}, {"name": "left", "edges": [5], "scale": 2}]})"};
  job_.options.locked.x = 0;
  job_.options.window_to_deg = 360;
  RunControl run;
  run.work_limit = 1000;
  const auto made = jobs::locate(job_, run);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_LT(made->document.placement.clearance, 0);
}

/// The search places a part that touches its blank to some last digits, and the checker encloses what sticks
/// out to 1e-9 mm.
TEST_F(Criteria, OfATurnedPartThatTouchesNoMoreIsClaimedThanTheCheckerProves) {
  job_.part.bytes =
      R"({"outer": [{"line": {"from": [0, 0], "to": [20.73111960320265, 28.817888194621528]}},
      {"line": {"from": [20.73111960320265, 28.817888194621528], "to": [10.583975872702112, 36.117578195749225]}},
      {"line": {"from": [10.583975872702112, 36.117578195749225], "to": [0.21841607110078698, 21.70863409843846]}},
      {"line": {"from": [0.21841607110078698, 21.70863409843846], "to": [7.8287738689761905, 16.233866597592687]}},
      {"line": {"from": [7.8287738689761905, 16.233866597592687], "to": [2.645993968175528, 9.029394548937306]}},
      {"line": {"from": [2.645993968175528, 9.029394548937306], "to": [-4.9643638296998756, 14.504162049783076]}},
      {"line": {"from": [-4.9643638296998756, 14.504162049783076], "to": [-10.147143730500538, 7.299690001127694]}},
      {"line": {"from": [-10.147143730500538, 7.299690001127694], "to": [0, 0]}}]})";
  job_.blank.bytes =
      R"({"outer": [{"line": {"from": [0, 0], "to": [36.5, 0]}}, {"line": {"from": [36.5, 0], "to": [36.5, 20.222254376098473]}},
      {"line": {"from": [36.5, 20.222254376098473], "to": [0, 20.222254376098473]}},
      {"line": {"from": [0, 20.222254376098473], "to": [0, 0]}}]})";
  job_.features =
      jobs::File{"f.json", R"({"features": [{"name": "notch", "edges": [3, 4, 5, 6], "minimum": 0.001}]})"};
  job_.options.locked.x = 0;
  job_.options.window_from_deg = -57.269374455428462, job_.options.window_to_deg = -51.269374455428462;
  RunControl run;
  run.work_limit = 100;
  const auto made = jobs::locate(job_, run);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_NEAR(made->document.placement.clearance, -1e-9, 1e-10);
}

TEST_F(Criteria, TheFirstOfTheListDoesNotGoOnAndAllOthersDo) {
  for (const locate::Criterion& criterion : locate::criteria()) {
    EXPECT_EQ(criterion.choose == nullptr, &criterion == &locate::criteria().front()) << criterion.name;
    EXPECT_EQ(locate::criterion_named(criterion.name), &criterion);
  }
  EXPECT_EQ(locate::criterion_named("none such"), nullptr);
}

TEST_F(Criteria, TheCheckerAndTheListUseTheSameWords) {
  for (const char* const name : {"smallest", "largest", "even"}) {
    EXPECT_NE(locate::criterion_named(name), nullptr) << name;
    EXPECT_TRUE(verify::knows_criterion(name)) << name;
  }
  EXPECT_FALSE(verify::knows_criterion(""));
  EXPECT_FALSE(verify::knows_criterion("Largest"));
}

}  // namespace
}  // namespace lekalo::locate_criteria_test

#include "lekalo/locate/locate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "support/cases.hpp"

namespace lekalo::locate::locate_test {
namespace {

geom::Ring rectangle(double width, double height) {
  return {{0, 0}, {width, 0}, {width, height}, {0, height}};
}

/// The outline as regions and as a convex polygon.
Outline outline(const geom::Ring& ring) {
  geom::Contour outer;
  for (std::size_t k = 0; k < ring.size(); ++k)
    outer.push_back({geom::EdgeKind::line, ring[k], ring[(k + 1) % ring.size()], {}});
  Outline both;
  both.regions.push_back(*geom::make_region(std::move(outer)));
  both.convex = ConvexOutline{cases::convex(ring), 0, {}, {}};
  return both;
}

/// A plate with 5 mm of material all round, also turned by 180 degrees.
Problem plate() { return {outline(rectangle(80, 40)), outline(rectangle(90, 50)), {}, Mirror::no, {}, {}}; }

/// Found fast enough for a test.
Options coarse() {
  Options options;
  options.gap = 0.05;
  return options;
}

Found found(const Problem& problem, const Options& options) {
  Result<Found> result = locate(problem, options);
  EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().message);
  return result ? std::move(*result) : Found{};
}

TEST(Locate, TwoConvexOutlinesTakeTheFastPath) {
  EXPECT_TRUE(is_convex(plate()));
  const Found result = found(plate(), {});
  EXPECT_EQ(result.status, Status::optimal);
  EXPECT_NEAR(result.best.clearance, 5, 1e-9);
  ASSERT_TRUE(result.upper_bound.has_value());
  EXPECT_GE(*result.upper_bound, 5);
  EXPECT_LE(*result.upper_bound - result.best.clearance, 1e-9);
  ASSERT_TRUE(std::holds_alternative<AngleProof>(result.proof));
  EXPECT_FALSE(std::get<AngleProof>(result.proof).intervals.empty());
  EXPECT_FALSE(result.mirrored);
  EXPECT_FALSE(result.demands.has_value());
}

TEST(Locate, WhatTheFastPathDoesNotTakeGoesToTheSearchOfRegions) {
  const std::function<void(Problem&)> changes[] = {
      [](Problem& p) { p.part.convex.reset(); },  [](Problem& p) { p.blank.convex.reset(); },
      [](Problem& p) { p.mirror = Mirror::yes; }, [](Problem& p) { p.mirror = Mirror::either; },
      [](Problem& p) { p.locked.x = 5; },         [](Problem& p) { p.locked.y = 5; }};
  for (std::size_t k = 0; k < std::size(changes); ++k) {
    Problem problem = plate();
    problem.window = {0, 0};
    changes[k](problem);
    EXPECT_FALSE(is_convex(problem)) << k;
    const Found result = found(problem, coarse());
    EXPECT_EQ(result.status, Status::optimal) << k;
    EXPECT_NEAR(result.best.clearance, 5, 0.05) << k;
    EXPECT_GE(result.upper_bound.value_or(0), 5) << k;
    EXPECT_EQ(result.mirrored, problem.mirror == Mirror::yes) << k;
    ASSERT_TRUE(std::holds_alternative<PoseProof>(result.proof)) << k;
    EXPECT_FALSE(std::get<PoseProof>(result.proof).trees.empty()) << k;
  }
}

TEST(Locate, WhatIsLockedStaysWhereItIs) {
  Problem problem = plate();
  problem.window = {0, 0};
  problem.locked = {3.0, 4.0};
  const Found result = found(problem, coarse());
  EXPECT_EQ(result.best.x, 3);
  EXPECT_EQ(result.best.y, 4);
  EXPECT_NEAR(result.best.clearance, 3, 1e-9);
}

TEST(Locate, ContactsAndProofHaveTheNumbersOfTheOutlines) {
  Problem problem = plate();
  const Found plain = found(problem, {});
  problem.part.convex->vertex_numbers = {10, 11, 12, 13};
  problem.blank.convex->edge_numbers = {23, 22, 21, 20};
  const Found named = found(problem, {});
  ASSERT_GE(plain.contacts.size(), 2U);
  ASSERT_EQ(named.contacts.size(), plain.contacts.size());
  for (std::size_t k = 0; k < plain.contacts.size(); ++k) {
    EXPECT_EQ(named.contacts[k].part_edge, 10 + plain.contacts[k].part_edge);
    EXPECT_EQ(named.contacts[k].blank_edge, 23 - plain.contacts[k].blank_edge);
    EXPECT_EQ(named.contacts[k].part, plain.contacts[k].part);
  }
  const auto &first = std::get<AngleProof>(plain.proof), &second = std::get<AngleProof>(named.proof);
  ASSERT_EQ(first.intervals.size(), second.intervals.size());
  for (std::size_t k = 0; k < first.intervals.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(second.intervals[k].contacts[c].part_vertex, 10 + first.intervals[k].contacts[c].part_vertex);
      EXPECT_EQ(second.intervals[k].contacts[c].blank_edge, 23 - first.intervals[k].contacts[c].blank_edge);
    }
}

TEST(Locate, TheErrorsOfTheOutlinesAreTakenOffOnBothPaths) {
  Problem problem = plate();
  problem.window = {0, 0};
  problem.part.convex->coordinate_error = 0.25, problem.part.tolerance = 0.25;
  EXPECT_LT(found(problem, {}).best.clearance, 4.76);
  problem.blank.convex.reset();
  const Found result = found(problem, coarse());
  EXPECT_LT(result.best.clearance, 4.76);
  EXPECT_GE(result.upper_bound.value_or(0), 5);
}

TEST(Locate, AlternativesAreListedForConvexOutlinesAndElseRefused) {
  Problem problem = plate();
  Options options;
  options.alternatives = 0.5;
  const Found result = found(problem, options);
  ASSERT_FALSE(result.alternatives.empty());
  EXPECT_NEAR(result.alternatives[0].clearance, 5, 0.5);
  EXPECT_NEAR(std::abs(std::remainder(result.alternatives[0].theta - result.best.theta, kTurn)), kPi, 0.1);
  problem.part.convex.reset();
  const Result<Found> refused = locate(problem, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
  EXPECT_NE(refused.error().message.find("alternatives"), std::string::npos);
}

TEST(Locate, AnAllowanceOutOfReachIsProvedSoOnBothPaths) {
  Problem problem = plate();
  problem.window = {0, 0};
  Options options = coarse();
  options.min_allowance = 7;
  const Found fast = found(problem, options);
  EXPECT_EQ(fast.status, Status::infeasible);
  EXPECT_GE(fast.shortfall, 2);
  EXPECT_TRUE(std::holds_alternative<AngleProof>(fast.proof));
  problem.blank.convex.reset();
  const Found slow = found(problem, options);
  EXPECT_EQ(slow.status, Status::infeasible);
  EXPECT_GE(slow.shortfall, 2);
  EXPECT_LT(slow.upper_bound.value_or(7), 7);
}

TEST(Locate, DemandsAreMetAndTheirProofIsTheProof) {
  Problem problem = plate();
  problem.window = {0, 0};
  problem.blank = outline(rectangle(90, 80));  // above and below there is more than enough
  problem.demands.emplace();
  problem.demands->minimum = 1;
  problem.demands->features.push_back({"left", {3}, 6, {}, {}, 1, {}});
  EXPECT_FALSE(is_convex(problem));
  const Found result = found(problem, coarse());
  EXPECT_EQ(result.status, Status::optimal);
  EXPECT_EQ(result.shortfall, 0);
  EXPECT_FALSE(result.upper_bound.has_value());
  ASSERT_TRUE(result.demands.has_value());
  // Of the 10 mm in x the left edge has 6 as its demand, the right one 1: each has 1.5 more at most.
  EXPECT_NEAR(result.demands->margin, 1.5, 0.05);
  EXPECT_NEAR(result.best.x, 7.5, 0.1);
  EXPECT_FALSE(std::get<PoseProof>(result.proof).trees.empty());
  EXPECT_TRUE(result.demands->proof.certificate.empty());
  EXPECT_FALSE(result.contacts.empty());
  EXPECT_TRUE(result.demands->contacts.empty());

  problem.demands->features[0].minimum = 11;
  const Found missed = found(problem, coarse());
  EXPECT_EQ(missed.status, Status::infeasible);
  EXPECT_NEAR(missed.shortfall, 1, 0.05);
}

TEST(Locate, WhatTheSearchBeneathRefusesComesBackOnEveryPath) {
  const auto refused = [](const Problem& problem, const Options& options) {
    const Result<Found> result = locate(problem, options);
    return !result && result.error().code == ErrorCode::usage;
  };
  Options options;
  options.gap = 0;
  Problem fast = plate(), slow = plate(), demanding = plate();
  slow.mirror = Mirror::yes;
  demanding.demands.emplace();
  EXPECT_TRUE(refused(fast, options));
  EXPECT_TRUE(refused(slow, options));
  EXPECT_TRUE(refused(demanding, options));
  demanding.demands->minimum = -1;
  EXPECT_TRUE(refused(demanding, coarse()));
  fast.window = slow.window = {1, 0};
  EXPECT_TRUE(refused(fast, {}));
  EXPECT_TRUE(refused(slow, {}));
}

TEST(Locate, AStoppedSearchHasAPlacementAndABound) {
  const cases::Example example = cases::published_examples()[2];
  Problem problem{
      outline(example.part().vertices()), outline(example.blank().vertices()), {}, Mirror::no, {}, {}};
  Options options;
  options.run.work_limit = 12;
  for (const bool convex : {true, false}) {
    if (!convex) problem.part.convex.reset();
    const Found result = found(problem, options);
    EXPECT_EQ(result.status, Status::stopped) << convex;
    EXPECT_GE(result.upper_bound.value_or(0), example.optimum) << convex;
    EXPECT_LE(result.best.clearance, example.optimum + 1e-9) << convex;
  }
}

}  // namespace
}  // namespace lekalo::locate::locate_test

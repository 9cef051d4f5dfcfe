// Results by demands and more than one criterion through the written document and the checker, which shares
// no code with the solver.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/locate/demand.hpp"
#include "lekalo/verify/verify.hpp"
#include "support/region_cases.hpp"

namespace lekalo::locate_demands_verify_test {
namespace {

using locate::criterion_named;

io::LocateDocument document_of(const locate::DemandProblem& problem, const locate::DemandResult& r) {
  io::LocateDocument d;
  d.status = r.status == locate::Status::optimal   ? "optimal"
             : r.status == locate::Status::stopped ? "stopped"
                                                   : "infeasible";
  d.method = "certified";
  d.inputs = {{"part", {"part.json", ""}, std::nullopt, 0, {}},
              {"blank", {"blank.json", ""}, std::nullopt, 0, {}}};
  d.placement = r.best;
  d.shortfall = std::max(0.0, -r.margin);
  const locate::RegionProblem& shapes = problem.shapes;
  io::DemandRecord demands;
  demands.minimum = problem.minimum, demands.features = problem.features;
  demands.criterion = problem.criterion, demands.give_up = problem.give_up;
  demands.margin = r.margin, demands.margin_bound = r.margin_bound, demands.margin_found = r.margin_found;
  demands.margin_gap = r.margin_gap, demands.largest = r.largest, demands.second = r.second;
  demands.deviation = r.deviation, demands.curve = r.curve;
  demands.grown_for = r.proof.grown_for, demands.shift = r.proof.shift, demands.bound = r.proof.bound;
  d.part = shapes.part, d.part_tolerance = shapes.part_tolerance;
  d.blank = shapes.blank, d.blank_tolerance = shapes.blank_tolerance;
  d.mirror = shapes.mirror, d.mirrored = r.mirrored, d.locked = shapes.locked;
  d.contacts = r.contacts;
  d.proof = locate::PoseProof{r.proof.pivot, r.proof.certificate};
  d.demands = std::move(demands);
  constexpr double kDegrees = 57.29577951308232;
  // A little less than was searched: degrees are rounded.
  d.window_from_deg = shapes.window.from * kDegrees + 1e-9;
  d.window_to_deg = shapes.window.to * kDegrees - 1e-9;
  return d;
}

/// The file of features that makes these demands.
std::string feature_file(const io::DemandRecord& demands) {
  using Json = nlohmann::json;
  Json file{{"units", "mm"}, {"minimum", demands.minimum}, {"features", Json::array()}};
  for (const locate::Feature& f : demands.features) {
    Json one{{"name", f.name}, {"edges", f.edges}, {"minimum", f.minimum}, {"scale", f.scale}};
    if (f.target) one["target"] = *f.target;
    if (f.maximum) one["maximum"] = *f.maximum;
    file["features"].push_back(std::move(one));
  }
  return file.dump();
}

verify::LocateReport checked(const io::LocateDocument& document) {
  const std::string text = io::result_json(document), features = feature_file(*document.demands),
                    part = io::regions_json(document.part), blank = io::regions_json(document.blank);
  const auto report = verify::verify_locate({{"result.json", text},
                                             {"part.json", part},
                                             {"blank.json", blank},
                                             std::nullopt,
                                             verify::Document{"features.json", features}});
  EXPECT_TRUE(report.has_value()) << (report ? "" : report.error().message);
  return report.value_or(verify::LocateReport{});
}

std::string findings(const verify::LocateReport& report) {
  std::string all;
  for (const std::string& finding : report.findings) all += finding + "\n";
  return all;
}

/// The first half of the outer edges and the holes, with demands that change from case to case.
locate::DemandProblem problem_of(const cases::RegionCase& one, std::size_t i) {
  locate::DemandProblem problem;
  problem.shapes.part = one.part, problem.shapes.blank = one.blank;
  problem.shapes.window = {one.theta - 0.2, one.theta + 0.2};
  if (i % 3 == 1) problem.shapes.part_tolerance = 1e-3, problem.shapes.blank_tolerance = 2e-3;
  if (i % 4 == 3) problem.shapes.mirror = locate::Mirror::either;
  locate::Feature side{"side", {}, 0.05, 0.5, {}, i % 2 == 0 ? 1.0 : 2.5, {}};
  for (std::uint32_t k = 0; k < one.part[0].outer.size() / 2; ++k) side.edges.push_back(k);
  if (i % 5 != 4) problem.features = {side};
  problem.criterion = i % 2 == 0 ? *criterion_named("largest") : *criterion_named("even");
  return problem;
}

TEST(LocateDemandsAndVerify, EveryBoundOfLargestAllowancesIsConfirmedAndNoHigherOne) {
  const std::size_t count = std::min<std::size_t>(cases::region_case_count(1), 12);
  std::size_t with_maximum = 0;
  for (std::size_t i = 0; i < 2 * count; ++i) {
    const cases::RegionCase one = cases::region_case(
        cases::seed() + 7, i, i % 2 == 0 ? cases::RegionKind::rounded : cases::RegionKind::near_net, 16);
    SCOPED_TRACE(one.name);
    locate::DemandProblem problem = problem_of(one, i);
    locate::RegionOptions options;
    options.gap = 2e-3;
    options.run.work_limit = 300'000;
    const auto first = locate::locate_demands(problem, options);
    ASSERT_TRUE(first.has_value()) << first.error().message;
    if (first->margin < 0) continue;
    problem.give_up = 0.3 * first->margin;
    if (!problem.features.empty() && i % 2 == 1) {
      problem.features[0].maximum = first->largest + 0.01;
      ++with_maximum;
    }
    const auto result = locate::locate_demands(problem, options);
    ASSERT_TRUE(result.has_value()) << result.error().message;
    ASSERT_TRUE(result->second.has_value());
    const io::LocateDocument document = document_of(problem, *result);
    const verify::LocateReport report = checked(document);
    EXPECT_EQ(report.verdict, verify::Verdict::confirmed) << findings(report);
    const locate::SmallestLargest& second = *result->second;
    ASSERT_TRUE(second.proof.has_value());

    if (i % 4 > 1) continue;  // reading long certificates again and again only costs time
    const auto refuted = [&](const std::function<void(io::LocateDocument&, locate::SmallestLargest&)>& lie) {
      io::LocateDocument wrong = document;
      lie(wrong, *wrong.demands->second);
      return checked(wrong).verdict == verify::Verdict::refuted;
    };
    // A cap as high as what was found is kept by the placement found: no tree proves the contrary.
    const double more = second.found - second.bound + 0.01;
    EXPECT_TRUE(refuted([&](auto&, auto& s) { s.bound = s.found; }) || second.bound == second.found);
    EXPECT_TRUE(refuted([&](auto&, auto& s) {
      s.proof->most += more;
      s.found += more, s.bound += more, s.kept = std::max(s.found, s.bound + s.gap);
    }));
    EXPECT_TRUE(refuted([&](auto&, auto& s) { s.proof->shift += 0.1, s.bound += 0.05, s.found += 0.1; }));
    EXPECT_TRUE(refuted([&](auto&, auto& s) { s.proof->bound -= 0.05; }));
    EXPECT_TRUE(refuted([&](auto&, auto& s) { s.proof->grown_for += 0.5; }));
    // More than the certificate says, and all else as it then would be.
    EXPECT_TRUE(refuted([&](auto&, auto& s) {
                  s.bound += 0.5 * (s.found - s.bound), s.kept = std::max(s.found, s.bound + s.gap);
                }) ||
                second.bound == second.found);
    // With less left of a maximum than it allows, fewer placements have to be excluded.
    if (i % 2 == 1 && !problem.features.empty()) {
      const double spare = second.proof->shift - second.proof->bound + 1e-9;
      EXPECT_TRUE(refuted([&](auto&, auto& s) { s.proof->shift -= spare, s.proof->most += spare; }));
    }
    // The bound is one for placements with that margin, and not for those with less.
    EXPECT_TRUE(refuted(
        [&](auto& d, auto& s) { d.demands->give_up += 0.1, s.margin = std::max(0.0, s.margin - 0.1); }));
    EXPECT_TRUE(refuted([&](auto&, auto& s) {
      for (locate::CoverTree& tree : s.proof->certificate) tree.nodes = {tree.nodes.back()};
    }));
    EXPECT_TRUE(refuted(
        [&](auto& d, auto& s) { s.proof->certificate = std::get<locate::PoseProof>(d.proof).trees; }));
    EXPECT_TRUE(refuted([&](auto& d, auto& s) { d.demands->largest = s.kept + 0.001; }));
    io::LocateDocument without = document;
    without.demands->second->proof->certificate.clear();
    EXPECT_EQ(checked(without).verdict, verify::Verdict::unproved);
  }
  EXPECT_GT(with_maximum, 0U);
}

}  // namespace
}  // namespace lekalo::locate_demands_verify_test

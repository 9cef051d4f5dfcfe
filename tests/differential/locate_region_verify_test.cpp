// Results for regions through the written document and the checker, which shares no code with the solver.

#include <gtest/gtest.h>

#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/locate/region.hpp"
#include "lekalo/verify/verify.hpp"
#include "support/region_cases.hpp"

namespace lekalo::locate_region_verify_test {
namespace {

io::LocateDocument document_of(const cases::RegionCase& one, const locate::RegionResult& result) {
  io::LocateDocument d;
  d.status = result.status == locate::Status::optimal   ? "optimal"
             : result.status == locate::Status::stopped ? "stopped"
                                                        : "infeasible";
  d.method = "certified";
  d.inputs = {{"part", {"part.json", ""}, std::nullopt, 0, {}},
              {"blank", {"blank.json", ""}, std::nullopt, 0, {}}};
  d.placement = result.best;
  d.upper_bound = result.upper_bound;
  d.shortfall = result.shortfall;
  d.part = one.part, d.blank = one.blank;
  d.mirrored = result.mirrored;
  d.contacts = result.contacts;
  d.proof = locate::PoseProof{result.pivot, result.certificate};
  return d;
}

verify::LocateReport checked(const io::LocateDocument& document) {
  const std::string text = io::result_json(document);
  const std::string part = io::regions_json(document.part), blank = io::regions_json(document.blank);
  const auto report = verify::verify_locate(
      {{"result.json", text}, {"part.json", part}, {"blank.json", blank}, std::nullopt});
  EXPECT_TRUE(report.has_value()) << (report ? "" : report.error().message);
  return report.value_or(verify::LocateReport{});
}

TEST(LocateRegionsAndVerify, TheCheckerConfirmsEveryRandomCase) {
  const std::size_t count = cases::region_case_count(4);
  for (const cases::RegionKind kind : cases::kRegionKinds) {
    for (std::size_t i = 0; i < count; ++i) {
      const cases::RegionCase one = cases::region_case(cases::seed() + 1, i, kind, 24);
      SCOPED_TRACE(one.name);
      locate::RegionOptions options;
      options.run.work_limit = 60'000;
      const auto result =
          locate::locate_regions({one.part, one.blank, {}, locate::Mirror::no, 0, 0}, options);
      ASSERT_TRUE(result.has_value());
      const io::LocateDocument document = document_of(one, *result);
      const verify::LocateReport report = checked(document);
      EXPECT_EQ(report.verdict, verify::Verdict::confirmed)
          << (report.findings.empty() ? "" : report.findings.front());
      // What is not true is not confirmed. (Reading long certificates again and again only costs time.)
      if (result->certificate[0].nodes.size() > 5000) continue;
      io::LocateDocument wrong = document;
      wrong.placement.clearance += 1e-9;
      EXPECT_EQ(checked(wrong).verdict, verify::Verdict::refuted);
      wrong = document;
      wrong.upper_bound = *wrong.upper_bound - 0.01;
      EXPECT_EQ(checked(wrong).verdict, verify::Verdict::refuted);
      // A lower bound proved by balls that are not what they are said to be.
      for (const bool of_part : {false, true}) {
        wrong = document;
        *wrong.upper_bound -= 0.01;
        for (locate::BallTerm& term : std::get<locate::PoseProof>(wrong.proof).trees[0].terms)
          (of_part ? term.part_radius : term.blank_radius) += 5;
        EXPECT_EQ(checked(wrong).verdict, verify::Verdict::refuted);
      }
      // One leaf made to stand for all poses.
      wrong = document;
      auto& nodes = std::get<locate::PoseProof>(wrong.proof).trees[0].nodes;
      ASSERT_GT(nodes.size(), 2u);
      nodes = {nodes.back()};
      EXPECT_EQ(checked(wrong).verdict, verify::Verdict::refuted);
    }
  }
}

}  // namespace
}  // namespace lekalo::locate_region_verify_test

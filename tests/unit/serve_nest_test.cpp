#include <gtest/gtest.h>

#include <atomic>

#include "lekalo/layout/check.hpp"
#include "lekalo/layout/command.hpp"
#include "server/nest_job.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::server::serve_nest_test {
namespace {

/// A sheet of 100 with squares of 10 at (20, 40) and (60, 40), and six wanted in all.
layout::Document wanted_squares() {
  layout::Document document = cases::two_squares();
  document.parts[0].demand = 6;
  return document;
}

std::string refusal(const std::string& line) {
  const auto request = nest_request(line, wanted_squares());
  return request && !*request ? request->error().message : "";
}

TEST(NestRequest, IsReadAndWritten) {
  const layout::Document document = wanted_squares();
  const NestRequest whole = nest_request("nest for 2.5", document)->value();
  EXPECT_EQ(whole, (NestRequest{{}, 2.5, 0}));
  const NestRequest some = nest_request("nest  2,1,2 for 60 seed 3", document)->value();
  EXPECT_EQ(some, (NestRequest{{1, 2}, 60, 3}));
  for (const NestRequest& request : {whole, some})
    EXPECT_EQ(nest_request(to_text(request), document)->value(), request);
  EXPECT_FALSE(nest_request("nearest 1 by 0 0", document));
  EXPECT_FALSE(nest_request("", document));
}

TEST(NestRequest, IsRefusedByItsWord) {
  EXPECT_NE(refusal("nest").find("for SECONDS"), std::string::npos);
  EXPECT_NE(refusal("nest for 0").find("0.1 to 3600"), std::string::npos);
  EXPECT_NE(refusal("nest for nan").find("0.1 to 3600"), std::string::npos);
  EXPECT_NE(refusal("nest 1,,2 for 1").find("''"), std::string::npos);
  EXPECT_NE(refusal("nest 1 for 1 seeds 2").find("'seeds'"), std::string::npos);
  EXPECT_NE(refusal("nest 1 for 1 seed -2").find("seed"), std::string::npos);
  EXPECT_NE(refusal("nest 9 for 1").find("no placement 9"), std::string::npos);
  layout::Document document = wanted_squares();
  document.placements[1].locked = true;
  const auto locked = nest_request("nest 1,2 for 1", document);
  ASSERT_FALSE(*locked);
  EXPECT_NE(locked->error().message.find("2 is locked"), std::string::npos);
}

TEST(NestJob, OfTheWholeLayoutAddsWhatIsWantedAndTellsOfIt) {
  const layout::Document document = wanted_squares();
  std::atomic<bool> stop{false};
  JobContext context;
  context.run.stop = &stop;
  std::vector<layout::Change> better;
  context.improved = [&](const layout::Change& change) {
    better.push_back(change);
    stop = true;
  };
  const auto change = job_of(NestRequest{{}, 600, 0})(document, context);
  ASSERT_TRUE(change) << change.error().message;
  ASSERT_FALSE(better.empty());
  EXPECT_EQ(*change, better.back()) << "stopped, it keeps the best it told of";
  layout::Document after = document;
  layout::carry_out(after, *change);
  EXPECT_EQ(after.placements.size(), 6u);
  EXPECT_TRUE(layout::check(after).empty());
}

TEST(NestJob, OfASelectionMovesNothingElseAndAddsNothing) {
  layout::Document document = wanted_squares();
  document.placements.push_back(document.placements[0]);
  document.placements[2].id = document.next_id++;
  document.placements[2].at.y -= geom::grid_from_mm(30);
  std::atomic<bool> stop{false};
  JobContext context;
  context.run.stop = &stop;
  context.improved = [&](const layout::Change& better) { stop = stop || !better.is_nothing(); };
  const auto change = job_of(NestRequest{{2}, 600, 0})(document, context);
  ASSERT_TRUE(change) << change.error().message;
  ASSERT_EQ(change->placements.size(), 1u);
  EXPECT_EQ(change->placements[0].before, document.placements[1]);
  ASSERT_TRUE(change->placements[0].after);
  EXPECT_EQ(change->placements[0].after->id, 2u);
  EXPECT_FALSE(change->placements[0].after->locked);
}

TEST(NestJob, SaysWhatKeepsItFromBeginning) {
  layout::Document document = wanted_squares();
  document.placements[1].at = document.placements[0].at;
  document.placements[0].locked = document.placements[1].locked = true;
  const auto change = job_of(NestRequest{{}, 1, 0})(document, {});
  ASSERT_FALSE(change);
  EXPECT_NE(change.error().message.find("which is to stay"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::server::serve_nest_test

#include "lekalo/base/stop.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

#include "lekalo/base/parallel.hpp"

namespace lekalo::base_stop_test {
namespace {

/// Asks so often, and says how often it came back.
std::uint64_t asked(std::uint64_t times) {
  std::uint64_t done = 0;
  for (; done < times; ++done) ask();
  return done;
}

TEST(Stop, WithoutAnyoneToListenToNothingEnds) { EXPECT_EQ(asked(1'000'000), 1'000'000u); }

TEST(Stop, AJobThatNobodyStopsGivesWhatItReturns) {
  const auto done = stoppable({}, [] { return asked(100'000); });
  ASSERT_TRUE(done);
  EXPECT_EQ(*done, 100'000u);
}

TEST(Stop, AFlagThatIsSetEndsAJobBeforeItBegins) {
  const std::atomic<bool> stop{true};
  RunControl run;
  run.stop = &stop;
  bool begun = false;
  const auto done = stoppable(run, [&] { return begun = true; });
  ASSERT_FALSE(done);
  EXPECT_FALSE(begun);
  EXPECT_FALSE(done.error().out_of_work());
  EXPECT_NE(std::string(done.error().what()).find("nothing was written"), std::string::npos);
}

TEST(Stop, AFlagIsSeenWithinAFewThousandSteps) {
  std::atomic<bool> stop{false};
  RunControl run;
  run.stop = &stop;
  std::uint64_t after = 0;
  const auto done = stoppable(run, [&] {
    asked(12'345);
    stop = true;
    for (; after < 1'000'000; ++after) ask();
    return 0;
  });
  EXPECT_FALSE(done);
  EXPECT_LE(after, 4096u);
}

TEST(Stop, TheWorkLimitEndsAJobAtTheVeryStep) {
  for (const std::uint64_t limit : {0U, 1U, 2047U, 2048U, 2049U, 100'000U}) {
    RunControl run;
    run.work_limit = limit;
    EXPECT_TRUE(stoppable(run, [&] { return asked(limit); })) << limit;
    const auto more = stoppable(run, [&] { return asked(limit + 1); });
    ASSERT_FALSE(more) << limit;
    EXPECT_TRUE(more.error().out_of_work());
    EXPECT_NE(std::string(more.error().what()).find(std::to_string(limit)), std::string::npos);
  }
}

TEST(Stop, StepsOfAllSizesCount) {
  RunControl run;
  run.work_limit = 100;
  EXPECT_TRUE(stoppable(run, [] { return (ask(60), ask(40), 0); }));
  EXPECT_FALSE(stoppable(run, [] { return (ask(60), ask(41), 0); }));
  EXPECT_FALSE(stoppable(run, [] { return (ask(1ULL << 40), 0); }));
}

TEST(Stop, WhatHasToBeDoneToTheEndIsNotStopped) {
  std::atomic<bool> stop{false};
  RunControl run;
  run.stop = &stop;
  std::uint64_t to_the_end = 0;
  const auto done = stoppable(run, [&] {
    stop = true;
    {
      const RunControl nobody;
      const Listening listening(nobody);
      to_the_end = asked(100'000);
    }
    return asked(100'000);
  });
  EXPECT_FALSE(done);
  EXPECT_EQ(to_the_end, 100'000u);
}

TEST(Stop, ThreadsOfAJobAreStoppedWithIt) {
  std::atomic<bool> stop{false};
  RunControl run;
  run.stop = &stop;
  std::vector<std::uint64_t> done_by(4, 0);
  const auto done = stoppable(run, [&] {
    share_out(done_by.size(), 4, [&](std::size_t i) {
      for (; done_by[i] < 100'000'000; ++done_by[i]) {
        ask();
        if (i == 0 && done_by[i] == 10'000) stop = true;
      }
    });
    return 0;
  });
  EXPECT_FALSE(done);
  for (const std::uint64_t count : done_by) EXPECT_LT(count, 100'000'000u);
}

TEST(Stop, TheWorkOfAllThreadsCountsAndNoneOfAnother) {
  RunControl run;
  run.work_limit = 40'000;
  const auto shared = [&](std::uint64_t each, unsigned threads) {
    return stoppable(run,
                     [&] {
                       share_out(8, threads, [&](std::size_t) { asked(each); });
                       Listening::look();
                       return 0;
                     })
        .has_value();
  };
  for (const unsigned threads : {1U, 2U, 5U, 8U}) {
    EXPECT_TRUE(shared(5000, threads)) << threads;
    EXPECT_FALSE(shared(5001, threads)) << threads;
  }
  EXPECT_EQ(asked(100'000), 100'000u);
}

}  // namespace
}  // namespace lekalo::base_stop_test

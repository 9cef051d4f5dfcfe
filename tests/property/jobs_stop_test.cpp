// One stop for all jobs: a job that is stopped after so many steps of work is stopped soon, leaves nothing
// behind, and one that is not stopped gives what it always gives.

#include <gtest/gtest.h>
#include <pthread.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/disk/open_layout.hpp"
#include "lekalo/jobs/check.hpp"
#include "lekalo/jobs/export.hpp"
#include "lekalo/jobs/locate.hpp"
#include "lekalo/jobs/nest.hpp"
#include "lekalo/jobs/pocket.hpp"
#include "lekalo/jobs/show.hpp"
#include "lekalo/jobs/simulate.hpp"
#include "lekalo/jobs/verify.hpp"
#include "lekalo/layout/check.hpp"
#include "support/cases.hpp"
#include "support/places.hpp"
#include "support/stopwatch.hpp"

namespace lekalo::jobs::jobs_stop_test {
namespace {

File file(const std::string& name) {
  return {name, disk::read_file(cases::source_dir() + "/" + name).value()};
}

/// The jobs take their time, so that many cases are too many.
std::size_t few_cases(std::size_t quick) { return std::min<std::size_t>(cases::case_count(quick), 60); }

struct Named {
  const char* name;
  /// Gives its result as one text.
  std::function<std::string()> run;
};

PocketJob cover() {
  PocketJob job;
  job.pocket = file("examples/pockets/cover.json");
  job.options.path.tool_diameter = 25;
  job.options.path.depth = 2;
  return job;
}

std::vector<Named> jobs_that_stop() {
  const File order = file("examples/orders/brackets.json");
  RunControl little;
  little.work_limit = 1;
  Layout nested;
  nested.name = "nested";
  nested.document = nest(open_layout(order).value().document, {}, little).value().document;
  const std::string program = pocket(cover()).value().program;
  std::vector<Named> jobs;
  jobs.push_back({"open", [=] {
                    return layout_bytes(open_layout({"nested", layout_bytes(nested)}).value());
                  }});
  jobs.push_back({"check", [=] { return check_json(nested, check(nested).value()); }});
  jobs.push_back({"show", [=] { return show_json(nested, show(nested.document)); }});
  jobs.push_back({"picture", [=] {
                    return layout_picture(nested.document, "nested", layout::check(nested.document),
                                          PictureForm::svg)
                        .value();
                  }});
  jobs.push_back({"pocket", [] { return pocket(cover()).value().program; }});
  jobs.push_back({"simulate", [=] {
                    SimulateJob job;
                    job.program = {"p.ngc", program};
                    job.pocket = file("examples/pockets/cover.json");
                    job.machining.tool_diameter = 25;
                    return simulate(job).value().json;
                  }});
  jobs.push_back({"verify", [] {
                    const std::string folder = "tests/corpus/data/written-0.1/";
                    return verify({"convex.json", file(folder + "convex.json").bytes},
                                  [&](const std::string&, const std::string& path) {
                                    return Result<std::optional<File>>(file(folder + path));
                                  })
                        .value()
                        .json;
                  }});
  return jobs;
}

/// The steps of work of a job: the least limit with which it comes to its end.
std::uint64_t steps_of(const std::function<std::string()>& job) {
  std::uint64_t enough = 1024;
  const auto ends = [&](std::uint64_t limit) {
    RunControl run;
    run.work_limit = limit;
    return stoppable(run, job).has_value();
  };
  while (!ends(enough)) enough *= 16;
  return enough;
}

TEST(JobsStop, OneThatIsStoppedAtAnyStepLeavesNothingAndOthersGiveTheSame) {
  Random random(cases::seed());
  for (const Named& job : jobs_that_stop()) {
    SCOPED_TRACE(job.name);
    const std::string whole = job.run();
    const std::uint64_t enough = steps_of(job.run);
    RunControl hardly;
    hardly.work_limit = 100;
    EXPECT_FALSE(stoppable(hardly, job.run)) << "it asks too seldom for this test to say anything";
    for (std::size_t k = 0; k < few_cases(2); ++k) {
      RunControl run;
      run.work_limit = random.below(enough);
      const auto done = stoppable(run, job.run);
      if (done)
        EXPECT_EQ(*done, whole);
      else
        EXPECT_TRUE(done.error().out_of_work());
    }
    EXPECT_EQ(job.run(), whole);
  }
}

double thread_seconds(clockid_t clock) {
  timespec at{};
  clock_gettime(clock, &at);
  return static_cast<double>(at.tv_sec) + 1e-9 * static_cast<double>(at.tv_nsec);
}

/// Sets a flag when a thread has worked for so long, and says how long it had worked then.
class Stopper {
 public:
  explicit Stopper(double after) {
    pthread_getcpuclockid(pthread_self(), &clock_);
    begin_ = thread_seconds(clock_);
    thread_ = std::thread([this, after] {
      while (!over_ && thread_seconds(clock_) - begin_ < after) std::this_thread::yield();
      flag_ = true;
      at_ = thread_seconds(clock_);
    });
  }
  ~Stopper() { finish(); }
  Stopper(const Stopper&) = delete;
  Stopper& operator=(const Stopper&) = delete;
  const std::atomic<bool>* flag() const { return &flag_; }
  /// The processor time of the thread from the flag until now.
  double late() {
    const double now = thread_seconds(CLOCK_THREAD_CPUTIME_ID);
    finish();
    return now - at_;
  }

 private:
  void finish() {
    over_ = true;
    if (thread_.joinable()) thread_.join();
  }
  clockid_t clock_{};
  double begin_ = 0, at_ = 0;
  std::atomic<bool> flag_{false}, over_{false};
  std::thread thread_;
};

constexpr double kLatest = 0.1 * cases::kSlowdown;

TEST(JobsStop, AFlagIsSeenWithinATenthOfASecondOfWork) {
  Random random(cases::seed(), 1);
  double latest = 0;
  for (const Named& job : jobs_that_stop()) {
    SCOPED_TRACE(job.name);
    const double begin = thread_seconds(CLOCK_THREAD_CPUTIME_ID);
    job.run();
    const double whole = thread_seconds(CLOCK_THREAD_CPUTIME_ID) - begin;
    for (std::size_t k = 0; k < few_cases(2); ++k) {
      Stopper stopper(random.uniform(0, whole));
      RunControl run;
      run.stop = stopper.flag();
      const auto done = stoppable(run, job.run);
      const double late = stopper.late();
      latest = std::max(latest, late);
      EXPECT_LE(late, kLatest);
    }
  }
  RecordProperty("latest", std::to_string(latest));
}

TEST(JobsStop, ANestingThatIsStoppedKeepsAValidLayout) {
  Random random(cases::seed(), 2);
  const auto order = disk::open_layout(cases::source_dir() + "/examples/orders/cupboard.json").value();
  for (std::size_t k = 0; k < few_cases(2); ++k) {
    Stopper stopper(random.uniform(0, 0.5));
    RunControl run;
    run.stop = stopper.flag();
    NestOptions options;
    options.threads = 1;
    const Result<Nested> nested = nest(order.document, options, run);
    ASSERT_TRUE(nested) << nested.error().message;
    EXPECT_TRUE(layout::check(nested->document).empty());
    std::int64_t wanted = 0, missing = 0;
    for (std::uint32_t p = 0; p < order.document.parts.size(); ++p)
      wanted += layout::wanted(order.document, p);
    for (const nest::Unplaced& u : nested->unplaced) missing += u.count;
    EXPECT_EQ(static_cast<std::int64_t>(nested->document.placements.size()) + missing, wanted);
  }
}

}  // namespace
}  // namespace lekalo::jobs::jobs_stop_test

// Lanes: what is short never waits for what is long.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <time.h>

#include <atomic>
#include <future>
#include <string>
#include <vector>

#include "server/lanes.hpp"

namespace lekalo::server::serve_lanes_test {
namespace {

using std::chrono::milliseconds;

/// Long enough for a machine that does much else.
constexpr auto kPatience = std::chrono::seconds(60);

LaneTime in(milliseconds time) { return std::chrono::steady_clock::now() + time; }

/// Work that lasts until the test lets it go.
class Gate {
 public:
  ~Gate() { open(); }
  void open() {
    if (!opened_) opened_ = true, promise_.set_value();
  }
  [[nodiscard]] Work work() const {
    return [future = future_] { future.wait(); };
  }

 private:
  bool opened_ = false;
  std::promise<void> promise_;
  std::shared_future<void> future_ = promise_.get_future().share();
};

bool is_done(std::promise<void>& promise) {
  return promise.get_future().wait_for(kPatience) == std::future_status::ready;
}

/// Computes for so long, however much else the machine does.
void compute(milliseconds time) {
  const auto now = [] {
    timespec at{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &at);
    return std::chrono::seconds(at.tv_sec) + std::chrono::nanoseconds(at.tv_nsec);
  };
  for (const auto end = now() + time; now() < end;) continue;
}

TEST(QuickLane, OvertakesWhatTakesLong) {
  Gate gate;
  std::promise<void> done;
  SlowLane slow(1);
  QuickLane lane(2, slow);
  for (int i = 0; i < 5; ++i) lane.post("x", gate.work());
  lane.post("x", [&] { done.set_value(); });
  EXPECT_TRUE(is_done(done));
  EXPECT_GE(lane.overtaken(), 4u);
  EXPECT_FALSE(lane.end(in(milliseconds(10))));
  gate.open();
  EXPECT_TRUE(lane.end(in(kPatience)));
}

TEST(QuickLane, SendsWhoOftenTakesLongToTheSlowLane) {
  Gate gate;
  std::promise<void> done;
  SlowLane slow(2);
  QuickLane lane(1, slow);
  for (int i = 0; i < 60; ++i) lane.post("greedy", gate.work());
  lane.post("modest", [&] { done.set_value(); });
  EXPECT_TRUE(is_done(done));
  EXPECT_GE(lane.overtaken(), 8u);
  EXPECT_LT(lane.overtaken(), 12u);
  gate.open();
  // What was overtaken is done, so it counts no more.
  std::promise<void> again;
  lane.post("greedy", [&] { again.set_value(); });
  EXPECT_TRUE(is_done(again));
}

TEST(QuickLane, DropsAtTheEndWhatHasNotBegun) {
  Gate gate;
  std::atomic<int> begun = 0;
  {
    SlowLane slow(1);
    QuickLane lane(1, slow);
    std::promise<void> first;
    lane.post("x", [&] {
      first.set_value();
      gate.work()();
    });
    ASSERT_TRUE(is_done(first));
    EXPECT_FALSE(lane.end(in(milliseconds(1))));
    for (int i = 0; i < 10; ++i) lane.post("x", [&] { ++begun; });
    gate.open();
    EXPECT_TRUE(lane.end(in(kPatience)));
  }
  EXPECT_EQ(begun, 0);
}

TEST(SlowLane, LeavesAThreadToOthers) {
  Gate gate;
  std::promise<void> other;
  SlowLane lane(3);
  for (int i = 0; i < 20; ++i) lane.post("greedy", gate.work());
  lane.post("modest", [&] { other.set_value(); });
  EXPECT_TRUE(is_done(other));
  gate.open();
}

TEST(SlowLane, TakesOwnersInTurns) {
  std::vector<std::string> order;
  std::promise<void> done;
  Gate gate;
  SlowLane lane(1);
  lane.post("first", gate.work());
  for (int i = 0; i < 3; ++i) lane.post("a", [&] { order.emplace_back("a"); });
  lane.post("b", [&] { order.emplace_back("b"); });
  lane.post("a", [&] { done.set_value(); });
  gate.open();
  ASSERT_TRUE(is_done(done));
  EXPECT_EQ(order, (std::vector<std::string>{"a", "b", "a", "a"}));
}

TEST(Turns, GoOneAfterTheOtherInOrder) {
  constexpr int kPieces = 3000;
  std::vector<int> order;
  std::atomic<int> at_once = 0, most = 0;
  std::promise<void> done;
  SlowLane slow(2);
  QuickLane quick(3, slow);
  const auto turns = std::make_shared<Turns>(quick, slow);
  for (int i = 0; i < kPieces; ++i)
    turns->post(
        "x",
        [&, i] {
          most = std::max<int>(most, ++at_once);
          order.push_back(i);
          --at_once;
          if (i + 1 == kPieces) done.set_value();
        },
        static_cast<Length>(i % 3));
  ASSERT_TRUE(is_done(done));
  EXPECT_EQ(most, 1);
  for (int i = 0; i < kPieces; ++i) ASSERT_EQ(order[static_cast<std::size_t>(i)], i);
}

TEST(Turns, OfASlowRoomGoToTheSlowLaneUntilOneIsShort) {
  SlowLane slow(2);
  QuickLane quick(1, slow);
  const auto turns = std::make_shared<Turns>(quick, slow);
  const int usual = getpriority(PRIO_PROCESS, 0);
  if (usual >= 19) GTEST_SKIP() << "nothing is nicer than this process";
  const auto priority = [&](Length length) {
    std::promise<void> done;
    int found = 0;
    turns->post(
        "x",
        [&] {
          found = getpriority(PRIO_PROCESS, 0);
          done.set_value();
        },
        length);
    EXPECT_TRUE(is_done(done));
    return found;
  };
  EXPECT_EQ(priority(Length::as_before), usual);
  turns->post(
      "x", [] { compute(2 * kLong); }, Length::as_before);
  EXPECT_EQ(priority(Length::brief), usual);
  EXPECT_GT(priority(Length::as_before), usual);
  EXPECT_EQ(priority(Length::as_before), usual);
  EXPECT_GT(priority(Length::lengthy), usual);
}

TEST(Turns, AreDroppedWhenTheLanesHaveEnded) {
  const auto held = std::make_shared<int>(0);
  SlowLane slow(1);
  QuickLane quick(1, slow);
  const auto turns = std::make_shared<Turns>(quick, slow);
  ASSERT_TRUE(quick.end(in(kPatience)));
  ASSERT_TRUE(slow.end(in(kPatience)));
  for (int i = 0; i < 3; ++i) turns->post("x", [held] {});
  turns->clear();
  EXPECT_EQ(held.use_count(), 1);
}

}  // namespace
}  // namespace lekalo::server::serve_lanes_test

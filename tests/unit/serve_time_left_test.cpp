#include <gtest/gtest.h>

#include "server/time_left.hpp"

namespace lekalo::server::serve_time_left_test {
namespace {

TEST(TimeLeft, SaysNothingBeforeItKnowsAnything) {
  TimeLeft left;
  EXPECT_FALSE(left.seconds());
  left.take(0, 0);
  EXPECT_FALSE(left.seconds());
  left.take(0.2, 0.1);
  EXPECT_FALSE(left.seconds());  // too soon to tell
}

TEST(TimeLeft, IsRightWhereThePaceIsEven) {
  TimeLeft left;
  for (int i = 0; i <= 50; ++i) {
    left.take(100 + 0.2 * i, i / 100.0);
    if (i < 3) continue;
    EXPECT_NEAR(left.seconds().value(), 20 - 0.2 * i, 1e-9) << i;
  }
}

TEST(TimeLeft, TurnsToTheNewPaceWhereItSlowsDown) {
  // Half of it in 5 s, then a tenth as quick: 50 s. The mean of all would say 5.6 s after one second of it.
  TimeLeft left;
  for (int i = 0; i <= 25; ++i) left.take(0.2 * i, 0.1 * 0.2 * i);
  for (int i = 1; i <= 15; ++i) left.take(5 + 0.2 * i, 0.5 + 0.01 * 0.2 * i);
  EXPECT_NEAR(left.seconds().value(), 47, 1);
}

TEST(TimeLeft, SaysNothingWhereNothingMoves) {
  TimeLeft left;
  for (int i = 0; i <= 5; ++i) left.take(0.2 * i, 0.02 * i);
  EXPECT_TRUE(left.seconds());
  for (int i = 6; i <= 30; ++i) left.take(0.2 * i, 0.1);
  EXPECT_FALSE(left.seconds());
}

}  // namespace
}  // namespace lekalo::server::serve_time_left_test

#include "lekalo/base/parallel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace lekalo::base_parallel_test {
namespace {

TEST(Parallel, EachNumberIsDoneOnce) {
  for (const unsigned threads : {0U, 1U, 2U, 7U, 64U}) {
    for (const std::size_t count : {0, 1, 2, 5, 1000}) {
      std::vector<std::atomic<int>> done(count);
      share_out(count, threads, [&](std::size_t i) { ++done[i]; });
      EXPECT_TRUE(std::all_of(done.begin(), done.end(), [](const auto& n) { return n == 1; }))
          << count << " on " << threads;
    }
  }
}

TEST(Parallel, TheFirstNumberIsTheCallers) {
  for (int round = 0; round < 100; ++round) {
    std::vector<std::thread::id> by(3);
    share_out(by.size(), 3, [&](std::size_t i) { by[i] = std::this_thread::get_id(); });
    ASSERT_EQ(by[0], std::this_thread::get_id());
  }
}

TEST(Parallel, WhatIsThrownComesBackToTheCaller) {
  const auto act = [](std::size_t i) {
    if (i == 3) throw std::runtime_error("three");
  };
  std::string said;
  try {
    share_out(50, 2, act);
  } catch (const std::runtime_error& error) {
    said = error.what();
  }
  EXPECT_EQ(said, "three");
}

}  // namespace
}  // namespace lekalo::base_parallel_test

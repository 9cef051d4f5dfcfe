#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "lekalo/base/random.hpp"

namespace lekalo::reference_random_test {
namespace {

TEST(Random, GivesThePublishedOutputsOfSplitmix64) {
  Random random(1234567);
  const std::array<std::uint64_t, 5> expected{6457827717110365317u, 3203168211198807973u,
                                              9817491932198370423u, 4593380528125082431u,
                                              16408922859458223821u};
  for (const std::uint64_t value : expected) EXPECT_EQ(random.bits(), value);
}

TEST(Random, StreamsOfOneSeedDifferFromEachOtherAndFromOtherSeeds) {
  std::vector<std::uint64_t> firsts;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (std::uint64_t stream = 0; stream < 100; ++stream) firsts.push_back(Random(seed, stream).bits());
  }
  std::sort(firsts.begin(), firsts.end());
  EXPECT_EQ(std::adjacent_find(firsts.begin(), firsts.end()), firsts.end());
}

TEST(Random, UniformStaysInItsIntervalAndFillsIt) {
  Random random(7);
  double low = 1, high = 0, sum = 0;
  constexpr int kDraws = 100'000;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.uniform();
    low = std::min(low, value);
    high = std::max(high, value);
    sum += value;
  }
  EXPECT_GE(low, 0);
  EXPECT_LT(high, 1);
  EXPECT_LT(low, 1e-3);
  EXPECT_GT(high, 1 - 1e-3);
  EXPECT_NEAR(sum / kDraws, 0.5, 5 * 0.2887 / 316.2);  // five standard deviations

  for (int i = 0; i < 1000; ++i) {
    const double value = random.uniform(1e16, 1e16 + 2);
    EXPECT_TRUE(value >= 1e16 && value <= 1e16 + 2);
  }
  EXPECT_EQ(random.uniform(3, 3), 3);
}

TEST(Random, BelowGivesEveryNumberAboutAsOften) {
  Random random(11);
  std::array<int, 7> counts{};
  for (int i = 0; i < 70'000; ++i) {
    const std::uint64_t value = random.below(7);
    ASSERT_LT(value, 7u);
    ++counts[value];
  }
  for (const int count : counts) EXPECT_NEAR(count, 10'000, 5 * 93);  // five standard deviations
  EXPECT_EQ(random.below(0), 0u);
  EXPECT_EQ(random.below(1), 0u);
}

}  // namespace
}  // namespace lekalo::reference_random_test

// Kits that share parts, beside a brute force over all numbers of kits.

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "lekalo/base/random.hpp"
#include "lekalo/layout/completeness.hpp"
#include "support/cases.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::layout::layout_kits_test {
namespace {

struct Case {
  Document document;
  std::vector<PieceCount> placed;
};

Case random_case(std::size_t index) {
  Random random(cases::seed(), index + 1);
  Case made;
  const std::size_t parts = 1 + random.below(3);
  for (std::size_t p = 0; p < parts; ++p) {
    made.document.parts.push_back(cases::two_squares().parts[0]);
    made.placed.push_back(
        {static_cast<std::int64_t>(random.below(7)), static_cast<std::int64_t>(random.below(4))});
  }
  const std::size_t kits = 1 + random.below(4);
  for (std::size_t k = 0; k < kits; ++k) {
    Kit kit;
    kit.demand = static_cast<std::int64_t>(random.below(5));
    kit.value = static_cast<double>(random.below(4)) * 0.1;  // equal ones too, and such as sums round
    for (std::uint64_t n = 1 + random.below(3); n > 0; --n) {
      std::optional<bool> hand;
      if (random.below(2) == 0) hand = random.below(2) == 0;
      kit.pieces.push_back({static_cast<std::uint32_t>(random.below(parts)),
                            static_cast<std::int64_t>(1 + random.below(2)), hand});
    }
    made.document.kits.push_back(kit);
  }
  return made;
}

/// Gives every piece of so many kits a placed one, those that may be either last.
bool can_be_made(const Case& c, const std::vector<std::int64_t>& kits) {
  std::vector<PieceCount> left = c.placed;
  for (const bool either : {false, true})
    for (std::size_t k = 0; k < kits.size(); ++k)
      for (const KitPiece& piece : c.document.kits[k].pieces)
        for (std::int64_t n = 0; n < kits[k] * piece.count; ++n) {
          PieceCount& there = left[piece.part];
          if (piece.mirrored.has_value() == either) continue;
          std::int64_t& from = piece.mirrored      ? (*piece.mirrored ? there.mirrored : there.upright)
                               : there.upright > 0 ? there.upright
                                                   : there.mirrored;
          if (--from < 0) return false;
        }
  return true;
}

TEST(LayoutKits, AreWorthAsMuchAsABruteForceFindsAndTheFirstOnesOfEquals) {
  std::size_t competing = 0;
  for (std::size_t i = 0; i < cases::case_count(2000); ++i) {
    const Case c = random_case(i);
    const std::size_t n = c.document.kits.size();
    std::vector<std::int64_t> now(n, 0), best(n, 0);
    // Values are tenths: counted in whole ones.
    const auto value_of = [&](const std::vector<std::int64_t>& kits) {
      std::int64_t value = 0;
      for (std::size_t k = 0; k < n; ++k) value += kits[k] * std::llround(10 * c.document.kits[k].value);
      return value;
    };
    const std::function<void(std::size_t)> visit = [&](std::size_t k) {
      if (k < n) {
        for (now[k] = c.document.kits[k].demand; now[k] >= 0; --now[k]) visit(k + 1);
        return;
      }
      if (std::pair(value_of(now), now) > std::pair(value_of(best), best) && can_be_made(c, now)) best = now;
    };
    visit(0);
    const KitsMade made = kits_made(c.document, c.placed);
    ASSERT_EQ(made.complete, best) << "case " << i << " of seed " << cases::seed();
    for (std::size_t p = 0; p < c.placed.size(); ++p) {
      std::int64_t used = 0;
      for (std::size_t k = 0; k < n; ++k)
        for (const KitPiece& piece : c.document.kits[k].pieces)
          used += piece.part == p ? best[k] * piece.count : 0;
      ASSERT_EQ(made.left[p].total() + used, c.placed[p].total()) << "case " << i;
      ASSERT_GE(made.left[p].upright, 0) << "case " << i;
      ASSERT_GE(made.left[p].mirrored, 0) << "case " << i;
    }
    std::vector<std::int64_t> first(n, 0);  // each as far as it goes, in the document's order
    for (std::size_t k = 0; k < n; ++k)
      while (first[k] < c.document.kits[k].demand) {
        ++first[k];
        if (can_be_made(c, first)) continue;
        --first[k];
        break;
      }
    competing += first != best ? 1 : 0;
  }
  EXPECT_GT(competing, 0u);  // the order of the document would have been wrong
}

TEST(LayoutKits, ACheapKitThatComesFirstLeavesSharedPiecesToTheDearOne) {
  Case c;
  c.document.parts.assign(1, cases::two_squares().parts[0]);
  c.placed = {{6, 0}};
  c.document.kits = {{"cheap", "", 2, 1, {{0, 2, std::nullopt}}},
                     {"dear", "", 1, 10, {{0, 5, std::nullopt}}}};
  EXPECT_EQ(kits_made(c.document, c.placed).complete, (std::vector<std::int64_t>{0, 1}));
}

TEST(LayoutKits, ManyThatCompeteAreCountedInNoTime) {
  Case c;
  constexpr std::uint32_t kParts = 12, kKits = 40;
  c.document.parts.assign(kParts, cases::two_squares().parts[0]);
  for (std::uint32_t p = 0; p < kParts; ++p) c.placed.push_back({500 + 37 * p, 100});
  double dear_first = 0;
  for (std::uint32_t k = 0; k < kKits; ++k) {
    Kit kit{"", "", 1000, 1.0 + 0.37 * ((7 * k) % kKits), {}};
    for (std::uint32_t n = 0; n < 4; ++n) kit.pieces.push_back({(k + 3 * n) % kParts, 1 + n, std::nullopt});
    c.document.kits.push_back(kit);
  }
  const KitsMade made = kits_made(c.document, c.placed);
  double value = 0;
  for (std::uint32_t k = 0; k < kKits; ++k)
    value += c.document.kits[k].value * static_cast<double>(made.complete[k]);
  // No worse than the dearest first.
  std::vector<std::uint32_t> order(kKits);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return c.document.kits[a].value > c.document.kits[b].value;
  });
  std::vector<PieceCount> left = c.placed;
  for (const std::uint32_t k : order) {
    Document one = c.document;
    one.kits = {c.document.kits[k]};
    const KitsMade of_one = kits_made(one, left);
    left = of_one.left;
    dear_first += one.kits[0].value * static_cast<double>(of_one.complete[0]);
  }
  EXPECT_GE(value, dear_first * (1 - 1e-12));
  EXPECT_GT(value, 0);
  // As many as a file may have, all of which compete for one part.
  c.document.kits.assign(100'000, {"", "", 1, 1, {{0, 1, std::nullopt}}});
  c.document.kits.back().value = 2;
  const std::vector<std::int64_t> complete = kits_made(c.document, c.placed).complete;
  EXPECT_EQ(std::accumulate(complete.begin(), complete.end(), std::int64_t{0}), c.placed[0].total());
  EXPECT_EQ(complete.back(), 1);
}

}  // namespace
}  // namespace lekalo::layout::layout_kits_test

#include "lekalo/jobs/quote.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "jobs/quote/money.hpp"
#include "lekalo/base/random.hpp"
#include "support/cases.hpp"

namespace lekalo::jobs::jobs_quote_test {
namespace {

std::int64_t money(std::int64_t quantity, int decimals_of_it, std::int64_t rate, std::int64_t per,
                   int decimals) {
  const auto made = money_of(quantity, decimals_of_it, rate, per, decimals);
  if (!made) throw std::logic_error("test input: " + made.error().message);
  return *made;
}

TEST(QuoteMoney, ADecimalHasAllItsPlaces) {
  EXPECT_EQ(decimal_of(0, 2), "0.00");
  EXPECT_EQ(decimal_of(7, 2), "0.07");
  EXPECT_EQ(decimal_of(12345, 3), "12.345");
  EXPECT_EQ(decimal_of(12345, 0), "12345");
}

TEST(QuoteMoney, HalvesGoUpExactly) {
  // 0.5 of a cent, and a millionth of a millionth less.
  EXPECT_EQ(money(1, 0, 5'000, 1, 2), 1);
  EXPECT_EQ(money(999'999'999, 9, 5'000, 1, 2), 0);
  // 1.005 is below the double next to it; as a decimal it is a half.
  EXPECT_EQ(money(1, 0, 1'005'000, 1, 2), 101);
  // 90 s at 85 an hour: 2.125.
  EXPECT_EQ(money(90'000, 3, 85'000'000, 3600, 2), 213);
  EXPECT_EQ(money(90'000, 3, 85'000'000, 3600, 0), 2);
  EXPECT_EQ(money(90'000, 3, 85'000'000, 3600, 4), 21'250);
}

TEST(QuoteMoney, WhatNobodyCanPayIsRefused) {
  const auto made = money_of(1'000'000'000'000'000, 0, 1'000'000'000'000'000, 1, 4);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().message, "an amount of the quote has more than 15 digits; look at the rates again");
}

TEST(QuoteMoney, SharesAddUpAndAreNoFurtherThanOneFromTheirPart) {
  EXPECT_EQ(shares_of(10, {1, 1, 1}), (std::vector<std::int64_t>{4, 3, 3}));
  EXPECT_EQ(shares_of(10, {0, 3, 1}), (std::vector<std::int64_t>{0, 8, 2}));
  EXPECT_EQ(shares_of(5, {0, 0}), (std::vector<std::int64_t>{3, 2}));
  EXPECT_EQ(shares_of(0, {4, 2}), (std::vector<std::int64_t>{0, 0}));
  for (std::size_t i = 0; i < cases::case_count(2000); ++i) {
    Random random(cases::seed(), i);
    std::vector<std::int64_t> weights(1 + random.below(9));
    for (std::int64_t& weight : weights) weight = static_cast<std::int64_t>(random.below(1'000'000));
    const auto total = static_cast<std::int64_t>(random.below(1'000'000'000));
    const std::int64_t whole = std::accumulate(weights.begin(), weights.end(), std::int64_t{0});
    const std::vector<std::int64_t> shares = shares_of(total, weights);
    EXPECT_EQ(std::accumulate(shares.begin(), shares.end(), std::int64_t{0}), total) << i;
    if (whole == 0) continue;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const std::int64_t off = shares[k] * whole - total * weights[k];
      EXPECT_LT(off, whole) << i;
      EXPECT_GT(off, -whole) << i;
    }
  }
}

TEST(Quote, CellsOfTheTableAreNoFormulas) {
  Quote quote;
  quote.rates.currency = "EUR";
  quote.sheets.push_back({});
  quote.sheets[0].name = "=1+2";
  quote.parts.push_back({});
  quote.parts[0].id = "@a", quote.parts[0].name = "a,b";
  quote.parts[0].purpose = {"+49", "2026-12-01", "-x"};
  quote.lines.push_back({0, 0, 2, QuoteKind::pierces, false, 3, 20'000, 6});
  quote.subtotal = quote.total = 6;
  const std::string csv = quote_csv(quote);
  EXPECT_NE(csv.find("\r\nline,1,'=1+2,'@a,\"a,b\",no "
                     "material,2,'+49,2026-12-01,'-x,pierces,3,pierce,0.020000,1,0.06,EUR\r\n"),
            std::string::npos)
      << csv;
}

}  // namespace
}  // namespace lekalo::jobs::jobs_quote_test

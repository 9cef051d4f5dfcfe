#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::jobs {

/// Money and what it is reckoned from, as whole numbers of the last decimal: nothing is a double, so that a
/// quote is what a person reckons from its rows.

/// No sum of a quote is larger, in units of its last decimal.
inline constexpr std::int64_t kMostMoney = 1'000'000'000'000'000;

/// `value` with a point before its last `decimals` digits. \pre value >= 0
[[nodiscard]] std::string decimal_of(std::int64_t value, int decimals);

/// quantity * rate / per, rounded half up to the last of `decimals`. `quantity` counts the last of
/// `quantity_decimals`, `rate` millionths of the currency. Fails with ErrorCode::bad_input above kMostMoney.
/// \pre 0 <= quantity <= 1e15, 0 <= rate <= 1e15, per >= 1
[[nodiscard]] Result<std::int64_t> money_of(std::int64_t quantity, int quantity_decimals, std::int64_t rate,
                                            std::int64_t per, int decimals);

/// Shares a total out in proportion to weights: each share is rounded down, and what is left goes, one unit
/// each, to those that lost most, the first of equals first. Shares add up to the total; equal shares where
/// all weights are 0. \pre total * the sum of the weights < 2^126
[[nodiscard]] std::vector<std::int64_t> shares_of(std::int64_t total,
                                                  const std::vector<std::int64_t>& weights);

}  // namespace lekalo::jobs

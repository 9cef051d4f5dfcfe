#include "money.hpp"

#include <algorithm>
#include <numeric>

#include "lekalo/geom/grid.hpp"

namespace lekalo::jobs {
namespace {

using geom::Int128;

Int128 power_of_ten(int exponent) {
  Int128 power = 1;
  for (int i = 0; i < exponent; ++i) power *= 10;
  return power;
}

}  // namespace

std::string decimal_of(std::int64_t value, int decimals) {
  std::string digits = std::to_string(value);
  const auto places = static_cast<std::size_t>(decimals);
  if (digits.size() <= places) digits.insert(0, places + 1 - digits.size(), '0');
  if (decimals > 0) digits.insert(digits.size() - places, 1, '.');
  return digits;
}

Result<std::int64_t> money_of(std::int64_t quantity, int quantity_decimals, std::int64_t rate,
                              std::int64_t per, int decimals) {
  const Int128 product = Int128{quantity} * rate * power_of_ten(decimals);
  const Int128 whole = power_of_ten(quantity_decimals + 6) * per;
  const Int128 rounded = (2 * product + whole) / (2 * whole);
  if (rounded > kMostMoney)
    return failure(ErrorCode::bad_input,
                   "an amount of the quote has more than 15 digits; look at the rates again");
  return static_cast<std::int64_t>(rounded);
}

std::vector<std::int64_t> shares_of(std::int64_t total, const std::vector<std::int64_t>& weights) {
  Int128 whole = 0;
  for (const std::int64_t weight : weights) whole += weight;
  const bool is_even = whole == 0;
  if (is_even) whole = static_cast<Int128>(weights.size());
  std::vector<std::int64_t> shares;
  std::vector<Int128> lost;
  std::int64_t left = total;
  for (const std::int64_t weight : weights) {
    const Int128 product = Int128{total} * (is_even ? 1 : weight);
    shares.push_back(static_cast<std::int64_t>(product / whole));
    lost.push_back(product % whole);
    left -= shares.back();
  }
  std::vector<std::size_t> order(weights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return lost[a] > lost[b]; });
  for (std::size_t k = 0; left > 0; ++k, --left) ++shares[order[k]];
  return shares;
}

}  // namespace lekalo::jobs

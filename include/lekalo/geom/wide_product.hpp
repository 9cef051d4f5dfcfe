#pragma once

#include <cstdint>

#include "lekalo/geom/grid.hpp"

namespace lekalo::geom {

__extension__ using Unsigned128 = unsigned __int128;

/// A whole number of 256 bits, not negative. It holds products of 128-bit numbers that are compared.
struct Unsigned256 {
  Unsigned128 high = 0, low = 0;
  friend constexpr bool operator==(const Unsigned256&, const Unsigned256&) = default;
  friend constexpr bool operator<(const Unsigned256& a, const Unsigned256& b) noexcept {
    return a.high != b.high ? a.high < b.high : a.low < b.low;
  }
};

/// Returns |a| |b|, exact.
[[nodiscard]] constexpr Unsigned256 wide_product(Int128 a, Int128 b) noexcept {
  constexpr Unsigned128 kHalf = ~std::uint64_t{0};
  const Unsigned128 x = a < 0 ? -static_cast<Unsigned128>(a) : static_cast<Unsigned128>(a);
  const Unsigned128 y = b < 0 ? -static_cast<Unsigned128>(b) : static_cast<Unsigned128>(b);
  const Unsigned128 low = (x & kHalf) * (y & kHalf), mid_a = (x >> 64) * (y & kHalf),
                    mid_b = (x & kHalf) * (y >> 64);
  const Unsigned128 mid = (low >> 64) + (mid_a & kHalf) + (mid_b & kHalf);
  return {(x >> 64) * (y >> 64) + (mid_a >> 64) + (mid_b >> 64) + (mid >> 64), (mid << 64) | (low & kHalf)};
}

/// Returns the sign of a b + c d, exact.
[[nodiscard]] constexpr int sign_of_sum(Int128 a, Int128 b, Int128 c, Int128 d) noexcept {
  const int first = sign(a) * sign(b), second = sign(c) * sign(d);
  if (first == 0 || second == 0 || first == second) return first != 0 ? first : second;
  const Unsigned256 p = wide_product(a, b), q = wide_product(c, d);
  return p == q ? 0 : (q < p ? first : second);
}

}  // namespace lekalo::geom

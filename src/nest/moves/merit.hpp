#pragma once

#include <compare>

namespace lekalo::nest {

/// How good a valid state is; less is better, the first that differs decides.
struct Merit {
  double missing = 0;   ///< value of the kits that are wanted and not complete
  double unplaced = 0;  ///< mm^2, weighed by priority
  double cost = 0;      ///< of the stock in use
  double reach =
      0;  ///< of a strip, mm; else what is outside the box that holds what is on the last, negative, mm^2
  friend auto operator<=>(const Merit&, const Merit&) = default;
};

}  // namespace lekalo::nest

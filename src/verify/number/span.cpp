#include "span.hpp"

#include <cmath>

#include "interval.hpp"

namespace lekalo::verify {

Span enclosed(const Decimal& value) {
  if (const auto few = small(value); few && few->is_double()) {
    // The remainder of a rounded quotient is a double, and says on which side of it the decimal lies.
    const double digits = static_cast<double>(few->digits), quotient = digits / few->power;
    const double above = std::fma(quotient, few->power, -digits);
    return {above > 0 ? step_down(quotient) : quotient, above < 0 ? step_up(quotient) : quotient};
  }
  if (const auto few = small(value)) {
    // The product is a whole number as the digits are, and what its rounding cut off is a double, too.
    const double nearest = approximate(value), product = nearest * few->power;
    const double above = static_cast<double>(static_cast<long>(product) - few->digits) +
                         std::fma(nearest, few->power, -product);
    return {above > 0 ? step_down(nearest) : nearest, above < 0 ? step_up(nearest) : nearest};
  }
  const Interval interval(value, 64);
  return {interval.low_double(), interval.high_double()};
}

}  // namespace lekalo::verify

#pragma once

#include <cmath>
#include <limits>

namespace lekalo {

/// a - b, rounded up where it is not a double: never below the exact difference. Finite arguments.
/// Source: the exact error of a sum (Knuth, The Art of Computer Programming 2, 4.2.2).
[[nodiscard]] inline double difference_rounded_up(double a, double b) noexcept {
  const double difference = a - b;
  const double b_part = a - difference;
  const double error = (a - (difference + b_part)) + (b_part - b);
  return error > 0 ? std::nextafter(difference, std::numeric_limits<double>::infinity()) : difference;
}

/// a - b, rounded down where it is not a double: never above the exact difference.
[[nodiscard]] inline double difference_rounded_down(double a, double b) noexcept {
  return 0.0 - difference_rounded_up(b, a);  // 0 where they are equal, not -0
}

}  // namespace lekalo

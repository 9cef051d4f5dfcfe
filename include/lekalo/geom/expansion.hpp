#pragma once

#include <cstddef>

#include "lekalo/geom/double_double.hpp"

namespace lekalo::geom {

/// An exact sum of doubles. Its components do not overlap, ascend in magnitude and leave zeros out, so the
/// last component has the sign of the sum. It is exact as long as nothing overflows; sums of doubles never
/// underflow. Source: Shewchuk 1997, GROW-EXPANSION (theorem 10) with zero elimination; the code is our own.
template <std::size_t Capacity>
class Expansion {
 public:
  /// \pre fewer than Capacity calls before.
  constexpr void add(double value) noexcept {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const DoubleDouble sum = two_sum(value, component_[i]);
      value = sum.hi;
      if (sum.lo != 0) component_[kept++] = sum.lo;
    }
    if (value != 0) component_[kept++] = value;
    size_ = kept;
  }
  constexpr void add(DoubleDouble value) noexcept {
    add(value.lo);
    add(value.hi);
  }
  [[nodiscard]] constexpr int sign() const noexcept {
    if (size_ == 0) return 0;
    return component_[size_ - 1] > 0 ? 1 : -1;
  }

 private:
  double component_[Capacity] = {};
  std::size_t size_ = 0;
};

}  // namespace lekalo::geom

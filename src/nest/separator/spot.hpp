#pragma once

#include <cstdint>

namespace lekalo::nest {

/// Where an item lies.
struct Spot {
  double x = 0, y = 0;
  std::uint32_t form = 0;
  std::uint32_t bin = 0;
};

inline constexpr std::uint32_t kNowhere = ~std::uint32_t{0};  ///< a bin that is none

}  // namespace lekalo::nest

#pragma once

#include <cstdint>

namespace lekalo::nest {

/// The place of an item.
struct Spot {
  double x = 0, y = 0;  ///< of its origin, mm
  std::uint32_t form = 0;
  std::uint32_t bin = 0;
};

inline constexpr std::uint32_t kNowhere = ~std::uint32_t{0};  ///< the bin of an item that lies on none

}  // namespace lekalo::nest

#pragma once

#include <cstdint>
#include <vector>

#include "arrangement.hpp"

namespace lekalo::geom::detail {

/// Returns the vertex at which a half-edge begins. Half-edge 2 e runs along map edge e, 2 e + 1 against it.
[[nodiscard]] inline std::uint32_t start_of(const Arrangement& a, std::uint32_t half_edge) noexcept {
  const Stretch& s = a.stretches[a.edges[half_edge / 2].stretch];
  return half_edge % 2 == 0 ? s.from : s.to;
}
[[nodiscard]] inline std::uint32_t end_of(const Arrangement& a, std::uint32_t half_edge) noexcept {
  return start_of(a, half_edge ^ 1);
}

/// Sorts the half-edges that leave one vertex counter-clockwise, beginning downwards. The beginning may be
/// another one where edges run within rounding of that direction on both sides of it.
void sort_counter_clockwise(const Arrangement& arrangement, std::uint32_t* begin, std::uint32_t* end);

}  // namespace lekalo::geom::detail

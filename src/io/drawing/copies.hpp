#pragma once

#include <cstddef>

namespace lekalo::io {

/// Most curves that blocks, arrays and uses make beside those that are drawn; more are refused. A few hundred
/// bytes can ask for any number.
inline constexpr std::size_t kMostCopies = 400'000;

}  // namespace lekalo::io

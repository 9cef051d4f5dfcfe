#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/layout/completeness.hpp"

namespace lekalo::layout {

/// Returns how many of each kit these pieces make when the kits are to be worth most together, for
/// kits_made().
[[nodiscard]] std::vector<std::int64_t> most_valuable_kits(const Document& document,
                                                           const std::vector<PieceCount>& placed);

}  // namespace lekalo::layout

#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/layout/completeness.hpp"

namespace lekalo::layout {

/// How many of each kit these pieces make so that they are worth most together: kits_made().
[[nodiscard]] std::vector<std::int64_t> most_valuable_kits(const Document& document,
                                                           const std::vector<PieceCount>& placed);

}  // namespace lekalo::layout

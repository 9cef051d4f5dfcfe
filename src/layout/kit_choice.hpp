#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/layout/completeness.hpp"

namespace lekalo::layout {

/// The number of each kit that these pieces make when the kits are to be worth most together: kits_made().
[[nodiscard]] std::vector<std::int64_t> most_valuable_kits(const Document& document,
                                                           const std::vector<PieceCount>& placed);

}  // namespace lekalo::layout

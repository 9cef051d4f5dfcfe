#pragma once

#include <cstdint>

#include "lekalo/nest/nest.hpp"
#include "nest/table/problem.hpp"

namespace lekalo::nest {

/// Says why a part is not placed although it has an angle and its box fits: too_large, no_zone or no_stock.
/// It tries the part alone on empty stock. docs/design/nest-sheets.md, step 10.
[[nodiscard]] Reason reason_alone(const Problem& problem, std::uint32_t part);

}  // namespace lekalo::nest

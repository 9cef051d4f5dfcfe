#pragma once

#include <cstdint>

#include "lekalo/nest/nest.hpp"
#include "nest/table/problem.hpp"

namespace lekalo::nest {

/// Why a part that has an angle and whose box fits is not placed, judged by trying it alone on stock with
/// nothing on it: too_large, no_zone, or no_stock.
[[nodiscard]] Reason reason_alone(const Problem& problem, std::uint32_t part);

}  // namespace lekalo::nest

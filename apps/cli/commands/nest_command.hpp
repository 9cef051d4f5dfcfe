#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// `lekalo nest`: 0 everything placed, 1 some pieces are not; nothing is written that the engine's check or
/// the independent checker would not pass.
[[nodiscard]] Result<int> run_nest(const NestOptions& options);

}  // namespace lekalo::cli

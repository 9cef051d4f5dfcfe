#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// Runs `lekalo heat`.
[[nodiscard]] Result<int> run_heat(const HeatOptions& options);

}  // namespace lekalo::cli

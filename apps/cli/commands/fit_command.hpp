#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// Runs `lekalo fit`.
[[nodiscard]] Result<int> run_fit(const FitOptions& options);

}  // namespace lekalo::cli

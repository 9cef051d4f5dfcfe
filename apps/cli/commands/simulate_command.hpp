#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// Runs `lekalo simulate`: hands program and pocket to the independent checker and reports its figures.
/// Returns the exit status, always 0: whether the figures are good is for whoever asked.
[[nodiscard]] Result<int> run_simulate(const SimulateOptions& options);

}  // namespace lekalo::cli

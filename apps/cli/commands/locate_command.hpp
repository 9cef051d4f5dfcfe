#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// Runs `lekalo locate`: reads, solves, rechecks what it is about to write, writes all files or none.
/// Returns the exit status 0 or 1.
[[nodiscard]] Result<int> run_locate(const LocateOptions& options);

}  // namespace lekalo::cli

#pragma once

#include "lekalo/base/error.hpp"
#include "options.hpp"

namespace lekalo::cli {

/// Runs `lekalo pocket`: the path that clears the pockets of a region file, as an NC program. Returns the
/// exit status.
[[nodiscard]] Result<int> run_pocket(const PocketOptions& options);

}  // namespace lekalo::cli

#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// Runs `lekalo pocket`: the path that clears pockets, as an NC program. Returns the
/// exit status.
[[nodiscard]] Result<int> run_pocket(const PocketOptions& options);

}  // namespace lekalo::cli

#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// `lekalo check`: every rule a layout breaks, found by the engine and by the independent checker. Exit
/// status 0 none, 1 some, 4 the two do not agree.
[[nodiscard]] Result<int> run_check(const CheckOptions& options);

}  // namespace lekalo::cli

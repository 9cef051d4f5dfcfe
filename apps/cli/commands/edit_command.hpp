#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// `lekalo edit`: carries out a log of commands (layout/command.hpp) on a layout.
[[nodiscard]] Result<int> run_edit(const EditOptions& options);

}  // namespace lekalo::cli

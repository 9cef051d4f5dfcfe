#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// `lekalo store`: checks, copies and puts back the layouts of a server (docs/cli.md).
[[nodiscard]] Result<int> run_store(const StoreOptions& options);

}  // namespace lekalo::cli

#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// `lekalo serve`: the editor of layouts in a browser (docs/protocol.md).
[[nodiscard]] Result<int> run_serve(const ServeOptions& options);

}  // namespace lekalo::cli

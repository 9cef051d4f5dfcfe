#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// `lekalo show`: a layout as picture and table: material, parts, kits.
[[nodiscard]] Result<int> run_show(const ShowOptions& options);

}  // namespace lekalo::cli

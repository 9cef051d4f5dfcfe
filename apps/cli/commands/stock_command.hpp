#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// `lekalo stock`: the sheets of a shop and what is left of them (docs/cli.md).
[[nodiscard]] Result<int> run_stock(const StockOptions& options);

}  // namespace lekalo::cli

#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// `lekalo quote`: what cutting layouts takes and costs.
[[nodiscard]] Result<int> run_quote(const QuoteOptions& options);

}  // namespace lekalo::cli

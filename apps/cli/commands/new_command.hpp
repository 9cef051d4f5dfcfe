#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// `lekalo new`: the layout of an order, with nothing placed.
[[nodiscard]] Result<int> run_new(const NewOptions& options);

}  // namespace lekalo::cli

#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/layout.hpp"
#include "options/options.hpp"
#include "outputs.hpp"

namespace lekalo::cli {

/// Reads the files of an order and makes its layout (jobs::open_order), after a look at the outputs
/// (check_outputs), which may replace none of them. Everything that is missing is told in one sentence.
[[nodiscard]] Result<jobs::Layout> read_order_input(const OrderSource& order,
                                                    const std::vector<NamedPath>& outputs);

}  // namespace lekalo::cli

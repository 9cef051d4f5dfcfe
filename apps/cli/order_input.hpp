#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/order.hpp"
#include "options/options.hpp"
#include "outputs.hpp"

namespace lekalo::cli {

/// Reads the files of an order and makes its layouts (jobs::open_orders), after a look at the outputs
/// (check_outputs), which may replace none of them. Where there are several layouts, each has outputs of its
/// own (jobs::path_with). Everything that is missing is told in one sentence.
[[nodiscard]] Result<std::vector<jobs::MaterialLayout>> read_order_input(
    const OrderSource& order, const std::vector<NamedPath>& outputs);

/// ErrorCode::usage where an order of several layouts would go to stdout.
[[nodiscard]] Result<void> several_need_files(const std::vector<jobs::MaterialLayout>& layouts,
                                              const std::string& output);

}  // namespace lekalo::cli

#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/simulate.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// Reads programs that ran before.
[[nodiscard]] Result<std::vector<jobs::EarlierProgram>> read_earlier(const std::vector<EarlierFile>& files);

}  // namespace lekalo::cli

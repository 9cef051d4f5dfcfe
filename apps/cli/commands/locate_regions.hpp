#pragma once

#include <string>

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// `lekalo locate` where the part or the blank is more than a convex polygon. Returns the exit status.
[[nodiscard]] Result<int> run_locate_regions(const LocateOptions& options, const std::string& part_bytes,
                                             const std::string& blank_bytes);

}  // namespace lekalo::cli

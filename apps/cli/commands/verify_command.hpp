#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// Runs `lekalo verify`: finds the files that a result names, compares their digests and hands the bytes to
/// the independent checker. Returns the exit status: 0 confirmed, 1 incomplete or unproved, 4 refuted.
[[nodiscard]] Result<int> run_verify(const VerifyOptions& options);

}  // namespace lekalo::cli

#pragma once

#include <string>

#include "lekalo/jobs/verify.hpp"
#include "lekalo/verify/claims.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// Verifies a file that is no placement, and returns the exit status.
[[nodiscard]] Result<int> verify_other(const VerifyOptions& o, const std::string& bytes, verify::Kind kind,
                                       const jobs::FileFinder& find);

}  // namespace lekalo::cli

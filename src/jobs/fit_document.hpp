#pragma once

#include <string>

#include "lekalo/jobs/fit.hpp"

namespace lekalo::jobs {

/// Returns the result as a document of the format lekalo-fit.
[[nodiscard]] std::string fit_json(const FitJob& job, const Fitted& made, std::uint64_t work);

}  // namespace lekalo::jobs

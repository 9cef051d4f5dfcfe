#pragma once

#include <string>
#include <vector>

#include "lekalo/jobs/heat_result.hpp"

namespace lekalo::jobs {

/// Returns the result as a document of the format lekalo-heat.
[[nodiscard]] std::string heat_json(const HeatJob& job, const HeatFound& found,
                                    const std::vector<std::string>& warnings);

}  // namespace lekalo::jobs

#pragma once

#include <string>

#include "lekalo/jobs/heat_result.hpp"

namespace lekalo::jobs {

/// Returns the picture that the job asks for; empty where it asks for none.
[[nodiscard]] Result<std::string> drawn_heat(const HeatResultJob& job, const HeatFound& found);

}  // namespace lekalo::jobs

#pragma once

#include "lekalo/jobs/heat_result.hpp"

namespace lekalo::jobs {

/// Adds the maps, the report and the page that the job asks for.
/// \pre what was found has a record where any of these is asked for
[[nodiscard]] Result<void> add_heat_scenes(const HeatResultJob& job, HeatResult& made);

}  // namespace lekalo::jobs

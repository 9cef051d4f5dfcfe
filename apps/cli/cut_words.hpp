#pragma once

#include <string>
#include <vector>

#include "lekalo/jobs/pocket.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::cli {

/// Returns the checker's findings for people, one figure a line.
[[nodiscard]] std::string report_rows(const verify::SimulateReport& report);

/// Returns a line for each of the hottest stretches, and one that says how many more there are.
/// ramp_notices() does the same for ramps.
[[nodiscard]] std::string hot_cut_notices(std::vector<jobs::ReportedStretch> cuts);
[[nodiscard]] std::string ramp_notices(std::vector<jobs::ReportedStretch> ramps);

}  // namespace lekalo::cli

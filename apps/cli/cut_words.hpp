#pragma once

#include <string>
#include <vector>

#include "lekalo/jobs/pocket.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::cli {

/// The checker's findings for people, a line a figure.
[[nodiscard]] std::string report_rows(const verify::SimulateReport& report);

/// A line for each of the hottest stretches, and how many more there are.
[[nodiscard]] std::string hot_cut_notices(std::vector<jobs::ReportedStretch> cuts);
[[nodiscard]] std::string ramp_notices(std::vector<jobs::ReportedStretch> ramps);

}  // namespace lekalo::cli

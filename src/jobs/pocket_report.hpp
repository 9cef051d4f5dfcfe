#pragma once

#include <string>
#include <vector>

#include "lekalo/jobs/pocket.hpp"
#include "lekalo/mill/ramps.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::jobs {

/// Returns the stretches that Pocketed::hot_cuts states.
[[nodiscard]] std::vector<ReportedStretch> hot_cuts(const verify::SimulateReport& report, double step_over);
[[nodiscard]] std::vector<ReportedStretch> reported_ramps(const std::vector<mill::Ramp>& ramps);

/// The document of a judged program; `made` has all of it but `json`.
/// \param outline  how the regions came from the file
/// \param regions  what the checker judged by, region JSON
/// \param supposed  the program that options.rest_of supposes to have run; empty without
[[nodiscard]] std::string pocket_json(const PocketJob& job, const Pocketed& made,
                                      const io::ReadOutline& outline, const std::string& regions,
                                      const std::string& supposed);

}  // namespace lekalo::jobs

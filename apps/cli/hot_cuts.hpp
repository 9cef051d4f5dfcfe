#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lekalo/mill/ramps.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::cli {

/// Stretches of the path, outside entries, where the checker finds more of the rim in material than 1.25
/// times what a straight pass of this step-over meets, all along 0.2 mm or more: the source's spirals have
/// them; of the product's path what ramps would not hold would be told here, too.
[[nodiscard]] nlohmann::ordered_json hot_cuts(const verify::SimulateReport& report, double step_over);
/// Stretches that would have been such, and are cut in ramps; as the path maker tells.
[[nodiscard]] nlohmann::ordered_json ramps(const std::vector<mill::Ramp>& ramps);
/// A line for each of the hottest, for people, and how many more there are.
[[nodiscard]] std::string hot_cut_notices(const nlohmann::ordered_json& cuts);
[[nodiscard]] std::string ramp_notices(const nlohmann::ordered_json& ramps);

}  // namespace lekalo::cli

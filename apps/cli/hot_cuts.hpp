#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lekalo/verify/simulate.hpp"

namespace lekalo::cli {

/// Stretches of the path, outside entries, where the checker finds more of the rim in material than 1.25 times
/// what a straight pass of this step-over meets, for 0.2 mm and more. It tells where, not why: a slot hardly
/// wider than the tool, a sharp corner, or a spiral of the source's methods.
[[nodiscard]] nlohmann::ordered_json hot_cuts(const verify::SimulateReport& report, double step_over);
/// A line for each of the hottest, for people, and how many more there are.
[[nodiscard]] std::string hot_cut_notices(const nlohmann::ordered_json& cuts);

}  // namespace lekalo::cli

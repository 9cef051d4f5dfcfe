#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lekalo/verify/simulate.hpp"

namespace lekalo::cli {

/// Stretches of the path, outside entries, where the checker finds more than 120 degrees of the rim in
/// material over half a millimetre and more. It tells where, not why: a slot hardly wider than the tool, a sharp
/// corner, or a spiral of the source's methods.
[[nodiscard]] nlohmann::ordered_json full_cuts(const verify::SimulateReport& report);
/// A line for each, for people.
[[nodiscard]] std::string full_cut_notices(const nlohmann::ordered_json& cuts);

}  // namespace lekalo::cli

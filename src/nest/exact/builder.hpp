#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "nest/tuning/tuning.hpp"
#include "placer.hpp"

namespace lekalo::nest {

/// The state in which every item lies nowhere. Obstacles are in their places, and bins with locked parts
/// are open.
[[nodiscard]] State empty_state(const Problem& problem, const Items& items);

/// Puts the items that lie nowhere, in this order, each to the free place found furthest left: on a bin
/// that is open, else on the cheapest that can hold it, while a strip gets longer. Items for which no place
/// is found stay nowhere, and items that lie somewhere stay there. It ends early, between two items, when
/// `enough` says so. The result breaks no rule.
[[nodiscard]] State built(const Problem& problem, const Items& items, Placer& placer, const State& from,
                          const std::vector<std::uint32_t>& order, const std::function<bool()>& enough,
                          const tuning::Tries& tries = tuning::kBuildTries);

/// Items by priority, then by size, large ones first.
[[nodiscard]] std::vector<std::uint32_t> by_size(const Problem& problem, const Items& items);

}  // namespace lekalo::nest

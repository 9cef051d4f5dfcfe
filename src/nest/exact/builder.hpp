#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "placer.hpp"

namespace lekalo::nest {

/// Everything nowhere, the obstacles in their places, stock with locked parts open.
[[nodiscard]] State empty_state(const Problem& problem, const Items& items);

/// Puts the items that lie nowhere one after the other, in this order, to the free place found furthest left:
/// on stock that is open, else on the cheapest that can hold them; a strip gets longer. Those for which no
/// place is found stay nowhere. What lies somewhere stays there. Ends early, between two items, where
/// `enough` says so. What it gives is settled: it breaks no rule.
[[nodiscard]] State built(const Problem& problem, const Items& items, Placer& placer, const State& from,
                          const std::vector<std::uint32_t>& order, const std::function<bool()>& enough);

/// Items by priority, then by size, large ones first.
[[nodiscard]] std::vector<std::uint32_t> by_size(const Problem& problem, const Items& items);

}  // namespace lekalo::nest

#pragma once

#include <optional>

#include "separator.hpp"

namespace lekalo::nest {

/// The state as placements on the grid that break no rule, the document's locked ones among them; none where
/// the little that rounding leaves could not be set right. New ids follow the document's in the order of the
/// items.
[[nodiscard]] std::optional<layout::Document> settled(const Problem& problem, const Items& items,
                                                      const State& state);

}  // namespace lekalo::nest

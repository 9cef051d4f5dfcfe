#pragma once

#include "nest/separator/separator.hpp"

namespace lekalo::nest {

struct Settled {
  layout::Document document;  ///< breaks no rule, the locked placements among them
  State state;                ///< the same: items on the grid, those that were taken out nowhere
  bool is_whole = true;       ///< none was
};
/// The state as placements on the grid: what rounding left is set right by small shifts, and what cannot be
/// is taken out, as few items as it goes. New ids follow the document's in the order of the items. \pre the
/// locked placements break no rule
[[nodiscard]] Settled settled(const Problem& problem, const Items& items, State state);

}  // namespace lekalo::nest

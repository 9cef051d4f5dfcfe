#pragma once

#include "nest/separator/separator.hpp"

namespace lekalo::nest {

/// A state that has become an exact layout.
struct Settled {
  layout::Document document;  ///< breaks no rule; the locked placements are in it
  State state;                ///< the same layout; items that were taken out lie nowhere
  bool is_whole = true;       ///< no item was taken out
};
/// Makes placements on the grid of a state. Small shifts end what rounding has left; items that no shift
/// can help are taken out, as few as it goes. New ids follow the document's in the order of the items. \pre
/// the locked placements break no rule
[[nodiscard]] Settled settled(const Problem& problem, const Items& items, State state);

}  // namespace lekalo::nest

#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/nest/nest.hpp"
#include "nest/separator/separator.hpp"

namespace lekalo::nest {

/// The items that a run has to place, and the state it begins from.
struct Wanted {
  Items items;
  std::vector<Unplaced> unplaced;  ///< pieces that no stock can hold or no angle suits; they are no items
  /// By item: the id of the given placement that it is, 0 for a new piece.
  std::vector<std::uint64_t> ids;
  State start;  ///< given placements that break no rule lie where they are, everything else nowhere
};

/// The pieces that a document wants beside its locked placements, as items. \param from_given  placements
/// that are not locked are wanted too, whatever the demand
[[nodiscard]] Wanted wanted_items(const Problem& problem, bool from_given);
/// Makes two and two of a kit's pieces of one part partners, left and right ones first. Locked pieces serve
/// the first kits. \param reach  mm; 0: there are no partners
void add_partners(const Problem& problem, double reach, Items& items);

}  // namespace lekalo::nest

#pragma once

#include <cstddef>
#include <vector>

#include "profile_leads.hpp"
#include "profile_path.hpp"

namespace lekalo::nc {

/// A cut and which of its starts it takes.
struct OrderedCut {
  std::size_t cut = 0, start = 0;
};

/// Each cut's enclosing cut, which must come after it: for a hole its part's outline, for an outline the
/// innermost hole in which it lies. A cut that nothing encloses has its own index.
[[nodiscard]] std::vector<std::size_t> enclosing_cuts(const std::vector<ProfilePart>& parts,
                                                      const std::vector<Cut>& cuts,
                                                      const Resolution& resolution);

/// Step 6 of docs/design/export.md: what is enclosed comes first, together with what encloses it. Otherwise
/// travels are made short: the nearest is next, then pairs of travels are exchanged while that shortens
/// (2-opt), then each cut takes its best start. The tour begins and ends at (0, 0). A budget of work, not of
/// time, ends the exchange, so that one input has one order.
[[nodiscard]] std::vector<OrderedCut> ordered_cuts(const std::vector<Starts>& starts,
                                                   const std::vector<std::size_t>& enclosing);

}  // namespace lekalo::nc

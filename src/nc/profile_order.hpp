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

/// For each cut the one that must come after it and in whose waste or part it lies: a hole's is its part's
/// outline, an outline's the innermost hole it lies in; its own index where there is none.
[[nodiscard]] std::vector<std::size_t> enclosing_cuts(const std::vector<ProfilePart>& parts,
                                                      const std::vector<Cut>& cuts,
                                                      const Resolution& resolution);

/// What is enclosed first and together with what encloses it, otherwise short travels: the nearest next, then
/// pairs of travels exchanged while that shortens (2-opt), then the best start of each. From and back to
/// (0, 0). The same for the same input; a budget of work, not of time.
[[nodiscard]] std::vector<OrderedCut> ordered_cuts(const std::vector<Starts>& starts,
                                                   const std::vector<std::size_t>& enclosing);

}  // namespace lekalo::nc

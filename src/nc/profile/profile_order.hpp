#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common_cuts.hpp"
#include "profile_leads.hpp"
#include "profile_loose.hpp"
#include "profile_path.hpp"

namespace lekalo::nc {

/// A cut and which of its starts it takes.
struct OrderedCut {
  std::size_t cut = 0, start = 0;
};

/// Each cut's enclosing cut, which must come after it: for a hole its part's outline, for an outline the
/// innermost hole or pocket in which it lies; the outline of a cluster for the cuts within it and for what
/// lies in its pockets. A cut that nothing encloses has its own index.
[[nodiscard]] std::vector<std::size_t> enclosing_cuts(const std::vector<ProfilePart>& parts,
                                                      const std::vector<Cut>& cuts,
                                                      const Resolution& resolution);

/// The rules that an order of cuts keeps.
struct OrderRules {
  std::vector<std::size_t> enclosing;  ///< enclosing_cuts()
  std::vector<Ring> rings;             ///< loose_rings()
  /// The next cut begins so far from all of the cut before where a choice is left, mm; 0: the nearest is
  /// next.
  double heat_spread_mm = 0;
};

/// Step 6 of docs/design/export.md: what is enclosed comes first, together with what encloses it, and deeper
/// rings before others of their heap. Otherwise travels are made short: the nearest is next, then pairs of
/// travels are exchanged while that shortens (2-opt), then each cut takes its best start, of those whose lead
/// meets no kerf that is there already. The tour begins and ends at (0, 0). A budget of work, not of time,
/// ends the exchange, so that one input has one order.
///
/// With a heat spread, parts need not be finished one by one: of all cuts that may come next the nearest that
/// is far enough from the last is taken, or else the farthest.
/// \param kerfs  of the same cuts
[[nodiscard]] std::vector<OrderedCut> ordered_cuts(const std::vector<Starts>& starts, const OrderRules& rules,
                                                   const KerfsAround& kerfs, const Resolution& resolution);

/// Puts lines and pockets of clusters before the outlines of these, in the order that they have to keep, and
/// chooses their starts anew, of outlines away from the ends of lines where there are such. \pre an order
/// without a heat spread: what a cluster waits for stands before it
void put_common_cuts_in_order(const CommonCuts& common, const std::vector<Cut>& cuts,
                              const std::vector<Starts>& starts, const ProfileOptions& options,
                              std::vector<OrderedCut>& order);

/// Gives cuts whose lead or pierce would meet the lead of a cut before them another start, one that meets no
/// kerf of an earlier cut, where they have one; and returns, by place in the order, the earlier cut that a
/// lead, pierce or both meet in the end.
[[nodiscard]] std::vector<std::optional<std::size_t>> settle_starts(const std::vector<Starts>& starts,
                                                                    const ProfileOptions& options,
                                                                    std::vector<OrderedCut>& order);

}  // namespace lekalo::nc

#pragma once

#include <vector>

#include "lekalo/mill/path.hpp"

namespace lekalo::mill {

/// The tool's load over a piece of a move.
struct MoveLoad {
  double length = 0;  ///< mm
  /// The part of the rim that is in material, degrees.
  double engagement_deg = 0;
  /// The part of it that is to the left of where the tool goes, degrees.
  double left_deg = 0;
};

struct FeedOptions {
  /// The feed at the engagement of a straight pass.
  double feed_mm_per_min = 1500;
  /// The largest feed: at least feed_mm_per_min, at most four times it.
  double most_mm_per_min = 1500;
  double step_over = 0.4;  ///< part of the diameter, in (0, 0.5]
};

/// Gives the path feeds that follow the load, in at most six steps from half the feed to the most. Below the
/// engagement a of a straight pass the thickest chip stays as thick, feed sin(a) / sin(engagement); above
/// 1.25 a the feed falls as the engagement grows. A step holds for 2 mm of path at least, and the slower feed
/// begins 1 mm before the load. Moves are divided where the feed changes; helices, plunges, links and rapids
/// keep theirs.
/// \param loads  of each move, along it; a move without any keeps its feed
[[nodiscard]] PocketPath with_feeds(const PocketPath& path, const std::vector<std::vector<MoveLoad>>& loads,
                                    const FeedOptions& options);

/// Turns stretches of links into cuts, which run at the feed of the cut: those that would meet a thicker chip
/// at their own feed than a straight pass does at its own, and a millimetre before and after them.
/// \param loads  of each link, along it
[[nodiscard]] PocketPath with_cutting_links_slow(const PocketPath& path,
                                                 const std::vector<std::vector<MoveLoad>>& loads,
                                                 const FeedOptions& options, double link_mm_per_min);

}  // namespace lekalo::mill

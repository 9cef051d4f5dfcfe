#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/nc/profile.hpp"
#include "profile_path.hpp"

namespace lekalo::nc {

/// The engravings of a program in the order in which they are made.
struct EngravedPaths {
  std::vector<std::vector<WrittenEdge>> paths;  ///< each connected, not empty
  std::vector<MarkLeftOut> left_out;            ///< by part and mark
  std::size_t marks = 0;                        ///< that are engraved
};

/// Takes part by part; within one the nearest line is next, open lines from either end. Cost: O(n log n)
/// near pairs of edges, and the square of the lines of one part up to 2,000 of them.
[[nodiscard]] EngravedPaths engraved_paths(const std::vector<ProfilePart>& parts,
                                           const ProfileOptions& options);

}  // namespace lekalo::nc

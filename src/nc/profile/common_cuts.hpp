#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/base/error.hpp"
#include "profile_path.hpp"
#include "profile_proof.hpp"

namespace lekalo::nc {

/// Parts that hang together by common stretches. Their outlines are cut as lines between two parts, rims of
/// the pockets that parts surround, and last of all one outline around all of them.
struct CommonCluster {
  std::size_t outline = 0;
  std::vector<std::size_t> inner;  ///< lines and pockets, in the order in which they are cut
};

struct CommonCuts {
  std::vector<CommonCluster> clusters;
  std::size_t lines = 0;
  double shared_mm = 0;  ///< the length of all common stretches
  /// A common stretch is so far from half a kerf beside either of its parts, at most.
  double off_mm = 0;
};

/// Replaces the outlines of parts that have common stretches by the cuts of their clusters; each cluster is
/// one more part, whose region is the parts with the kerfs between them filled. Steps 1 to 5 of
/// docs/design/common-line.md. \pre proof is of the parts as they are given
///
/// Fails as geom::offset does. Cost: O(n log n) edges and pairs of them that are near, and the square of the
/// lines of a cluster.
[[nodiscard]] Result<CommonCuts> take_common_cuts(std::vector<ProfilePart>& parts, std::vector<Cut>& cuts,
                                                  const KerfProof& proof, const ProfileOptions& options);

}  // namespace lekalo::nc

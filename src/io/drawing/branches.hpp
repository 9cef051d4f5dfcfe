#pragma once

#include <cstdint>
#include <vector>

#include "contour_mending.hpp"

namespace lekalo::io {

inline constexpr std::uint32_t kNoNode = 0xffffffff;

/// Edges in a row, without gaps, between two places where chains meet.
struct BranchChain {
  std::vector<geom::Edge> edges;
  std::vector<std::uint32_t> curves;  ///< by edge
  std::uint32_t begin = kNoNode, end = kNoNode;
};

struct Branches {
  std::vector<LooseContour> contours;  ///< of all bounded faces: neighbours share edges
  std::vector<LooseEdge> left;         ///< what bounds no face
  /// Half of each gap that was bridged by a line, mm.
  std::vector<MovedCurve> bridged;
  /// Clusters that enclose no more than loops, and of which two loose ends are so near that they were meant
  /// to.
  std::vector<std::vector<LooseEdge>> unclosed;
};

/// Resolves chains that meet three and more in a place: everything that they enclose together is a contour.
/// Chains that hang together are looked at by themselves. Cost: O((n + k) log n), k pairs of edges whose
/// boxes meet.
/// \param repair  mm: the only gap of a cluster is bridged if it is no wider
/// \param widest_gap  mm: loose ends that are this near were meant to meet
[[nodiscard]] Branches faces_of_branches(const std::vector<BranchChain>& chains, double repair,
                                         double widest_gap);

}  // namespace lekalo::io

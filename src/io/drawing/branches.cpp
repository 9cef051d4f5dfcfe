#include "branches.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/box_tree.hpp"

namespace lekalo::io {
namespace {

/// Numbers of chains that hang together, each list ascending, in the order of their first.
std::vector<std::vector<std::uint32_t>> clusters_of(const std::vector<BranchChain>& chains) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> at_node;
  for (std::uint32_t i = 0; i < chains.size(); ++i)
    for (const std::uint32_t node : {chains[i].begin, chains[i].end})
      if (node != kNoNode) at_node[node].push_back(i);
  std::vector<char> seen(chains.size(), 0);
  std::vector<std::vector<std::uint32_t>> clusters;
  for (std::uint32_t first = 0; first < chains.size(); ++first) {
    if (seen[first] != 0) continue;
    seen[first] = 1;
    std::vector<std::uint32_t> cluster{first};
    for (std::size_t k = 0; k < cluster.size(); ++k)
      for (const std::uint32_t node : {chains[cluster[k]].begin, chains[cluster[k]].end}) {
        const auto at = at_node.find(node);
        if (at == at_node.end()) continue;
        for (const std::uint32_t other : at->second) {
          ask();
          if (seen[other] == 0) seen[other] = 1, cluster.push_back(other);
        }
        at_node.erase(at);
      }
    std::sort(cluster.begin(), cluster.end());
    clusters.push_back(std::move(cluster));
  }
  return clusters;
}

struct BranchEnd {
  geom::Point at;
  std::uint32_t curve = 0;
};

/// Pairs of loose ends of a cluster that are no further apart than `gap`.
std::vector<std::pair<BranchEnd, BranchEnd>> gaps_of(const std::vector<BranchChain>& chains,
                                                     const std::vector<std::uint32_t>& cluster, double gap) {
  std::vector<BranchEnd> ends;
  std::vector<geom::Box> boxes;
  for (const std::uint32_t i : cluster) {
    const BranchChain& chain = chains[i];
    if (chain.begin == kNoNode) ends.push_back({chain.edges.front().from, chain.curves.front()});
    if (chain.end == kNoNode) ends.push_back({chain.edges.back().to, chain.curves.back()});
  }
  for (const BranchEnd& end : ends) boxes.push_back(geom::grown({end.at, end.at}, gap / 2));
  std::vector<std::pair<BranchEnd, BranchEnd>> gaps;
  geom::BoxTree(boxes).visit_pairs_while([&](std::uint32_t i, std::uint32_t j) {
    if (norm(ends[i].at - ends[j].at) <= gap) gaps.emplace_back(ends[i], ends[j]);
    // Many are a fan, and no gaps.
    return gaps.size() <= 2 * ends.size();
  });
  return gaps;
}

/// Says whether none of the faces is larger than a loop that may be mended.
bool only_loops(const geom::CutFaces& faces, double repair) {
  return std::all_of(faces.contours.begin(), faces.contours.end(), [&](const geom::CutContour& face) {
    const geom::Box box = geom::bounds(face.contour);
    return norm(box.high - box.low) <= 2 * repair;
  });
}

}  // namespace

Branches faces_of_branches(const std::vector<BranchChain>& chains, double repair, double widest_gap) {
  Branches made;
  for (const std::vector<std::uint32_t>& cluster : clusters_of(chains)) {
    std::vector<geom::Edge> edges;
    std::vector<std::uint32_t> curves;
    for (const std::uint32_t i : cluster) {
      edges.insert(edges.end(), chains[i].edges.begin(), chains[i].edges.end());
      curves.insert(curves.end(), chains[i].curves.begin(), chains[i].curves.end());
    }
    const auto gaps = gaps_of(chains, cluster, repair);
    if (gaps.size() == 1) {
      const auto& [one, other] = gaps.front();
      edges.push_back({geom::EdgeKind::line, one.at, other.at, {}});
      curves.push_back(one.curve);
      made.bridged.push_back({one.curve, 0.5 * norm(one.at - other.at) * (1 + 0x1p-48)});
    }
    const auto faces = geom::faces_between(edges);
    if ((!faces || only_loops(*faces, repair)) && !gaps_of(chains, cluster, widest_gap).empty()) {
      auto& unclosed = made.unclosed.emplace_back();
      for (std::size_t k = 0; k < edges.size(); ++k) unclosed.push_back({edges[k], curves[k]});
      continue;
    }
    if (!faces) {
      for (std::size_t k = 0; k < edges.size(); ++k) made.left.push_back({edges[k], curves[k]});
      continue;
    }
    for (const geom::CutContour& face : faces->contours) {
      LooseContour contour{face.contour, {}};
      for (const std::uint32_t origin : face.origins) contour.curves.push_back(curves[origin]);
      made.contours.push_back(std::move(contour));
    }
    for (const geom::CutEdge& one : faces->left) made.left.push_back({one.edge, curves[one.origin]});
  }
  return made;
}

}  // namespace lekalo::io

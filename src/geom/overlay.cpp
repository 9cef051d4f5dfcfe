#include "overlay.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "lekalo/base/limits.hpp"
#include "loop_contour.hpp"

namespace lekalo::geom::detail {
namespace {

/// Each attempt snaps eight times as far as the one before, the last 2^21 times as far as the first.
constexpr int kAttempts = 8;
constexpr double kCoarser = 8;

/// Makes one region of the outline and holes of each group. Returns nothing where a group has two outlines,
/// or holes alone.
std::optional<std::vector<Region>> regions_of(const std::vector<std::uint32_t>& groups,
                                              std::vector<Contour> contours) {
  std::map<std::uint32_t, std::size_t> owners;
  std::vector<Region> regions;
  std::vector<std::size_t> holes;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (!(geom::signed_area(contours[i]) > 0)) {
      holes.push_back(i);
      continue;
    }
    if (!owners.emplace(groups[i], regions.size()).second) return std::nullopt;
    regions.push_back({std::move(contours[i]), {}});
  }
  for (const std::size_t i : holes) {
    const auto owner = owners.find(groups[i]);
    if (owner == owners.end()) return std::nullopt;
    regions[owner->second].holes.push_back(std::move(contours[i]));
  }
  return regions;
}

/// Steps 1 to 5 of docs/design/boolean.md with one snapping distance; nothing where they contradict
/// themselves.
Result<std::optional<BooleanResult>> overlay_at(const Outlines& outlines, KeepRule keep, double snap,
                                                double operand_error) {
  // Steps 1 and 2: pieces, and snapping them.
  const Arrangement arrangement = arrange(outlines, snap);
  if (arrangement.too_much)
    return failure(
        ErrorCode::bad_input,
        fmt::format("the {} edges meet each other in more than {} places, or nearly; combine fewer "
                    "shapes at a time",
                    outlines.edges.size(), limits::kMostCrossings));
  // Step 3: the map of faces, which may contradict itself.
  const auto map = PlanarMap::make(arrangement);
  if (!map) return std::optional<BooleanResult>();
  // Step 4: faces are kept or dropped, and the kept ones are bounded by loops.
  std::vector<PlanarMap::Loop> loops = map->loops(keep);
  const auto first = [](const PlanarMap::Loop& loop) {
    return *std::min_element(loop.half_edges.begin(), loop.half_edges.end());
  };
  std::sort(loops.begin(), loops.end(),
            [&](const PlanarMap::Loop& a, const PlanarMap::Loop& b) { return first(a) < first(b); });

  // Step 5: contours, which must be regions as they are.
  BooleanResult result;
  result.edge_error = kEdgeErrorInSnaps * snap + operand_error;
  result.corner_error = result.edge_error;
  std::vector<std::uint32_t> groups;
  std::vector<Contour> contours;
  for (const PlanarMap::Loop& loop : loops) {
    LoopContour made = contour_of(loop, outlines, arrangement, result.edge_error);
    // A thin loop bounds nothing, or a crack in the material.
    if (PlanarMap::is_thin(arrangement, loop)) continue;
    result.corner_error = std::max(result.corner_error, made.corner_error);
    groups.push_back(loop.group);
    contours.push_back(std::move(made.contour));
  }
  auto regions = regions_of(groups, std::move(contours));
  if (!regions) return std::optional<BooleanResult>();
  // A loop so thin that rounding could turn it is no region. Snapping coarser points together may resolve it.
  for (const Region& region : *regions) {
    const auto again = make_region(region.outer, region.holes);
    if (!again || !(*again == region)) return std::optional<BooleanResult>();
  }
  result.regions = std::move(*regions);
  return std::optional(std::move(result));
}

}  // namespace

Result<BooleanResult> overlay(const Outlines& outlines, KeepRule keep, double operand_error) {
  double snap = kBooleanSnap * extent(outlines);
  if (snap == 0) return BooleanResult{};
  // Step 3: where the drawing contradicts itself, everything is done again with a coarser snap.
  for (int attempt = 0; attempt < kAttempts; ++attempt, snap *= kCoarser) {
    LEKALO_TRY(auto result, overlay_at(outlines, keep, snap, operand_error));
    if (result) return *std::move(result);
  }
  return failure(
      ErrorCode::bad_input,
      fmt::format("the outlines are too tangled: points up to {:.3g} mm apart were joined and they still "
                  "contradict each other; draw them with fewer coinciding edges",
                  snap / kCoarser));
}

}  // namespace lekalo::geom::detail

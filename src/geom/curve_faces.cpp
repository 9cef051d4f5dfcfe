#include "lekalo/geom/curve_faces.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "lekalo/base/limits.hpp"
#include "lekalo/geom/boolean.hpp"
#include "loop_contour.hpp"

namespace lekalo::geom {
namespace {

using detail::Arrangement;
using detail::KeepRule;
using detail::kNoEdge;
using detail::Outlines;
using detail::PlanarMap;
using detail::Winding;

/// As in overlay: each attempt snaps eight times as far as the one before.
constexpr int kAttempts = 8;
constexpr double kCoarser = 8;

/// Makes the contours of loops; nothing where one of them is none.
std::optional<CutFaces> contours_of(const Outlines& outlines, const Arrangement& arrangement,
                                    std::vector<PlanarMap::Loop> loops) {
  const auto first = [](const PlanarMap::Loop& loop) {
    return *std::min_element(loop.half_edges.begin(), loop.half_edges.end());
  };
  std::sort(loops.begin(), loops.end(),
            [&](const PlanarMap::Loop& a, const PlanarMap::Loop& b) { return first(a) < first(b); });
  CutFaces made;
  made.edge_error = made.corner_error = kEdgeErrorInSnaps * arrangement.snap;
  std::vector<char> runs(arrangement.edges.size(), 0);
  for (const PlanarMap::Loop& loop : loops) {
    if (PlanarMap::is_thin(arrangement, loop)) continue;
    detail::LoopContour read = contour_of(loop, outlines, arrangement, made.edge_error);
    const bool hole = !(signed_area(read.contour) > 0);
    const auto checked = make_region(hole ? reversed(read.contour) : read.contour);
    if (!checked) return std::nullopt;
    for (const std::uint32_t h : loop.half_edges) runs[h / 2] = 1;
    made.corner_error = std::max(made.corner_error, read.corner_error);
    made.contours.push_back({std::move(read.contour), std::move(read.origins)});
  }
  std::vector<char> listed(arrangement.edges.size(), 0);
  for (std::uint32_t i = 0; i < arrangement.stretches.size(); ++i) {
    const std::uint32_t e = arrangement.edge_of_stretch[i];
    if (e != kNoEdge && (runs[e] != 0 || std::exchange(listed[e], 1) != 0)) continue;
    const detail::Stretch& s = arrangement.stretches[i];
    const detail::Piece piece = piece_between(arrangement, s);
    made.left.push_back({{piece.kind, piece.from, piece.to, piece.centre}, piece.origin});
  }
  return made;
}

/// The rounds of overlay: everything is done again with a coarser snap where the map contradicts itself.
template <class Loops>
Result<CutFaces> cut(const Outlines& outlines, Loops&& loops_of) {
  double snap = kBooleanSnap * extent(outlines);
  if (snap == 0) return CutFaces{};
  for (int attempt = 0; attempt < kAttempts; ++attempt, snap *= kCoarser) {
    Arrangement arrangement = detail::arrange(outlines, snap);
    if (arrangement.too_much)
      return failure(ErrorCode::bad_input,
                     fmt::format("the {} edges meet each other in more than {} places, or nearly",
                                 outlines.edges.size(), limits::kMostCrossings));
    auto loops = loops_of(arrangement);
    if (!loops) continue;
    if (auto made = contours_of(outlines, arrangement, *std::move(loops))) return *std::move(made);
  }
  return failure(ErrorCode::bad_input, "the curves are too tangled");
}

}  // namespace

Result<CutFaces> contours_around(const std::vector<Contour>& contours, FillRule rule) {
  Outlines outlines;
  for (const Contour& contour : contours) outlines.add(contour, 0);
  const KeepRule keep = rule == FillRule::even_odd ? KeepRule([](const Winding& w) { return w[0] % 2 != 0; })
                                                   : KeepRule([](const Winding& w) { return w[0] != 0; });
  return cut(outlines, [&](const Arrangement& arrangement) -> std::optional<std::vector<PlanarMap::Loop>> {
    const auto map = PlanarMap::make(arrangement);
    if (!map) return std::nullopt;
    return map->loops(keep);
  });
}

Result<CutFaces> faces_between(const std::vector<Edge>& edges) {
  Outlines outlines;
  outlines.loose = true;
  for (const Edge& edge : edges) outlines.add(Contour{edge}, 0);
  return cut(outlines, [](Arrangement& arrangement) -> std::optional<std::vector<PlanarMap::Loop>> {
    const auto whole = PlanarMap::make_of_curves(arrangement);
    if (!whole) return std::nullopt;
    std::vector<detail::MapEdge> kept;
    std::vector<std::uint32_t> number(arrangement.edges.size(), kNoEdge);
    for (std::uint32_t e = 0; e < arrangement.edges.size(); ++e) {
      if (whole->is_bridge(e)) continue;
      number[e] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(arrangement.edges[e]);
    }
    for (std::uint32_t& e : arrangement.edge_of_stretch)
      if (e != kNoEdge) e = number[e];
    arrangement.edges = std::move(kept);
    const auto map = PlanarMap::make_of_curves(arrangement);
    if (!map) return std::nullopt;
    return map->face_loops();
  });
}

}  // namespace lekalo::geom

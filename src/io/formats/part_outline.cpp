#include "part_outline.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "io/drawing/near_edges.hpp"
#include "io/layout/layout_outline.hpp"
#include "lekalo/geom/curve_faces.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/io/layout/layout_json.hpp"

namespace lekalo::io {
namespace {

using geom::Contour;
using geom::Edge;
using geom::EdgeKind;

/// Chords are made finer down to this, mm: corners that mends pull apart are wider.
constexpr double kFinerChords[] = {1e-3, 1e-4, 2e-5};

void append_chords(const Edge& edge, double tolerance, Contour& lines) {
  const Edge chord{EdgeKind::line, edge.from, edge.to, {}};
  const auto near = [&] {
    const Bisected halves = bisected(edge);
    return geom::arc_sweep(edge) < 1.6 &&
           norm(nearest_on(geom::make_curve(chord), halves.middle) - halves.middle) <= tolerance;
  };
  if (edge.kind == EdgeKind::line || near()) {
    if (!(edge.from == edge.to)) lines.push_back(chord);
    return;
  }
  const Bisected halves = bisected(edge);
  append_chords(halves.first, tolerance, lines);
  append_chords(halves.second, tolerance, lines);
}

Contour lines_of(const Contour& contour, double tolerance) {
  Contour lines;
  for (const Edge& edge : contour) append_chords(edge, tolerance, lines);
  return lines;
}

std::optional<geom::Region> as_lines(const geom::Region& region, double tolerance) {
  auto outer = lines_of(region.outer, tolerance);
  std::vector<Contour> holes;
  for (const Contour& hole : region.holes) {
    Contour lines = lines_of(hole, tolerance);
    if (geom::make_region(geom::reversed(lines))) holes.push_back(std::move(lines));
  }
  auto made = geom::make_region(std::move(outer), std::move(holes));
  return made ? std::optional(*std::move(made)) : std::nullopt;
}

/// Returns the largest piece of what contours wind around, without the holes that the grid loses, and without
/// those of at most `most_loss` that the outer contour alone closes about: they are left of a crack in it.
std::optional<geom::Region> filled(const geom::Region& lines, double most_loss) {
  std::vector<Contour> contours{lines.outer};
  contours.insert(contours.end(), lines.holes.begin(), lines.holes.end());
  const auto cut = geom::contours_around(contours, geom::FillRule::nonzero);
  if (!cut || cut->contours.empty()) return std::nullopt;
  const auto largest =
      std::max_element(cut->contours.begin(), cut->contours.end(), [](const auto& a, const auto& b) {
        return geom::signed_area(a.contour) < geom::signed_area(b.contour);
      });
  geom::Region region{largest->contour, {}};
  const geom::RegionIndex inside({region});
  const auto is_of_crack = [&](const geom::CutContour& hole) {
    const geom::Box box = geom::bounds(hole.contour);
    return norm(box.high - box.low) <= most_loss &&
           std::all_of(hole.origins.begin(), hole.origins.end(),
                       [&](std::uint32_t edge) { return edge < lines.outer.size(); });
  };
  for (const geom::CutContour& one : cut->contours) {
    const Edge& first = one.contour.front();
    if (geom::signed_area(one.contour) < 0 && inside.contains(0.5 * (first.from + first.to)) &&
        !is_of_crack(one) &&
        geom::grid_region_of_curves({geom::reversed(one.contour), {}}, geom::ChordSide::grow,
                                    kFinerChords[0]))
      region.holes.push_back(one.contour);
  }
  return region;
}

std::vector<Edge> all_edges(const geom::Region& region) {
  std::vector<Edge> edges(region.outer.begin(), region.outer.end());
  for (const Contour& hole : region.holes) edges.insert(edges.end(), hole.begin(), hole.end());
  return edges;
}

/// Returns a bound on how far two regions' outlines are from each other; nothing beyond `most`.
std::optional<double> distance_between(const geom::Region& a, const geom::Region& b, double most) {
  const std::vector<Edge> of_a = all_edges(a), of_b = all_edges(b);
  const NearEdges near_a(of_a), near_b(of_b);
  double loss = 0;
  std::size_t work = kMostWork;
  for (const auto& [edges, others] : {std::pair(&of_a, &near_b), std::pair(&of_b, &near_a)})
    for (const Edge& edge : *edges) {
      const auto far = others->farthest(edge, most, work);
      if (!far) return std::nullopt;
      loss = std::max(loss, *far);
    }
  return loss;
}

}  // namespace

Result<PartOutline> outline_of_part(const geom::Region& region, double chord_tolerance, double most_loss) {
  auto kept = detail::outline_of_curves(region, geom::ChordSide::grow, chord_tolerance);
  if (kept) return PartOutline{*std::move(kept), 0};
  // Neither finer chords nor lines need fewer points.
  if (geom::points_of_curves(region, geom::ChordSide::grow, chord_tolerance) > kMostOutlinePoints)
    return tl::unexpected(kept.error());
  for (const double finer : kFinerChords) {
    if (finer >= chord_tolerance) continue;
    if (auto again = detail::outline_of_curves(region, geom::ChordSide::grow, finer))
      return PartOutline{*std::move(again), 0};
  }
  auto lines = as_lines(region, std::min(chord_tolerance, most_loss / 2));
  for (const bool fill : {false, true}) {
    if (lines && fill) lines = filled(*lines, most_loss);
    if (!lines) break;
    auto made = detail::outline_of_curves(*lines, geom::ChordSide::grow, chord_tolerance);
    if (!made) continue;
    const auto loss = distance_between(region, geom::region_of_lines(made->polygon), most_loss);
    if (loss) return PartOutline{*std::move(made), *loss};
  }
  return tl::unexpected(kept.error());
}

}  // namespace lekalo::io

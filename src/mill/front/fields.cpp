#include "fields.hpp"

#include <utility>

#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/offset.hpp"
#include "mill/path/arc_through.hpp"
#include "mill/path/edge_path.hpp"
#include "opening.hpp"

namespace lekalo::mill {
namespace {

using geom::Edge;
using geom::Region;

constexpr double kStrip = 0.12;         // of the tool's radius, left to the pass along the walls
constexpr double kFieldFillet = 0.55;   // of the tool's radius: corners of the fields
constexpr double kLeastCorridor = 2.8;  // of the radius the fields are opened by: what is shorter is a corner
constexpr std::size_t kManyEdges = 40;
constexpr double kFieldSpacing = 0.5, kFieldFit = 0.01;  // mm

/// True for a piece that leads on: more than one stretch of its boundary is no wall, or it goes round
/// something.
bool leads_on(const Region& piece, const geom::RegionIndex& walls) {
  if (!piece.holes.empty()) return true;
  const auto is_open = [&](const Edge& edge) { return walls.nearest(place_at(edge, 0.5)).distance > 1e-3; };
  int stretches = 0;
  bool last = is_open(piece.outer.back());
  for (const Edge& edge : piece.outer) {
    const bool now = is_open(edge);
    stretches += now && !last ? 1 : 0;
    last = now;
  }
  return stretches > 1;
}

/// Replaces long contours of short edges by lines and arcs near them: the fields need not be exact.
std::vector<Region> with_fewer_edges(std::vector<Region> regions) {
  std::vector<geom::Contour> contours;
  bool fewer = false;
  const auto look = [&](const geom::Contour& contour) {
    contours.push_back(contour);
    if (contour.size() < kManyEdges) return;
    contours.back().clear();
    fit_arcs(places_on(contour, kFieldSpacing), kFieldFit, contours.back());
    fewer = true;
  };
  for (const Region& region : regions) {
    look(region.outer);
    for (const geom::Contour& hole : region.holes) look(hole);
  }
  if (!fewer) return regions;
  auto made = geom::nest_contours(std::move(contours));
  return made ? std::move(*made) : regions;
}

/// The places that the fields leave over, without those that only lead into a corner, and with some of the
/// fields around them.
Result<std::vector<Region>> narrow_places(const Places& allowed, const std::vector<Region>& fields,
                                          double strip, double fillet) {
  LEKALO_TRY(auto reached, geom::offset(fields, 1.01 * strip));
  LEKALO_TRY(auto lost, geom::combine(allowed.regions, reached.regions, geom::BooleanOperation::subtract,
                                      reached.edge_error));
  // A short piece leads into a corner.
  std::erase_if(lost.regions, [&](const Region& piece) {
    const geom::Box box = geom::bounds(piece.outer);
    return !fields.empty() && norm(box.high - box.low) < kLeastCorridor * (strip + fillet) &&
           !leads_on(piece, allowed.index);
  });
  if (lost.regions.empty()) return std::vector<Region>{};
  LEKALO_TRY(auto wider, geom::offset(lost.regions, 2 * strip + fillet));
  LEKALO_TRY(auto narrow, geom::combine(wider.regions, allowed.regions, geom::BooleanOperation::intersect,
                                        wider.edge_error));
  return std::move(narrow.regions);
}

}  // namespace

Result<Piece> find_fields(const Region& allowed, double tool_radius, const std::vector<Region>& cleared) {
  Places all({allowed});
  const double strip = kStrip * tool_radius, fillet = kFieldFillet * tool_radius;
  LEKALO_TRY(auto opened, opened_by(all.regions, strip, fillet));
  std::vector<Region> fields = with_fewer_edges(std::move(opened));
  LEKALO_TRY(auto narrow, narrow_places(all, fields, strip, fillet));
  if (!cleared.empty()) {
    LEKALO_TRY(auto both, geom::combine(fields, cleared, geom::BooleanOperation::unite));
    fields = std::move(both.regions);
  }
  return Piece{tool_radius, strip, std::move(all), Places(std::move(fields)), Places(std::move(narrow))};
}

}  // namespace lekalo::mill

#include "heat_beside.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "lekalo/geom/edge_distance.hpp"

namespace lekalo::jobs {
namespace {

/// A tip is as deep as a place within this, mm.
constexpr double kTipAsDeep = 1e-6;

/// The way of a piece, seen from above. It turns by less than half a turn.
geom::Curve way_of(const heat::ToolPiece& piece) {
  geom::Edge edge{geom::EdgeKind::line, {piece.from[0], piece.from[1]}, {piece.to[0], piece.to[1]}, {}};
  // The curve of an arc without length would be a full circle.
  if (piece.centre && edge.from != edge.to) {
    edge.centre = {(*piece.centre)[0], (*piece.centre)[1]};
    const bool left = geom::cross(edge.from - edge.centre, edge.to - edge.centre) > 0;
    edge.kind = left ? geom::EdgeKind::arc_ccw : geom::EdgeKind::arc_cw;
  }
  return geom::make_curve(edge);
}

bool is_as_deep(const heat::ToolPiece& piece, double z) {
  return piece.line > 0 && !piece.rapid && std::max(piece.from[2], piece.to[2]) <= z + kTipAsDeep;
}

auto place_of(const WallPoint& w) { return std::tuple(w.x, w.y, w.z, w.outward); }

}  // namespace

BesideWall beside(const HeatSource& source, const WallPoint& wall, const WallVisit& visit) {
  BesideWall found;
  found.distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = visit.first; i <= visit.last; ++i) {
    const heat::ToolPiece& piece = source.pieces[i];
    if (!is_as_deep(piece, wall.z)) continue;
    const geom::Curve way = way_of(piece);
    const geom::Point foot = geom::nearest_on(way, {wall.x, wall.y}),
                      off = geom::Point{wall.x, wall.y} - foot, chord = way.edge.to - way.edge.from;
    const double distance = geom::norm(off), square = geom::dot(chord, chord);
    if (!(distance < found.distance)) continue;
    found = {distance, {off.x / distance, off.y / distance}, i, 0};
    if (square > 0) found.share = std::clamp(geom::dot(foot - way.edge.from, chord) / square, 0.0, 1.0);
  }
  return found;
}

double nearest_of_all(const HeatSource& source, const WallPoint& wall) {
  double least = std::numeric_limits<double>::infinity();
  for (const heat::ToolPiece& piece : source.pieces) {
    if (!is_as_deep(piece, wall.z)) continue;
    const geom::Point at{wall.x, wall.y};
    least = std::min(least, geom::norm(at - geom::nearest_on(way_of(piece), at)));
  }
  return least;
}

SamePlaces::SamePlaces(const std::vector<WallPoint>& walls) : walls_(&walls), order_(walls.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::ranges::sort(order_, {}, [&](std::size_t i) { return place_of(walls[i]); });
}

std::size_t SamePlaces::find(const WallPoint& wall) const {
  const auto at = std::ranges::lower_bound(order_, place_of(wall), {},
                                           [&](std::size_t i) { return place_of((*walls_)[i]); });
  return at != order_.end() && place_of((*walls_)[*at]) == place_of(wall) ? *at : walls_->size();
}

}  // namespace lekalo::jobs

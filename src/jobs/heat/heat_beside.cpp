#include "heat_beside.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace lekalo::jobs {
namespace {

/// A tip is as deep as a place within this, mm.
constexpr double kTipAsDeep = 1e-6;

/// The place on a piece that is nearest to a point, seen from above.
std::array<double, 2> foot_on(const heat::ToolPiece& piece, double x, double y) {
  const double dx = piece.to[0] - piece.from[0], dy = piece.to[1] - piece.from[1];
  if (!piece.centre) {
    const double square = dx * dx + dy * dy;
    const double t =
        square > 0 ? std::clamp(((x - piece.from[0]) * dx + (y - piece.from[1]) * dy) / square, 0.0, 1.0) : 0;
    return {piece.from[0] + t * dx, piece.from[1] + t * dy};
  }
  const auto& c = *piece.centre;
  const double ax = piece.from[0] - c[0], ay = piece.from[1] - c[1], bx = piece.to[0] - c[0],
               by = piece.to[1] - c[1], px = x - c[0], py = y - c[1];
  const double turn = ax * by - ay * bx, away = std::hypot(px, py);
  // A piece turns by less than half a turn.
  if (away > 0 && turn * (ax * py - ay * px) >= 0 && turn * (px * by - py * bx) >= 0 &&
      px * (ax + bx) + py * (ay + by) > 0) {
    const double radius = (std::hypot(ax, ay) + std::hypot(bx, by)) / 2;
    return {c[0] + radius * px / away, c[1] + radius * py / away};
  }
  const bool first = std::hypot(px - ax, py - ay) < std::hypot(px - bx, py - by);
  return first ? std::array{piece.from[0], piece.from[1]} : std::array{piece.to[0], piece.to[1]};
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
    const auto foot = foot_on(piece, wall.x, wall.y);
    const double distance = std::hypot(wall.x - foot[0], wall.y - foot[1]);
    if (!(distance < found.distance)) continue;
    const double dx = piece.to[0] - piece.from[0], dy = piece.to[1] - piece.from[1],
                 square = dx * dx + dy * dy;
    found = {distance, {(wall.x - foot[0]) / distance, (wall.y - foot[1]) / distance}, i, 0};
    if (square > 0)
      found.share =
          std::clamp(((foot[0] - piece.from[0]) * dx + (foot[1] - piece.from[1]) * dy) / square, 0.0, 1.0);
  }
  return found;
}

double nearest_of_all(const HeatSource& source, const WallPoint& wall) {
  double least = std::numeric_limits<double>::infinity();
  for (const heat::ToolPiece& piece : source.pieces) {
    if (!is_as_deep(piece, wall.z)) continue;
    const auto foot = foot_on(piece, wall.x, wall.y);
    least = std::min(least, std::hypot(wall.x - foot[0], wall.y - foot[1]));
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

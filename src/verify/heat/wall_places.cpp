#include "wall_places.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::verify {
namespace {

/// Places stand to 1e-6 mm, times to 1e-6 s.
constexpr double kRounded = 2e-6;
/// A wall is cut where the rim comes this near, mm; a pass is as near as another within kAsNear.
constexpr double kReached = 0.1, kAsNear = 0.03;
/// A tip is as deep as a place within this, mm.
constexpr double kAsDeep = 1e-6;
/// A flat pass begins a level if it is more than this below the one before, mm.
constexpr double kOneLevel = 0.01;
/// The tool has not left a place in this time, s.
constexpr double kOneVisit = 0.2;
/// Distances may round to the other side of a limit, mm.
constexpr double kDistanceRounding = 1e-9;

double middle(Span s) { return 0.5 * (s.low + s.high); }

/// An edge as numbers; a line has no radius.
struct WallEdge {
  bool open = false;
  double from_x = 0, from_y = 0, to_x = 0, to_y = 0;
  double x = 0, y = 0, radius = 0, begin = 0, turn = 0;  ///< of an arc: centre, first angle, signed turn
};

WallEdge edge_of(const Side& side) {
  WallEdge e;
  e.open = side.open;
  e.from_x = middle(side.written_from.x), e.from_y = middle(side.written_from.y);
  e.to_x = middle(side.written_to.x), e.to_y = middle(side.written_to.y);
  if (!side.arc) return e;
  e.x = middle(side.centre.x), e.y = middle(side.centre.y), e.radius = middle(side.radius);
  e.begin = std::atan2(e.from_y - e.y, e.from_x - e.x);
  e.turn = std::atan2(e.to_y - e.y, e.to_x - e.x) - e.begin;
  if (side.ccw && e.turn <= 0) e.turn += kTurn;
  if (!side.ccw && e.turn >= 0) e.turn -= kTurn;
  return e;
}

/// Twice the area to the left of the way, with the arcs' bulges.
double turning_area(const std::vector<WallEdge>& edges) {
  double sum = 0;
  for (const WallEdge& e : edges)
    sum += e.from_x * e.to_y - e.to_x * e.from_y + e.radius * e.radius * (e.turn - std::sin(e.turn));
  return sum;
}

/// \param side  1 where the pocket is to the left of the edge, -1 where it is to the right
void add_stations(const WallEdge& e, double side, double spacing, std::vector<WallStation>& stations) {
  const double dx = e.to_x - e.from_x, dy = e.to_y - e.from_y;
  const double whole = e.radius > 0 ? e.radius * std::abs(e.turn) : std::sqrt(dx * dx + dy * dy);
  const double count = std::max(1.0, std::ceil(whole / spacing));
  for (double k = 0.5; k < count && stations.size() <= limits::kMostHeatPlaces; ++k) {
    ask();
    const double share = k / count;
    if (e.radius > 0) {
      const double angle = e.begin + share * e.turn, out = e.turn > 0 ? side : -side;
      const double c = std::cos(angle), s = std::sin(angle);
      stations.push_back({e.x + e.radius * c, e.y + e.radius * s, {out * c, out * s}});
    } else {
      stations.push_back(
          {e.from_x + share * dx, e.from_y + share * dy, {side * dy / whole, -side * dx / whole}});
    }
  }
}

/// A piece is at most a quarter turn.
Stroke way_of(const CutPiece& piece) {
  Stroke way{false, true, {piece.from_x, piece.from_y}, {piece.to_x, piece.to_y}, {}, 0};
  if (!piece.centre) return way;
  way.arc = true, way.centre = {(*piece.centre)[0], (*piece.centre)[1]};
  const Place from = way.from - way.centre, to = way.to - way.centre;
  way.ccw = cross(from, to) > 0, way.radius = (length(from) + length(to)) / 2;
  return way;
}

double tip_of(const CutPiece& piece) { return std::max(piece.from_z, piece.to_z); }

}  // namespace

std::vector<WallStation> wall_stations(const Shape& pocket, double spacing) {
  std::vector<WallStation> stations;
  for (std::size_t piece = 0; piece + 1 < pocket.piece_starts.size(); ++piece)
    for (std::size_t c = pocket.piece_starts[piece]; c < pocket.piece_starts[piece + 1]; ++c) {
      std::vector<WallEdge> edges;
      for (std::size_t i = pocket.contour_starts[c]; i < pocket.contour_starts[c + 1]; ++i)
        if (pocket.sides[i].written) edges.push_back(edge_of(pocket.sides[i]));
      const bool island = c > pocket.piece_starts[piece];
      const double side = (turning_area(edges) > 0) == island ? -1 : 1;
      for (const WallEdge& edge : edges)
        if (!edge.open) add_stations(edge, side, spacing, stations);
    }
  return stations;
}

WallPlaces::WallPlaces(std::vector<WallStation> stations, const CutHistory& history, double top,
                       double thickness, double reach, double spacing)
    : stations_(std::move(stations)), reach_(reach) {
  std::ranges::sort(stations_, {}, &WallStation::x);
  double deepest = top;
  for (const CutPiece& piece : history.pieces)
    if (piece.line > 0 && !piece.rapid && tip_of(piece) < top)
      down_.push_back(&piece), deepest = std::min(deepest, tip_of(piece));
  set_heights(top, std::max(deepest, top - thickness), spacing);
  Place low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const CutPiece* piece : down_) {
    const Place from{piece->from_x, piece->from_y}, to{piece->to_x, piece->to_y};
    strokes_.push_back({false, true, from, to, {}, 0});
    ways_.push_back(way_of(*piece));
    low = {std::min({low.x, from.x, to.x}), std::min({low.y, from.y, to.y})};
    high = {std::max({high.x, from.x, to.x}), std::max({high.y, from.y, to.y})};
  }
  if (down_.empty()) return;
  index_ = {low, high, reach_};
  for (std::uint32_t i = 0; i < strokes_.size(); ++i) index_.add(i, strokes_[i]);
}

void WallPlaces::set_heights(double top, double deepest, double spacing) {
  std::set<double> levels;  // below the top, as heights
  for (const CutPiece* piece : down_)
    if (piece->from_z == piece->to_z) levels.insert(piece->to_z);
  double above = top;
  const auto fill_down_to = [&](double below) {
    const double count = std::max(1.0, std::round((above - below) / spacing));
    for (double k = 0.5; k < count && heights_.size() <= limits::kMostHeatPlaces; ++k)
      heights_.push_back(above - k * (above - below) / count);
    above = below;
  };
  for (auto level = levels.rbegin(); level != levels.rend(); ++level)
    if (*level - deepest > kOneLevel && above - *level > kOneLevel) fill_down_to(*level);
  fill_down_to(deepest);
}

bool WallPlaces::too_many() const { return stations_.size() * heights_.size() > limits::kMostHeatPlaces; }

std::optional<WallPlaces::Which> WallPlaces::find(double x, double y, double z) const {
  const auto near = [](double a, double b) { return std::abs(a - b) <= kRounded; };
  const auto height = std::ranges::find_if(heights_, [&](double h) { return near(h, z); });
  if (height == heights_.end()) return std::nullopt;
  for (auto at = std::ranges::lower_bound(stations_, x - kRounded, {}, &WallStation::x);
       at != stations_.end() && near(at->x, x); ++at)
    if (near(at->y, y))
      return Which{static_cast<std::size_t>(at - stations_.begin()),
                   static_cast<std::size_t>(height - heights_.begin())};
  return std::nullopt;
}

void WallPlaces::go_to(std::size_t station) {
  const Place at{stations_[station].x, stations_[station].y};
  near_.clear(), distances_.clear(), at_ = station;
  if (!down_.empty()) index_.near(at, reach_ + kReached + kAsNear + 2 * kDistanceRounding, near_);
  for (const std::uint32_t i : near_) distances_.push_back(distance(at, strokes_[i]));
  ask(1 + near_.size());
}

double WallPlaces::nearest(std::size_t height) const {
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < near_.size(); ++k)
    if (tip_of(*down_[near_[k]]) <= heights_[height] + kAsDeep) least = std::min(least, distances_[k]);
  return least;
}

WallPlaces::Cut WallPlaces::cut(std::size_t height) const {
  const double over = nearest(height) - reach_ - kReached;
  return {over <= 0, std::abs(over) <= kDistanceRounding};
}

std::vector<WallPlaces::Visit> WallPlaces::visits(std::size_t height, double slack) const {
  const double within = nearest(height) + kAsNear + slack;
  const auto is_deep = [&](std::size_t k) { return tip_of(*down_[near_[k]]) <= heights_[height] + kAsDeep; };
  std::vector<std::pair<std::size_t, std::size_t>> runs;  // of near_, both ends among them
  double ended = -HUGE_VAL;
  for (std::size_t k = 0; k < near_.size(); ++k) {
    if (!is_deep(k) || !(distances_[k] <= within)) continue;
    const CutPiece& piece = *down_[near_[k]];
    if (piece.start > ended + kOneVisit) runs.emplace_back(k, k);
    runs.back().second = k, ended = piece.start + piece.seconds;
  }
  const Place at{stations_[at_].x, stations_[at_].y};
  std::vector<Visit> found;
  for (const auto& [first, last] : runs) {
    Visit visit;
    visit.start = down_[near_[first]]->start,
    visit.end = down_[near_[last]]->start + down_[near_[last]]->seconds;
    visit.distance = HUGE_VAL;
    for (std::size_t k = first; k <= last; ++k) {
      if (!is_deep(k)) continue;
      const Place off = at - nearest_on(ways_[near_[k]], at);
      if (const double distance = length(off); distance < visit.distance)
        visit.distance = distance, visit.towards = {off.x / distance, off.y / distance};
    }
    found.push_back(visit);
  }
  return found;
}

bool WallPlaces::visited(std::size_t height, double seconds) const {
  const double within = nearest(height) + kAsNear + kDistanceRounding;
  for (std::size_t k = 0; k < near_.size(); ++k) {
    const CutPiece& piece = *down_[near_[k]];
    if (std::abs(piece.start + piece.seconds / 2 - seconds) <= kRounded && distances_[k] <= within &&
        tip_of(piece) <= heights_[height] + kAsDeep)
      return true;
  }
  return false;
}

}  // namespace lekalo::verify

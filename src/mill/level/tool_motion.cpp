#include "tool_motion.hpp"

#include <algorithm>
#include <utility>

#include "mill/path/edge_path.hpp"
#include "wall_way.hpp"

namespace lekalo::mill {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

namespace {

constexpr double kApproach = 1;  // mm above the stock: from there on at the plunge feed
constexpr double kFrontWay = 3;  // of the step: links from front to front that need no grid, at most
constexpr double kMostBack = 40, kBackSpacing = 1.5;  // mm: farther back a lift is sooner there
constexpr double kOnlyStep = 0.5;  // of the tool's radius: what is nearer is cut to instead of hopped to

bool is_within(const std::vector<Edge>& edges, const geom::RegionIndex& cut, double slack) {
  const std::vector<Point> places = places_on(edges, 0.1);
  return std::all_of(places.begin() + 1, places.end() - 1,
                     [&](Point p) { return cut.contains(p) || cut.nearest(p).distance <= slack; });
}

}  // namespace

ToolMotion::ToolMotion(const Piece& piece, const PocketOptions& o)
    : piece_(piece), depth_(o.depth), safe_height_(o.safe_height), step_(o.step_over * o.tool_diameter) {}

void ToolMotion::go(const PathMove& move) {
  if (move.shape == EdgeKind::line && !moves_.empty() && moves_.back().to == move.to &&
      moves_.back().z == move.z)
    return;
  at_ = move.to;
  moves_.push_back(move);
}

void ToolMotion::go(Kind kind, Point to) { go({.kind = kind, .to = to, .z = -depth_}); }

void ToolMotion::go(Kind kind, const Edge& edge) {
  // The centre is put at the same distance from both ends, whatever rounding or a way along a wall made of
  // them.
  const Point chord = edge.to - at_;
  const double square = dot(chord, chord);
  Point centre = edge.centre;
  if (edge.kind != EdgeKind::line && square > 0)
    centre = centre - (dot(centre - 0.5 * (at_ + edge.to), chord) / square) * chord;
  go({.kind = kind, .to = edge.to, .z = -depth_, .shape = edge.kind, .centre = centre});
}

void ToolMotion::go(Kind kind, const std::vector<Edge>& edges) {
  for (const Edge& edge : edges) go(kind, edge);
}

void ToolMotion::rise() { go({.kind = Kind::rapid, .to = at_, .z = safe_height_}); }

void ToolMotion::come_down(Point to, double z) {
  go({.kind = Kind::rapid, .to = to, .z = safe_height_});
  go({.kind = Kind::rapid, .to = to, .z = std::min(safe_height_, kApproach)});
  go({.kind = Kind::plunge, .to = to, .z = z});
}

void ToolMotion::come_down(Point to) { come_down(to, -depth_); }

void ToolMotion::link(Point to) { link_along(piece_.allowed.index, to); }

void ToolMotion::link_along(const geom::RegionIndex& walls, Point to) {
  const double far = norm(to - at_);
  if (far < 1e-6) return;
  if (far < kWallWay * step_)
    if (const auto wall = way_along_wall(walls, at_, to, kWallWay * step_)) return go(Kind::link, *wall);
  link_over_grid(to);
}

void ToolMotion::link(Point to, const geom::RegionIndex& cut) {
  const double far = norm(to - at_);
  if (far < 1e-6) return;
  if (far < kFrontWay * step_) {
    const auto wall = way_along_wall(piece_.fields.index, at_, to, kWallWay * step_);
    // The wall of the fields also runs past mouths of corridors, where material may still stand.
    if (wall && is_within(*wall, cut, 0.02 * piece_.tool_radius)) return go(Kind::link, *wall);
    if (is_within({{EdgeKind::line, at_, to, {}}}, cut, 1e-3)) return go(Kind::link, to);
  }
  link_over_grid(to);
}

/// Links over the grid. Where it has no way (in a corridor that is narrower than its pitch, or at a place
/// whose front is still to be cut) the tool first goes back on its path to where there is one.
void ToolMotion::link_over_grid(Point to) {
  std::vector<Edge> back;
  double length = 0, tried = -kBackSpacing;
  for (std::size_t i = moves_.size(); i > 0; --i) {
    const Point from = back.empty() ? at_ : back.back().to;
    if (length - tried >= kBackSpacing) {
      tried = length;
      if (const std::vector<Point> corners = way_inside(from, to); !corners.empty()) {
        go(Kind::link, back);
        for (const Point corner : corners) go(Kind::link, corner);
        return;
      }
    }
    const PathMove& move = moves_[i - 1];
    if (i < 2 || move.z != -depth_ || moves_[i - 2].z != -depth_) break;
    const Point begin = moves_[i - 2].to;
    back.push_back(geom::reversed(move.shape == EdgeKind::line ? Edge{EdgeKind::line, begin, move.to, {}}
                                                               : arc_of(move, begin)));
    length += length_of(back.back());
    if (length > kMostBack) break;
  }
  hop(to);
}

std::vector<Point> ToolMotion::way_inside(Point from, Point to) const {
  const auto is_way = [&](const std::vector<Point>& corners) {
    Point last = from;
    return !corners.empty() && std::all_of(corners.begin(), corners.end(), [&](Point corner) {
      return is_inside(std::exchange(last, corner), corner);
    });
  };
  std::vector<Point> corners = grid_->way(from, to);
  return is_way(corners) ? corners : std::vector<Point>{};
}

/// Goes over the stock, because there is no way at depth.
void ToolMotion::hop(Point to) {
  if (norm(to - at_) < kOnlyStep * piece_.tool_radius && is_inside(at_, to)) return go(Kind::cut, to);
  rise();
  come_down(to);
}

bool ToolMotion::is_inside(const Edge& edge) const {
  const geom::RegionIndex& limit = piece_.allowed.index;
  const std::vector<Point> places = places_on({edge}, 0.05 * piece_.tool_radius);
  return std::all_of(places.begin(), places.end(),
                     [&](Point p) { return limit.contains(p) || !(limit.nearest(p).distance > 1e-4); });
}

bool ToolMotion::is_inside(Point from, Point to) const { return is_inside({EdgeKind::line, from, to, {}}); }

}  // namespace lekalo::mill

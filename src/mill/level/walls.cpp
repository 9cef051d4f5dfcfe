#include "walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "cleared.hpp"
#include "lekalo/base/stop.hpp"
#include "mill/path/edge_path.hpp"

namespace lekalo::mill {

using geom::Edge;
using geom::Point;
using geom::Region;
using geom::RegionIndex;
using Kind = PathMove::Kind;

namespace {

constexpr double kNearWall = 1.5;  // of the strip: a pass that ends nearer leads on to the wall
constexpr double kAhead = 4;       // of the strip: along the wall, to where it is led
constexpr double kLeastAhead = 2;  // of the strip: what is led to the wall over less comes to it steeply
constexpr double kBadStart = 3;    // of the tool's radius: of way rather than a start at a corner, or steeply
constexpr double kMissed = 5e-3;   // mm: walls on which more stands are cut once more
constexpr double kMissedPiece = 0.1;  // of the tool's radius

/// The corners that are left from each edge of the walls: how many mm along the edge, and which.
using Stops = std::vector<std::vector<std::pair<double, std::size_t>>>;

Stops stops_of(const RegionIndex& walls, const std::vector<Front>& corners) {
  Stops stops(walls.curves().size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point end = corners[i].edges.back().to;
    const auto near = walls.nearest(end);
    const Edge& edge = walls.curves()[near.edge].edge;
    stops[near.edge].emplace_back(length_of(Edge{edge.kind, edge.from, end, edge.centre}), i);
  }
  for (auto& list : stops) std::sort(list.begin(), list.end());
  return stops;
}

/// The place where the pass along a wall begins.
struct WallStart {
  std::size_t contour = 0;
  std::uint32_t edge = 0;
  double share = 0;           ///< of the edge
  std::optional<Point> from;  ///< near the wall, cut
};

std::size_t contour_of(const RegionIndex& walls, std::uint32_t edge) {
  const auto& starts = walls.contour_starts();
  return static_cast<std::size_t>(std::upper_bound(starts.begin(), starts.end(), edge) - starts.begin()) - 1;
}

/// Finds the start nearest to where the tool is.
/// \param left  contours
WallStart wall_start(const RegionIndex& walls, const std::vector<std::size_t>& left, const Stops& stops,
                     const std::vector<Point>& ends, const Piece& piece, Point at) {
  const double strip = piece.strip, radius = piece.tool_radius;
  WallStart best;
  double least = std::numeric_limits<double>::infinity();
  for (const Point end : ends) {
    const auto near = walls.nearest(end);
    if (near.distance > kNearWall * strip) continue;
    const std::size_t contour = contour_of(walls, near.edge);
    if (std::find(left.begin(), left.end(), contour) == left.end()) continue;
    const Edge& edge = walls.curves()[near.edge].edge;
    if (edge.from == edge.to) continue;
    const double length = length_of(edge);
    double along = norm(near.point - edge.from) < 1e-9
                       ? 0
                       : length_of(Edge{edge.kind, edge.from, near.point, edge.centre});
    along = std::min(length, along + kAhead * strip);
    const bool at_corner =
        std::any_of(stops[near.edge].begin(), stops[near.edge].end(),
                    [&](const auto& stop) { return std::abs(stop.first - along) < radius; });
    const bool steep = norm(place_at(edge, along / length) - end) < kLeastAhead * strip;
    const double d = norm(end - at) + (at_corner ? kBadStart * radius : 0) + (steep ? kBadStart * radius : 0);
    if (d < least) least = d, best = {contour, near.edge, along / length, end};
  }
  if (best.from) return best;
  for (const std::size_t contour : left)
    for (std::uint32_t e = walls.contour_starts()[contour]; e < walls.contour_starts()[contour + 1]; ++e) {
      const double d = norm(walls.curves()[e].edge.from - at);
      if (d < least) least = d, best = {contour, e, 0, std::nullopt};
    }
  return best;
}

/// Goes once round a contour.
Result<void> cut_wall(ToolMotion& tool, Corners& corners, const WallStart& start, const Stops& stops) {
  const RegionIndex& walls = corners.walls().index;
  const Edge begun = walls.curves()[start.edge].edge;
  const Point on = start.share < 1 ? place_at(begun, start.share) : begun.to;
  if (start.from) tool.link(*start.from);
  if (start.from && tool.is_inside(tool.at(), on))
    tool.go(Kind::cut, on);
  else
    tool.link(on);
  const std::uint32_t first = walls.contour_starts()[start.contour],
                      count = walls.contour_starts()[start.contour + 1] - first;
  for (std::uint32_t k = 0; k <= count; ++k) {
    const std::uint32_t e = first + (start.edge - first + k) % count;
    Edge edge = walls.curves()[e].edge;
    if (k == 0) {
      if (!(start.share < 1)) continue;
      edge.from = on;
    } else if (k == count) {
      if (!(start.share > 0)) continue;
      edge.to = on;
    }
    const double skipped = k == 0 ? start.share * length_of(begun) : 0;
    const double length = skipped + length_of(edge);
    for (const auto& [along, corner] : stops[e]) {
      if (along < skipped - 1e-6 || (k == count && along > length - 1e-6)) continue;
      const Point stop = corners.zones()[corner].edges.back().to;
      if (norm(stop - edge.from) > 1e-6) {
        const bool ends = norm(stop - edge.to) < 1e-6;
        tool.go(Kind::cut, ends ? edge : Edge{edge.kind, edge.from, stop, edge.centre});
        edge.from = ends ? edge.to : stop;
      }
      LEKALO_CHECK(corners.cut(corner, tool));
      tool.link(stop);
    }
    if (!(edge.from == edge.to)) tool.go(Kind::cut, edge);
  }
  return {};
}

/// The lines and arcs of a path that cut.
class CutPlaces {
 public:
  explicit CutPlaces(const std::vector<PathMove>& moves) {
    Point from;
    for (const PathMove& move : moves) {
      if (move.kind == Kind::cut && !(move.to == from)) {
        curves_.push_back(geom::make_curve({move.shape, from, move.to, move.centre}));
        boxes_.push_back(geom::curve_box(curves_.back()));
      }
      from = move.to;
    }
  }

  [[nodiscard]] bool are_near(Point p) const {
    for (std::size_t i = 0; i < curves_.size(); ++i)
      if (p.x > boxes_[i].low.x - kMissed && p.x < boxes_[i].high.x + kMissed &&
          p.y > boxes_[i].low.y - kMissed && p.y < boxes_[i].high.y + kMissed &&
          norm(geom::nearest_on(curves_[i], p) - p) < kMissed)
        return true;
    return false;
  }

 private:
  std::vector<geom::Curve> curves_;
  std::vector<geom::Box> boxes_;
};

}  // namespace

Result<void> cut_walls(ToolMotion& tool, Corners& corners, const Piece& piece,
                       const std::vector<Point>& ends) {
  const RegionIndex& walls = corners.walls().index;
  const Stops stops = stops_of(walls, corners.zones());
  std::vector<std::size_t> left(walls.contour_starts().size() - 1);
  std::iota(left.begin(), left.end(), std::size_t{0});
  while (!left.empty()) {
    ask();
    const WallStart start = wall_start(walls, left, stops, ends, piece, tool.at());
    std::erase(left, start.contour);
    LEKALO_CHECK(cut_wall(tool, corners, start, stops));
  }
  return {};
}

void cut_stretches(ToolMotion& tool, const std::vector<Front>& walls, std::vector<std::size_t> which,
                   const RegionIndex& rounded) {
  while (!which.empty()) {
    const auto next = std::min_element(which.begin(), which.end(), [&](std::size_t a, std::size_t b) {
      return norm(walls[a].edges.front().from - tool.at()) < norm(walls[b].edges.front().from - tool.at());
    });
    tool.link_along(rounded, walls[*next].edges.front().from);
    tool.go(Kind::cut, walls[*next].edges);
    which.erase(next);
  }
}

void cut_missed_walls(ToolMotion& tool, const Piece& piece, const std::vector<Region>& cleared) {
  const RegionIndex before(cleared);
  const CutPlaces passes(tool.moves());
  const auto is_cut = [&](Point p) {
    return passes.are_near(p) ||
           (!cleared.empty() && (before.contains(p) || before.nearest(p).distance < kMissed - kThin));
  };
  std::vector<std::vector<Edge>> missed;
  for (const geom::Curve& wall : piece.allowed.index.curves()) {
    const double pieces = std::max(1.0, std::ceil(length_of(wall.edge) / (kMissedPiece * piece.tool_radius)));
    for (double i = 0; i < pieces; ++i) {
      ask();
      // The ends count too: of a blunt corner that a larger tool rounded its point alone stands.
      const Edge part = part_of(wall.edge, i / pieces, (i + 1) / pieces);
      if (is_cut(part.from) && is_cut(place_at(part, 0.5)) && is_cut(part.to)) continue;
      if (missed.empty() || !(missed.back().back().to == part.from)) missed.emplace_back();
      missed.back().push_back(part);
    }
  }
  for (const std::vector<Edge>& stretch : missed) {
    tool.link(stretch.front().from);
    tool.go(Kind::cut, stretch);
  }
}

}  // namespace lekalo::mill

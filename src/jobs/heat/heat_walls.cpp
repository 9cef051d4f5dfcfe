#include "heat_walls.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/io/shape/region_json.hpp"

namespace lekalo::jobs {
namespace {

/// A pass is as near to a wall as another within this, mm: pieces of arcs are chords.
constexpr double kAsNear = 0.03;
/// A wall is cut where the tool's rim comes this near, mm.
constexpr double kReached = 0.1;
/// The tool has not left a place in this time, s.
constexpr double kOneVisit = 0.2;
/// A tip is as deep as a place within this, mm.
constexpr double kAsDeep = 1e-6;
/// Flat passes within this are of one level, mm.
constexpr double kOneLevel = 0.01;

struct Station {
  geom::Point at;
  std::array<double, 2> outward{};
};

/// Places along an edge, whose left is the pocket.
void add_stations(const geom::Edge& edge, double spacing, std::vector<Station>& stations) {
  const geom::Point way = edge.to - edge.from;
  if (edge.kind == geom::EdgeKind::line) {
    const double length = geom::norm(way);
    const double count = std::max(1.0, std::ceil(length / spacing));
    for (double k = 0; k < count && stations.size() <= limits::kMostHeatPlaces; ++k) {
      const double t = (k + 0.5) / count;
      stations.push_back({edge.from + t * way, {way.y / length, -way.x / length}});
    }
    return;
  }
  const bool ccw = edge.kind == geom::EdgeKind::arc_ccw;
  const geom::Point a = edge.from - edge.centre, b = edge.to - edge.centre;
  const double radius = geom::arc_radius(edge), from = geom::direction_angle(a.x, a.y);
  double turn = geom::direction_angle(b.x, b.y) - from;
  if (ccw && turn <= 0) turn += kTurn;
  if (!ccw && turn >= 0) turn -= kTurn;
  const double count = std::max(1.0, std::ceil(radius * std::abs(turn) / spacing));
  for (double k = 0; k < count && stations.size() <= limits::kMostHeatPlaces; ++k) {
    const auto direction = geom::sincos(from + turn * (k + 0.5) / count);
    const double sign = ccw ? 1 : -1;
    stations.push_back({{edge.centre.x + radius * direction.cosine, edge.centre.y + radius * direction.sine},
                        {sign * direction.cosine, sign * direction.sine}});
  }
}

double distance_from(const heat::ToolPiece& piece, geom::Point p) {
  const double dx = piece.to[0] - piece.from[0], dy = piece.to[1] - piece.from[1];
  const double px = p.x - piece.from[0], py = p.y - piece.from[1], square = dx * dx + dy * dy;
  const double t = square > 0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(px - t * dx, py - t * dy);
}

double tip_of(const heat::ToolPiece& piece) { return std::max(piece.from[2], piece.to[2]); }

/// Returns what divides a wall into strips that the same passes cut, from the top down: the depths of flat
/// passes.
std::vector<double> level_borders(const std::vector<const heat::ToolPiece*>& down, double top,
                                  double deepest) {
  std::vector<double> depths;
  for (const heat::ToolPiece* piece : down)
    if (piece->from[2] == piece->to[2] && piece->to[2] > deepest) depths.push_back(piece->to[2]);
  std::ranges::sort(depths, std::greater{});
  std::vector<double> borders{top};
  for (const double depth : depths)
    if (borders.back() - depth > kOneLevel) borders.push_back(depth);
  if (borders.size() > 1 && borders.back() - deepest <= kOneLevel) borders.pop_back();
  borders.push_back(deepest);
  return borders;
}

/// Returns the heights of places, from the top down. They lie inside of strips, as far from their borders as
/// from each other: what cuts a place on a border would be a matter of rounding.
std::vector<double> heights_of(const std::vector<double>& borders, double spacing) {
  std::vector<double> heights;
  for (std::size_t i = 1; i < borders.size(); ++i) {
    const double strip = borders[i - 1] - borders[i], count = std::max(1.0, std::round(strip / spacing));
    for (double k = 0.5; k < count && heights.size() <= limits::kMostHeatPlaces; ++k)
      heights.push_back(borders[i - 1] - k * strip / count);
  }
  return heights;
}

/// Solves three equations with a positive definite matrix by Cholesky's method; 0 for what nothing decides.
std::array<double, 3> solved(std::array<std::array<double, 3>, 3> m, std::array<double, 3> b) {
  std::array<bool, 3> decided{};
  const double scale = m[0][0] + m[1][1] + m[2][2];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < i; ++k)
      if (decided[k]) m[i][i] -= m[i][k] * m[i][k];
    decided[i] = m[i][i] > 1e-12 * scale;
    if (!decided[i]) continue;
    m[i][i] = std::sqrt(m[i][i]);
    for (std::size_t j = i + 1; j < 3; ++j) {
      for (std::size_t k = 0; k < i; ++k)
        if (decided[k]) m[j][i] -= m[j][k] * m[i][k];
      m[j][i] /= m[i][i];
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < i; ++k)
      if (decided[k]) b[i] -= m[i][k] * b[k];
    b[i] = decided[i] ? b[i] / m[i][i] : 0;
  }
  for (std::size_t i = 3; i-- > 0;) {
    for (std::size_t k = i + 1; k < 3; ++k)
      if (decided[i]) b[i] -= m[k][i] * b[k];
    b[i] = decided[i] ? b[i] / m[i][i] : 0;
  }
  return b;
}

}  // namespace

Result<CutWalls> cut_walls(const HeatSourceJob& job, const HeatSource& source, double spacing) {
  std::vector<geom::Edge> open;
  LEKALO_TRY(const io::RegionFile pocket, io::parse_regions(job.pocket.bytes, job.pocket.name, {}, &open));
  std::vector<Station> stations;
  const auto add_walls = [&](const geom::Contour& contour) {
    for (const geom::Edge& edge : contour)
      if (std::ranges::find(open, edge) == open.end() &&
          std::ranges::find(open, geom::reversed(edge)) == open.end())
        add_stations(edge, spacing, stations);
  };
  for (const geom::Region& region : pocket.regions) {
    add_walls(region.outer);
    for (const geom::Contour& hole : region.holes) add_walls(hole);
  }
  const double top = job.machining.top,
               radius = job.machining.tool_diameter / 2 + job.machining.stock_to_leave;
  double deepest = top;
  std::vector<const heat::ToolPiece*> down;
  for (const heat::ToolPiece& piece : source.pieces)
    if (tip_of(piece) < top && piece.line > 0 && !piece.rapid) {
      down.push_back(&piece);
      deepest = std::min(deepest, tip_of(piece));
    }
  deepest = std::max(deepest, top - source.stock.box.thickness);
  const std::vector<double> heights = heights_of(level_borders(down, top, deepest), spacing);
  if (heights.size() * stations.size() > limits::kMostHeatPlaces)
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: its walls have more than {} places {} mm apart; choose larger voxels",
                               job.pocket.name, limits::kMostHeatPlaces, spacing));
  CutWalls walls;
  std::vector<double> distances(down.size());
  for (const Station& station : stations) {
    ask(1 + down.size() / 16);
    for (std::size_t i = 0; i < down.size(); ++i) distances[i] = distance_from(*down[i], station.at);
    for (const double z : heights) {
      const auto is_deep = [&](std::size_t i) { return tip_of(*down[i]) <= z + kAsDeep; };
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < down.size(); ++i)
        if (is_deep(i)) nearest = std::min(nearest, distances[i]);
      if (!(nearest <= radius + kReached)) {
        ++walls.uncut;
        continue;
      }
      WallPoint point;
      point.x = station.at.x, point.y = station.at.y, point.z = z, point.outward = station.outward;
      // Pieces that follow one another are one visit, at its nearest.
      std::vector<WallVisit> visits;
      double best = 0, ended = -std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < down.size(); ++i) {
        if (!is_deep(i) || !(distances[i] <= nearest + kAsNear)) continue;
        const double at = down[i]->start + down[i]->seconds / 2;
        const auto piece = static_cast<std::size_t>(down[i] - source.pieces.data());
        if (down[i]->start > ended + kOneVisit) {
          visits.push_back({at, piece, piece}), best = distances[i];
        } else if (distances[i] < best) {
          visits.back().at = at, best = distances[i];
        }
        visits.back().last = piece;
        ended = down[i]->start + down[i]->seconds;
      }
      walls.visits.push_back(std::move(visits));
      walls.points.push_back(point);
    }
  }
  if (walls.points.empty())
    return failure(ErrorCode::bad_input,
                   job.program.name + ": the program cuts no wall of " + job.pocket.name +
                       "; the tool, the stock to leave and the pocket have to be those of the program");
  return walls;
}

WallErrors summary_of(const std::vector<double>& errors) {
  WallErrors found;
  if (errors.empty()) return found;
  const auto [least, most] = std::ranges::minmax(errors);
  found.least = least, found.most = most;
  for (const double error : errors) found.mean += error;
  found.mean /= static_cast<double>(errors.size());
  return found;
}

std::vector<double> scaled(const std::vector<WallPoint>& walls, const std::vector<double>& errors_um,
                           double part, const UniformScaling& by) {
  std::vector<double> left;
  const double growth = 1000 * (by.factor - 1);  // um of a mm
  for (std::size_t n = 0; n < walls.size(); ++n) {
    const WallPoint& w = walls[n];
    const double x = growth * (w.x - by.centre[0]) + by.shift_um[0],
                 y = growth * (w.y - by.centre[1]) + by.shift_um[1];
    left.push_back(part * errors_um[n] + x * w.outward[0] + y * w.outward[1]);
  }
  return left;
}

double WallErrors::largest() const noexcept { return std::max(std::abs(least), std::abs(most)); }

UniformScaling best_scaling(const std::vector<WallPoint>& walls, const std::vector<double>& errors_um) {
  double middle_x = 0, middle_y = 0;
  for (const WallPoint& w : walls) middle_x += w.x, middle_y += w.y;
  middle_x /= static_cast<double>(walls.size()), middle_y /= static_cast<double>(walls.size());
  // A wall moves outwards by (x n) e + s n where the program is scaled by 1 + e and shifted by s.
  const auto row = [&](const WallPoint& w) {
    return std::array{(w.x - middle_x) * w.outward[0] + (w.y - middle_y) * w.outward[1], w.outward[0],
                      w.outward[1]};
  };
  std::array<std::array<double, 3>, 3> matrix{};
  std::array<double, 3> right{};
  for (std::size_t n = 0; n < walls.size(); ++n) {
    const auto r = row(walls[n]);
    for (std::size_t i = 0; i < 3; ++i) {
      right[i] -= r[i] * errors_um[n];
      for (std::size_t k = 0; k < 3; ++k) matrix[i][k] += r[i] * r[k];
    }
  }
  const std::array<double, 3> found = solved(matrix, right);
  UniformScaling scaling;
  scaling.factor = 1 + found[0] / 1000;
  scaling.centre = {middle_x, middle_y};
  scaling.shift_um = {found[1], found[2]};
  scaling.left = summary_of(scaled(walls, errors_um, 1, scaling));
  return scaling;
}

}  // namespace lekalo::jobs

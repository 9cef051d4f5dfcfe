#include "lekalo/solid/point_surface.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <utility>

#include "edge_flips.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "point_grid.hpp"

namespace lekalo::solid {
namespace {

constexpr double kMostCells = 4e7;
/// As many triangles as the surface is meant to have at most, if nobody says how fine it is to be.
constexpr double kTriangles = 300'000;
/// The radius of the ball has so many of the cells' sides, unless the points are many more.
constexpr double kStepsOfBall = 3;
/// Edges may become so many times longer than they should be, so that the cells are not too many.
constexpr double kCoarser = 4;
/// A floor's cells away from its rim are joined to squares of twice so many cells.
constexpr std::int32_t kFloorSquare = 8;
/// The cells take this part of the time. Measured.
constexpr double kCellsShare = 0.7;

/// Guesses the area that the points lie on, by cells that have several each: a surface passes about one and a
/// half for each square of their size.
double area_of(const std::vector<Vector>& points, const Box& box) {
  const Vector size = box.high - box.low;
  const double longest = std::max({size.x, size.y, size.z});
  std::vector<std::uint32_t> cells(points.size());
  for (double side = 256;; side /= 2) {
    const double cell = longest / side;
    const auto at = [&](double x, double low) { return static_cast<std::uint32_t>((x - low) / cell); };
    for (std::size_t k = 0; k < points.size(); ++k) {
      ask();
      const Vector p = points[k];
      cells[k] = (at(p.z, box.low.z) << 18U) + (at(p.y, box.low.y) << 9U) + at(p.x, box.low.x);
    }
    std::ranges::sort(cells);
    std::size_t different = 1;
    for (std::size_t k = 1; k < cells.size(); ++k) different += cells[k] != cells[k - 1] ? 1U : 0U;
    if (4 * different <= points.size() || side <= 1)
      return static_cast<double>(different) * cell * cell / 1.5;
  }
}

double cells_of(const Box& box, double step, double ball) {
  const double around = 2 * (ball + 3 * step);
  const Vector size = box.high - box.low;
  return (size.x + around) * (size.y + around) * (size.z + around) / (step * step * step);
}

/// The size of the cells: about the distance of the points, and small beside the ball.
Result<double> step_for(const std::vector<Vector>& points, const Box& box,
                        const PointSurfaceOptions& options) {
  const auto as_fine_as_points = [&] {
    const double area = area_of(points, box);
    return std::max(1.2 * std::sqrt(area / static_cast<double>(points.size())),
                    std::sqrt(2 * area / kTriangles));
  };
  const double wanted =
      std::min(options.step ? *options.step : as_fine_as_points(), options.ball / kStepsOfBall);
  for (double step = wanted; step <= kCoarser * wanted && 1.5 * step <= options.ball; step *= 1.1)
    if (cells_of(box, step, options.ball) <= kMostCells) return step;
  const Vector size = box.high - box.low;
  return failure(
      ErrorCode::bad_input,
      fmt::format("the points reach over {:.6g} x {:.6g} x {:.6g} mm, too far for cells of {:.4g} mm; leave "
                  "out those that lie far away, or let the ball or the edges be larger",
                  size.x, size.y, size.z, wanted));
}

/// The side of the grid's cells, outside or not, becomes a surface through points.
class Surface {
 public:
  Surface(const PointGrid& grid, bool floor, const PointGrid::Listener& told)
      : grid_(grid), floor_(floor), told_(told) {}

  Mesh made() {
    if (floor_) find_squares();
    told_(0.1);
    add_sides();
    told_(0.5);
    std::erase_if(mesh_.triangles,
                  [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    cancel_pairs();
    told_(0.6);
    flip_edges(mesh_);
    return std::move(mesh_);
  }
  /// Two sheets, between points on a grid that the ball falls through, have most triangles in pairs.
  [[nodiscard]] bool mostly_cancelled() const { return mostly_cancelled_; }

 private:
  using Place = PointGrid::Place;

  /// A corner of cells on the floor is inner where all cells around it, and around those, are of the body and
  /// without points.
  [[nodiscard]] bool inner(std::int32_t x, std::int32_t y) const {
    for (std::int32_t i = -2; i < 2; ++i)
      for (std::int32_t j = -2; j < 2; ++j) {
        const Place cell{x + i, y + j, 0};
        if (!grid_.has(cell) || grid_.outside(cell) || grid_.occupied(cell)) return false;
      }
    return true;
  }

  void find_squares() {
    const std::int32_t nx = grid_.counts().x, ny = grid_.counts().y;
    width_ = nx + 1;
    inner_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(ny + 1));
    // Counts of the corners that are not inner, summed over both directions, tell whole squares that are.
    std::vector<std::uint32_t> others(inner_.size());
    for (std::int32_t y = 0; y <= ny; ++y) {
      std::uint32_t row = 0;
      for (std::int32_t x = 0; x <= nx; ++x) {
        ask();
        const std::size_t at = floor_place(x, y);
        inner_[at] = inner(x, y) ? 1 : 0;
        row += 1U - inner_[at];
        others[at] = row + (y > 0 ? others[floor_place(x, y - 1)] : 0);
      }
    }
    square_.resize(inner_.size());
    const auto sum = [&](std::int32_t x, std::int32_t y) {
      return x < 0 || y < 0 ? 0 : others[floor_place(std::min(x, nx), std::min(y, ny))];
    };
    constexpr std::int32_t k = kFloorSquare;
    for (std::int32_t y = 2 * k; y + 2 * k <= ny; y += 2 * k)
      for (std::int32_t x = 2 * k; x + 2 * k <= nx; x += 2 * k)
        square_[floor_place(x, y)] = sum(x + 2 * k, y + 2 * k) - sum(x - 2 * k - 1, y + 2 * k) -
                                                 sum(x + 2 * k, y - 2 * k - 1) +
                                                 sum(x - 2 * k - 1, y - 2 * k - 1) ==
                                             0
                                         ? 1
                                         : 0;
  }
  [[nodiscard]] std::size_t floor_place(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  /// The corner of cells becomes a corner of the surface: the point nearest to it, or itself on the floor.
  [[nodiscard]] std::uint64_t corner(Place p) const {
    const std::optional<std::uint32_t> near = grid_.nearest_point(p);
    if (floor_ && p.z == 0 && (!near || inner_[floor_place(p.x, p.y)] != 0)) {
      constexpr std::int32_t k = 2 * kFloorSquare;
      const std::int32_t x = (p.x + kFloorSquare) / k * k, y = (p.y + kFloorSquare) / k * k;
      const auto [nx, ny, nz] = grid_.counts();
      if (x <= nx && y <= ny && square_[floor_place(x, y)] != 0) p = {x, y, 0};
      return kOnFloor + floor_place(p.x, p.y);
    }
    return near.value();
  }

  void add_sides() {
    const auto [nx, ny, nz] = grid_.counts();
    std::vector<std::array<std::uint64_t, 4>> sides;
    for (std::int32_t z = 0; z < nz; ++z)
      for (std::int32_t y = 0; y < ny; ++y)
        for (std::int32_t x = 0; x < nx; ++x) {
          const Place cell{x, y, z};
          if (grid_.outside(cell)) continue;
          ask();
          add_sides_of(cell, sides);
        }
    std::vector<std::uint64_t> corners;
    for (const auto& side : sides) corners.insert(corners.end(), side.begin(), side.end());
    std::ranges::sort(corners);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    for (const std::uint64_t c : corners)
      mesh_.vertices.push_back(c < kOnFloor ? grid_.point(static_cast<std::uint32_t>(c))
                                            : on_floor(c - kOnFloor));
    const auto number = [&](std::uint64_t c) {
      return static_cast<std::uint32_t>(std::ranges::lower_bound(corners, c) - corners.begin());
    };
    for (const auto& side : sides)
      add_quad({number(side[0]), number(side[1]), number(side[2]), number(side[3])});
  }
  [[nodiscard]] Vector on_floor(std::uint64_t at) const {
    const auto width = static_cast<std::uint64_t>(width_);
    return grid_.corner({static_cast<std::int32_t>(at % width), static_cast<std::int32_t>(at / width), 0});
  }

  void add_sides_of(Place c, std::vector<std::array<std::uint64_t, 4>>& sides) const {
    for (int axis = 0; axis < 3; ++axis)
      for (const int way : {-1, 1}) {
        Place beside = c;
        beside[axis] += way;
        const bool bare = grid_.has(beside) ? grid_.outside(beside) : true;
        if (!bare) continue;
        Place a = c;
        if (way > 0) a[axis] += 1;
        Place b = a, d = a;
        b[(axis + 1) % 3] += 1, d[(axis + 2) % 3] += 1;
        Place e = b;
        e[(axis + 2) % 3] += 1;
        // Counter-clockwise as seen from outside.
        if (way > 0)
          sides.push_back({corner(a), corner(b), corner(e), corner(d)});
        else
          sides.push_back({corner(a), corner(d), corner(e), corner(b)});
      }
  }

  void add_quad(const std::array<std::uint32_t, 4>& q) {
    const auto length = [&](std::size_t i, std::size_t j) {
      return norm(mesh_.vertices[q[i]] - mesh_.vertices[q[j]]);
    };
    if (length(0, 2) <= length(1, 3)) {
      mesh_.triangles.push_back({q[0], q[1], q[2]});
      mesh_.triangles.push_back({q[0], q[2], q[3]});
    } else {
      mesh_.triangles.push_back({q[1], q[2], q[3]});
      mesh_.triangles.push_back({q[1], q[3], q[0]});
    }
  }

  /// Two triangles over the same corners enclose nothing.
  void cancel_pairs() {
    std::vector<std::pair<Triangle, std::uint32_t>> sorted;
    sorted.reserve(mesh_.triangles.size());
    for (std::uint32_t k = 0; k < mesh_.triangles.size(); ++k) {
      Triangle t = mesh_.triangles[k];
      std::ranges::sort(t);
      sorted.emplace_back(t, k);
    }
    std::ranges::sort(sorted);
    std::vector<std::uint32_t> kept;
    for (std::size_t k = 0; k < sorted.size();) {
      std::size_t end = k;
      while (end < sorted.size() && sorted[end].first == sorted[k].first) ++end;
      if ((end - k) % 2 == 1) kept.push_back(sorted[k].second);
      k = end;
    }
    std::ranges::sort(kept);
    mostly_cancelled_ = 2 * kept.size() < mesh_.triangles.size();
    std::vector<Triangle> triangles;
    triangles.reserve(kept.size());
    for (const std::uint32_t k : kept) triangles.push_back(mesh_.triangles[k]);
    mesh_.triangles = std::move(triangles);
  }

  static constexpr std::uint64_t kOnFloor = std::uint64_t{1} << 32;

  const PointGrid& grid_;
  bool floor_;
  const PointGrid::Listener& told_;
  bool mostly_cancelled_ = false;
  std::int32_t width_ = 0;
  std::vector<std::uint8_t> inner_, square_;
  Mesh mesh_;
};

/// The surface is two sheets on the same points where the ball falls in. Triangles around a corner look away
/// from each other there.
bool encloses_something(const Mesh& mesh) {
  constexpr double kTurnedAway = 0.5, kShare = 0.2;
  std::vector<Vector> sum(mesh.vertices.size());
  std::vector<double> all(mesh.vertices.size());
  double volume = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vector p = mesh.vertices[t[0]], n = cross(mesh.vertices[t[1]] - p, mesh.vertices[t[2]] - p);
    volume += dot(p - mesh.vertices[0], n);
    for (const std::uint32_t corner : t) sum[corner] = sum[corner] + n, all[corner] += norm(n);
  }
  double whole = 0, sheets = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    whole += all[k];
    if (norm(sum[k]) < kTurnedAway * all[k]) sheets += all[k];
  }
  return volume > 0 && sheets < kShare * whole;
}

Result<void> check(const std::vector<Vector>& points, const PointSurfaceOptions& options) {
  const auto length = [](double x) { return x > 0 && x <= limits::kLargestCoordinate; };
  if (!length(options.ball))
    return failure(ErrorCode::usage, fmt::format("a ball of {} mm must have a radius above 0", options.ball));
  if (options.step && !length(*options.step))
    return failure(ErrorCode::usage, fmt::format("edges of {} mm must be longer than 0", *options.step));
  for (std::size_t k = 0; k < points.size(); ++k)
    for (const double x : {points[k].x, points[k].y, points[k].z})
      if (!(std::abs(x) <= limits::kLargestCoordinate))
        return failure(ErrorCode::bad_input,
                       fmt::format("point {} has the coordinate {}, which is not within {:g} mm", k + 1, x,
                                   limits::kLargestCoordinate));
  return {};
}

}  // namespace

Result<PointSurface> surface_through(const std::vector<Vector>& points, const PointSurfaceOptions& options,
                                     const ProgressListener& progress) {
  LEKALO_CHECK(check(points, options));
  std::vector<Vector> used;
  used.reserve(points.size());
  for (const Vector p : points)
    if (!options.floor || p.z >= *options.floor) used.push_back(p);
  if (used.size() < 4)
    return failure(ErrorCode::bad_input, fmt::format("{} points{} give no surface", used.size(),
                                                     options.floor ? " above the underside" : ""));
  Box box = box_of(used);
  if (options.floor) box.low.z = *options.floor;
  if (box.low == box.high)
    return failure(ErrorCode::bad_input, "all points are at one place, so they give no surface");
  LEKALO_TRY(const double step, step_for(used, box, options));
  const std::size_t below = points.size() - used.size();
  const auto part_of_whole = [&](double from, double to) -> PointGrid::Listener {
    return [&progress, from, to](double share) {
      const double fraction = std::lerp(from, to, share);
      if (progress) progress({static_cast<std::uint64_t>(100 * fraction), fraction});
    };
  };
  const PointGrid::Listener of_cells = part_of_whole(0, kCellsShare),
                            of_surface = part_of_whole(kCellsShare, 1);
  const PointGrid grid(std::move(used), box, step, options.ball, options.floor.has_value(), of_cells);
  Surface surface(grid, options.floor.has_value(), of_surface);
  PointSurface made{surface.made(), step, below};
  made.encloses = !surface.mostly_cancelled() && encloses_something(made.mesh);
  of_surface(1);
  return made;
}

std::vector<std::uint32_t> lonely_points(const std::vector<Vector>& points, double distance) {
  const Box box = box_of(points);
  const Vector size = box.high - box.low;
  struct Cell {
    std::int64_t x, y, z;
    std::uint32_t point;
    auto operator<=>(const Cell&) const = default;
  };
  const double wide = std::max(distance, 1e-9 * std::max({size.x, size.y, size.z}));
  const auto at = [&](double x, double low) { return static_cast<std::int64_t>((x - low) / wide); };
  std::vector<Cell> cells;
  cells.reserve(points.size());
  for (std::uint32_t k = 0; k < points.size(); ++k) {
    const Vector p = points[k];
    cells.push_back({at(p.x, box.low.x), at(p.y, box.low.y), at(p.z, box.low.z), k});
  }
  std::ranges::sort(cells);
  const auto has_other = [&](const Cell& cell) {
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const Cell first{cell.x + dx, cell.y + dy, cell.z - 1, 0};
        for (auto other = std::ranges::lower_bound(cells, first);
             other != cells.end() && other->x == first.x && other->y == first.y && other->z <= cell.z + 1;
             ++other) {
          ask();
          if (other->point != cell.point && norm(points[other->point] - points[cell.point]) <= distance)
            return true;
        }
      }
    return false;
  };
  std::vector<std::uint32_t> lonely;
  for (const Cell& cell : cells)
    if (!has_other(cell)) lonely.push_back(cell.point);
  std::ranges::sort(lonely);
  return lonely;
}

}  // namespace lekalo::solid

#include "lekalo/heat/body.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "cut_cell.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::heat {
namespace {

/// Corners further than this from a stroke, in pitches, keep their value: what lies between two of them is
/// whole whatever they are.
constexpr double kReach = 2;
/// mm, beyond every distance that a cut could bring.
constexpr double kFar = 1e9;

/// How near the middle of a stroke's tip gets to a place seen from above, and how deep over it.
struct Nearest {
  double distance = 0, depth = 0;
};
Nearest nearest_of(const Stroke& s, double x, double y) {
  const double dx = s.to.x - s.from.x, dy = s.to.y - s.from.y, dz = s.to.z - s.from.z;
  const double square = dx * dx + dy * dy;
  const double px = x - s.from.x, py = y - s.from.y;
  const double middle = square > 0 ? (px * dx + py * dy) / square : 0;
  const double part = std::clamp(middle, 0.0, 1.0);
  const double distance =
      std::sqrt((px - part * dx) * (px - part * dx) + (py - part * dy) * (py - part * dy));
  if (!(square > 0)) return {distance, std::min(s.from.z, s.to.z)};
  if (dz == 0) return {distance, s.from.z};
  // The tip is over the place on a stretch of the stroke, and deepest at one of the stretch's ends.
  const double ahead = px - middle * dx, beside = py - middle * dy;
  const double half =
      std::sqrt(std::max(s.radius * s.radius - ahead * ahead - beside * beside, 0.0) / square);
  const double first = std::clamp(middle - half, 0.0, 1.0), last = std::clamp(middle + half, 0.0, 1.0);
  return {distance, s.from.z + dz * (dz < 0 ? last : first)};
}

}  // namespace

Result<Grid> Grid::divide(Place low, Place high, double pitch) {
  const std::array<double, 3> size{high.x - low.x, high.y - low.y, high.z - low.z};
  if (!(pitch > 0) || !std::isfinite(pitch))
    return failure(ErrorCode::bad_input,
                   fmt::format("voxels of {:g} mm cannot be made; state a pitch above 0", pitch));
  Grid grid;
  grid.low = low;
  double all = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(size[axis] > 0) || !std::isfinite(size[axis]))
      return failure(ErrorCode::bad_input,
                     fmt::format("the stock is {:g} x {:g} x {:g} mm; each side has to be longer than 0",
                                 size[0], size[1], size[2]));
    const double count = std::max(1.0, std::round(size[axis] / pitch));
    all *= count;
    if (!(all <= static_cast<double>(kMostVoxels)))
      return failure(
          ErrorCode::bad_input,
          fmt::format("a stock of {:g} x {:g} x {:g} mm has more than {} voxels of {:g} mm; choose larger "
                      "ones",
                      size[0], size[1], size[2], kMostVoxels, pitch));
    grid.count[axis] = static_cast<std::size_t>(count);
  }
  grid.pitch = {size[0] / static_cast<double>(grid.count[0]), size[1] / static_cast<double>(grid.count[1]),
                size[2] / static_cast<double>(grid.count[2])};
  return grid;
}

std::array<std::size_t, 3> Grid::voxel_of(Place p) const noexcept {
  const auto along = [](double voxels, std::size_t all) {
    const double n = std::floor(voxels);
    return n > 0 ? std::min(static_cast<std::size_t>(std::min(n, 1e9)), all - 1) : std::size_t{0};
  };
  return {along((p.x - low.x) / pitch.x, count[0]), along((p.y - low.y) / pitch.y, count[1]),
          along((p.z - low.z) / pitch.z, count[2])};
}

Body::Body(const Grid& grid, const std::function<double(Place)>& within) : grid_(grid) {
  const auto [nx, ny, nz] = grid.count;
  model_.resize((nx + 1) * (ny + 1) * (nz + 1), kFar);
  share_.resize(grid.size(), 1.0);
  wall_.resize(grid.size(), 0.0);
  depth_.resize(grid.size(), 0.0);
  stale_.resize(grid.size(), 0);
  for (std::size_t axis = 0; axis < 3; ++axis)
    open_[axis].resize((nx + (axis == 0 ? 1 : 0)) * (ny + (axis == 1 ? 1 : 0)) * (nz + (axis == 2 ? 1 : 0)),
                       1.0);
  if (!within) return;
  for (std::size_t k = 0; k <= nz; ++k)
    for (std::size_t j = 0; j <= ny; ++j) {
      ask(nx);
      for (std::size_t i = 0; i <= nx; ++i) model_[corner(i, j, k)] = within(place_of_corner(i, j, k));
    }
  std::fill(stale_.begin(), stale_.end(), 1);
  settle();
}

Place Body::place_of_corner(std::size_t i, std::size_t j, std::size_t k) const noexcept {
  return {grid_.low.x + static_cast<double>(i) * grid_.pitch.x,
          grid_.low.y + static_cast<double>(j) * grid_.pitch.y,
          grid_.low.z + static_cast<double>(k) * grid_.pitch.z};
}

void Body::cut(const Stroke& s) {
  struct Range {
    std::size_t first, end;
  };
  const auto range = [](double low, double high, double pitch, std::size_t count) {
    const double first = std::max(0.0, std::floor(low / pitch));
    const double end = std::min(static_cast<double>(count) + 1, std::ceil(high / pitch) + 1);
    return end > first ? Range{static_cast<std::size_t>(first), static_cast<std::size_t>(end)} : Range{0, 0};
  };
  const Place h = grid_.pitch;
  const double reach = kReach * std::max({h.x, h.y, h.z}), side = s.radius + reach;
  const Range across = range(std::min(s.from.x, s.to.x) - side - grid_.low.x,
                             std::max(s.from.x, s.to.x) + side - grid_.low.x, h.x, grid_.count[0]);
  const Range along = range(std::min(s.from.y, s.to.y) - side - grid_.low.y,
                            std::max(s.from.y, s.to.y) + side - grid_.low.y, h.y, grid_.count[1]);
  const double lowest = std::min(s.from.z, s.to.z) - reach - grid_.low.z;
  const Range up = range(lowest, static_cast<double>(grid_.count[2] + 1) * h.z, h.z, grid_.count[2]);
  for (std::size_t j = along.first; j < along.end; ++j)
    for (std::size_t i = across.first; i < across.end; ++i) {
      const Place foot = place_of_corner(i, j, 0);
      const Nearest near = nearest_of(s, foot.x, foot.y);
      const double beside = near.distance - s.radius;
      if (beside > reach) continue;
      for (std::size_t k = up.first; k < up.end; ++k) {
        const double value = std::max(beside, near.depth - (foot.z + static_cast<double>(k) * h.z));
        double& model = model_[corner(i, j, k)];
        if (!(value < model)) continue;
        model = value;
        for (std::size_t c = k > 0 ? k - 1 : 0; c < std::min(k + 1, grid_.count[2]); ++c)
          for (std::size_t b = j > 0 ? j - 1 : 0; b < std::min(j + 1, grid_.count[1]); ++b)
            for (std::size_t a = i > 0 ? i - 1 : 0; a < std::min(i + 1, grid_.count[0]); ++a)
              stale_[grid_.cell(a, b, c)] = 1;
      }
    }
}

void Body::compute(std::size_t i, std::size_t j, std::size_t k) {
  Corners value{};
  double middle = 0;
  for (std::size_t n = 0; n < 8; ++n) {
    value[n] = model_[corner(i + (n & 1U), j + (n >> 1U & 1U), k + (n >> 2U & 1U))];
    middle += value[n] / 8;
  }
  const std::size_t cell = grid_.cell(i, j, k);
  const CutCell cut = cut_cell(value, grid_.pitches());
  share_[cell] = cut.share;
  wall_[cell] = cut.wall;
  const Place h = grid_.pitch;
  depth_[cell] = cut.wall > 0 ? std::clamp(middle, 0.0, std::max({h.x, h.y, h.z}) / 2) : 0;
  // Faces belong to two voxels, and both have it from the same corners.
  for (std::size_t high = 0; high < 2; ++high) {
    const std::size_t x = high, y = 2 * high, z = 4 * high;
    open_[0][face(0, i + high, j, k)] = open_share(value[x], value[x + 2], value[x + 6], value[x + 4]);
    open_[1][face(1, i, j + high, k)] = open_share(value[y], value[y + 1], value[y + 5], value[y + 4]);
    open_[2][face(2, i, j, k + high)] = open_share(value[z], value[z + 1], value[z + 3], value[z + 2]);
  }
}

std::vector<Changed> Body::settle() {
  std::vector<Changed> changed;
  const auto [nx, ny, nz] = grid_.count;
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j) {
      ask(nx / 16);
      for (std::size_t i = 0; i < nx; ++i) {
        const std::size_t cell = grid_.cell(i, j, k);
        if (stale_[cell] == 0) continue;
        stale_[cell] = 0;
        const double before = share_[cell];
        compute(i, j, k);
        if (share_[cell] != before) changed.push_back({cell, before, share_[cell]});
      }
    }
  return changed;
}

double Body::volume() const noexcept {
  double sum = 0;
  for (const double share : share_) sum += share;
  return sum * grid_.volume();
}

}  // namespace lekalo::heat

#include "lekalo/solid/distance_field.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/assert.hpp"
#include "lekalo/base/parallel.hpp"

namespace lekalo::solid {
namespace {

float rounded_down(double v) {
  const auto near = static_cast<float>(v);
  return near > v ? std::nextafter(near, -std::numeric_limits<float>::infinity()) : near;
}

/// The bound at one place after another. Next to a place far enough from the surface inside is inside.
class Walk {
 public:
  explicit Walk(const TriangleTree& tree) : tree_(tree) {}

  /// Outside the least, inside minus the greatest distance that may be.
  double bound(Vector p) {
    const auto near = tree_.nearest(p, std::numeric_limits<double>::infinity(), triangle_);
    const bool same_side = triangle_ && norm(p - last_) < 0.999 * last_distance_;
    if (!same_side) inside_ = tree_.holds(p);
    triangle_ = near->triangle;
    last_ = p;
    last_distance_ = near->low;
    return inside_ ? -near->high : near->low;
  }

 private:
  const TriangleTree& tree_;
  std::optional<std::uint32_t> triangle_;
  Vector last_;
  double last_distance_ = 0;
  bool inside_ = false;
};

}  // namespace

DistanceField::DistanceField(const TriangleTree& tree, double cell, double margin, double extent)
    : tree_(&tree), low_(tree.box().low - Vector{margin, margin, margin}), cell_(cell) {
  const Vector size = tree.box().high + Vector{margin, margin, margin} - low_;
  const double brick = cell * kCells;
  for (const auto& [k, length] : {std::pair(0U, size.x), {1U, size.y}, {2U, size.z}})
    bricks_[k] = static_cast<int>(length / brick) + 1;
  // A coordinate is rounded to 2^-24 of the extent at most on each of some eight steps; three such make a
  // place, and the mean of eight distances rounds some ten times.
  rounding_ = 0x20p-24 * (extent + norm(size) + brick);
  margin_ = rounded_down(margin - rounding_);
  const auto count = static_cast<std::size_t>(bricks_[0]) * static_cast<std::size_t>(bricks_[1]) *
                     static_cast<std::size_t>(bricks_[2]);
  least_.reserve(count);
  cells_of_.assign(count, -1);
  Walk walk(tree);
  for (int z = 0; z < bricks_[2]; ++z)
    for (int y = 0; y < bricks_[1]; ++y)
      for (int x = 0; x < bricks_[0]; ++x)
        least_.push_back(rounded_down(walk.bound(low_ + brick * Vector{x + 0.5, y + 0.5, z + 0.5}) -
                                      (0.8661 * brick + rounding_)));
}

std::uint32_t DistanceField::brick_at(Place p) const noexcept {
  // A coordinate that is not a number fails, too.
  const float side = kCells;
  if (!(p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < side * static_cast<float>(bricks_[0]) &&
        p.y < side * static_cast<float>(bricks_[1]) && p.z < side * static_cast<float>(bricks_[2])))
    return kNoBrick;
  const int x = static_cast<int>(p.x) / kCells, y = static_cast<int>(p.y) / kCells,
            z = static_cast<int>(p.z) / kCells;
  return static_cast<std::uint32_t>((z * bricks_[1] + y) * bricks_[0] + x);
}

DistanceField::Cells::Cells() noexcept {
  distance.fill(std::numeric_limits<float>::quiet_NaN());
  bend.fill(-1);
}

float DistanceField::bound_in(const Cells& cells, std::size_t cell, Place p) const noexcept {
  const int x = static_cast<int>(p.x), y = static_cast<int>(p.y), z = static_cast<int>(p.z);
  const float u = p.x - static_cast<float>(x), v = p.y - static_cast<float>(y),
              w = p.z - static_cast<float>(z);
  const int i = x % kCells, j = y % kCells, k = z % kCells;
  constexpr int kRow = kCorners, kLayer = kCorners * kCorners;
  const float* d = &cells.distance[static_cast<std::size_t>(k * kLayer + j * kRow + i)];
  const auto between = [](float share, float a, float b) { return a + share * (b - a); };
  const float low = between(v, between(u, d[0], d[1]), between(u, d[kRow], d[kRow + 1]));
  const float high =
      between(v, between(u, d[kLayer], d[kLayer + 1]), between(u, d[kLayer + kRow], d[kLayer + kRow + 1]));
  // The mean square of the way to the corners, as they are weighed, in cells.
  const float spread = u * (1 - u) + v * (1 - v) + w * (1 - w);
  const float off = std::min(spread * cells.bend[cell], std::sqrt(spread) * static_cast<float>(cell_));
  return between(w, low, high) - off - static_cast<float>(rounding_);
}

float DistanceField::bound_beside(const Cells& cells, Place p) const noexcept {
  const std::size_t cell = cell_at(p);
  const float u = p.x - std::floor(p.x), v = p.y - std::floor(p.y), w = p.z - std::floor(p.z);
  float best = -std::numeric_limits<float>::infinity();
  for (std::size_t k = 0; k < 8; ++k) {
    const float x = k % 2 != 0 ? 1 - u : u, y = k / 2 % 2 != 0 ? 1 - v : v, z = k / 4 != 0 ? 1 - w : w;
    const float bound =
        cells.distance[corner_of(cell, k)] - std::sqrt(x * x + y * y + z * z) * static_cast<float>(cell_);
    if (bound > best) best = bound;  // not where the corner is not made
  }
  return best - static_cast<float>(rounding_);
}

void DistanceField::make_cells(std::vector<std::uint64_t> wanted, unsigned threads) {
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  // Those of one brick lie together, from one of these places to the next.
  std::vector<std::size_t> begins;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (k > 0 && wanted[k] / kCellsOfBrick == wanted[k - 1] / kCellsOfBrick) continue;
    begins.push_back(k);
    std::int32_t& at = cells_of_[wanted[k] / kCellsOfBrick];
    if (at >= 0) continue;
    at = static_cast<std::int32_t>(cells_.size());
    cells_.emplace_back();
  }
  begins.push_back(wanted.size());
  share_out(begins.size() - 1, threads, [&](std::size_t k) {
    const std::span<const std::uint64_t> of_brick(&wanted[begins[k]], begins[k + 1] - begins[k]);
    fill(of_brick, cells_[static_cast<std::size_t>(cells_of_[of_brick[0] / kCellsOfBrick])]);
  });
}

void DistanceField::fill(std::span<const std::uint64_t> wanted, Cells& cells) const {
  const auto brick = static_cast<int>(wanted[0] / kCellsOfBrick);
  const int x0 = brick % bricks_[0] * kCells, y0 = brick / bricks_[0] % bricks_[1] * kCells,
            z0 = brick / (bricks_[0] * bricks_[1]) * kCells;
  Walk walk(*tree_);
  for (const std::uint64_t number : wanted) {
    const auto cell = static_cast<std::size_t>(number % kCellsOfBrick);
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < 8; ++k) {
      const std::size_t corner = corner_of(cell, k);
      float& distance = cells.distance[corner];
      if (std::isnan(distance)) {
        const auto at = static_cast<int>(corner);
        distance = rounded_down(walk.bound(low_ + cell_ * Vector{double(x0 + at % kCorners),
                                                                 double(y0 + at / kCorners % kCorners),
                                                                 double(z0 + at / (kCorners * kCorners))}));
      }
      least = std::min(least, distance);
    }
    // No place of the cell is farther than half its diagonal from a corner; the bound so found makes a better
    // one.
    double within = least - 0.8661 * cell_;
    if (within > 0) within = std::max(within, least - 0.375 * cell_ * cell_ / within);
    cells.bend[cell] = within > 0 ? static_cast<float>(0.5 * cell_ * cell_ / within * (1 + 0x1p-20))
                                  : std::numeric_limits<float>::infinity();
  }
}

}  // namespace lekalo::solid

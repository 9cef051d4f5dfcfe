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
  made_.assign(count, Made::nothing);
  cells_at_.assign(count, 0);
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

template <int kAlong>
float DistanceField::bound_in(const Cells<kAlong>& cells, Place p) const noexcept {
  constexpr float kShare = static_cast<float>(kAlong) / kCells;  // of two, so that nothing is rounded
  const float px = kShare * p.x, py = kShare * p.y, pz = kShare * p.z;
  const int x = static_cast<int>(px), y = static_cast<int>(py), z = static_cast<int>(pz);
  const float u = px - static_cast<float>(x), v = py - static_cast<float>(y), w = pz - static_cast<float>(z);
  const int i = x % kAlong, j = y % kAlong, k = z % kAlong;
  constexpr int kRow = kAlong + 1, kLayer = kRow * kRow;
  const float* d = &cells.distance[static_cast<std::size_t>(k * kLayer + j * kRow + i)];
  const auto between = [](float share, float a, float b) { return a + share * (b - a); };
  const float low = between(v, between(u, d[0], d[1]), between(u, d[kRow], d[kRow + 1]));
  const float high =
      between(v, between(u, d[kLayer], d[kLayer + 1]), between(u, d[kLayer + kRow], d[kLayer + kRow + 1]));
  // The mean square of the way to the corners, as they are weighed, in cells.
  const float spread = u * (1 - u) + v * (1 - v) + w * (1 - w);
  const float bend = cells.bend[static_cast<std::size_t>((k * kAlong + j) * kAlong + i)];
  const float off = std::min(spread * bend, std::sqrt(spread) * static_cast<float>(cell_ / kShare));
  return between(w, low, high) - off - static_cast<float>(rounding_);
}

template float DistanceField::bound_in(const Cells<kCells / 2>& cells, Place p) const noexcept;
template float DistanceField::bound_in(const Cells<kCells>& cells, Place p) const noexcept;

void DistanceField::make_cells(std::vector<std::uint32_t> bricks, unsigned threads) {
  std::sort(bricks.begin(), bricks.end());
  bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
  for (const std::uint32_t brick : bricks) {
    if (made_[brick] == Made::nothing) {
      made_[brick] = Made::coarse;
      cells_at_[brick] = static_cast<std::uint32_t>(coarse_.size());
      coarse_.emplace_back();
    } else if (made_[brick] == Made::coarse) {
      made_[brick] = Made::fine;
      cells_at_[brick] = static_cast<std::uint32_t>(fine_.size());
      fine_.emplace_back();
    }
  }
  share_out(bricks.size(), threads, [&](std::size_t k) {
    const std::uint32_t brick = bricks[k], at = cells_at_[brick];
    made_[brick] == Made::coarse ? fill(brick, coarse_[at]) : fill(brick, fine_[at]);
  });
}

template <int kAlong>
void DistanceField::fill(std::uint32_t brick, Cells<kAlong>& cells) const {
  constexpr int kCorners = kAlong + 1;
  const double side = cell_ * kCells / kAlong;
  const auto number = static_cast<int>(brick);
  const int x0 = number % bricks_[0] * kAlong, y0 = number / bricks_[0] % bricks_[1] * kAlong,
            z0 = number / (bricks_[0] * bricks_[1]) * kAlong;
  Walk walk(*tree_);
  std::size_t at = 0;
  for (int z = 0; z < kCorners; ++z)
    for (int y = 0; y < kCorners; ++y)
      for (int x = 0; x < kCorners; ++x)
        cells.distance[at++] =
            rounded_down(walk.bound(low_ + side * Vector{double(x0 + x), double(y0 + y), double(z0 + z)}));
  at = 0;
  for (int z = 0; z < kAlong; ++z) {
    for (int y = 0; y < kAlong; ++y) {
      for (int x = 0; x < kAlong; ++x) {
        float least = std::numeric_limits<float>::infinity();
        for (const int corner : {0, 1, 2, 3, 4, 5, 6, 7})
          least = std::min(
              least, cells.distance[static_cast<std::size_t>(
                         ((z + corner / 4) * kCorners + y + corner / 2 % 2) * kCorners + x + corner % 2)]);
        // No place of the cell is farther than half its diagonal from a corner; the bound so found makes a
        // better one.
        double within = least - 0.8661 * side;
        if (within > 0) within = std::max(within, least - 0.375 * side * side / within);
        cells.bend[at++] = within > 0 ? static_cast<float>(0.5 * side * side / within * (1 + 0x1p-20))
                                      : std::numeric_limits<float>::infinity();
      }
    }
  }
}

}  // namespace lekalo::solid

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lekalo/solid/triangle_tree.hpp"

namespace lekalo::solid {

/// Lower bounds of the distance to the surface of a body, positive outside and negative inside, from the
/// distances at the corners of cells: a mean of eight numbers for a question (docs/design/solid.md).
///
/// The region is the box of the body and a margin around it, made of bricks of 8 x 8 x 8 cells. A brick has
/// one number, the bound at its middle, until its cells are asked for: those of a few near the surface are
/// enough. At first they are twice as wide, which takes 1 kB and 125 distances, and is enough for most; asked
/// for once more they take 5 kB and 729 distances.
class DistanceField {
 public:
  /// \param tree  of a closed mesh; outlives the field
  /// \param cell, margin  mm, above 0. \pre at most 2^24 bricks
  /// \param extent  a length, mm, that no coordinate exceeds from which places are worked out in single
  /// precision
  DistanceField(const TriangleTree& tree, double cell, double margin, double extent);

  static constexpr int kCells = 8;  ///< of a brick, along each axis
  /// A place in cells from the lower corner of the region; single precision, so that 1,000,000 are looked at
  /// in milliseconds.
  struct Place {
    float x, y, z;
  };

  [[nodiscard]] Vector low() const noexcept { return low_; }
  [[nodiscard]] double cell() const noexcept { return cell_; }
  /// A bound for the place (p - low()) / cell() of p, as exact as what is made there. Outside the region it
  /// is the margin. It holds for p in double precision, whatever single precision made of it.
  [[nodiscard]] float bound(Place p) const noexcept {
    const std::uint32_t brick = brick_at(p);
    if (brick == kNoBrick) return margin_;
    const std::uint32_t at = cells_at_[brick];
    switch (made_[brick]) {
      case Made::fine:
        return bound_in(fine_[at], p);
      case Made::coarse:
        return bound_in(coarse_[at], p);
      default:
        return least_[brick];
    }
  }
  static constexpr std::uint32_t kNoBrick = 0xffffffffU;
  /// The brick at a place whose cells are not made, or are the wide ones; kNoBrick where nothing is to be
  /// made.
  [[nodiscard]] std::uint32_t unmade_at(Place p) const noexcept {
    const std::uint32_t brick = brick_at(p);
    return brick != kNoBrick && made_[brick] != Made::fine ? brick : kNoBrick;
  }

  /// Makes the wide cells of bricks that have none, and the others of those that have, on as many threads.
  /// Each brick's are the same whoever makes them.
  void make_cells(std::vector<std::uint32_t> bricks, unsigned threads);

 private:
  enum class Made : std::uint8_t { nothing, coarse, fine };
  /// So many cells of a brick along each axis.
  template <int kAlong>
  struct Cells {
    static constexpr int kCorners = kAlong + 1;
    std::array<float, kCorners * kCorners * kCorners> distance;
    /// Half of the square of the cell's side, divided by the least distance in the cell; infinite inside.
    std::array<float, kAlong * kAlong * kAlong> bend;
  };
  [[nodiscard]] std::uint32_t brick_at(Place p) const noexcept;
  template <int kAlong>
  [[nodiscard]] float bound_in(const Cells<kAlong>& cells, Place p) const noexcept;
  template <int kAlong>
  void fill(std::uint32_t brick, Cells<kAlong>& cells) const;

  const TriangleTree* tree_;
  Vector low_;
  double cell_, rounding_;
  float margin_;
  std::array<int, 3> bricks_{};
  std::vector<float> least_;
  std::vector<Made> made_;
  std::vector<std::uint32_t> cells_at_;
  std::vector<Cells<kCells / 2>> coarse_;
  std::vector<Cells<kCells>> fine_;
};

}  // namespace lekalo::solid

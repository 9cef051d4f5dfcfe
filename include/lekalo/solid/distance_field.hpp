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
/// enough. A brick takes 5 kB and 729 distances to make.
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
    return cells_of_[brick] < 0 ? least_[brick]
                                : bound_in(cells_[static_cast<std::size_t>(cells_of_[brick])], p);
  }
  static constexpr std::uint32_t kNoBrick = 0xffffffffU;
  /// The brick at a place whose cells are not made, or kNoBrick where nothing is to be made.
  [[nodiscard]] std::uint32_t unmade_at(Place p) const noexcept {
    const std::uint32_t brick = brick_at(p);
    return brick != kNoBrick && cells_of_[brick] < 0 ? brick : kNoBrick;
  }

  /// Makes the cells of bricks that have none, on as many threads. Each brick's are the same whoever makes
  /// them.
  void make_cells(const std::vector<std::uint32_t>& bricks, unsigned threads);

 private:
  static constexpr int kCorners = kCells + 1;
  struct Cells {
    std::array<float, kCorners * kCorners * kCorners> distance;
    /// Half of the square of the cell's side, divided by the least distance in the cell; infinite inside.
    std::array<float, kCells * kCells * kCells> bend;
  };
  [[nodiscard]] std::uint32_t brick_at(Place p) const noexcept;
  [[nodiscard]] float bound_in(const Cells& cells, Place p) const noexcept;
  void fill(std::uint32_t brick, Cells& cells) const;

  const TriangleTree* tree_;
  Vector low_;
  double cell_, rounding_;
  float margin_;
  std::array<int, 3> bricks_{};
  std::vector<float> least_;
  std::vector<std::int32_t> cells_of_;
  std::vector<Cells> cells_;
};

}  // namespace lekalo::solid

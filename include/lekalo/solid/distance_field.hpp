#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lekalo/solid/triangle_tree.hpp"

namespace lekalo::solid {

/// Lower bounds of the distance to the surface of a body, positive outside and negative inside, from the
/// distances at the corners of cells: a mean of eight numbers for a question (docs/design/solid.md).
///
/// The region is the box of the body and a margin around it, made of bricks of 8 x 8 x 8 cells. A brick has
/// one number, the bound at its middle, for all cells that are not asked for: those that a surface goes
/// through are enough. A brick of which any cell is made takes 5 kB, and a cell up to eight distances, at the
/// corners that no other cell of the brick has.
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
    if (cells_of_[brick] < 0) return least_[brick];
    const Cells& cells = cells_[static_cast<std::size_t>(cells_of_[brick])];
    const std::size_t cell = cell_at(p);
    return cells.bend[cell] < 0 ? std::max(least_[brick], bound_beside(cells, p)) : bound_in(cells, cell, p);
  }
  static constexpr std::uint64_t kNoCell = ~std::uint64_t{0};
  /// The number of the cell at a place if it is not made, or kNoCell where nothing is to be made.
  [[nodiscard]] std::uint64_t unmade_at(Place p) const noexcept {
    const std::uint32_t brick = brick_at(p);
    if (brick == kNoBrick) return kNoCell;
    const std::size_t cell = cell_at(p);
    if (cells_of_[brick] >= 0 && cells_[static_cast<std::size_t>(cells_of_[brick])].bend[cell] >= 0)
      return kNoCell;
    return std::uint64_t{brick} * kCellsOfBrick + cell;
  }

  /// Makes cells, on as many threads. Each is the same whoever makes it, but for rounding.
  void make_cells(std::vector<std::uint64_t> wanted, unsigned threads);

 private:
  /// The number of a corner of a cell, counted from 0 to 7.
  [[nodiscard]] static std::size_t corner_of(std::size_t cell, std::size_t k) noexcept {
    const std::size_t x = cell % kCells + k % 2, y = cell / kCells % kCells + k / 2 % 2,
                      z = cell / (kCells * kCells) + k / 4;
    return (z * kCorners + y) * kCorners + x;
  }
  static constexpr std::uint32_t kNoBrick = 0xffffffffU;
  static constexpr int kCorners = kCells + 1, kCellsOfBrick = kCells * kCells * kCells;
  struct Cells {
    Cells() noexcept;
    std::array<float, kCorners * kCorners * kCorners> distance;  ///< not a number where it is not made
    /// Half of the square of the cell's side, divided by the least distance in the cell; infinite inside,
    /// negative where the cell is not made.
    std::array<float, kCellsOfBrick> bend;
  };
  [[nodiscard]] std::uint32_t brick_at(Place p) const noexcept;
  [[nodiscard]] static std::size_t cell_at(Place p) noexcept {
    const int x = static_cast<int>(p.x) % kCells, y = static_cast<int>(p.y) % kCells,
              z = static_cast<int>(p.z) % kCells;
    return static_cast<std::size_t>((z * kCells + y) * kCells + x);
  }
  [[nodiscard]] float bound_in(const Cells& cells, std::size_t cell, Place p) const noexcept;
  /// A bound from the corners that cells beside this one have, each less the way to it.
  [[nodiscard]] float bound_beside(const Cells& cells, Place p) const noexcept;
  void fill(std::span<const std::uint64_t> wanted, Cells& cells) const;

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

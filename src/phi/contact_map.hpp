#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "flat_outline.hpp"

namespace lekalo::phi {

/// Two outlines with the low corners of their boxes in the origin, of which the second is moved. A ContactMap
/// is about such a pair.
struct OutlinePair {
  const FlatOutline& fixed;
  const FlatOutline& moving;
  std::int64_t gap = 0;
  /// For a container the outside of `fixed` is forbidden, not its inside.
  bool container = false;

  /// Answers from the outlines alone.
  [[nodiscard]] bool forbidden(geom::GridPoint shift) const;
};

/// Step 4 of docs/design/scene.md: a map of the places where one outline may lie beside another. It is a
/// raster over their relative shifts, which is filled as it is asked. Its answers are exact;
/// docs/design/scene.md has the reasons. It has two levels: 32 x 32 cells, and those that matter divided by
/// 16 x 16. In one of the latter the few contact lines that pass it are asked.
class ContactMap {
 public:
  /// \pre suits(pair)
  explicit ContactMap(const OutlinePair& pair);
  /// Says whether a map can serve the pair: the cells must be wider than a few steps, and the edges not too
  /// many.
  [[nodiscard]] static bool suits(const OutlinePair& pair) noexcept;

  /// Answers for the map's own pair.
  /// \pre the boxes come nearer than the gap (or, in a container, the moving box lies in the fixed one)
  [[nodiscard]] bool forbidden(geom::GridPoint shift, const OutlinePair& pair) {
    const double u = static_cast<double>(shift.x) + offset_x_, v = static_cast<double>(shift.y) + offset_y_;
    const int qx = static_cast<int>(u * per_step_x_), qy = static_cast<int>(v * per_step_y_);
    const std::uint64_t row = rows_[static_cast<std::size_t>(qy / kFine)];
    const unsigned state = static_cast<unsigned>(row >> (2 * (qx / kFine))) & 3;
    if (state < touched) return state == hit;
    return in_fine(qx, qy, u, v, shift, pair);
  }

  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  static constexpr int kCoarse = 32, kFine = 16, kAll = kCoarse * kFine;
  static constexpr std::size_t kLines = 5;
  static constexpr std::size_t kMostPairs = 1 << 20;  ///< of edges
  /// The state of a cell takes two bits. A contact line comes near a `touched` cell. A `clear` or `hit` cell
  /// has one answer everywhere in it, and an `open` one has not been asked yet.
  enum State : unsigned { clear = 0, hit = 1, touched = 2, open = 3 };
  /// The shifts at which a vertex of one outline may come to rest on an edge of the other: from `at` along
  /// `way`.
  struct Contact {
    double x, y, dx, dy;
  };
  struct Block {
    std::array<std::uint64_t, kFine / 2> rows;
    /// By word: the number of touched cells in the words before it.
    std::array<std::uint16_t, kFine / 2> before;
    /// The index in leaf_of_ of the block's first touched cell.
    std::uint32_t leaves;
  };
  /// A touched cell with few lines. A pattern has a bit for the side of each line; `known` and `hit` have a
  /// bit for each pattern.
  struct Leaf {
    std::uint32_t known = 0, hit = 0;
    std::array<std::uint16_t, kLines> lines = {};
    std::uint16_t count = 0;
  };
  struct Window {
    double x0, y0, x1, y1;
  };

  [[nodiscard]] bool in_fine(int qx, int qy, double u, double v, geom::GridPoint shift,
                             const OutlinePair& pair);
  [[nodiscard]] bool in_leaf(Leaf& leaf, double u, double v, geom::GridPoint shift, const OutlinePair& pair);
  void add_contacts(const FlatOutline& vertices, bool reversed_vertices, const FlatOutline& edges,
                    bool reversed_edges, bool vertices_move);
  [[nodiscard]] bool touches(const Contact& contact, const Window& window) const noexcept;
  /// Calls mark(column, row) for those of count x count cells, from `corner` on, that the contact's line
  /// comes near.
  template <class Mark>
  void visit_touched(const Contact& contact, double corner_x, double corner_y, int per_cell, int count,
                     Mark&& mark) const;
  std::uint32_t make_block(int cx, int cy);
  Leaf make_leaf(int qx, int qy) const;

  /// Added to a shift to make the low corner of the raster 0.
  double offset_x_ = 0, offset_y_ = 0;
  /// The fine cells in a step.
  double per_step_x_ = 0, per_step_y_ = 0;
  /// The steps in a fine cell.
  double step_x_ = 0, step_y_ = 0;
  double gap_ = 0;
  std::array<std::uint64_t, kCoarse> rows_ = {};
  std::array<std::uint16_t, kCoarse> before_ = {};
  std::vector<Contact> contacts_;
  /// By touched coarse cell the number of its block, from 1; 0 where there is none yet.
  std::vector<std::uint16_t> block_of_;
  std::vector<Block> blocks_;
  /// By touched fine cell the number of its leaf, from 1; 0 where there is none yet.
  std::vector<std::uint32_t> leaf_of_;
  std::vector<Leaf> leaves_;
};

}  // namespace lekalo::phi

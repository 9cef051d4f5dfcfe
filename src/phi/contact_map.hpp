#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "flat_outline.hpp"

namespace lekalo::phi {

/// Two outlines, their boxes' low corners in the origin, the second to be moved: what a ContactMap is about.
struct OutlinePair {
  const FlatOutline& fixed;
  const FlatOutline& moving;
  std::int64_t gap = 0;
  bool container = false;  ///< what lies outside `fixed` is forbidden, not what lies in it

  /// Decided from the outlines alone.
  [[nodiscard]] bool forbidden(geom::GridPoint shift) const;
};

/// A map of the places where one outline may lie beside another: a raster over their relative shifts, filled
/// as it is asked. What it says is exact; docs/design/scene.md has the reasons. Two levels: 32 x 32 cells,
/// those that matter divided by 16 x 16; in one of these the few contact lines that pass it are asked.
class ContactMap {
 public:
  /// \pre suits(pair)
  explicit ContactMap(const OutlinePair& pair);
  /// A pair suits when the cells are wider than a few steps and the edges not too many.
  [[nodiscard]] static bool suits(const OutlinePair& pair) noexcept;

  /// \pre the map's own pair; the boxes come nearer than the gap (or, in a container, the moving box lies in
  /// the fixed one)
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
  /// The state of a cell takes two bits. `touched`: a contact line comes near it. Others are the same
  /// everywhere in them, and `open` ones have not been asked yet.
  enum State : unsigned { clear = 0, hit = 1, touched = 2, open = 3 };
  /// Shifts where a vertex of one may come to rest on an edge of the other: from `at` along `way`.
  struct Contact {
    double x, y, dx, dy;
  };
  struct Block {
    std::array<std::uint64_t, kFine / 2> rows;
    std::array<std::uint16_t, kFine / 2> before;  ///< touched cells in the words before
    std::uint32_t leaves;                         ///< index in leaf_of_
  };
  /// A touched cell with few lines: what is known of each side of them, a bit for every pattern of sides.
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
  /// mark(column, row) of those of count x count cells from `corner` on that the contact's line comes near.
  template <class Mark>
  void visit_touched(const Contact& contact, double corner_x, double corner_y, int per_cell, int count,
                     Mark&& mark) const;
  std::uint32_t make_block(int cx, int cy);
  Leaf make_leaf(int qx, int qy) const;

  double offset_x_ = 0, offset_y_ = 0;      ///< added to a shift: 0 at the low corner
  double per_step_x_ = 0, per_step_y_ = 0;  ///< fine cells in a step
  double step_x_ = 0, step_y_ = 0;          ///< steps in a fine cell
  double gap_ = 0;
  std::array<std::uint64_t, kCoarse> rows_ = {};
  std::array<std::uint16_t, kCoarse> before_ = {};
  std::vector<Contact> contacts_;
  std::vector<std::uint16_t> block_of_;  ///< by touched coarse cell, from 1; 0: not made
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> leaf_of_;  ///< by touched fine cell, from 1; 0: not made
  std::vector<Leaf> leaves_;
};

}  // namespace lekalo::phi

#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

#include "lekalo/solid/motion.hpp"
#include "lekalo/solid/triangle_tree.hpp"

namespace lekalo::solid {

/// A box along three axes of its own, of length 1 and across each other but for rounding, mm.
struct OrientedBox {
  Vector middle;
  std::array<Vector, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vector half;  ///< widths along the axes, in their order

  [[nodiscard]] double size() const noexcept { return half.x + half.y + half.z; }
};

/// A box around the triangles of each node of a tree, along the ways in which they are spread most and least.
/// So the box of a smooth patch is a plate as thin as the patch is flat, however it lies, and that of a
/// triangle is flat. Nodes with more than kMostTriangles have their boxes along the axes of the mesh.
///
/// A box is made when it is first asked for, which any number of threads may do at once; one of them makes
/// it. Cost: O(triangles) for a box; 121 bytes a node, which are not touched before.
class OrientedBoxes {
 public:
  static constexpr std::uint32_t kMostTriangles = 512;

  explicit OrientedBoxes(const TriangleTree& tree);

  /// \param tree  the one that it was made for
  [[nodiscard]] const OrientedBox& of(const TriangleTree& tree, std::uint32_t node) const {
    if (state_[node].load(std::memory_order_acquire) != kMade) make(tree, node);
    return *std::launder(reinterpret_cast<const OrientedBox*>(boxes_[node].bytes));
  }

 private:
  static constexpr std::uint8_t kOpen = 0, kInTheMaking = 1, kMade = 2;
  struct Room {
    alignas(OrientedBox) std::byte bytes[sizeof(OrientedBox)];
  };
  void make(const TriangleTree& tree, std::uint32_t node) const;

  std::unique_ptr<std::atomic<std::uint8_t>[]> state_;
  std::unique_ptr<Room[]> boxes_;
};

[[nodiscard]] OrientedBox moved(const Motion& motion, const OrientedBox& box) noexcept;

/// The square of a distance that no two points of the boxes fall short of: the greater one of those that
/// either box has, along its axes, from the other's shadows on them. Rounding hides less than 2^-45 of the
/// largest coordinates of both meshes and of the motion together.
[[nodiscard]] double squared_gap(const OrientedBox& a, const OrientedBox& b) noexcept;

}  // namespace lekalo::solid

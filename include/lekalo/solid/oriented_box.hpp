#pragma once

#include <array>
#include <vector>

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

/// A box around the triangles of each node, along the ways in which they are spread most and least. So the
/// box of a smooth patch is a plate as thin as the patch is flat, however it lies, and that of a triangle is
/// flat. Cost: O(n log n); 120 bytes a node.
[[nodiscard]] std::vector<OrientedBox> oriented_boxes(const TriangleTree& tree);

[[nodiscard]] OrientedBox moved(const Motion& motion, const OrientedBox& box) noexcept;

/// The square of a distance that no two points of the boxes fall short of: the greater one of those that
/// either box has, along its axes, from the other's shadows on them. Rounding hides less than 2^-45 of the
/// largest coordinates of both meshes and of the motion together.
[[nodiscard]] double squared_gap(const OrientedBox& a, const OrientedBox& b) noexcept;

}  // namespace lekalo::solid

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "lekalo/solid/mesh.hpp"

namespace lekalo::solid {

/// A distance between two bounds that rounding leaves, mm, and where it is.
struct Nearest {
  double low = 0, high = 0;  ///< low <= the exact distance <= high
  std::uint32_t triangle = 0;
  Vector place;  ///< on the triangle, within high - low
};

/// The corners of a triangle by their places.
using Corners = std::array<Vector, 3>;
/// The distance of p from a triangle, within rounding, mm.
[[nodiscard]] double distance(const Corners& triangle, Vector p) noexcept;

/// A balanced tree over the triangles of a mesh. It asks for distances and for inside and outside; what it
/// answers does not depend on anything but its arguments. Building: O(n log n); 150 bytes a triangle.
class TriangleTree {
 public:
  /// \param leaf  the most triangles that a leaf has, at least 1
  /// \param threads  that build it
  explicit TriangleTree(const Mesh& mesh, std::uint32_t leaf = 4, unsigned threads = 1);

  /// The distance from p to the nearest triangle, or none if all are farther away than `most`, mm. A triangle
  /// that is near p, as that of a neighbouring point, makes it quicker. The bounds are within 2^-47 of the
  /// largest coordinate of mesh and point; beside a triangle less than a millionth as wide as long they hold,
  /// too, but may be farther apart. Cost: O(log n) as a rule.
  [[nodiscard]] std::optional<Nearest> nearest(Vector p,
                                               double most = std::numeric_limits<double>::infinity(),
                                               std::optional<std::uint32_t> near = {}) const;

  /// A bound from below of the least sum, over all triangles, of the distance and so many times the
  /// triangle's width, mm, as near as that of `nearest`. \param least  no width is less, so many times \pre
  /// there are triangles, each with a width
  [[nodiscard]] double least_sum(Vector p, const std::vector<double>& widths, double times,
                                 double least) const;

  /// Returns whether a way straight up from p crosses the triangles an odd number of times; exact, whatever
  /// the way meets: it counts as p moved by less than every number. \pre p lies on no triangle, where either
  /// may be said, and the mesh is closed
  [[nodiscard]] bool holds(Vector p) const;
  /// Appends the triangles that this way crosses, in any order, and returns how many were looked at.
  std::size_t crossed_above(Vector p, std::vector<std::uint32_t>& triangles) const;

  /// The corner that is foremost against a direction: the product with it is least. \pre there are triangles
  [[nodiscard]] Vector foremost(Vector direction) const;

  [[nodiscard]] const Box& box() const noexcept { return box_; }

  struct Node {
    Box box;
    std::uint32_t begin = 0, end = 0;  ///< in leaf order
    /// The right child, 0 in a leaf; the left child is the next node.
    std::uint32_t right = 0;
  };
  /// For whoever walks the tree: its nodes in preorder, and the triangles in leaf order.
  [[nodiscard]] const std::vector<Node>& nodes() const noexcept { return nodes_; }
  [[nodiscard]] const Corners& corners(std::uint32_t in_order) const noexcept { return corners_[in_order]; }
  [[nodiscard]] std::uint32_t triangle(std::uint32_t in_order) const noexcept { return order_[in_order]; }
  [[nodiscard]] std::uint32_t place_in_order(std::uint32_t triangle) const noexcept {
    return place_in_order_[triangle];
  }
  /// Nodes whose triangles are `count` patches, in the order of the nodes: the largest one is cut until there
  /// are as many, or each is a leaf.
  [[nodiscard]] std::vector<std::uint32_t> patches(std::size_t count) const;
  /// No coordinate of the mesh is larger, mm.
  [[nodiscard]] double largest() const noexcept { return largest_; }

 private:
  class Builder;
  template <class Visit>
  void descend(std::uint32_t at, const Visit& visit, Vector p) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_, place_in_order_;
  std::vector<Corners> corners_;
  Box box_;
  double largest_ = 0;
};

}  // namespace lekalo::solid

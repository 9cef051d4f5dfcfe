#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "lekalo/solid/motion.hpp"
#include "lekalo/solid/oriented_box.hpp"
#include "lekalo/solid/triangle_tree.hpp"

namespace lekalo::solid {

/// A triangle of the part and one of the blank, and where they are nearest to each other.
struct NearPair {
  std::uint32_t part_triangle = 0, blank_triangle = 0;
  Vector part, blank;  ///< the two points, both in the blank's frame
  /// Bounds of their distance less the width of the blank's triangle, mm.
  double low = 0, high = 0;
};

/// The allowance of a part in a blank, both closed meshes, at one pose after another: the least distance of
/// their surfaces, where the part lies inside the blank. A triangle of the blank may have a width, which is
/// how far the true surface may lie inside it.
///
/// Its answers depend on their arguments alone. docs/design/solid.md has the bounds.
class MeshClearance {
 public:
  /// \param widths  of the blank's triangles, mm, >= 0; or none, of a blank taken as drawn
  /// \param threads  that make the trees
  MeshClearance(const Mesh& part, const Mesh& blank, const std::vector<double>& widths = {},
                unsigned threads = 1);
  /// Some triangles of a part, which need not be closed, in the blank of another.
  MeshClearance(const Mesh& part, const MeshClearance& other);

  [[nodiscard]] const TriangleTree& part() const noexcept { return part_; }
  [[nodiscard]] const TriangleTree& blank() const noexcept { return blank_->tree; }

  /// The nearest pair, or none if all are `most` apart or more; rounding may let one of these be given. `low`
  /// holds for all pairs. It is within 2^-41 of the largest coordinate of `high` unless a triangle is very
  /// thin; where surfaces cross it is not above 0, and the pair is one of those that do. A pair that is near,
  /// as that of a neighbouring pose, makes it quicker.
  [[nodiscard]] std::optional<NearPair> nearest(const Motion& blank_from_part,
                                                double most = std::numeric_limits<double>::infinity(),
                                                const NearPair* near = nullptr) const;

  /// A pair of triangles below one node of each tree that is less than `most` apart, or none if none was met
  /// in so many steps. It is the nearest where these are enough; `low` holds for the pairs that were met.
  [[nodiscard]] std::optional<NearPair> near_below(const Motion& blank_from_part, std::uint32_t part_node,
                                                   std::uint32_t blank_node, double most,
                                                   std::size_t steps) const;

  /// One pair, as the numbers of its triangles say.
  [[nodiscard]] NearPair pair(const Motion& blank_from_part, std::uint32_t part_triangle,
                              std::uint32_t blank_triangle) const;

  /// The nearest pairs of those pieces of the part that have one less than `most` apart, or some pair of a
  /// piece that crosses: at most `count` of them, nearest first. The pieces are kPieces patches of like size,
  /// if the part has as many triangles; threads share them out where all are wanted. \pre count > 0
  void nearest_by_piece(const Motion& blank_from_part, double most, std::size_t count,
                        std::vector<NearPair>& found, unsigned threads = 1) const;
  static constexpr std::size_t kPieces = 64;
  /// The same, of each piece what so many steps meet.
  void near_by_piece(const Motion& blank_from_part, double most, std::size_t steps,
                     std::vector<NearPair>& found) const;

  /// Says if the part lies inside the blank where their surfaces are apart: a point of each surface of the
  /// part is in the blank, and a point of each of the blank is not in the part. Where they cross it may say
  /// either.
  [[nodiscard]] bool inside(const Motion& blank_from_part) const;
  /// The first half of that.
  [[nodiscard]] bool part_in_blank(const Motion& blank_from_part) const;

 private:
  struct Walk;
  struct Blank {
    Blank(const Mesh& blank, const std::vector<double>& widths, unsigned threads);

    TriangleTree tree;
    OrientedBoxes boxes;  ///< of the tree's nodes
    /// The widths of its triangles in leaf order, and the widest of each node; both empty without widths.
    std::vector<double> width, widest;
    /// A vertex of each surface that hangs together.
    std::vector<Vector> points;
  };
  MeshClearance(const Mesh& part, TriangleTree tree, std::shared_ptr<const Blank> blank);

  TriangleTree part_;
  OrientedBoxes part_boxes_;
  /// The roots of the pieces.
  std::vector<std::uint32_t> pieces_;
  std::vector<Vector> of_part_;
  std::shared_ptr<const Blank> blank_;
};

/// A vertex of each piece of the surface that hangs together by its vertices.
[[nodiscard]] std::vector<Vector> surface_points(const Mesh& mesh);

}  // namespace lekalo::solid

#pragma once

#include <optional>
#include <vector>

#include "box_tree.hpp"
#include "solid_mesh.hpp"
#include "verify/number/vec3.hpp"

namespace lekalo::verify {

/// A pose in space as it is written: the rotation of a quaternion w, x, y, z of any length but 0, then a
/// shift.
struct SolidPose {
  std::array<Decimal, 4> quaternion;
  std::array<Decimal, 3> shift;
};

/// The motion of a pose. The rotation of a quaternion of fractions is one of fractions, so it is exact.
class SolidMotion {
 public:
  /// \pre the quaternion is not 0
  explicit SolidMotion(const SolidPose& pose);

  [[nodiscard]] Exact3 operator()(const Exact3& p) const;
  [[nodiscard]] Vec3 operator()(const Vec3& p) const;

 private:
  std::array<Exact3, 3> rows_;
  Exact3 shift_;
  std::array<Vec3, 3> enclosed_rows_;
  Vec3 enclosed_shift_{};
};

using Triangle3 = std::array<Vec3, 3>;
using ExactTriangle = std::array<Exact3, 3>;

/// A closed mesh at its place: where each vertex is, enclosed and exactly, and the tree over its triangles.
class PlacedSolid {
 public:
  /// \param mesh  outlives this
  /// \param motion  none for a mesh that stays where it is
  explicit PlacedSolid(const SolidMesh& mesh, const std::optional<SolidMotion>& motion = std::nullopt);

  [[nodiscard]] const SolidMesh& mesh() const { return *mesh_; }
  [[nodiscard]] const BoxTree& tree() const { return tree_; }
  /// No triangle has less width, or more.
  [[nodiscard]] double narrowest() const { return narrowest_; }
  [[nodiscard]] double widest() const { return widest_; }
  [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return at_[vertex]; }
  [[nodiscard]] Exact3 exactly_at(std::uint32_t vertex) const;
  [[nodiscard]] Triangle3 triangle(std::uint32_t number) const;
  [[nodiscard]] ExactTriangle exact_triangle(std::uint32_t number) const;

  /// Says whether a point is inside: whether the way straight up from it crosses the triangles an odd number
  /// of times. The point counts as moved by less than any number along y, and by far less along x, so that no
  /// way meets an edge or a corner. Exact. \pre it lies on no triangle
  [[nodiscard]] bool holds(const Vec3& enclosed, const Exact3& point) const;

  /// Says whether a point lies on a triangle, exactly.
  [[nodiscard]] bool touches(const Vec3& enclosed, const Exact3& point) const;

  /// Returns the vertices of each part of the surface that hangs together by vertices, and one of each.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> components() const;
  [[nodiscard]] std::vector<std::uint32_t> one_of_each_component() const;

 private:
  const SolidMesh* mesh_;
  std::optional<SolidMotion> motion_;
  std::vector<Vec3> at_;
  BoxTree tree_;
  double narrowest_ = 0, widest_{};
};

}  // namespace lekalo::verify

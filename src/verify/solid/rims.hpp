#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "placed_solid.hpp"

namespace lekalo::verify {

/// The rims of finished faces of a part: points nearer to such a face than its rim is wide demand nothing.
class Rims {
 public:
  /// \param part  closed; outlives this
  explicit Rims(const SolidMesh& part) : part_(part) {}
  /// Adds the rim of some triangles. \pre its width is above 0
  void add(const std::vector<std::uint32_t>& triangles, double width);

  [[nodiscard]] bool any() const { return !rims_.empty(); }
  /// Says whether no point of a triangle of the part lies in a rim, and the same of a point. Exact.
  [[nodiscard]] bool spare(std::uint32_t triangle) const;
  [[nodiscard]] bool spare(const Exact3& point) const;

  /// Triangles with corners in doubles which hold all points of some triangles of the part that lie in no
  /// rim, moved by less than off(), and others that are nearly in none.
  [[nodiscard]] SolidMesh rest(const std::vector<std::uint32_t>& triangles) const;
  [[nodiscard]] double off() const;

 private:
  struct Rim {
    Rim(SolidMesh triangles, double wide) : face(std::move(triangles)), placed(face), width(wide) {}
    SolidMesh face;
    PlacedSolid placed;
    double width;
  };
  class Cut;

  const SolidMesh& part_;
  std::vector<std::unique_ptr<const Rim>> rims_;
};

/// Returns some triangles of a mesh as a mesh of their own, and the vertices that they have.
[[nodiscard]] SolidMesh part_of(const SolidMesh& mesh, const std::vector<std::uint32_t>& triangles);

}  // namespace lekalo::verify

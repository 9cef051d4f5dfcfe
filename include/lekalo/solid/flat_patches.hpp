#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lekalo/solid/mesh.hpp"

namespace lekalo::solid {

/// Finds how far the surface goes on in the plane of a triangle, across the edges that its neighbours share.
class FlatPatches {
 public:
  /// \param mesh  closed; outlives this
  explicit FlatPatches(const Mesh& mesh);

  /// The radius of a disc about a point of a triangle, in its plane, that lies on the surface but for
  /// `flatness`, mm; 0 where the point is on a bend.
  [[nodiscard]] double disc(std::uint32_t triangle, Vector place, double flatness) const;

 private:
  const Mesh* mesh_;
  static constexpr std::uint32_t kNone = 0xffffffff;
  /// Across the edge from a corner to the next one; none where an edge has other than two triangles.
  std::vector<std::array<std::uint32_t, 3>> neighbours_;
};

}  // namespace lekalo::solid

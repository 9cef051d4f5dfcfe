#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/solid/vector.hpp"

namespace lekalo::solid {

/// A corner of a triangle is the number of a vertex.
using Triangle = std::array<std::uint32_t, 3>;

/// Triangles over shared vertices, millimetres.
struct Mesh {
  std::vector<Vector> vertices;
  std::vector<Triangle> triangles;
};

/// A box along the axes, mm; empty as it is made.
struct Box {
  Vector low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void hold(Vector p) noexcept;
};
[[nodiscard]] Box box_of(const std::vector<Vector>& points) noexcept;

/// A mesh whose surface closes: every edge belongs to an even number of triangles, and none has a corner
/// twice. So a way from far outside to a point crosses it an odd number of times where the point is inside,
/// whichever way the triangles are turned; a body within another is a void.
struct ClosedMesh {
  Mesh mesh;
  /// Sentences about mends and about what does not matter.
  std::vector<std::string> notices;
};

/// Makes one vertex of those at the same place, and leaves out vertices that no triangle has and triangles
/// with a corner twice.
///
/// Fails with bad_input and one sentence that names places and the way out: no triangles, a vertex that is
/// not finite or beyond limits::kLargestCoordinate, or edges with an odd number of triangles. Triangles are
/// counted from 1 in the order given. It does not ask whether the surface crosses itself. Cost: O(n log n).
[[nodiscard]] Result<ClosedMesh> closed_mesh(Mesh mesh);

}  // namespace lekalo::solid

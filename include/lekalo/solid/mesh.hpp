#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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

/// Triangles that hang together by their edges.
struct Shell {
  std::uint32_t first = 0, triangles = 0;  ///< its first triangle, and how many it has
  /// How many other shells it lies in: an even number bounds a body, an odd one a void. Asked at
  /// the middles of eight triangles; none if these differ, because shells cross or touch,
  /// or if thousands of shells lie around each other.
  std::optional<std::uint32_t> depth;
  /// mm3, positive where the triangles look outwards; of a surface that has two sides.
  double volume = 0;
};

/// A mesh whose surface closes: every edge belongs to an even number of triangles, and none has a corner
/// twice. So a way from far outside to a point crosses it an odd number of times where the point is inside,
/// whichever way the triangles are turned; a body within another is a void.
///
/// The triangles of a shell look away from the material, counter-clockwise as seen from outside, if that can
/// be told: every edge has two triangles, they can be turned to one side, and the shell's depth is known.
/// Else they are turned as they were given.
struct ClosedMesh {
  Mesh mesh;
  /// The number of each triangle among those given, from 0.
  std::vector<std::uint32_t> numbers;
  /// Says of each triangle whether it is turned round, so that its last two corners have changed places.
  std::vector<bool> turned;
  std::vector<Shell> shells;  ///< in the order of their first triangles
  /// Sentences about mends and about what does not matter.
  std::vector<std::string> notices;
};

/// Makes one vertex of those at the same place, leaves out vertices that no triangle has and triangles
/// without area, and turns triangles round. Triangles without area stay if the surface does not close without
/// them: they fill the seam between a long edge and the short ones beside it. A triangle repeats another one
/// where it has the same corners. Repeats are left out if the surface closes without them, and either is open
/// with them, or one of them is turned as the other, or every triangle is repeated, as where both sides of a
/// surface were written; else two bodies touch there. Coordinates below 2^-320 mm become 0.
///
/// Fails with bad_input and one sentence that names places and the way out: no triangles, a vertex that is
/// not finite or beyond limits::kLargestCoordinate, or edges with an odd number of triangles. Triangles are
/// counted from 1 in the order given. Whether the surface crosses itself `crossings` says. Cost: O(n log n),
/// and for each of several shells what lies above a few places of it.
[[nodiscard]] Result<ClosedMesh> closed_mesh(Mesh mesh);

}  // namespace lekalo::solid

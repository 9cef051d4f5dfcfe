#pragma once

#include <array>

#include "lekalo/solid/mesh.hpp"
#include "lekalo/solid/vector.hpp"

namespace lekalo::solid {

/// Only its symmetric ones are meant.
using Matrix = std::array<std::array<double, 3>, 3>;

/// The eigenvectors of a symmetric matrix, of length 1 and right-handed but for rounding, in no order.
[[nodiscard]] std::array<Vector, 3> eigenvectors(Matrix m);

/// How a body balances and which ways it is long.
struct PrincipalAxes {
  double volume = 0;  ///< mm3
  Vector centre;      ///< of the volume
  /// Right-handed; the body is spread least along the first, and most along the last.
  std::array<Vector, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  /// Along each of them: the square of the distance from the centre, over the volume, mm5.
  std::array<double, 3> spread{};
};

/// \param mesh  closed, its triangles turned away from the material; if that cannot be told, or for a body
/// without volume, nothing can be said of centre and axes. Cost: O(n).
[[nodiscard]] PrincipalAxes principal_axes(const Mesh& mesh);

}  // namespace lekalo::solid

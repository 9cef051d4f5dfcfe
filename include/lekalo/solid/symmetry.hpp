#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/solid/mesh.hpp"

namespace lekalo::solid {

/// A line through the middle of a body about which turns leave it as it is.
struct SymmetryAxis {
  Vector direction;         ///< of length 1
  std::uint32_t turns = 0;  ///< it is the same after each of so many equal parts of a turn; 0: after any
};

/// The rotations that leave a body as it is.
struct Symmetry {
  Vector centre;                   ///< of the volume; all axes go through it
  std::vector<SymmetryAxis> axes;  ///< those of most turns first, the ones after any turn before all
  /// Their number, with the one that does nothing; 0 where an axis has any turn.
  std::uint32_t rotations = 1;
};

/// Looks for them: rotations about the axes of inertia, and those that bring two vertices to two others. One
/// counts if it, and its opposite, bring no vertex of some hundreds farther from the surface than the
/// tolerance; so it is an estimate. A body whose vertices do not lie evenly has only the symmetry of them.
/// \param mesh  closed, its triangles turned away from the material
/// \param tolerance  mm, > 0
/// Deterministic. Cost: O(n log n), and a tree over the mesh where there is anything to be tried.
[[nodiscard]] Symmetry symmetry(const Mesh& mesh, double tolerance);

}  // namespace lekalo::solid

#pragma once

#include <array>
#include <vector>

#include "lekalo/fit/assembly.hpp"
#include "lekalo/fit/pressing.hpp"

namespace lekalo::fit {

/// An assembly in 8-node quadrilaterals, docs/design/fit.md, step 2: half of it (z >= 0) where it is
/// symmetric.

struct MeshNode {
  double r = 0, z = 0;
};

/// Corners counterclockwise from the least r and z, then the middles of the sides in the same order.
struct MeshElement {
  std::array<int, 8> nodes{};
  int ring = 0;
};

/// The nodes of a ring's inner and outer surface along z. Corners and middles alternate, and seats that meet
/// have nodes at the same z: node i lies in column first + i of the mesh.
struct RingSurfaces {
  std::vector<int> inner, outer;
  std::size_t first = 0;
};

struct RingMesh {
  std::vector<MeshNode> nodes;  ///< column by column along z, and outwards within each
  std::vector<MeshElement> elements;
  std::vector<RingSurfaces> rings;
  bool half = true;  ///< the plane z = 0 is one of symmetry
};

/// Only surfaces that are no seats may be turned. \pre check_assembly() takes it. Cost: O(nodes), some
/// thousands.
[[nodiscard]] RingMesh mesh_of(const Assembly& assembly, const Fineness& fineness,
                               const std::vector<Turned>& turned);

}  // namespace lekalo::fit

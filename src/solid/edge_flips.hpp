#pragma once

#include "lekalo/solid/mesh.hpp"

namespace lekalo::solid {

/// Turns edges between two triangles to the other diagonal where the larger of the smallest circles around
/// the two becomes smaller, and neither looks back. The surface stays closed.
void flip_edges(Mesh& mesh);

}  // namespace lekalo::solid

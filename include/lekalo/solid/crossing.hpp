#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "lekalo/solid/mesh.hpp"

namespace lekalo::solid {

/// A place where a surface goes through itself.
struct Crossing {
  Vector place;
  std::uint32_t triangle = 0;
  /// The triangle that goes through it, where that was seen.
  std::optional<std::uint32_t> other;
};

/// How a closed surface crosses itself.
struct Crossings {
  std::size_t edges = 0;          ///< of triangles that go through other triangles, or end on them
  std::optional<Crossing> first;  ///< of those
  /// One that changes inside and outside: one side of one sheet of the surface is inside by an odd count at
  /// one place and outside at another, with balls of radius `depth` on both sides of both places. So the mesh
  /// bounds no body whose inside is what a sheet has on one side of it, however it is read.
  std::optional<Crossing> changing;
  double depth = 0;      ///< mm
  bool complete = true;  ///< all pairs of triangles that can meet were looked at
};

/// Looks for crossings. Any two sheets that cross do change inside and outside, but where what lies between
/// them is nowhere `depth` thick, as where facets of one face fold by a rounding, nothing has room there that
/// could be taken for inside or outside.
/// \pre the mesh is closed. Cost: O(n log n) where few triangles meet each other.
[[nodiscard]] Crossings crossings(const Mesh& mesh);

}  // namespace lekalo::solid

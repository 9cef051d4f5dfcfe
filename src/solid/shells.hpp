#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "lekalo/solid/mesh.hpp"

namespace lekalo::solid {

/// An edge of a triangle, from its lesser vertex to its greater one.
struct Edge {
  std::uint32_t low, high;
  std::uint32_t triangle;
  bool forward;  ///< the triangle passes it from low to high
  [[nodiscard]] auto ends() const noexcept { return std::pair(low, high); }
};

/// The edges of all triangles: those between the same two vertices are neighbours.
[[nodiscard]] std::vector<Edge> sorted_edges(const std::vector<Triangle>& triangles);

/// Calls see(begin, end) for the edges between the same two vertices, as a range of indices. \pre they are
/// sorted
template <class See>
void for_each_edge(const std::vector<Edge>& edges, const See& see) {
  for (std::size_t begin = 0, end; begin < edges.size(); begin = end) {
    for (end = begin; end < edges.size() && edges[end].ends() == edges[begin].ends();) ++end;
    see(begin, end);
  }
}

/// Finds the shells of the mesh, turns their triangles away from the material and tells so.
/// \param edges  of all triangles, sorted
void find_shells(const std::vector<Edge>& edges, ClosedMesh& closed);

}  // namespace lekalo::solid

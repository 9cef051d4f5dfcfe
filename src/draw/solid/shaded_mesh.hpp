#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/solid/mesh.hpp"
#include "lekalo/solid/motion.hpp"

namespace lekalo::draw {

/// A surface ready to be painted: bends of more than some 30 degrees are edges, smaller ones look smooth. A
/// vertex on an edge therefore stands here once for each side.
struct ShadedMesh {
  std::vector<solid::Vector> places;
  std::vector<solid::Vector> normals;  ///< of length 1, on the outer side where the triangles are turned so
  std::vector<std::uint32_t> from;     ///< the vertex of the mesh
  std::vector<solid::Triangle> triangles;  ///< as many as the mesh has, in its order

  struct Edge {
    std::uint32_t a = 0, b = 0;  ///< vertices of this surface
    solid::Vector left, right;   ///< the normals of its two sides
    bool sharp = true;
  };
  /// The edges that bend at all, so that they may be seen as outlines.
  std::vector<Edge> edges;
};

[[nodiscard]] ShadedMesh shaded(const solid::Mesh& mesh, const solid::Motion& motion = {});

}  // namespace lekalo::draw

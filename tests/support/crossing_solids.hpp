#pragma once

// Surfaces that go through themselves, for the solver's tests of them and the checker's.

#include <cstdint>
#include <vector>

#include "support/solids.hpp"

namespace lekalo::cases {

inline solid::Mesh both(solid::Mesh mesh, const solid::Mesh& other) {
  append(mesh, other);
  return mesh;
}

/// An outline that crosses itself in the middle, pulled up.
inline solid::Mesh bow_tie() {
  solid::Mesh mesh;
  for (const double z : {0.0, 10.0})
    for (const solid::Vector p : {solid::Vector{0, 0, z}, {10, 10, z}, {10, 0, z}, {0, 10, z}})
      mesh.vertices.push_back(p);
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t next = (k + 1) % 4;
    mesh.triangles.insert(mesh.triangles.end(), {{k, next, k + 4}, {next, next + 4, k + 4}});
  }
  mesh.triangles.insert(mesh.triangles.end(), {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}});
  return mesh;
}

struct NamedMesh {
  const char* what;
  solid::Mesh mesh;
};

/// Each changes inside and outside where it goes through itself.
inline std::vector<NamedMesh> changing_meshes() {
  return {{"askew", both(block({0, 0, 0}, {20, 20, 20}), block({5, 6, 7}, {30, 31, 32}))},
          {"no corner within the other",
           both(block({-50, -5, -5}, {50, 5, 5}), block({-3, -50, -7}, {4, 50, 6}))},
          {"on the same planes", both(block({-50, -5, -5}, {50, 5, 5}), block({-5, -50, -5}, {5, 50, 5}))},
          {"end in end", both(block({0, 0, 0}, {20, 2, 2}), block({19, 0, 0}, {39, 2, 2}))},
          {"a little", both(block({0, 0, 0}, {20, 20, 20}), block({19.95, 3, 4}, {39, 30, 30}))},
          {"a void that sticks out", both(block({0, 0, 0}, {20, 20, 20}), block({5, 5, 5}, {9, 9, 25}))},
          {"one sheet", bow_tie()}};
}

}  // namespace lekalo::cases

#pragma once

// Bodies for tests of meshes: boxes, wavy balls and rings, as functions of a seed.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/solid/mesh.hpp"

namespace lekalo::cases {

/// Adds the other mesh; their triangles share no vertices.
inline void append(solid::Mesh& mesh, const solid::Mesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const solid::Triangle& t : other.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

/// A box along the axes.
inline solid::Mesh block(solid::Vector low, solid::Vector high) {
  solid::Mesh mesh;
  for (const unsigned k : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U})
    mesh.vertices.push_back({k % 2 ? high.x : low.x, k / 2 % 2 ? high.y : low.y, k / 4 ? high.z : low.z});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A ring about the z axis whose thickness waves: `around` quads along it, `across` around its tube.
inline solid::Mesh ring(Random& random, std::uint32_t around, std::uint32_t across, double radius,
                        double tube) {
  solid::Mesh mesh;
  const double wave = random.uniform(0, 0.3), phase = random.uniform(0, 6),
               turns = 1 + static_cast<double>(random.below(4));
  for (std::uint32_t i = 0; i < around; ++i) {
    const double a = 2 * std::numbers::pi * i / around;
    for (std::uint32_t j = 0; j < across; ++j) {
      const double b = 2 * std::numbers::pi * j / across,
                   r = tube * (1 + wave * std::sin(turns * a + phase + b));
      const double out = radius + r * std::cos(b);
      mesh.vertices.push_back({out * std::cos(a), out * std::sin(a), r * std::sin(b)});
      const std::uint32_t next_i = (i + 1) % around, next_j = (j + 1) % across;
      const std::uint32_t p = i * across + j, q = next_i * across + j, r0 = i * across + next_j,
                          s = next_i * across + next_j;
      mesh.triangles.push_back({p, q, r0});
      mesh.triangles.push_back({q, s, r0});
    }
  }
  return mesh;
}

}  // namespace lekalo::cases

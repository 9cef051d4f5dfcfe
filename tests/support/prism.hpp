#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "lekalo/solid/mesh.hpp"

namespace lekalo::cases {

/// A prism along y over an outline in x and z, whose point 3 sees all the others.
inline solid::Mesh prism(const std::vector<std::array<double, 2>>& outline, double low, double high) {
  solid::Mesh mesh;
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double y : {low, high})
    for (const auto& [x, z] : outline) mesh.vertices.push_back({x, y, z});
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n;
    mesh.triangles.push_back({k, next, n + k});
    mesh.triangles.push_back({next, n + next, n + k});
    if (k == 3 || next == 3) continue;
    mesh.triangles.push_back({3, next, k});
    mesh.triangles.push_back({n + 3, n + k, n + next});
  }
  return closed_mesh(std::move(mesh)).value().mesh;
}

}  // namespace lekalo::cases

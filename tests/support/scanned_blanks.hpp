#pragma once

// Blanks that are known as bodies, and as the mesh that a scanner makes of them.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/solid_cases.hpp"

namespace lekalo::cases {

inline constexpr double kBall = 40;

/// A ball with bites of balls that come from outside.
struct Bitten {
  double radius = 0;  ///< of the balls that bite
  std::vector<solid::Vector> bites;

  [[nodiscard]] bool material(solid::Vector p) const {
    if (norm(p) > kBall) return false;
    return std::none_of(bites.begin(), bites.end(), [&](solid::Vector c) { return norm(p - c) < radius; });
  }
  /// How far the material goes from the middle in a direction.
  [[nodiscard]] double reach(solid::Vector u) const {
    double least = kBall;
    for (const solid::Vector c : bites) {
      const double along = dot(u, c), square = radius * radius - (dot(c, c) - along * along);
      if (square > 0 && along > 0) least = std::min(least, along - std::sqrt(square));
    }
    return least;
  }
};

inline Bitten bitten(Random& random) {
  Bitten blank;
  blank.radius = random.uniform(4, 12);
  for (int k = 0; k < 12; ++k)
    blank.bites.push_back((kBall + random.uniform(0, 0.9) * blank.radius) * direction(random));
  return blank;
}

/// What a scanner sees of it: points on meridians, each off by up to the guard.
inline solid::Mesh scanned(const Bitten& blank, std::uint32_t rings, double guard, Random& random) {
  const std::uint32_t around = 2 * rings;
  solid::Mesh mesh;
  const auto add = [&](double polar, double turn) {
    const solid::Vector u{std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                          std::cos(polar)};
    mesh.vertices.push_back(blank.reach(u) * u + random.uniform(0, guard) * direction(random));
  };
  add(0, 0);
  for (std::uint32_t i = 1; i < rings; ++i)
    for (std::uint32_t k = 0; k < around; ++k)
      add(std::numbers::pi * i / rings, 2 * std::numbers::pi * k / around);
  add(std::numbers::pi, 0);
  const auto at = [&](std::uint32_t i, std::uint32_t k) { return 1 + (i - 1) * around + k % around; };
  const std::uint32_t last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (std::uint32_t k = 0; k < around; ++k) {
    mesh.triangles.push_back({0, at(1, k), at(1, k + 1)});
    mesh.triangles.push_back({last, at(rings - 1, k + 1), at(rings - 1, k)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return mesh;
}

}  // namespace lekalo::cases

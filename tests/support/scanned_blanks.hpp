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
  /// How far a place is from the air, negative in it.
  [[nodiscard]] double depth(solid::Vector p) const {
    double depth = kBall - norm(p);
    for (const solid::Vector c : bites) depth = std::min(depth, norm(p - c) - radius);
    return depth;
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

/// A casting as it stands on a table at z = 0: a cylinder of radius 20 and height 20 with a core in its top
/// and dents in its side, all bitten by balls of 5 mm radius and more.
struct Casting {
  std::vector<solid::Vector> bites{{0, 0, 21}};
  static constexpr double kCore = 7, kDent = 5;

  explicit Casting(Random& random) {
    for (int k = 0; k < 8; ++k) {
      const double turn = random.uniform(0, 2 * std::numbers::pi), out = 24 + random.uniform(0.2, 0.8);
      bites.push_back({out * std::cos(turn), out * std::sin(turn), random.uniform(7, 14)});
    }
  }
  /// How far a place is from the air, negative in it.
  [[nodiscard]] double depth(solid::Vector p) const {
    double depth = std::min({p.z, 20 - p.z, 20 - std::hypot(p.x, p.y)});
    for (std::size_t k = 0; k < bites.size(); ++k)
      depth = std::min(depth, norm(p - bites[k]) - (k == 0 ? kCore : kDent));
    return depth;
  }
  /// The scanner's mesh: points about a millimetre apart, each off by up to `noise`. It saw nothing of the
  /// underside, which few triangles close.
  [[nodiscard]] solid::Mesh scanned(double noise, Random& random) const {
    constexpr std::uint32_t kUp = 20, kIn = 19, kAround = 120;
    const solid::Vector middle{0, 0, 8};
    solid::Mesh mesh;
    const auto add = [&](solid::Vector p) {
      const solid::Vector way = p - middle;
      double low = 0, high = 1;
      for (int k = 0; k < 60 && depth(p) < 0; ++k) {
        const double half = 0.5 * (low + high);
        (depth(middle + half * way) > 0 ? low : high) = half;
      }
      mesh.vertices.push_back(middle + high * way + noise * direction(random));
    };
    for (std::uint32_t i = 0; i <= kUp + kIn; ++i)
      for (std::uint32_t k = 0; k < kAround; ++k) {
        const double turn = 2 * std::numbers::pi * k / kAround, r = i <= kUp ? 20 : 20 + kUp - i;
        add({r * std::cos(turn), r * std::sin(turn), std::min<double>(i, kUp)});
      }
    const auto top = static_cast<std::uint32_t>(mesh.vertices.size());
    add({0, 0, 20});
    mesh.vertices.push_back({});
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t next = (k + 1) % kAround;
      mesh.triangles.push_back({top + 1, next, k});
      for (std::uint32_t i = 0; i < kUp + kIn; ++i) {
        const std::uint32_t a = i * kAround, b = a + kAround;
        mesh.triangles.push_back({a + k, a + next, b + next});
        mesh.triangles.push_back({a + k, b + next, b + k});
      }
      mesh.triangles.push_back({(kUp + kIn) * kAround + k, (kUp + kIn) * kAround + next, top});
    }
    return mesh;
  }
  /// A part that fits: a body with a pocket in its top.
  [[nodiscard]] static solid::Mesh part() {
    return turned({{0, 1.7}, {16.5, 1.7}, {17, 17.5}, {9, 17.5}, {5, 12.2}, {0, 12.2}}, 12, 0.1);
  }
};

}  // namespace lekalo::cases

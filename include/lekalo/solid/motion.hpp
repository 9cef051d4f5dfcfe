#pragma once

#include <array>

#include "lekalo/solid/vector.hpp"

namespace lekalo::solid {

/// A rigid motion as doubles: p goes to `rotation` p + `shift`. The rows of the rotation may be off by
/// rounding.
struct Motion {
  std::array<Vector, 3> rotation{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vector shift;
  [[nodiscard]] Vector turned(Vector p) const noexcept {
    return {dot(rotation[0], p), dot(rotation[1], p), dot(rotation[2], p)};
  }
  /// The other way round: turns a direction back.
  [[nodiscard]] Vector turned_back(Vector p) const noexcept {
    return p.x * rotation[0] + (p.y * rotation[1] + p.z * rotation[2]);
  }
  [[nodiscard]] Vector operator()(Vector p) const noexcept { return turned(p) + shift; }
  [[nodiscard]] Vector back(Vector p) const noexcept { return turned_back(p - shift); }
};

}  // namespace lekalo::solid

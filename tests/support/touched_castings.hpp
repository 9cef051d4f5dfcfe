#pragma once

// Castings of a metre that differ from their nominal mesh, and the touches of a probe on them. Where material
// is, is known exactly.

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/solid/triangle_tree.hpp"
#include "support/solid_cases.hpp"

namespace lekalo::cases {

/// Material is where the height over the nominal surface, negative inside, is no more than `bump` says. So
/// each surface lies within the largest bump of the other, along its normal.
class TouchedCasting {
 public:
  /// \param most  the largest bump, mm
  TouchedCasting(solid::Mesh nominal, const solid::Motion& there, double most, Random& random)
      : nominal_(std::move(nominal)), tree_(std::make_unique<solid::TriangleTree>(nominal_)), there_(there) {
    for (Wave& wave : waves_)
      wave = {most / 3, random.uniform(0.003, 0.008) * direction(random), random.uniform(0, 6)};
  }

  [[nodiscard]] const solid::Mesh& nominal() const { return nominal_; }
  /// Where the nominal mesh truly is.
  [[nodiscard]] const solid::Motion& there() const { return there_; }

  /// Tells of a place in the machine's frame, none on the surface.
  [[nodiscard]] bool is_material(solid::Vector place) const {
    const solid::Vector p = there_.back(place);
    return height(p) <= bump(p);
  }

  /// The centre of a ball that touches the casting somewhere, from outside and where there is room; with a
  /// radius of 0 a point of the surface.
  /// \param direction  becomes that out of the casting, of some length
  [[nodiscard]] solid::Vector touch(double radius, Random& random, solid::Vector& direction) const {
    for (;;) {
      const auto& t = nominal_.triangles[random.below(nominal_.triangles.size())];
      const solid::Vector a = nominal_.vertices[t[0]], b = nominal_.vertices[t[1]] - a,
                          c = nominal_.vertices[t[2]] - a, across = cross(b, c);
      double u = random.uniform(), v = random.uniform();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const solid::Vector n = 1 / norm(across) * across, at = a + u * b + v * c;
      constexpr double kRoom = 12;
      if (tree_->nearest(at + kRoom * n)->low < 0.999 * kRoom ||
          tree_->nearest(at - kRoom * n)->low < 0.999 * kRoom)
        continue;
      double low = -kRoom / 2, high = kRoom / 2;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        const solid::Vector p = at + middle * n;
        (middle > bump(p) ? high : low) = middle;
      }
      const solid::Vector on = at + low * n, out = n - slope(on);
      direction = there_.turned(random.uniform(0.5, 2) * out);
      return there_(on + radius / norm(out) * out);
    }
  }

 private:
  struct Wave {
    double height = 0;
    solid::Vector way;
    double phase = 0;
  };

  [[nodiscard]] double height(solid::Vector p) const {
    const double distance = tree_->nearest(p)->high;
    return tree_->holds(p) ? -distance : distance;
  }
  [[nodiscard]] double bump(solid::Vector p) const {
    double sum = 0;
    for (const Wave& w : waves_) sum += w.height * std::sin(dot(w.way, p) + w.phase);
    return sum;
  }
  [[nodiscard]] solid::Vector slope(solid::Vector p) const {
    solid::Vector sum;
    for (const Wave& w : waves_) sum = sum + w.height * std::cos(dot(w.way, p) + w.phase) * w.way;
    return sum;
  }

  solid::Mesh nominal_;
  std::unique_ptr<solid::TriangleTree> tree_;
  solid::Motion there_;
  std::array<Wave, 3> waves_;
};

/// A block of a metre with two tilted cores, and a part for it.
inline SolidCase large_cored_block(Random& random) {
  SolidCase made = cored_block(random);
  constexpr double kLarge = 7;
  for (solid::Mesh* const mesh : {&made.part, &made.blank})
    for (solid::Vector& p : mesh->vertices) p = kLarge * p;
  made.there.shift = kLarge * made.there.shift;
  return made;
}

/// So many touches, each off by less than `off`.
/// \param directions  those of all, if it is not null
inline std::vector<solid::Vector> touches_of(const TouchedCasting& casting, std::size_t count, double radius,
                                             double off, Random& random,
                                             std::vector<solid::Vector>* directions = nullptr) {
  std::vector<solid::Vector> made;
  while (made.size() < count) {
    solid::Vector out;
    const solid::Vector at = casting.touch(radius, random, out);
    made.push_back(at + random.uniform(0, 0.99) * off * direction(random));
    if (directions != nullptr) directions->push_back(out);
  }
  return made;
}

}  // namespace lekalo::cases

#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::fit {

/// A metal that yields by von Mises and hardens linearly. MPa, and 1/K.
struct Material {
  std::string name;
  double youngs_mpa = 0;
  double poisson = 0;
  double yield_mpa = 0;        ///< 0: never yields
  double hardening_mpa = 0;    ///< growth of the yield stress per unit of plastic strain; 0: ideally plastic
  double expansion_per_k = 0;  ///< 0: not known
};

/// A cylinder of revolution. mm.
struct Ring {
  double inner_diameter = 0;  ///< 0: solid
  double outer_diameter = 0;
  double length = 0;
  Material material;
  double middle = 0;  ///< of its length, along z
};

/// A shaft and the rings that are pressed on it, from the axis outwards. Neighbours have the nominal
/// diameter of their seat in common. The hub and what is pressed on it have their middles at z = 0.
struct Assembly {
  std::vector<Ring> rings;

  /// All middles lie at z = 0, so that one half says everything.
  [[nodiscard]] bool symmetric() const;
};

/// Refuses what is no assembly, with one sentence that names the ring and the number: fewer than two rings,
/// lengths or diameters not above 0 or beyond 10 m, a bore not below the diameter, walls thinner than a
/// hundredth of their diameter or lengths beyond a hundred walls, seats that do not meet, a hub that
/// hangs over an end of a shaft whose middle is elsewhere, numbers of a material that no metal has.
/// ErrorCode::bad_input.
[[nodiscard]] Result<void> check_assembly(const Assembly& assembly);

/// Returns the name of a ring for sentences: "the shaft", "the hub", "ring 2", ...
[[nodiscard]] std::string ring_name(std::size_t ring);

}  // namespace lekalo::fit

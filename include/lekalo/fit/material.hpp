#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "lekalo/fit/assembly.hpp"

namespace lekalo::fit {

/// A metal whose numbers were read in a public source.
struct KnownMaterial {
  std::string_view name;
  double youngs_mpa, poisson, expansion_per_k;
  /// Yield stresses of sections up to a thickness, the thinnest first; beyond the last none is known.
  struct Yield {
    double up_to_mm, yield_mpa;
  };
  std::span<const Yield> yields;
  std::string_view source;  ///< one line that names every number's source
};

/// All that are known, in the order in which they are listed to people.
[[nodiscard]] std::span<const KnownMaterial> known_materials() noexcept;
[[nodiscard]] const KnownMaterial* known_material(std::string_view name) noexcept;

/// Returns the metal as it is in a ring: the yield stress is that of its wall, or of a solid shaft's
/// diameter; 0 where none is known for so thick a section.
[[nodiscard]] Material material_in(const KnownMaterial& known, double inner_diameter, double outer_diameter);

}  // namespace lekalo::fit

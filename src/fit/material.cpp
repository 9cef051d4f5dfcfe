#include "lekalo/fit/material.hpp"

#include <algorithm>
#include <array>

namespace lekalo::fit {
namespace {

constexpr std::array<KnownMaterial::Yield, 3> kC45{{{16, 340}, {100, 305}, {250, 275}}};
constexpr std::array<KnownMaterial::Yield, 1> k6061{{{200, 276}}};

constexpr std::array<KnownMaterial, 2> kKnown{{
    {"C45", 210000, 0.3, 11.5e-6, kC45,
     "normalised; yield: Saarstahl, material specification sheet C45 (EN 10083); E: szrtjs.com 1.0503; "
     "Poisson: AISI "
     "1045, 0.27 to 0.30; expansion 20 to 100 C: ninesteel-cs.com 1.0503"},
    {"6061-T6", 68900, 0.33, 23.6e-6, k6061,
     "typical values; Glemco, Aluminum 6061-T6 (Aluminum Association), and mfgproto.com, Aluminum 6061-T6 "
     "data sheet"},
}};

}  // namespace

std::span<const KnownMaterial> known_materials() noexcept { return kKnown; }

const KnownMaterial* known_material(std::string_view name) noexcept {
  const auto* const at =
      std::find_if(kKnown.begin(), kKnown.end(), [&](const KnownMaterial& m) { return m.name == name; });
  return at == kKnown.end() ? nullptr : at;
}

Material material_in(const KnownMaterial& known, double inner_diameter, double outer_diameter) {
  const double section = inner_diameter > 0 ? (outer_diameter - inner_diameter) / 2 : outer_diameter;
  Material material{std::string(known.name), known.youngs_mpa, known.poisson, 0, 0, known.expansion_per_k};
  for (const KnownMaterial::Yield& y : known.yields)
    if (section <= y.up_to_mm) {
      material.yield_mpa = y.yield_mpa;
      break;
    }
  return material;
}

}  // namespace lekalo::fit

#pragma once

#include <optional>
#include <vector>

#include "lekalo/fit/assembly.hpp"
#include "lekalo/fit/pressing.hpp"

namespace lekalo::fit {

/// Closed forms of rings that are as long as one another, without stress along the axis. They are printed
/// beside what the elements say, and tests hold the elements against them.

/// Radial displacement, mm, at radius r of an elastic ring under pressures inside and outside (Lame). MPa.
[[nodiscard]] double lame_displacement(const Ring& ring, double r, double inside_mpa, double outside_mpa);

/// The pressures of the seats of elastic rings, MPa, for interferences in diameter, mm. Negative where rings
/// would pull. \pre check_assembly() takes it, and there is one interference for each seat
[[nodiscard]] std::vector<double> compound_pressures(const Assembly& assembly,
                                                     const std::vector<double>& interference);

/// One hub on a shaft by the closed form that DIN 7190 uses: Tresca with a yield stress of 2/sqrt(3), plane
/// stress.
struct DinFit {
  State state = State::elastic;
  double pressure_mpa = 0;
  double zeta = 1;              ///< radius up to which the hub yields, by that of the seat
  double hub_outer_growth = 0;  ///< in diameter, mm
};

/// Returns none where the form does not hold: more rings than a hub; beyond the elastic range a hollow shaft,
/// a shaft of other elasticity or that would yield, a hub that hardens or yields through its whole wall.
[[nodiscard]] std::optional<DinFit> din_7190(const Assembly& assembly, double interference);

/// The temperature by which the hub has to be warmer than the shaft for a clearance in diameter, K; none
/// where its expansion is not known.
[[nodiscard]] std::optional<double> shrink_difference(const Ring& hub, double interference, double clearance);

}  // namespace lekalo::fit

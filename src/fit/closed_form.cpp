#include "lekalo/fit/closed_form.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lekalo::fit {

double lame_displacement(const Ring& ring, double r, double inside_mpa, double outside_mpa) {
  const double a = ring.inner_diameter / 2, b = ring.outer_diameter / 2, nu = ring.material.poisson;
  const double ring_area = b * b - a * a;
  const double even = (inside_mpa * a * a - outside_mpa * b * b) / ring_area;
  const double bent = (inside_mpa - outside_mpa) * a * a * b * b / ring_area;
  return ((1 - nu) * even * r + (a > 0 ? (1 + nu) * bent / r : 0.0)) / ring.material.youngs_mpa;
}

std::vector<double> compound_pressures(const Assembly& assembly, const std::vector<double>& interference) {
  // Each seat's overlap is what both surfaces give way; a row has its own pressure and its neighbours'.
  const std::size_t n = interference.size();
  std::vector<double> below(n, 0), own(n, 0), above(n, 0), pressure(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const Ring &inner = assembly.rings[i], &outer = assembly.rings[i + 1];
    const double r = inner.outer_diameter / 2;
    own[i] = lame_displacement(outer, r, 1, 0) - lame_displacement(inner, r, 0, 1);
    if (i > 0) below[i] = -lame_displacement(inner, r, 1, 0);
    if (i + 1 < n) above[i] = lame_displacement(outer, r, 0, 1);
    pressure[i] = interference[i] / 2;
  }
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = below[i] / own[i - 1];
    own[i] -= factor * above[i - 1];
    pressure[i] -= factor * pressure[i - 1];
  }
  for (std::size_t i = n; i-- > 0;)
    pressure[i] = (pressure[i] - (i + 1 < n ? above[i] * pressure[i + 1] : 0.0)) / own[i];
  return pressure;
}

std::optional<DinFit> din_7190(const Assembly& assembly, double interference) {
  if (assembly.rings.size() != 2) return {};
  const Ring &shaft = assembly.rings[0], &hub = assembly.rings[1];
  DinFit fit;
  fit.pressure_mpa = compound_pressures(assembly, {interference})[0];
  fit.hub_outer_growth = 2 * lame_displacement(hub, hub.outer_diameter / 2, fit.pressure_mpa, 0);
  const double q = hub.inner_diameter / hub.outer_diameter;
  const double strength = 2 * hub.material.yield_mpa / std::numbers::sqrt3;
  const double shaft_part = shaft.inner_diameter / shaft.outer_diameter;
  const double shaft_most =
      shaft.material.yield_mpa == 0 ? HUGE_VAL
      : shaft_part == 0             ? shaft.material.yield_mpa
                        : shaft.material.yield_mpa / std::numbers::sqrt3 * (1 - shaft_part * shaft_part);
  const bool hub_elastic = hub.material.yield_mpa == 0 || fit.pressure_mpa <= strength / 2 * (1 - q * q);
  if (hub_elastic) return fit.pressure_mpa <= shaft_most ? std::optional(fit) : std::nullopt;
  const double youngs = hub.material.youngs_mpa;
  if (shaft_part != 0 || shaft.material.youngs_mpa != youngs ||
      shaft.material.poisson != hub.material.poisson || hub.material.hardening_mpa != 0)
    return {};
  fit.zeta = std::sqrt(interference / hub.inner_diameter * youngs / strength);
  if (!(fit.zeta < 1 / q)) return {};
  fit.state = State::plastic;
  fit.pressure_mpa =
      std::min(strength / 2 * (1 + 2 * std::log(fit.zeta) - q * q * fit.zeta * fit.zeta), strength);
  if (!(fit.pressure_mpa <= shaft_most)) return {};
  fit.hub_outer_growth = strength / youngs * fit.zeta * fit.zeta * q * hub.inner_diameter;
  return fit;
}

std::optional<double> shrink_difference(const Ring& hub, double interference, double clearance) {
  if (!(hub.material.expansion_per_k > 0)) return {};
  return (interference + clearance) / (hub.inner_diameter * hub.material.expansion_per_k);
}

}  // namespace lekalo::fit

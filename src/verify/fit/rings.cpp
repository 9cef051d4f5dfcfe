#include "rings.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::verify {

double mean_growth(const CheckedRing& ring, double diameter, double inside, double outside) {
  // u = A r + B / r, with the pressures at both surfaces; B is 0 without a bore.
  const double ri2 = ring.inner * ring.inner / 4, ro2 = ring.outer * ring.outer / 4, r = diameter / 2;
  const double b = ri2 * ro2 * (inside - outside) / (ro2 - ri2) * (1 + ring.poisson) / ring.youngs;
  const double a = (ri2 * inside - ro2 * outside) / (ro2 - ri2) * (1 - ring.poisson) / ring.youngs;
  return 2 * (a * r + b / r);
}

std::optional<CheckedDin> checked_din(const std::vector<CheckedRing>& rings, double interference) {
  if (rings.size() != 2) return {};
  const CheckedRing &shaft = rings[0], &hub = rings[1];
  const double d = hub.inner, q = d / hub.outer, bored = shaft.inner / d;
  const double give = mean_growth(hub, d, 1, 0) - mean_growth(shaft, d, 0, 1);
  const double strength = 2 / std::sqrt(3.0) * hub.yield;
  CheckedDin din{false, interference / give, 0};
  if (din.pressure > (1 - q * q) / 2 * strength) {
    const bool one_metal = shaft.youngs == hub.youngs && shaft.poisson == hub.poisson;
    if (!one_metal || bored > 0 || hub.hardening != 0) return {};
    const double border = interference * hub.youngs / (d * strength);  // the square of zeta
    if (border >= 1 / (q * q)) return {};
    din.yields = true;
    din.pressure = strength * std::min(1.0, (1 + std::log(border) - q * q * border) / 2);
    din.growth = interference * q;
  } else {
    din.growth = mean_growth(hub, hub.outer, din.pressure, 0);
  }
  const double bears = bored > 0 ? (1 - bored * bored) * shaft.yield / std::sqrt(3.0) : shaft.yield;
  if (din.pressure > bears) return {};
  return din;
}

}  // namespace lekalo::verify

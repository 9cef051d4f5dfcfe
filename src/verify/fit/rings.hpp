#pragma once

#include <optional>
#include <vector>

namespace lekalo::verify {

/// Closed forms of pressed rings, by formulas of the checker's own.

struct CheckedRing {
  double inner = 0, outer = 0, length = 0;  ///< diameters and length, mm
  double youngs = 0, poisson = 0, yield = 0, hardening = 0, expansion = 0;
  double middle = 0;  ///< of its length, along the axis, mm
};

/// The mean growth of a diameter of an elastic ring, mm, under mean pressures on its whole inner and outer
/// surface, MPa. By Betti's theorem it is that of even pressures, however these are distributed.
[[nodiscard]] double mean_growth(const CheckedRing& ring, double diameter, double inside, double outside);

/// The words of DIN 7190 on a hub and a shaft: none, where its form does not hold.
struct CheckedDin {
  bool yields = false;
  double pressure = 0, growth = 0;  ///< MPa; of the hub's outer diameter, mm
};
[[nodiscard]] std::optional<CheckedDin> checked_din(const std::vector<CheckedRing>& rings,
                                                    double interference);

}  // namespace lekalo::verify

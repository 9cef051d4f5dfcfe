#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/fit/pressing.hpp"

namespace lekalo::fit {

/// A profile to be turned before pressing, so that a surface is a cylinder after it: docs/design/fit.md,
/// step 12.

enum class Surface : std::uint8_t {
  outside,  ///< of the outermost ring
  bore      ///< of a hollow shaft
};

/// A diameter to be turned at a place along the axis, mm; z from the middle.
struct TurnedPoint {
  double z = 0, diameter = 0;
};

/// How far a diameter varies along its surface, mm: the largest less the smallest.
struct Variation {
  double before = 0;  ///< without the profile
  double after = 0;   ///< pressed again, as turned
};

struct Corrected {
  Surface surface = Surface::outside;
  double nominal = 0;                ///< the diameter that the surface is to have, mm
  std::vector<TurnedPoint> profile;  ///< z >= 0, in whole tenths of a micrometre; straight between its points
  std::vector<Variation> variations;  ///< of each interference
  std::vector<Pressed> pressed;       ///< at each, with the profile
};

/// Turns off what the surface grows at one of the interferences, and presses all of them again with that
/// profile, in their order.
///
/// bad_input where a bore is asked for of a solid shaft, and where pressing again does not leave a cylinder
/// to a micrometre or a twentieth of the variation before. Cost: that of Pressing. \param interferences  of
/// each press() in turn; \param pressed  what it gave; \param at  which of them counts
[[nodiscard]] Result<Corrected> corrected(const Assembly& assembly,
                                          const std::vector<std::vector<double>>& interferences,
                                          const std::vector<Pressed>& pressed, std::size_t at,
                                          Surface surface);

}  // namespace lekalo::fit

#pragma once

#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/fit/pressing.hpp"

namespace lekalo::fit {

/// A profile to be turned before pressing, so that a surface is a cylinder after it: docs/design/fit.md,
/// step 12.

enum class Surface : std::uint8_t {
  outside,  ///< of the outermost ring
  bore,     ///< of a hollow shaft
  seat      ///< of the shaft in the hub
};
[[nodiscard]] std::string_view name_of(Surface surface) noexcept;

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
  double nominal = 0;  ///< the diameter before pressing that a profile changes, mm
  double face = 0;     ///< z of the right face of the part that is turned
  std::vector<TurnedPoint>
      profile;                  ///< as Growth has z; in whole tenths of a micrometre, straight between points
  std::vector<double> growths;  ///< of each point, mm, at the interference that counts, with the profile
  std::vector<Variation> variations;  ///< of each interference
  std::vector<Pressed> pressed;       ///< at each, with the profile
};

/// Turns off what the surface grows at one of the interferences, and presses all of them again with that
/// profile, in their order. The seat's profile changes the pressure: it is such that the hub's bore stays a
/// cylinder that has grown by what it grew in the mean, which takes the same pressure while the hub is
/// elastic.
///
/// bad_input where a bore is asked for of a solid shaft, and where pressing again does not leave a cylinder
/// to a micrometre or a twentieth of the variation before. Cost: that of Pressing. \param interferences  of
/// each press() in turn; \param pressed  what it gave; \param at  which of them counts; \param seat_diameter
/// the shaft's before pressing, mm, which is of use for the seat alone
[[nodiscard]] Result<Corrected> corrected(const Assembly& assembly,
                                          const std::vector<std::vector<double>>& interferences,
                                          const std::vector<Pressed>& pressed, std::size_t at,
                                          Surface surface, double seat_diameter = 0);

}  // namespace lekalo::fit

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lekalo::verify {

/// A turned profile from the right end of a part to its left one: z from the middle, and a diameter; mm.
struct ProfilePoint {
  double z = 0, diameter = 0;
};

/// The surface that is turned.
enum class TurnedSurface : std::uint8_t { outside, bore, seat };

/// The claims about a turning program. Z0 is the right face of the part, whose place from the middle is
/// `face`.
struct TurningClaim {
  bool fanuc = false, radius = false;
  TurnedSurface surface = TurnedSurface::outside;
  double feed = 0, spindle = 0, face = 0;
};

/// Each says why a file is not that profile, and none where it is, to half of its last decimal.
[[nodiscard]] std::optional<std::string> fault_of_profile_table(std::string_view text,
                                                                const std::vector<ProfilePoint>& profile);
[[nodiscard]] std::optional<std::string> fault_of_profile_drawing(std::string_view text,
                                                                  const std::vector<ProfilePoint>& profile);
/// The program follows the whole profile once, from 1 mm before the right face to 1 mm behind the left one,
/// with feed and spindle as claimed, in the modes that it says; rapid motions are before the face, or off the
/// surface along X. Onto a seat, beside which the shaft goes on, the tool is fed along X, and off it too.
/// Words that lekalo does not write there are a fault.
[[nodiscard]] std::optional<std::string> fault_of_turning(std::string_view text,
                                                          const std::vector<ProfilePoint>& profile,
                                                          const TurningClaim& claim);

}  // namespace lekalo::verify

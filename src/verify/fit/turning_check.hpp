#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lekalo::verify {

/// A turned profile from the right end of a part to its left one: z from the middle, and a diameter; mm.
struct ProfilePoint {
  double z = 0, diameter = 0;
};

/// The claims about a turning program.
struct TurningClaim {
  bool fanuc = false, radius = false, bore = false;
  double feed = 0, spindle = 0;
};

/// Each says why a file is not that profile, and none where it is, to half of its last decimal.
[[nodiscard]] std::optional<std::string> fault_of_profile_table(std::string_view text,
                                                                const std::vector<ProfilePoint>& profile);
[[nodiscard]] std::optional<std::string> fault_of_profile_drawing(std::string_view text,
                                                                  const std::vector<ProfilePoint>& profile);
/// The program follows the whole profile once, from 1 mm before the right face to 1 mm behind the left one,
/// with feed and spindle as claimed, in the modes that it says; rapid motions are before the face, or off the
/// surface along X. Words that lekalo does not write there are a fault.
[[nodiscard]] std::optional<std::string> fault_of_turning(std::string_view text,
                                                          const std::vector<ProfilePoint>& profile,
                                                          const TurningClaim& claim);

}  // namespace lekalo::verify

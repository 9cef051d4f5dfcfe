#pragma once

#include <string>
#include <vector>

#include "lekalo/fit/corrected.hpp"

namespace lekalo::fit {

/// A whole profile as files: from one end of the part to the other, the middle at z = 0.

/// "z_mm,diameter_mm" and a row for each point.
[[nodiscard]] std::string profile_csv(const Corrected& corrected);

/// A DXF (R12) with one open polyline in mm on the layer PROFILE: x along the axis, y the radius.
[[nodiscard]] std::string profile_dxf(const Corrected& corrected);

enum class Lathe : std::uint8_t { linuxcnc, fanuc };

struct TurningWords {
  Lathe control = Lathe::linuxcnc;
  bool radius = false;  ///< X is a radius, not a diameter
  double feed_mm_per_min = 50;
  double spindle_rpm = 1000;
};

/// The finishing cut along the profile: G18, Z0 at the right face of the part, from there to the left. X is a
/// diameter (LinuxCNC: G7) or a radius (G8); Fanuc has no word for it, so that a comment says it. LinuxCNC
/// also gets G61, since blending cuts corners where the tool leaves a seat. The tool
/// comes from 1 mm before the face and goes off by 1 mm, outwards or into the bore. Onto a seat it comes
/// along X, and off it too: beside a seat the shaft goes on. Coordinates have 4 decimals.
[[nodiscard]] std::string turning_program(const Corrected& corrected, const TurningWords& words);

}  // namespace lekalo::fit

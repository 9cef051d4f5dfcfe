#pragma once

#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"

namespace lekalo::fit {

/// Limits of ISO 286 for sizes up to 500 mm: grades IT01 to IT18, holes A to ZC and shafts a to zc. Sources:
/// docs/design/fit.md, "Limits"; every entry stands in two public tables, which the test names.

/// Deviations of a size from the nominal one, um.
struct Limits {
  double lower_um = 0, upper_um = 0;
};

/// Returns the limits of a class ("H8", "z8", "js01") at a size. bad_input with one sentence for a class or
/// size that the tables do not have, with the way out. \param diameter_mm  above 0 to 500
[[nodiscard]] Result<Limits> limits_of(double diameter_mm, std::string_view tolerance_class);

/// A hole and a shaft of one nominal diameter.
struct NamedFit {
  double diameter_mm = 0;
  std::string hole, shaft;  ///< "H8", "z8"
  Limits hole_limits, shaft_limits;
  /// The difference of the diameters; negative where it is clearance.
  double least_um = 0, greatest_um = 0;
};

/// Reads "18H8/z8". Errors are those of limits_of, or name the part that is not read.
[[nodiscard]] Result<NamedFit> read_fit(std::string_view text);

}  // namespace lekalo::fit

#pragma once

#include <array>
#include <string>
#include <vector>

#include "lekalo/verify/cut_history.hpp"
#include "verify/heat/cut_work.hpp"

namespace lekalo::verify {

/// Temperatures that were measured while a program ran, by the checker's own formulas (step 12 of
/// docs/design/heat-walls.md).

struct CheckedMeasurement {
  double celsius = 0, uncertainty = 0;  ///< K
  std::array<double, 3> at{};           ///< mm
  double seconds = 0;
  std::vector<double> rises;  ///< of each case, if all of the middle work were heat, K
};

/// Says in a few words why nothing can be measured at that place then; empty where it can.
/// \param top  Z of the stock's upper face, mm
[[nodiscard]] std::string no_place_for(const CheckedMeasurement& m, const CutHistory& history,
                                       const CheckedStock& stock, double diameter, double top);

/// The heat that a measurement supports, J: what makes the place as warm with some film.
/// \pre all rises are above 0
[[nodiscard]] CheckedRange supported_heat(const CheckedMeasurement& m, double ambient, double middle_work);

}  // namespace lekalo::verify

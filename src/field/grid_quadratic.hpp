#pragma once

#include <array>

#include "lekalo/field/grid.hpp"

namespace lekalo::field {

// Bounds on FLOZ's first four derivatives along any line, relative to its value, times the distance from the
// segment's middle to the same power, where that is at least kFarLengths lengths. FLOZ of any segment is that
// of one of length 1, scaled, so that a table of directions and distances is all of them.
inline constexpr double kFarLengths = 1.5;
inline constexpr std::array<double, 4> kFarDerivatives{2.3, 3.6, 1.9, 10.2};

// In the derivatives of q = (a and b), r^2 = a^2 + b^2, the factor a^2 b^2 / (r^3 q) is at most kMixing, and
// kMixingSlope times the lesser of a / b and b / a.
inline constexpr double kMixing = 0.604, kMixingSlope = 1.05;
// All four held by tests/property/field_quadratic_test.cpp.

/// The quadratic conjunction at every node, signed; how: grid_quadratic.cpp. \pre grid has its frame and room
void sample_quadratic(const ContourModel& model, unsigned threads, FieldGrid& grid);

}  // namespace lekalo::field

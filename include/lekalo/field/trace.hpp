#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "lekalo/field/r_function.hpp"

namespace lekalo::field {

using Function = std::function<Jet(geom::Point)>;

/// The source's path: steps of one length perpendicular to the gradient, counter-clockwise about the peak.
/// Every step leaves the level line outwards by half its square over the line's radius, so that a turn ends
/// pi times the step farther out whatever its size: the step sets the spacing. Ends before the function is
/// 0 or less, where the gradient vanishes, or after `most` places. \pre step > 0
[[nodiscard]] std::vector<geom::Point> gradient_spiral(const Function& f, geom::Point start, double step,
                                                       std::size_t most = 100'000);

/// A place where f is largest about `start`: steps along the gradient, halved as they overshoot, until they
/// are shorter than `tolerance`.
[[nodiscard]] geom::Point peak_of(const Function& f, geom::Point start, double step, double tolerance);

}  // namespace lekalo::field

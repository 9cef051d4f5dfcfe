#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "lekalo/field/r_function.hpp"

namespace lekalo::field {

using Function = std::function<Jet(geom::Point)>;

/// The level line of f through `start`, counter-clockwise about higher values, in steps no longer than
/// `longest`: a step of an embedded Runge-Kutta pair (Bogacki & Shampine, 3(2)), then back to the level along
/// the gradient. Ends where it closes (the first place again, as the last), after `most` places, or where the
/// gradient vanishes.
/// Error: every place is within `tolerance` mm of the level, measured as |f - level| / |gradient|, and a step
/// deviates from the line by no more, as the pair estimates. \pre tolerance > 0, longest > 0
[[nodiscard]] std::vector<geom::Point> level_line(const Function& f, geom::Point start, double longest,
                                                  double tolerance, std::size_t most = 100'000);

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

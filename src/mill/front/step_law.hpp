#pragma once

#include "lekalo/mill/straight_pass.hpp"

/// How far a pass may lie from the one before: exact for two circles, docs/design/pocket.md.
namespace lekalo::mill {

/// What the next pass is to hold, of the angle of a straight one: a little more, for it is seldom as deep.
constexpr double kNext = 1.0134;

/// The step from a pass of convex radius r0 to the next about the same centre for which the rim's arc in
/// material spans the angle of that cosine: (r0 + r)^2 = r1^2 + r^2 + 2 r1 r cosine, step = r1 - r0.
/// \pre r0 >= 0, r > 0, (r0 + r)^2 >= r^2 (1 - cosine^2)
[[nodiscard]] double step_for(double r0, double r, double cosine);

}  // namespace lekalo::mill

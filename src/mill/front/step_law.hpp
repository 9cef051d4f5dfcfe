#pragma once

#include "lekalo/mill/straight_pass.hpp"

/// The distance at which a pass may follow another: exact for two circles (docs/design/pocket.md, step 2).
namespace lekalo::mill {

/// The share of a straight pass's angle that the next pass is to hold: a little more than all of it, because
/// a pass is seldom as deep as it may be.
constexpr double kNext = 1.0134;

/// The step from a pass of convex radius r0 to the next about the same centre for which the rim's arc in
/// material spans the angle of that cosine: (r0 + r)^2 = r1^2 + r^2 + 2 r1 r cosine, step = r1 - r0.
/// \pre r0 >= 0, r > 0, (r0 + r)^2 >= r^2 (1 - cosine^2)
[[nodiscard]] double step_for(double r0, double r, double cosine);

}  // namespace lekalo::mill

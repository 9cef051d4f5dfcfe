#pragma once

/// How far a pass may lie from the one before: exact for two circles, docs/design/pocket.md.
namespace lekalo::mill {

/// The step from a pass of convex radius r0 to the next about the same centre for which the rim's arc in
/// material spans the angle of that cosine: (r0 + r)^2 = r1^2 + r^2 + 2 r1 r cosine, step = r1 - r0.
/// \pre r0 >= 0, r > 0, (r0 + r)^2 >= r^2 (1 - cosine^2)
[[nodiscard]] double step_for(double r0, double r, double cosine);

/// The longest way along a straight wall, from where a pass came in on a fillet of radius `fillet` tangent to
/// it, after which the rim's arc in material (from the wall on) spans no more than kWallAngle.
[[nodiscard]] double step_along_wall(double fillet, double r);
/// The least fillet that allows this step along a wall.
[[nodiscard]] double fillet_for(double step, double r);

}  // namespace lekalo::mill

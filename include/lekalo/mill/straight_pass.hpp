#pragma once

/// What the rim of the tool meets on a straight pass: the measure of all others.
namespace lekalo::mill {

/// Beside a straight pass, radians: acos(1 - 2 step_over). \param step_over  of the diameter, in (0, 0.5]
[[nodiscard]] double straight_pass_angle(double step_over);

/// Degrees of the rim above which a stretch outside entries is too hot: 1.25 straight passes.
[[nodiscard]] double most_held_degrees(double step_over);

}  // namespace lekalo::mill

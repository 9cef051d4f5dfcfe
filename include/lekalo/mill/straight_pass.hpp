#pragma once

/// The angle of the rim that is in material on a straight pass: the measure of all other stretches.
namespace lekalo::mill {

/// The angle of a straight pass beside another one, radians: acos(1 - 2 step_over). \param step_over  of the
/// diameter, in (0, 0.5]
[[nodiscard]] double straight_pass_angle(double step_over);

/// Degrees of the rim above which a stretch outside entries is too hot: 1.25 straight passes.
[[nodiscard]] double most_held_degrees(double step_over);

}  // namespace lekalo::mill

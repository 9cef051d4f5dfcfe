#pragma once

#include "shape.hpp"

namespace lekalo::verify {

/// How far a placed part sticks out of its blank: the largest distance of a point of the part from the
/// blank's outline, of the points that are not in the blank; 0 when there are none. Both enclosed, between
/// the two ends of the result; about `tolerance` apart, or what 20,000 pieces tell.
///
/// The largest is found on the part's outline, or inside it where the distance has a local maximum: there the
/// nearest points of the blank are not all to one side. So the outline is bisected, each piece bounded by its
/// largest distance from any one side of the blank, and the inside is searched by squares that may hold such
/// a maximum.
[[nodiscard]] Span sticking_out(const Shape& placed_part, const Shape& blank, double tolerance);

}  // namespace lekalo::verify
